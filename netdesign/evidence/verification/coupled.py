"""Snow and net together: two codes, invariants, limits, orders."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from netdesign.coupling.interface import compute_support_forces
from netdesign.coupling.scene import MESH_LEVELS, Scene, SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.evidence.scene import build_scene, solve, solve_wall
from netdesign.evidence.verification.case import (
    Found,
    VerificationCase,
    judge,
    largest_difference,
    observe_order,
)
from netdesign.snow.flow import solve_flow
from netdesign.snow.ground import GroundKind, GroundLaw
from netdesign.snow.kernel import assemble_stress
from netdesign.snow.law import FlowProblem
from netdesign.snow.mesh import MeshSize, build_template, place_nodes
from netdesign.snow.placed_mesh import build_placed_mesh

# Tight, without the coarsest level: verification looks at what the default
# leaves out for speed.
_LEVELS = MESH_LEVELS[1:]
_SETTINGS = SolverSettings(
    accuracy=0.01, stress_tolerance=1e-9, shape_tolerance=1e-8, levels=_LEVELS
)
_LAYERS = ((1.2, 400.0), (1.0, 320.0), (0.8, 240.0))  # m, kg/m3, from the ground


def build_paper_scene(
    *,
    inclination: float = 30.0,
    friction: float = 30.0,
    ground: GroundKind = "free",
    stiffness: float = 2e7,
    size: float = 1.0,
    density: float = 366.8,
) -> Scene:
    """Scene of the source paper, its lengths times ``size``; degrees, N/m, kg/m3."""
    return build_scene(
        (4.0 * size, density),
        slope=40.0,
        length=20.0 * size,
        ground=GroundLaw(kind=ground),
        lean=inclination,
        friction=friction,
        stiffness=stiffness,
    )


def list_reference() -> list[VerificationCase]:
    """Tensions and sag of the source paper's scene against two other codes."""
    found: dict[str, float] = {}
    for inclination in (0, 30):
        solution = _solve(build_paper_scene(inclination=float(inclination)))
        found |= {
            f"reference-{inclination}-foot": solution.foot.size / 1e3,
            f"reference-{inclination}-head": solution.head.size / 1e3,
            f"reference-{inclination}-sag": solution.sag,
        }
    return judge(found)


def list_layered() -> list[VerificationCase]:
    """End tensions of layered snow against another code."""
    found = {}
    grounds: tuple[GroundKind, ...] = ("no-slip", "free")
    for ground in grounds:
        solution = _solve(_build_layered_scene(ground))
        found[f"layered-{ground}-foot"] = solution.foot.size / 1e3
        found[f"layered-{ground}-head"] = solution.head.size / 1e3
    return judge(found)


def list_invariants() -> list[VerificationCase]:
    """Invariants: they hold whatever the numbers are."""
    base = build_paper_scene()
    reference = _solve(base)
    balance = max(
        _balance_along_slope(friction) for friction in (0.0, 10.0, 20.0, 45.0)
    )
    scaled = _solve(build_paper_scene(size=2.0, stiffness=8e7, density=366.8))
    warm = _solve(replace(base, fluidity=7.0 * base.creep_fluidity))
    foot, velocity = reference.foot.size, reference.largest_velocity
    return judge(
        {
            "balance-along-slope": balance,
            "load-equals-weight": _load_error(),
            "rotation-of-axes": _rotation(),
            "mirror-image": _mirror(),
            "similarity": Found(scaled.foot.size, 4.0 * foot),
            "fluidity-leaves-forces": Found(warm.foot.size, foot),
            "fluidity-scales-velocity": Found(warm.largest_velocity, 7.0 * velocity),
        }
    )


def list_limits() -> list[VerificationCase]:
    """Ends of the parameter ranges."""
    smooth = _solve(build_paper_scene(friction=0.0))
    stiff = _solve(build_paper_scene(ground="no-slip", stiffness=1e13, inclination=0.0))
    held = solve_wall(build_paper_scene(ground="no-slip", inclination=0.0), _SETTINGS)
    sticks = [
        _solve(build_paper_scene(inclination=0.0, friction=phi)) for phi in (15.0, 45.0)
    ]
    return judge(
        {
            "no-friction-uniform-tension": Found(smooth.head.size, smooth.foot.size),
            "stiff-net-rigid-wall": Found(stiff.foot.x + stiff.head.x, held.force.x),
            "sticking-friction-is-enough": Found(
                sticks[1].foot.size, sticks[0].foot.size
            ),
        }
    )


def list_numerics() -> list[VerificationCase]:
    """Two elements and two stress floors give the same forces."""
    coarse, fine = _floor_forces(1e-3), _floor_forces(5e-4)
    return judge(
        {
            "two-elements-agree": _mixed_over_velocity(),
            "stress-floor-does-not-matter": Found(fine, coarse),
        }
    )


def list_orders() -> list[VerificationCase]:
    """End tensions over nested meshes; the finest stands for the truth."""
    nested = [replace(MESH_LEVELS[1], subdivisions=times) for times in (0, 1, 2)]
    found = {}
    for name, friction in (("order-sticking", 45.0), ("order-sliding", 10.0)):
        scene = build_paper_scene(friction=friction)
        tensions = [_tension_on_level(scene, size) / 1e3 for size in nested]
        errors = [abs(tension / tensions[-1] - 1.0) for tension in tensions[:-1]]
        order = observe_order([1.0, 0.5], errors)
        found[name] = Found(tensions[-2], tensions[-1], order)
    return judge(found)


def _build_layered_scene(ground: GroundKind) -> Scene:
    """Scenes LA and LB: 3 m of three layers, 38 degrees."""
    law = GroundLaw(kind=ground)
    return build_scene(*_LAYERS, slope=38.0, length=20.0, ground=law, slack=0.03)


def _solve(scene: Scene, settings: SolverSettings = _SETTINGS) -> Solution:
    return solve(scene, settings)


def _balance_along_slope(friction: float) -> float:
    solution = _solve(build_paper_scene(friction=friction))
    weight = solution.balance.weight_along_slope
    return abs(solution.foot.x + solution.head.x - weight) / weight


def _tension_on_level(scene: Scene, level: MeshSize) -> float:
    """Foot tension on one mesh level; the estimate needs a second, coarse one."""
    settings = replace(_SETTINGS, accuracy=0.1, levels=(MESH_LEVELS[0], level))
    return _solve(scene, settings).foot.size


def _load_error() -> float:
    """Largest relative error of the total load; the snow ends in a parabola."""
    bulge = 0.1
    errors = []
    for level in MESH_LEVELS:
        template = build_template(5.0, level)
        heights = template.net_fractions
        curve = np.array([4.0 * bulge * heights * (1.0 - heights), heights])
        mesh = build_placed_mesh(template, place_nodes(template, curve))
        errors.append(abs(float(mesh.load.sum()) / mesh.area - 1.0))
        # Simpson's rule is exact for the pieces of one parabola
        exact = 5.0 + 2.0 / 3.0 * bulge
        errors.append(abs(mesh.area / exact - 1.0))
    return max(errors)


def _kernel_forces(turn: np.ndarray, *, is_mirror: bool = False) -> np.ndarray:
    """Nodal forces (2, n) of one stress field on a mesh moved by ``turn``, moved back.

    The stress is that of a fixed velocity field, moved along with the mesh.
    """
    template = build_template(2.0, _LEVELS[0])
    heights = template.net_fractions
    curve = np.array([0.2 * heights * (1.0 - heights) + 0.3 * heights, heights])
    nodes = place_nodes(template, curve)
    if is_mirror:
        template = replace(template, orientation=-template.orientation)
    mesh = build_placed_mesh(template, turn @ nodes)
    x, y = nodes
    stress_of = np.array([[1.0, 0.3], [0.3, -0.7]])
    moved = turn @ stress_of @ turn.T
    plane = np.array([moved[0, 0], moved[1, 1], moved[0, 1]])
    amplitude = np.cos(x + 2.0 * y)
    at_points = amplitude[template.triangles.T].mean(axis=1)
    field = at_points[:, None, None] * np.ones((*mesh.weights.shape, 3)) * plane
    forces = mesh.to_slope_axes(assemble_stress(mesh, field))
    return np.asarray(turn.T @ forces)


def _rotation() -> float:
    angle = 0.7
    cosine, sine = math.cos(angle), math.sin(angle)
    turn = np.array([[cosine, -sine], [sine, cosine]])
    return largest_difference(_kernel_forces(turn), _kernel_forces(np.eye(2)))


def _mirror() -> float:
    turn = np.diag([-1.0, 1.0])
    mirrored = _kernel_forces(turn, is_mirror=True)
    return largest_difference(mirrored, _kernel_forces(np.eye(2)))


def _flow_resultant(law: FlowProblem) -> float:
    """Size of the snow's force on a straight net of the reference scene."""
    template = build_template(5.0, _LEVELS[1])
    heights = template.net_fractions
    straight = np.array([math.tan(math.radians(30.0)) * heights, heights])
    mesh = build_placed_mesh(template, place_nodes(template, straight), law.element)
    flow = solve_flow(law, mesh, tolerance=1e-9)
    forces = compute_support_forces(law, mesh, flow.state).on_net
    return float(np.abs(forces).sum())


def _floor_forces(floor: float) -> float:
    law = build_paper_scene(ground="no-slip").flow_problem
    return _flow_resultant(replace(law, stress_floor=floor))


def _mixed_over_velocity() -> float:
    law = build_paper_scene(ground="no-slip").flow_problem
    return _flow_resultant(replace(law, element="mixed")) / _flow_resultant(law)
