"""Closed forms: creep law, slabs, columns of snow, cables, sliding net, compaction."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from netdesign.addons.evidence.verification.case import (
    Found,
    VerificationCase,
    judge,
    observe_order,
)
from netdesign.addons.evidence.verification.exact_solutions import (
    PrescribedFlow,
    build_square,
    solve_prescribed,
)
from netdesign.addons.history.net_pulls import NetResponse, measure_arcs
from netdesign.addons.history.staggered import advance_increment, build_cable_state
from netdesign.addons.history.yielding import NetGuess, YieldingNodes, settle_net
from netdesign.addons.winter.settling import Hs2swe
from netdesign.cable.funicular import (
    Funicular,
    share_uniform_load,
    solve_funicular,
)
from netdesign.cable.net import (
    compute_capstan_ratio,
    compute_parabola_sag,
    compute_turning_angles,
)
from netdesign.numerics.arrays import Floats
from netdesign.snow.creep_law import (
    BOUTILLIER_2004,
    PAPER_FLUIDITY,
    ZWINGER_2007,
    CreepLaw,
    compute_bulk_factor,
    compute_confined_softness,
    compute_shear_factor,
    compute_strain_rate,
)
from netdesign.snow.kernel import interpolate
from netdesign.snow.law import FlowLayer, FlowProblem
from netdesign.snow.mesh import place_nodes
from netdesign.snow.placed_mesh import build_placed_mesh
from netdesign.units import SECONDS_PER_YEAR, fluidity_from_mpa_year

# Of "Porous Law for snow and firn in Elmer/Ice" (2012).
_DENSITY, _FLUIDITY, _STRESS = 0.5, 20.0, -0.01  # [-], [MPa^-3 a^-1], [MPa]
_N = 3.0
_BULK_RATIO, _SLOPE = 2.0, math.radians(40.0)
_DIVISIONS = (4, 8, 16)


def list_law() -> list[VerificationCase]:
    """Strain rates of simple stress states, against formula and printed figure."""
    confined, rows = _list_states()
    results: dict[str, float | Found] = {}
    for name, stress, axis, formula in rows:
        got = float(_rate_per_year(stress)[axis, axis])
        results |= {name: Found(got, formula), f"{name}-printed": got}
    rate = _rate_per_year(confined)
    return judge({**results, "law-confined-lateral": rate[0, 0] / rate[2, 2]})


def _list_states() -> tuple[Floats, tuple[tuple[str, Floats, int, float], ...]]:
    """Confined compression, and all states with the axis and rate of the formula."""
    a = compute_shear_factor(ZWINGER_2007, _DENSITY)
    b = compute_bulk_factor(ZWINGER_2007, _DENSITY)
    s = _STRESS
    axial = np.diag([0.0, 0.0, s])
    even = np.diag([s, s, s])
    # lateral stress of confined compression, from tau_xx and p of the same source
    tau = -2.0 / (3.0 * a) / (4.0 / (3.0 * a) + 1.0 / b) * s
    confined = np.diag([s + 3.0 * tau, s + 3.0 * tau, s])
    rate_once = a / 3.0 + b / 9.0
    two = 4.0 / (3.0 * a) + 1.0 / b
    lateral = _FLUIDITY / 18.0 * rate_once * (2 * b - 3 * a) * s**3
    rows = (
        ("law-uniaxial", axial, 2, _FLUIDITY * rate_once**2 * s**3),
        ("law-uniaxial-lateral", axial, 0, lateral),
        ("law-isotropic", even, 0, b**2 * _FLUIDITY * s**3 / 3.0),
        ("law-confined", confined, 2, _FLUIDITY * two**-2 * s**3),
    )
    return confined, rows


def list_snow() -> list[VerificationCase]:
    """Settlement of a confined column and shear of an infinite slab."""
    return judge(
        {
            "column-settlement": _settle_slab(0.0, 1),
            "slab-shear": _settle_slab(_SLOPE, 0),
            "slab-settlement": _settle_slab(_SLOPE, 1),
        }
    )


def list_cable() -> list[VerificationCase]:
    """Elastic catenary (uniform load along its length) and shallow parabola."""
    load, chord, stiffness = 10.0, 4.0, 20e3
    exact = _clamped_parabola(load, chord, stiffness)
    errors, counts = [], (2, 4, 8)
    for count in counts:
        cable = _solve_uniform(load, chord, stiffness, count)
        errors.append(abs(float(np.hypot(*cable.foot_pull)) / exact - 1.0))
    order = observe_order([1.0 / n for n in counts], errors)
    # a small sag is the premise of the formula: a stiff cable, a light load
    stiff = 1e9
    sag = float(_solve_uniform(1.0, chord, stiff, 8).curve[0].max())
    return judge(
        {
            "cable-catenary": Found(exact * (1.0 + errors[-1]), exact, order),
            "cable-parabola-sag": Found(
                sag, compute_parabola_sag(1.0, chord, stiff, 0.0)
            ),
        }
    )


def _rate_per_year(stress_mpa: Floats) -> Floats:
    fluidity = fluidity_from_mpa_year(_FLUIDITY, _N)
    rate = compute_strain_rate(ZWINGER_2007, _DENSITY, fluidity, stress_mpa * 1e6)
    return rate * SECONDS_PER_YEAR


def _settle_slab(slope: float, axis: int) -> Found:
    """Velocity of the surface along an axis, beside the exact one."""
    exact = float(_slab_velocity(np.ones(()), slope)[axis])
    errors, got = [], math.nan
    for divisions in _DIVISIONS:
        got, error = _solve_slab(divisions, slope, axis)
        errors.append(error)
    return Found(got, exact, observe_order([1.0 / n for n in _DIVISIONS], errors))


def _solve_slab(divisions: int, slope: float, axis: int) -> tuple[float, float]:
    """Surface velocity along an axis, and its relative L2 error over the slab.

    The two sides of the square move as an infinite slab does.
    """
    template = build_square(divisions)
    heights = template.net_fractions
    straight = np.array([0.0 * heights, heights])
    mesh = build_placed_mesh(template, place_nodes(template, straight))
    on_ground = mesh.nodes[1] == 0.0
    on_side = (template.nodes[0] == 0.0) | (template.nodes[0] == 1.0)
    gravity = (math.sin(slope), -math.cos(slope))
    law = FlowProblem(
        exponent=_N,
        layers=(FlowLayer(bulk_ratio=_BULK_RATIO),),
        gravity=gravity,
        stress_floor=1e-9,
    )
    flow: PrescribedFlow = solve_prescribed(
        law,
        mesh,
        held=np.array([on_ground | on_side, on_ground | on_side]),
        values=_slab_velocity(mesh.nodes[1], slope),
        body_force=np.ones((2, *mesh.weights.shape)) * np.array(gravity)[:, None, None],
    )
    middle = np.hypot(mesh.nodes[0] + 0.5, mesh.nodes[1] - 1.0).argmin()
    _, height = interpolate(mesh, mesh.nodes)
    exact = _slab_velocity(height, slope)[axis]
    missed = interpolate(mesh, flow.velocity[axis]) - exact
    error = (mesh.weights * missed**2).sum() / (mesh.weights * exact**2).sum()
    return float(flow.velocity[axis, middle]), math.sqrt(error)


def _slab_velocity(height: Floats, slope: float) -> Floats:
    """Exact velocity of an infinite slab, shape (2, n)."""
    stiffness = _BULK_RATIO + 4.0 / 3.0
    size = math.hypot(math.sin(slope), math.cos(slope) / math.sqrt(stiffness))
    profile = size ** (_N - 1.0) * (1.0 - (1.0 - height) ** (_N + 1.0)) / (_N + 1.0)
    return np.array([math.sin(slope) * profile, -math.cos(slope) / stiffness * profile])


def _solve_uniform(
    load: float, chord: float, stiffness: float, count: int
) -> Funicular:
    """Straight unstressed cable along Y under a load along X."""
    lengths = np.full(count, chord / count)
    shares = share_uniform_load(lengths)
    sag = compute_parabola_sag(load, chord, stiffness, 0.0)
    start = np.array([load * chord / 2.0, load * chord**2 / (8.0 * sag)])
    forces = load * np.array([shares, 0.0 * shares])
    head = np.array([0.0, chord])
    return solve_funicular(forces, lengths, stiffness, head, start)


def _clamped_parabola(load: float, chord: float, stiffness: float) -> float:
    """End tension of (C9) for an unstressed length equal to the chord."""
    end = load * chord / 2.0  # V at the ends
    low, high = 1e-6 * stiffness, stiffness
    for _ in range(200):
        pull = math.sqrt(low * high)
        half = pull * (chord / 2.0) / stiffness + pull / load * math.asinh(end / pull)
        low, high = (pull, high) if half < chord / 2.0 else (low, pull)
    return math.hypot(math.sqrt(low * high), end)


_STIFFNESS = 2e7  # [N/m]
_WRAP, _FRICTION_ANGLE = math.radians(60.0), math.radians(30.0)
_COUNTS = (8, 16, 32)
_INCREMENTS = (16, 32, 64)


def list_sliding_net() -> list[VerificationCase]:
    """Sliding in both directions over an arc; increments of the paper's cable."""
    exact = compute_capstan_ratio(_WRAP, _FRICTION_ANGLE)
    results = {}
    for name, expected, is_reversed in (
        ("capstan-to-head", exact, False),
        ("capstan-to-foot", 1.0 / exact, True),
    ):
        ratios = [_end_ratio(count, is_reversed=is_reversed) for count in _COUNTS]
        errors = [abs(ratio / expected - 1.0) for ratio in ratios]
        order = observe_order([1.0 / n for n in _COUNTS], errors)
        results[name] = Found(ratios[-1], expected, order)
    pairs = [_bulge_tensions(count) for count in _INCREMENTS]
    errors = [abs(paper / ours - 1.0) for paper, ours in pairs]
    order = observe_order([1.0 / n for n in _INCREMENTS], errors)
    return judge({**results, "paper-increments": Found(*pairs[-1], order)})


def _end_ratio(count: int, *, is_reversed: bool) -> float:
    """Tension at the head over that at the foot when every node glides."""
    angles = np.linspace(0.0, _WRAP, count + 1)
    # from the foot downslope, then round the snow towards the head, with tangent ends
    arc = np.array([np.sin(angles), 1.0 - np.cos(angles)])
    foot = np.array([[-0.5], [0.0]])
    head = arc[:, -1:] + 0.5 * np.array([[math.cos(_WRAP)], [math.sin(_WRAP)]])
    points = np.hstack([foot, arc, head])
    arcs = measure_arcs(points)
    strain = np.full(arcs.size, 1e-5)
    strain[0 if is_reversed else -1] = 0.05  # a pull at one end that starts it all
    net = slide_on(points, arcs / (1.0 + strain), math.tan(_FRICTION_ANGLE))
    return float(net.tensions[-1] / net.tensions[0])


def slide_on(
    points: Floats,
    old_lengths: Floats,
    friction: float,
    stiffness: float = _STIFFNESS,
) -> NetResponse:
    """Net of a history on nodes that do not yield.

    Parameters
    ----------
    points : ndarray, shape (2, n + 2)
        Foot, nodes and head [m].
    old_lengths : ndarray, shape (n + 1,)
        Unstressed lengths before the net slides [m].
    friction : float
        Tan phi [-].
    stiffness : float
        ES [N/m].

    Raises
    ------
    SolveError
        If there is no convergence.
    """
    from_foot = points - points[:, :1]
    nodes = YieldingNodes(
        positions=from_foot[:, 1:-1],
        forces=np.ones_like(from_foot[:, 1:-1]),
        compliance=np.zeros((2 * old_lengths.size - 2,) * 2),
    )
    guess = NetGuess.at_rest(nodes.positions, np.zeros(old_lengths.size - 1, np.int8))
    net, _ = settle_net(
        *(nodes, guess, from_foot[:, -1], old_lengths),
        friction=friction,
        stiffness=stiffness,
    )
    return net


def _bulge_tensions(count: int) -> tuple[float, float]:
    """Foot tension [N/m] after ``count`` increments: the paper's, the exact one."""
    friction = math.tan(math.radians(5.0))
    points = _bulge(0.5)
    net = slide_on(points, measure_arcs(_bulge(0.0)), friction)
    paper = build_cable_state(measure_arcs(points), net.lengths, _STIFFNESS)
    for share in np.linspace(0.5, 1.0, count + 1)[1:]:
        points = _bulge(float(share))
        net = slide_on(points, net.lengths, friction)
        paper = advance_increment(
            paper,
            measure_arcs(points),
            compute_turning_angles(points),
            friction=friction,
            stiffness=_STIFFNESS,
        )
    return float(paper.tensions[0]), float(net.tensions[0])


def _bulge(share: float) -> Floats:
    """Net of 12 nodes that bulges downslope, more below than above."""
    height = np.linspace(0.0, 1.0, 14)
    return np.array([2.0 * share * height * (1.0 - height) ** 2, height])


PLACE = (367.0, 5e3)  # at which one figure is quoted [kg/m3, Pa]


def _settle_as_hs2swe(density: float) -> float:
    model = Hs2swe()  # its constants are those of the program's winters
    return model.viscosity * math.exp(model.stiffening * density)


# Viscosity of snow at freezing [Pa s] by its density [kg/m3]; constants of Crocus as in
# a public snow solver (Vionnet et al. 2012), of ISBA as in a public program (Boone 2002
# by Essery et al. 2013), of SNTHRM.89 as in the public code of VIC.
MODELS: Mapping[str, Callable[[float], float]] = {
    "Crocus": lambda density: 7.62237e6 * density / 250.0 * math.exp(0.023 * density),
    "ISBA": lambda density: 3.7e7 * math.exp(0.018 * density),
    "HS2SWE": _settle_as_hs2swe,
    "SNTHRM": lambda density: 3.6e6 * math.exp(0.021 * density),
}


def compute_viscosity(law: CreepLaw, density: float, stress: float) -> float:
    """Apparent compaction viscosity of a creep law of the paper's fluidity [Pa s].

    Parameters
    ----------
    law : CreepLaw
        A set for n = 3.
    density : float
        [kg/m3].
    stress : float
        Across the layer, positive [Pa].
    """
    softness = compute_confined_softness(law, density)
    return float(stress / (PAPER_FLUIDITY * stress**law.exponent * softness))


def find_middle(density: float) -> float:
    """Geometric mean of the operational models at freezing [Pa s]."""
    logs = [math.log(compute(density)) for compute in MODELS.values()]
    return math.exp(sum(logs) / len(logs))


def list_compaction() -> list[VerificationCase]:
    """Settling of the default law at one place, against models in operational use."""
    density, stress = PLACE
    own = compute_viscosity(BOUTILLIER_2004, density, stress)
    return judge({"compaction-default": math.log(own / find_middle(density))})
