"""Snow and net together: two codes, invariants, limits, orders."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from netdesign.coupling.interface import compute_support_forces
from netdesign.coupling.scene import MESH_LEVELS, Scene, SolverSettings
from netdesign.coupling.solution import FailedSolution, Solution, WallSolution
from netdesign.coupling.steady.rigid import solve_rigid
from netdesign.evidence.scene import build_scene, solve
from netdesign.evidence.verification.case import (
    VerificationCase,
    expect_zero,
    largest_difference,
    observe_order,
)
from netdesign.outcome import SolveError
from netdesign.snow.flow import solve_flow
from netdesign.snow.ground import GroundKind, GroundLaw
from netdesign.snow.kernel import assemble_stress
from netdesign.snow.law import FlowProblem
from netdesign.snow.mesh import MeshSize, build_template, place_nodes
from netdesign.snow.placed_mesh import build_placed_mesh
from netdesign.snow.wall import Wall

# Tight, without the coarsest level: verification looks at what the default
# leaves out for speed.
_LEVELS = MESH_LEVELS[1:]
_SETTINGS = SolverSettings(
    accuracy=0.01, stress_tolerance=1e-9, shape_tolerance=1e-8, levels=_LEVELS
)
_TWO_CODES = "two independent codes, 0.1 % apart (theta {:g} degrees)"
_LAYERS = ((1.2, 400.0), (1.0, 320.0), (0.8, 240.0))  # m, kg/m3, from the ground
# ground -> foot and head tension [kN/m] of the layered scenes
_LAYERED: dict[GroundKind, tuple[float, float]] = {
    "no-slip": (27.987, 28.225),
    "free": (168.14, 107.42),
}
# theta -> foot and head tension [kN/m], sag [m]
_REFERENCE = {0.0: (309.67, 303.41, 0.3016), 30.0: (345.41, 269.45, 0.3476)}


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
    cases = []
    for inclination, (foot, head, sag) in _REFERENCE.items():
        solution = _solve(build_paper_scene(inclination=inclination))
        for name, expected, got in (
            ("foot", foot, solution.foot.size / 1e3),
            ("head", head, solution.head.size / 1e3),
            ("sag", sag, solution.sag),
        ):
            cases.append(
                VerificationCase(
                    f"reference-{inclination:g}-{name}",
                    "cross model",
                    _TWO_CODES.format(inclination),
                    expected,
                    got,
                    2e-3,
                )
            )
    return cases


def list_layered() -> list[VerificationCase]:
    """End tensions of layered snow against another code."""
    source = "independent code with layers at their heights, 0.03 %"
    cases = []
    for ground, expected in _LAYERED.items():
        solution = _solve(_build_layered_scene(ground))
        for name, value, pull in zip(
            ("foot", "head"), expected, (solution.foot, solution.head), strict=True
        ):
            case = f"layered-{ground}-{name}"
            got = pull.size / 1e3
            cases.append(
                VerificationCase(case, "cross model", source, value, got, 1e-3)
            )
    return cases


def list_invariants() -> list[VerificationCase]:
    """Invariants: they hold whatever the numbers are."""
    base = build_paper_scene()
    reference = _solve(base)
    balance = max(
        _balance_along_slope(friction) for friction in (0.0, 10.0, 20.0, 45.0)
    )
    scaled = _solve(build_paper_scene(size=2.0, stiffness=8e7, density=366.8))
    warm = _solve(replace(base, fluidity=7.0 * base.creep_fluidity))
    return [
        expect_zero(
            "balance-along-slope", "sum of end pulls less weight, phi 0 to 45", balance
        ),
        expect_zero(
            "load-equals-weight", "all mesh levels, curved net", _load_error(), 1e-12
        ),
        expect_zero(
            "rotation-of-axes", "nodal forces turn with the mesh", _rotation(), 1e-11
        ),
        expect_zero(
            "mirror-image", "nodal forces mirror with the mesh", _mirror(), 1e-11
        ),
        VerificationCase(
            "similarity",
            "invariant",
            "same dimensionless groups, lengths twice, ES four times as large",
            4.0 * reference.foot.size,
            scaled.foot.size,
            1e-9,
        ),
        VerificationCase(
            "fluidity-leaves-forces",
            "invariant",
            "fluidity 7 times as large",
            reference.foot.size,
            warm.foot.size,
            1e-12,
        ),
        VerificationCase(
            "fluidity-scales-velocity",
            "invariant",
            "fluidity 7 times as large",
            7.0 * reference.largest_velocity,
            warm.largest_velocity,
            1e-9,
        ),
    ]


def list_limits() -> list[VerificationCase]:
    """Ends of the parameter ranges."""
    smooth = _solve(build_paper_scene(friction=0.0))
    stiff = _solve(build_paper_scene(ground="no-slip", stiffness=1e13, inclination=0.0))
    held = _solve_wall(build_paper_scene(ground="no-slip", inclination=0.0))
    sticks = [
        _solve(build_paper_scene(inclination=0.0, friction=phi)) for phi in (15.0, 45.0)
    ]
    return [
        VerificationCase(
            "no-friction-uniform-tension",
            "limit",
            "phi = 0: head tension equals foot tension",
            smooth.foot.size,
            smooth.head.size,
            5e-3,
        ),
        VerificationCase(
            "stiff-net-rigid-wall",
            "limit",
            "ES to infinity, sticking snow: force along X of a rigid wall",
            held.force.x,
            stiff.foot.x + stiff.head.x,
            1e-3,
        ),
        VerificationCase(
            "sticking-friction-is-enough",
            "limit",
            "theta = 0: every phi above 10 degrees gives the same",
            sticks[0].foot.size,
            sticks[1].foot.size,
            1e-9,
        ),
    ]


def list_numerics() -> list[VerificationCase]:
    """Two elements and two stress floors give the same forces."""
    coarse, fine = _floor_forces(1e-3), _floor_forces(5e-4)
    return [
        VerificationCase(
            "two-elements-agree",
            "cross model",
            "P2-P1 against P2, compressible snow",
            1.0,
            _mixed_over_velocity(),
            2e-3,
        ),
        VerificationCase(
            "stress-floor-does-not-matter",
            "limit",
            "net forces with half the stress floor",
            coarse,
            fine,
            1e-5,
        ),
    ]


def list_orders() -> list[VerificationCase]:
    """End tensions over nested meshes; the finest stands for the truth."""
    nested = [replace(MESH_LEVELS[1], subdivisions=times) for times in (0, 1, 2)]
    cases = []
    for name, friction, least, tolerance in (
        ("order-sticking", 45.0, 1.8, 5e-4),
        ("order-sliding", 10.0, 1.0, 1e-3),
    ):
        scene = build_paper_scene(friction=friction)
        tensions = [_tension_on_level(scene, size) for size in nested]
        errors = [abs(tension / tensions[-1] - 1.0) for tension in tensions[:-1]]
        sizes = [1.0, 0.5]
        cases.append(
            VerificationCase(
                id=name,
                kind="limit",
                reference="foot tension against every side halved twice",
                expected=tensions[-1] / 1e3,
                got=tensions[-2] / 1e3,
                tolerance=tolerance,
                order=observe_order(sizes, errors),
                least_order=least,
            )
        )
    return cases


def _build_layered_scene(ground: GroundKind) -> Scene:
    """Scenes LA and LB: 3 m of three layers, 38 degrees."""
    law = GroundLaw(kind=ground)
    return build_scene(*_LAYERS, slope=38.0, length=20.0, ground=law, slack=0.03)


def _solve(scene: Scene, settings: SolverSettings = _SETTINGS) -> Solution:
    return solve(scene, settings)


def _solve_wall(scene: Scene) -> WallSolution:
    wall = Wall(height_normal=scene.snowpack.thickness)
    solution = solve_rigid(replace(scene, net=wall), _SETTINGS)
    if isinstance(solution, FailedSolution):
        raise SolveError(solution.outcome, solution.reason)
    return solution


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
