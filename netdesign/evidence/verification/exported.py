"""Three solved scenes in a form that another finite element code can run.

Each is a legacy VTK file (mesh of six-node triangles, density, boundaries, the snow's
nodal forces on the net) and a text of the equations with what is to come out.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib.resources import files
from typing import Any

import numpy as np

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.evidence.scene import build_scene, solve
from netdesign.evidence.verification.case import Found, VerificationCase, judge
from netdesign.numerics.arrays import Floats, Ints
from netdesign.snow.creep_law import (
    ICE_DENSITY,
    compute_bulk_factor,
    compute_shear_factor,
)
from netdesign.snow.ground import GroundKind, GroundLaw
from netdesign.snow.snowpack import GRAVITY

_QUADRATIC_TRIANGLE, _QUADRATIC_EDGE = 22, 21  # cell types of VTK
_GROUND, _NET, _SURFACE, _UPSLOPE = 1, 2, 3, 4  # boundaries
_ACCURACY = 0.002
_ON_SIDE = 1e-9  # of the thickness


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportedScene:
    """One scene whose snow sticks to its net: the flow alone can be run again.

    Attributes
    ----------
    name, about : str
        Of its files; what it is.
    solution : Solution
        As this program solved it.
    """

    name: str
    about: str
    solution: Solution

    @property
    def resultant(self) -> tuple[float, float]:
        """Force of the snow on the net [N/m]."""
        x, y = self.solution.net_forces.sum(axis=1)
        return float(x), float(y)

    @property
    def moment(self) -> float:
        """Its moment about the foot, positive where it tips the head downslope."""
        (x, y), (force_x, force_y) = self.solution.net_curve, self.solution.net_forces
        return float((y * force_x - x * force_y).sum())


@lru_cache(maxsize=1)
def _load_tables() -> dict[str, Any]:
    text = files(__package__).joinpath("another_code.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


@lru_cache(maxsize=1)
def solve_exported() -> tuple[ExportedScene, ...]:
    """The three scenes, solved; their snow sticks to the net (friction of 60 degrees).

    Raises
    ------
    SolveError
        If one has no solution.
    """
    return tuple(map(_solve, _load_tables()["scene"]))


def _solve(table: dict[str, Any]) -> ExportedScene:
    scene = build_scene(
        *table["layers"],
        slope=table["slope_deg"],
        length=16.0,
        ground=GroundLaw(kind=table["ground"]),
        lean=table["inclination_deg"],
        friction=60.0,
        slack=0.03,
    )
    solution = solve(scene, SolverSettings(accuracy=_ACCURACY))
    return ExportedScene(name=table["name"], about=table["about"], solution=solution)


def list_files() -> list[str]:
    """Names of the files of all scenes."""
    names = [table["name"] for table in _load_tables()["scene"]]
    return [f"{name}.{kind}" for name in names for kind in ("vtk", "txt")]


def write_scenes(scenes: Sequence[ExportedScene]) -> dict[str, bytes]:
    """Contents of the files of all scenes, by their names."""
    files = {}
    for scene in scenes:
        files[f"{scene.name}.vtk"] = write_vtk(scene)
        files[f"{scene.name}.txt"] = describe_scene(scene)
    return files


def write_vtk(scene: ExportedScene) -> bytes:
    """Mesh, density, boundaries and forces on the net, as legacy VTK in ASCII.

    Parameters
    ----------
    scene : ExportedScene
        As solved.
    """
    solution = scene.solution
    nodes, triangles = solution.mesh_nodes, _list_triangles(solution)
    edges, sides = _list_boundary(solution)
    cells = [("6", row) for row in triangles.T] + [("3", row) for row in edges.T]
    forces = _place_forces(solution, edges, sides)
    size = 7 * triangles.shape[1] + 4 * edges.shape[1]
    tags = np.concatenate([np.zeros(triangles.shape[1], dtype=int), sides])
    density = np.concatenate([solution.mesh_density, np.zeros(edges.shape[1])])
    lines = [
        "# vtk DataFile Version 3.0",
        f"netdesign {scene.name}: lengths in m, X downslope, Y normal to the slope",
        "ASCII",
        "DATASET UNSTRUCTURED_GRID",
        f"POINTS {nodes.shape[1]} double",
        *(f"{x:.12g} {y:.12g} 0" for x, y in nodes.T),
        f"CELLS {len(cells)} {size}",
        *(f"{count} {' '.join(map(str, row))}" for count, row in cells),
        f"CELL_TYPES {len(cells)}",
        *([str(_QUADRATIC_TRIANGLE)] * triangles.shape[1]),
        *([str(_QUADRATIC_EDGE)] * edges.shape[1]),
        f"CELL_DATA {len(cells)}",
        *_write_scalars("density_kg_m3", "double", density),
        *_write_scalars("boundary", "int", tags),
        f"POINT_DATA {nodes.shape[1]}",
        "VECTORS force_on_net_N_per_m double",
        *(f"{x:.10g} {y:.10g} 0" for x, y in forces.T),
    ]
    return ("\n".join(lines) + "\n").encode("ascii")


def _write_scalars(name: str, kind: str, values: Floats | Ints) -> list[str]:
    shown = [f"{value:.10g}" for value in values.tolist()]
    return [f"SCALARS {name} {kind} 1", "LOOKUP_TABLE default", *shown]


def _list_triangles(solution: Solution) -> Ints:
    """Nodes of the triangles in the order of VTK: corners, then 12, 23, 31."""
    corners, edges = solution.mesh_triangles, np.sort(solution.mesh_edges, axis=0)
    vertices = solution.mesh_nodes.shape[1] - edges.shape[1]
    keys = vertices * edges[0] + edges[1]
    order = np.argsort(keys)
    low, high = np.sort([corners, np.roll(corners, -1, axis=0)], axis=0)
    places = np.searchsorted(keys, vertices * low + high, sorter=order)
    return np.vstack([corners, vertices + order[places]])


def _list_boundary(solution: Solution) -> tuple[Ints, Ints]:
    """Edges of one triangle only, with the number of their side."""
    nodes, pack = solution.mesh_nodes, solution.scene.snowpack
    middles, counts = np.unique(_list_triangles(solution)[3:], return_counts=True)
    outer = middles[counts == 1]
    vertices = nodes.shape[1] - solution.mesh_edges.shape[1]
    found = np.vstack([solution.mesh_edges[:, outer - vertices], outer])
    x, y = nodes[:, outer]
    near = _ON_SIDE * pack.thickness
    sides = np.full(outer.size, _NET)
    sides[y < near] = _GROUND
    sides[y > pack.thickness - near] = _SURFACE
    sides[x < -pack.upslope_length + near] = _UPSLOPE
    return found, sides


def _place_forces(solution: Solution, edges: Ints, sides: Ints) -> Floats:
    """Forces of the net's nodes on all nodes of the mesh, zero elsewhere.

    The net's curve is that of the last round, the mesh's that of the round before:
    nodes are matched by their order from the foot, not by their places.
    """
    forces = np.zeros_like(solution.mesh_nodes)
    nodes = np.unique(edges[:, sides == _NET])
    nodes = nodes[np.argsort(solution.mesh_nodes[1, nodes])]
    forces[:, nodes] = solution.net_forces[:, : nodes.size]
    return forces


def _describe_layers(scene: Scene) -> str:
    """Line of each layer: its top, density, and factors of the law."""
    law, tops = scene.creep_law, np.cumsum([one.thickness for one in scene.layers])
    return "\n".join(
        f"  up to Y = {top:.6g} m: density {layer.density:.6g} kg/m3, "
        f"a = {compute_shear_factor(law, layer.density / ICE_DENSITY):.8g}, "
        f"b = {compute_bulk_factor(law, layer.density / ICE_DENSITY):.8g}"
        for top, layer in zip(tops, scene.layers, strict=True)
    )


def describe_scene(scene: ExportedScene) -> bytes:
    """Equations, numbers and what this program found, as a text.

    Parameters
    ----------
    scene : ExportedScene
        As solved.
    """
    solution = scene.solution
    pack, law = solution.scene.snowpack, solution.scene.creep_law
    x, y = scene.resultant
    text = f"""netdesign {scene.name}: {scene.about}

Plane strain, quasi-static, per metre of width. X along the slope, positive downslope;
Y normal to it, positive upwards. Unknown: velocity v on the mesh of {scene.name}.vtk.

  div sigma + rho g = 0,  g = {GRAVITY} m/s2 (sin psi, -cos psi),  \
psi = {math.degrees(pack.slope_angle):g} degrees
  eps = sym grad v,  e = eps - (tr eps / 3) I in three dimensions (e_zz = -tr eps / 3)
  eps_D^2 = (2/a) e:e + (1/b) (tr eps)^2
  sigma = B^(-1/n) eps_D^((1-n)/n) [ (2/a) e + (1/b) (tr eps) I ],  n = {law.exponent:g}
  B any positive number: stresses do not depend on it.

Snow, cut at constant Y (cell data density_kg_m3):
{_describe_layers(solution.scene)}

Boundaries (cell data boundary):
  1 ground: {_describe_ground(solution.scene.ground.kind)}
  2 net, at rest, snow sticks to it: v = 0
  3 surface and 4 upslope end: sigma . n = 0

What this program found (steady state; the net's curve is the mesh's boundary 2):
  force of the snow on the net, X: {x / 1e3:.5g} kN/m
  force of the snow on the net, Y: {y / 1e3:.5g} kN/m
  its moment about the net's foot, y F_x - x F_y: {scene.moment / 1e3:.5g} kN m/m
  nodal forces: point data force_on_net_N_per_m
  the net alone: stiffness ES = {_net(solution).stiffness_per_m / 1e3:g} kN/m,
  unstressed length (1 + {_net(solution).slack:g}) times its chord;
  under these forces it hangs as boundary 2 does, with pulls on its ends of
  foot ({solution.foot.x / 1e3:.5g}, {solution.foot.y / 1e3:.5g}) kN/m, \
head ({solution.head.x / 1e3:.5g}, {solution.head.y / 1e3:.5g}) kN/m
  stated errors of the pulls: {solution.foot.error / 1e3:.2g} and \
{solution.head.error / 1e3:.2g} kN/m

Stresses are singular at both ends of the net: grade the mesh towards them.
"""
    return text.encode("ascii")


def _net(solution: Solution) -> Net:
    net = solution.scene.net
    if not isinstance(net, Net):
        raise TypeError(net)
    return net


def _describe_ground(kind: GroundKind) -> str:
    return "v = 0" if kind == "no-slip" else "v_y = 0, no shear stress"


_WITHIN = 1e-3  # of the whole force or moment: stated errors of this program


@dataclass(frozen=True, slots=True, kw_only=True)
class OtherResult:
    """Result of another code for one scene [kN/m, kN m/m]."""

    code: str
    recipe: str
    scene: str
    force_x: float
    force_y: float
    moment: float
    uncertainty_force: float
    uncertainty_moment: float

    @property
    def force(self) -> float:
        """Size of the force [kN/m]."""
        return math.hypot(self.force_x, self.force_y)


@lru_cache(maxsize=1)
def load_results() -> tuple[OtherResult, ...]:
    """Stored results of all codes."""
    return tuple(
        OtherResult(code=code["name"], recipe=code["recipe"], **result)
        for code in _load_tables()["code"]
        for result in code["result"]
    )


def list_another_code() -> list[VerificationCase]:
    """Force and moment on the net of each exported scene."""
    scenes = {scene.name: scene for scene in solve_exported()}
    return [
        case
        for other in load_results()
        for case in _compare(scenes[other.scene], other)
    ]


def _compare(scene: ExportedScene, other: OtherResult) -> list[VerificationCase]:
    x, y = scene.resultant
    of_force = other.uncertainty_force + _WITHIN * other.force
    of_moment = other.uncertainty_moment + _WITHIN * other.moment
    rows = {
        "force-x": (x, other.force_x, of_force),
        "force-y": (y, other.force_y, of_force),
        "moment": (scene.moment, other.moment, of_moment),
    }
    name = f"another-code-{scene.name}"
    found = {
        f"{name}-{part}": Found(got / 1e3, expected)
        for part, (got, expected, _) in rows.items()
    }
    return [
        replace(case, tolerance=allowed / abs(case.expected))
        for case, (*_, allowed) in zip(judge(found), rows.values(), strict=True)
    ]
