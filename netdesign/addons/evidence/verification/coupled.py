"""Snow on a net or a wall: other codes, invariants, limits, orders, couplings."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from netdesign.addons.evidence.scene import build_scene, solve
from netdesign.addons.evidence.verification.case import (
    Found,
    VerificationCase,
    judge,
    largest_difference,
    observe_order,
)
from netdesign.addons.evidence.verification.exact_solutions import (
    Slab,
    compute_slab_force,
    scale_slip_length,
)
from netdesign.addons.evidence.verification.rigid import solve_wall
from netdesign.addons.history.moments import HistoryPoint
from netdesign.addons.history.run import Run
from netdesign.addons.history.settings import (
    TRANSIENT_LEVELS,
    StaggeredSettings,
    Start,
    TransientSettings,
)
from netdesign.addons.history.staggered import run_exchange
from netdesign.addons.history.transient import run_history
from netdesign.coupling.interface import compute_support_forces
from netdesign.coupling.scene import MESH_LEVELS, Scene, SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.numerics.arrays import Floats
from netdesign.snow.creep_law import BOUTILLIER_2004
from netdesign.snow.flow import solve_flow
from netdesign.snow.ground import GroundKind, GroundLaw
from netdesign.snow.kernel import assemble_stress
from netdesign.snow.law import FlowProblem
from netdesign.snow.mesh import MeshSize, build_template, place_nodes
from netdesign.snow.placed_mesh import build_placed_mesh
from netdesign.snow.snowpack import GRAVITY

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
    results: dict[str, float] = {}
    for inclination in (0, 30):
        solution = _solve(build_paper_scene(inclination=float(inclination)))
        results |= {
            f"reference-{inclination}-foot": solution.foot.size / 1e3,
            f"reference-{inclination}-head": solution.head.size / 1e3,
            f"reference-{inclination}-sag": solution.sag,
        }
    return judge(results)


def list_layered() -> list[VerificationCase]:
    """End tensions of layered snow against another code."""
    results = {}
    grounds: tuple[GroundKind, ...] = ("no-slip", "free")
    for ground in grounds:
        solution = _solve(_build_layered_scene(ground))
        results[f"layered-{ground}-foot"] = solution.foot.size / 1e3
        results[f"layered-{ground}-head"] = solution.head.size / 1e3
    return judge(results)


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
    results = {}
    for name, friction in (("order-sticking", 45.0), ("order-sliding", 10.0)):
        scene = build_paper_scene(friction=friction)
        tensions = [_tension_on_level(scene, size) / 1e3 for size in nested]
        errors = [abs(tension / tensions[-1] - 1.0) for tension in tensions[:-1]]
        order = observe_order([1.0, 0.5], errors)
        results[name] = Found(tensions[-2], tensions[-1], order)
    return judge(results)


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


_HORIZON = 0.06  # creep time
_DRAGS = (0.1, 0.05)
_SETTLED = 1e-4  # creep time after which pulls must be smooth; 3 s in these scenes


def list_histories() -> list[VerificationCase]:
    """Steady state met, balance of all steps, smooth pulls, staggered trend."""
    results: dict[str, float | Found] = {}
    for inclination in (0, 30):
        scene = build_paper_scene(inclination=inclination)
        name = f"history-{inclination}"
        run = _run(scene, start="sagged", densifies=False, level=1)
        results |= _compare_with_steady(scene, run, name)
        results |= _check_steps(run, name)
        straight = _run(scene, start="straight", densifies=True, level=1)
        results |= _check_steps(straight, f"{name}-straight")
    return judge({**results, "staggered-tends-to-transient": _compare_staggered()})


def _check_steps(run: Run, name: str) -> dict[str, float]:
    residual = max(moment.residual for moment in run.moments)
    return {f"{name}-balance": residual, f"{name}-smooth": _largest_return(run)}


def _run(scene: Scene, *, start: Start, densifies: bool, level: int) -> Run:
    settings = TransientSettings(
        start=start, densifies=densifies, stops_at_plateau=not densifies
    )
    return run_history(scene, TRANSIENT_LEVELS[level], settings, _HORIZON)


def _compare_with_steady(scene: Scene, run: Run, name: str) -> dict[str, Found]:
    """Pulls [kN/m] when the net has come to rest, densification off."""
    steady = solve(scene, SolverSettings())
    if run.plateau.end is None:
        return {f"{name}-{end}": Found(math.nan, math.nan) for end in ("foot", "head")}
    moment = run.moments[run.plateau.end]
    pulls = {"foot": (moment.foot, steady.foot), "head": (moment.head, steady.head)}
    return {
        f"{name}-{end}": Found(_size(got, scene), expected.size / 1e3)
        for end, (got, expected) in pulls.items()
    }


def _size(pull: Floats, scene: Scene) -> float:
    """Pull of a history [kN/m]."""
    return float(np.hypot(*pull)) * scene.force_scale / 1e3


def _largest_return(run: Run) -> float:
    """Largest part of a step's change of a pull that the next step takes back."""
    moments = [moment for moment in run.moments if moment.time > _SETTLED]
    worst = 0.0
    for sizes in (_sizes(moments, "foot"), _sizes(moments, "head")):
        change = np.diff(np.log(sizes))
        back = change[1:] * change[:-1] < 0.0
        returned = np.minimum(np.abs(change[1:]), np.abs(change[:-1]))
        worst = max(worst, float(returned[back].max(initial=0.0)))
    return worst


def _sizes(moments: list[HistoryPoint], end: str) -> Floats:
    return np.array([float(np.hypot(*getattr(moment, end))) for moment in moments])


def _compare_staggered() -> Found:
    """Foot pull of the exchange at one creep time, drag and step shrinking."""
    scene = build_paper_scene(inclination=0.0)
    history = _run(scene, start="straight", densifies=True, level=0)
    expected = _size(history.moments[-1].foot, scene)
    settings = StaggeredSettings(horizon=_HORIZON)
    runs = [run_exchange(scene, replace(settings, base_drag=drag)) for drag in _DRAGS]
    got = [_size(run.moments[-1].foot, scene) for run in runs]
    order = observe_order(_DRAGS, [abs(value - expected) for value in got])
    return Found(got[-1], expected, order)


_THICKNESS = 3.0  # [m]
_ROUGH = GroundLaw(kind="no-slip")
# Recalled, not read, from the guideline: density -> K / sin(2 psi).
_CREEP_FACTORS = {200.0: 0.70, 300.0: 0.76, 400.0: 0.83, 500.0: 0.92, 600.0: 1.05}
# Slip length and upslope length over d, friction of the wall.
_SLABS = (
    (0.0, 40.0, 0.0),
    (0.0, 40.0, None),
    (1.0, 3.0, 0.0),
    (4.0, 190.0, None),
    (16.0, 8.0, 0.0),
    (64.0, 190.0, None),
)


def list_walls() -> list[VerificationCase]:
    """Force along X on a wall normal to the slope, snow adhering, rough ground."""
    ratios = {
        f"wall-n{exponent}-{slope}": wall_force(slope, 300.0, exponent=exponent)
        / guideline_force(slope, 300.0)
        for exponent in (3, 1)
        for slope in (35, 45)
    }
    forces = {
        f"guideline-{density:.0f}-{slope}": Found(
            wall_force(slope, density) / 1e3, guideline_force(slope, density) / 1e3
        )
        for density in _CREEP_FACTORS
        for slope in (35, 40, 45)
    }
    return judge({**ratios, **forces})


def list_depth_averaged() -> list[VerificationCase]:
    """Linear creep against the closed form: long and short snow, rough to slippery."""
    results: dict[str, float | Found] = {}
    for ratio, aspect, friction in _SLABS:
        slab = Slab(thickness=_THICKNESS, slope_angle=math.radians(40), density=300.0)
        slip, length = ratio * _THICKNESS, aspect * _THICKNESS
        force = compute_slab_force(slab, slip_length=slip, upslope_length=length)
        got = wall_force(
            40,
            300.0,
            exponent=1,
            ground=GroundLaw(kind="sliding", slip_length=slip) if slip else _ROUGH,
            length=length,
            friction_angle=friction,
        )
        wall = "adhering" if friction is None else "smooth"
        name = f"haefeli-{ratio:g}-{aspect:g}-{wall}"
        results[name] = Found(got / 1e3, force / 1e3)
    # stagnation depth that halves the force on smooth ground, as published
    slab = Slab(thickness=2.0, slope_angle=math.radians(30), density=350.0)
    results["haefeli-half-the-force"] = scale_slip_length(slab, 10.0, 0.5)
    return judge(results)


def wall_force(
    slope: float,
    density: float,
    *,
    exponent: float = 3,
    ground: GroundLaw = _ROUGH,
    length: float = 40.0,
    friction_angle: float | None = None,
) -> float:
    """Force along X [N/m] on a wall, adhering without a friction angle."""
    scene = build_scene(
        (_THICKNESS, density), slope=slope, length=length, ground=ground, lean=0.0
    )
    law = replace(BOUTILLIER_2004, exponent=float(exponent))
    solution = solve_wall(
        replace(scene, creep_law=law),
        SolverSettings(accuracy=0.005),
        friction_angle=friction_angle,
    )
    return solution.force.x


def guideline_force(slope: float, density: float) -> float:
    """S'_N = rho g H^2 / 2 K with N = 1 [N/m]; H is the vertical height."""
    angle = math.radians(slope)
    height = _THICKNESS / math.cos(angle)
    creep_factor = _CREEP_FACTORS[density] * math.sin(2.0 * angle)
    return density * GRAVITY * height**2 / 2.0 * creep_factor
