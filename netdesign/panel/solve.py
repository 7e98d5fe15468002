"""A panel at rest: strips and ropes by Newton's method on all of them at once.

First: the result, forces on supports and ropes, and on the support at the row's end.
Theory: panel/THEORY.md, sections 3 and 4; structure/THEORY.md, (S1) to (S6).
"""

from __future__ import annotations

import ctypes
import math
from dataclasses import dataclass

import numpy as np

from netdesign.core.arguments import locate, to_floats
from netdesign.core.library import find_core, require_sound
from netdesign.coupling.solution import Solution
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome, SolveError, require_within
from netdesign.panel.equations import (
    PanelProblem,
    RopeLoads,
    build_problem,
    derive_missing,
    describe_panel,
    guess_point,
    read_loads,
    read_point,
)
from netdesign.panel.inputs import LARGEST_GUY_ANGLE, Panel
from netdesign.panel.strips import Strip, draw_strips, take_strip
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import Point, SupportPoints
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RopeForces:
    """A border rope under load.

    Attributes
    ----------
    along : float
        H, the same over its span [N].
    tension : float
        T, at the support where it is largest [N].
    mid_displacement : tuple of float, shape (2,)
        (x, y) in mid-panel, from the straight line between the supports [m].
    tensions : ndarray, shape (24,)
        Tension at ``ROPE_POINTS``, from mid-panel to the post [N].
    """

    along: float
    tension: float
    mid_displacement: Point
    tensions: Floats


@dataclass(frozen=True, slots=True, kw_only=True)
class PanelBalance:
    """Forces and moments that are missing, over the load (and the chord).

    Attributes
    ----------
    force : float
        Of the load on feet and heads [-].
    moment_in_section : float
        Of the strips about the foot's line [-].
    moment_along_row : float
        Of half the panel about the post's section [-].
    """

    force: float
    moment_in_section: float
    moment_along_row: float

    @property
    def largest(self) -> float:
        """Largest of the three [-]."""
        return max(self.force, self.moment_in_section, self.moment_along_row)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PanelSolution:
    """A panel between equal ones, at rest; its balance was checked. SI units.

    Attributes
    ----------
    panel : Panel
        What was solved.
    foot, mid_foot, head : tuple of float, shape (2,)
        (x, y) of the force on the foot anchor beside a post, on that in mid-panel (0
        without one) and on a post head [N].
    lower, upper : RopeForces
        The two ropes.
    stations : ndarray, shape (K + 1,)
        z of the strips: those that were solved for, and mid-panel [m].
    curves : ndarray, shape (K + 1, 2, 2 n + 1)
        Their nodes in the axes of the section [m].
    balance : PanelBalance
        What is missing in it.
    steps : int
        Of Newton's method.
    """

    panel: Panel
    foot: Point
    mid_foot: Point
    head: Point
    lower: RopeForces
    upper: RopeForces
    stations: Floats
    curves: Floats
    balance: PanelBalance
    steps: int

    @property
    def outcome(self) -> Outcome:
        """Always converged: anything else is a ``FailedPanel``."""
        return Outcome.CONVERGED


@dataclass(frozen=True, slots=True, kw_only=True)
class FailedPanel:
    """A panel that gave no number that may be used."""

    outcome: Outcome
    reason: Message


@dataclass(frozen=True, slots=True, kw_only=True)
class EndForces:
    """Forces of the first or last support of a row.

    Attributes
    ----------
    support : AnchorForces
        Forces in the section, of half a bay [N].
    foot : tuple of float, shape (3,)
        Force on the foot anchor: downslope, out of the ground, along the row [N].
    head_along : float
        Pull of the ridge rope on the post head along the row [N].
    guy_tension : float
        Of the end guy that holds the head along the row [N].
    post_compression : float
        Of half a bay and of that guy [N].
    """

    support: AnchorForces
    foot: tuple[float, float, float]
    head_along: float
    guy_tension: float
    post_compression: float

    @property
    def foot_size(self) -> float:
        """Size of the force on the foot anchor [N]."""
        return math.hypot(*self.foot)


def compute_end_forces(
    panel: PanelSolution, points: SupportPoints, guy_angle: float
) -> EndForces | FailedSupport:
    """Forces of the support at a row's end: half a bay, and both ropes, (P7).

    Parameters
    ----------
    panel : PanelSolution
        The last panel.
    points : SupportPoints
        Geometry of the support [m].
    guy_angle : float
        Of the guy that holds the head along the row, to the row [rad].

    Returns
    -------
    EndForces or FailedSupport
        Per anchor [N].

    Raises
    ------
    ModelError
        If the guy is steeper than ``LARGEST_GUY_ANGLE``.

    Verified by
    -----------
    tests/verification/test_panel.py
    """
    require_within("end guy angle", guy_angle, 0.0, LARGEST_GUY_ANGLE, "rad")
    spacing = panel.panel.post_spacing
    support = compute_anchor_forces(
        points,
        foot_pull_per_m=(panel.foot[0] / spacing, panel.foot[1] / spacing),
        head_pull_per_m=(panel.head[0] / spacing, panel.head[1] / spacing),
        post_spacing=spacing / 2.0,
    )
    if isinstance(support, FailedSupport):
        return support
    along = panel.upper.along
    return EndForces(
        support=support,
        foot=(support.foot_anchor.x, support.foot_anchor.y, panel.lower.along),
        head_along=along,
        guy_tension=along / math.cos(guy_angle),
        post_compression=support.head.post_compression + along * math.tan(guy_angle),
    )


# Stations of half a panel: the error falls to a tenth or so with each, where the net is
# taut to a quarter; six cost hardly more than four.
STATIONS = 6
LARGEST_COUNT = 10  # the polynomial through more loses digits
_STILL = 1e-11  # last step: of pulls over the load, of log H
_MOST_STEPS = 60
_HALVINGS = 20
_LONGEST_STEP = 2.0  # of log H
_BALANCED = 1e-8
_ON_GROUND = 1e-9  # depth below the ground, over the chord
_TOO_MANY_STEPS = 2  # as in panel.c


def solve_panel(
    solution: Solution, panel: Panel, *, stations: int = STATIONS
) -> PanelSolution | FailedPanel:
    """Panel whose post section has been solved.

    Parameters
    ----------
    solution : Solution
        Steady state at the post.
    panel : Panel
        Spacing, ropes and cut.
    stations : int
        K, strips on half the panel, 1 to 10 [-].

    Returns
    -------
    PanelSolution or FailedPanel
        Outcome ``out_of_validity`` if the net would lie on the ground between posts.

    Raises
    ------
    ModelError
        If the solution is no steady state of a net, or K is out of its range.

    Verified by
    -----------
    tests/verification/test_panel.py
    """
    return solve_strips(take_strip(solution), panel, stations=stations)


def solve_strips(
    strip: Strip, panel: Panel, *, stations: int = STATIONS
) -> PanelSolution | FailedPanel:
    """Panel of strips like the one at the post; otherwise as ``solve_panel``.

    Parameters
    ----------
    strip : Strip
        At the post.
    panel : Panel
        Spacing, ropes and cut.
    stations : int
        K, strips on half the panel, 1 to 10 [-].

    Raises
    ------
    ModelError
        If K is out of its range.
    """
    require_within("stations", stations, 1, LARGEST_COUNT)
    try:
        problem = build_problem(strip, panel, stations)
        return _build_solution(problem, *_solve(problem))
    except SolveError as failure:
        return FailedPanel(outcome=failure.outcome, reason=failure.reason)


def _solve(problem: PanelProblem) -> tuple[RopeLoads, int]:
    """Loads under which nothing is missing, and Newton steps to them.

    A step is halved until the next one, by the same derivatives, would be shorter:
    that needs no common measure of gaps and lengths (Deuflhard's natural test).
    """
    point = guess_point(problem)
    core = find_core()
    if core is not None:
        return _solve_compiled(core, problem, point)
    state = read_point(problem, point)
    for number in range(1, _MOST_STEPS + 1):
        inverse = _invert(derive_missing(problem, state))
        step = -inverse @ state.missing
        share = min(1.0, _LONGEST_STEP / max(_LONGEST_STEP, *np.abs(step[-2:])))
        for _ in range(_HALVINGS):
            tried = read_point(problem, point + share * step)
            left = float(np.linalg.norm(inverse @ tried.missing))
            if left <= _STILL:
                return tried.loads, number
            if left <= (1.0 - share / 4.0) * float(np.linalg.norm(step)):
                break
            share /= 2.0
        else:
            raise SolveError(Outcome.NO_EQUILIBRIUM, say("panel.not_found"))
        point, state = point + share * step, tried
    raise SolveError(Outcome.MAX_ITERATIONS)


def _solve_compiled(
    core: ctypes.PyDLL, problem: PanelProblem, point: Floats
) -> tuple[RopeLoads, int]:
    """The same by the compiled core."""
    argument, kept = describe_panel(problem)
    argument.still, argument.longest_step = _STILL, _LONGEST_STEP
    argument.most_steps, argument.most_halvings = _MOST_STEPS, _HALVINGS
    unknowns = to_floats(point, (2 * problem.lengths.size + 2,)).copy()
    code = core.nd_panel(ctypes.byref(argument), ctypes.c_void_p(locate(unknowns)))
    del kept  # the core had its addresses
    if require_sound(code) == _TOO_MANY_STEPS:
        raise SolveError(Outcome.MAX_ITERATIONS)
    if code:
        raise SolveError(Outcome.NO_EQUILIBRIUM, say("panel.not_found"))
    return read_loads(problem, unknowns), argument.steps


def _invert(matrix: Floats) -> Floats:
    try:
        return np.asarray(np.linalg.inv(matrix))
    except np.linalg.LinAlgError as singular:
        raise SolveError(Outcome.NO_EQUILIBRIUM, say("panel.not_found")) from singular


def _build_solution(problem: PanelProblem, end: RopeLoads, steps: int) -> PanelSolution:
    """Result of the last step; refused if it is not in balance or on the ground."""
    curves = draw_strips(
        problem.strip, problem.lengths, end.displacements, end.pulls[0]
    )
    _require_clear_of_ground(problem, curves)
    stations = problem.stations
    lower, upper = (
        2.0 * problem.half * load[:, :-1] @ span.end_shear.T * [1.0, -1.0]
        for load, span in zip(end.pulls, (stations.lower, stations.upper), strict=True)
    )
    balance = _measure_balance(problem, end, curves, lower, upper)
    if not balance.largest <= _BALANCED:
        raise SolveError(
            Outcome.BALANCE_VIOLATED,
            say("panel.out_of_balance", missing=balance.largest, accepted=_BALANCED),
        )
    return PanelSolution(
        panel=problem.panel,
        foot=_as_point(lower[:, 0]),
        mid_foot=_as_point(lower[:, 1]),
        head=_as_point(upper[:, 0]),
        lower=_describe_rope(problem, end, 0, lower),
        upper=_describe_rope(problem, end, 1, upper),
        stations=problem.half * (1.0 - np.append(stations.xi, 0.0)),
        curves=curves,
        balance=balance,
        steps=steps,
    )


def _describe_rope(
    problem: PanelProblem, end: RopeLoads, which: int, supports: Floats
) -> RopeForces:
    """Lower (0) or upper rope, from the forces of both bays on its supports (2, 2)."""
    along = float(end.along[which])
    across = float(np.hypot(*supports).max()) / 2.0
    shear = end.pulls[which][:, :-1] @ problem.shear[which].T
    return RopeForces(
        along=along,
        tension=math.hypot(along, across),
        mid_displacement=_as_point(end.displacements[which][:, -1]),
        tensions=np.asarray(np.hypot(along, np.hypot(*shear))),
    )


def _require_clear_of_ground(problem: PanelProblem, curves: Floats) -> None:
    depth = -float(curves[:, 1].min())
    if depth > _ON_GROUND * problem.strip.chord:
        raise SolveError(
            Outcome.OUT_OF_VALIDITY, say("panel.lies_on_ground", depth=depth)
        )


def _measure_balance(
    problem: PanelProblem, end: RopeLoads, curves: Floats, lower: Floats, upper: Floats
) -> PanelBalance:
    """Missing forces and moments, from curves and supports as they came out (P6)."""
    strip, half = problem.strip, problem.half
    load, weights = strip.load, problem.stations.weights
    size, chord = problem.load_size, strip.chord
    force = lower.sum(axis=1) + upper.sum(axis=1) - 2.0 * half * load
    ends = [end.displacements[0], end.displacements[1] + strip.head[:, None]]
    held = sum(_cross(at, pull) for at, pull in zip(ends, end.pulls, strict=True))
    turned = _cross(curves.transpose(1, 0, 2), strip.forces[:, None]).sum(axis=1)
    lever = half**2 / 2.0 * load - half * (lower[:, 1] + upper[:, 1]) / 2.0
    for along, moved in zip(end.along, end.displacements, strict=True):
        lever = lever - along * moved[:, -1]
    return PanelBalance(
        force=float(np.hypot(*force)) / (2.0 * half * size),
        moment_in_section=float(np.abs(turned - held)[:-1] @ weights) / (size * chord),
        moment_along_row=float(np.hypot(*lever)) / (half * size * chord),
    )


def _cross(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[0] * b[1] - a[1] * b[0])


def _as_point(vector: Floats) -> Point:
    x, y = vector
    return float(x), float(y)
