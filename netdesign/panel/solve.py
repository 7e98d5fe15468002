"""A panel at rest: strips and ropes by Newton's method on all of them at once.

First: the result, forces on supports and ropes. Theory: panel/THEORY.md, section 3.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

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
from netdesign.panel.inputs import Panel
from netdesign.panel.strips import Strip, draw_strips, take_strip
from netdesign.structure.layout import Point
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


@dataclass(frozen=True, slots=True)
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
    (solved,) = solve_strips(take_strip(solution), (panel,), stations=stations)
    return solved


def solve_strips(
    strip: Strip, panels: Sequence[Panel], *, stations: int = STATIONS
) -> list[PanelSolution | FailedPanel]:
    """Panels of strips like the one at the post; otherwise as ``solve_panel``.

    Parameters
    ----------
    strip : Strip
        At the post.
    panels : sequence of Panel
        Spacing, ropes and cut.
    stations : int
        K, strips on half the panel, 1 to 10 [-].

    Returns
    -------
    list of PanelSolution or FailedPanel
        One a panel.

    Raises
    ------
    ModelError
        If K is out of its range.
    """
    require_within("stations", stations, 1, LARGEST_COUNT)
    core = find_core()
    found: dict[int, PanelSolution | FailedPanel] = {}
    alike: dict[tuple[bool, float], dict[int, _SolvedPoint]] = {}
    for place, panel in enumerate(panels):
        try:
            solved = _solve(build_problem(strip, panel, stations), core)
        except SolveError as failure:
            found[place] = _fail(failure)
        else:
            key = panel.has_mid_anchors, panel.post_spacing
            alike.setdefault(key, {})[place] = solved
    for points in alike.values():
        found |= zip(points, _build_solutions(list(points.values())), strict=True)
    return [found[place] for place in range(len(panels))]


def _fail(failure: SolveError) -> FailedPanel:
    return FailedPanel(outcome=failure.outcome, reason=failure.reason)


class _SolvedPoint(NamedTuple):
    """Point, shape (2 K + 4,), at which nothing is missing; Newton steps to it."""

    problem: PanelProblem
    point: Floats
    steps: int


def _solve(problem: PanelProblem, core: ctypes.PyDLL | None) -> _SolvedPoint:
    """Point at which nothing is missing.

    A step is halved until the next one, by the same derivatives, would be shorter:
    that needs no common measure of gaps and lengths (Deuflhard's natural test).
    """
    point = guess_point(problem)
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
                return _SolvedPoint(problem, point + share * step, number)
            if left <= (1.0 - share / 4.0) * float(np.linalg.norm(step)):
                break
            share /= 2.0
        else:
            raise SolveError(Outcome.NO_EQUILIBRIUM, say("panel.not_found"))
        point, state = point + share * step, tried
    raise SolveError(Outcome.MAX_ITERATIONS)


def _solve_compiled(
    core: ctypes.PyDLL, problem: PanelProblem, point: Floats
) -> _SolvedPoint:
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
    return _SolvedPoint(problem, unknowns, argument.steps)


def _invert(matrix: Floats) -> Floats:
    try:
        return np.asarray(np.linalg.inv(matrix))
    except np.linalg.LinAlgError as singular:
        raise SolveError(Outcome.NO_EQUILIBRIUM, say("panel.not_found")) from singular


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Panels:
    """Solved panels of one strip, spacing and kind of anchors, as arrays.

    Attributes
    ----------
    problem : PanelProblem
        The first one.
    loads : RopeLoads
        Of all of them; the panels are the first dimension.
    curves : ndarray, shape (p, K + 1, 2, 2 n + 1)
        Nodes of the strips [m].
    lower, upper : ndarray, shape (p, 2, 2)
        Forces of both bays on the supports of each rope: x and y, post and mid-panel
        [N].
    """

    problem: PanelProblem
    loads: RopeLoads
    curves: Floats
    lower: Floats
    upper: Floats


def _gather(points: Sequence[_SolvedPoint]) -> _Panels:
    first = points[0].problem
    loads = read_loads(first, np.array([one.point for one in points]))
    lengths = np.array([one.problem.lengths for one in points])
    curves = draw_strips(
        first.strip,
        lengths.ravel(),
        np.moveaxis(loads.displacements, 0, 2).reshape(2, 2, -1),
        np.moveaxis(loads.pulls[:, 0], 0, 1).reshape(2, -1),
    )
    lower, upper = (
        2.0 * first.half * loads.pulls[:, rope, :, :-1] @ span.end_shear.T * [1.0, -1.0]
        for rope, span in enumerate((first.stations.lower, first.stations.upper))
    )
    return _Panels(
        problem=first,
        loads=loads,
        curves=curves.reshape(*lengths.shape, 2, -1),
        lower=lower,
        upper=upper,
    )


def _build_solutions(
    points: Sequence[_SolvedPoint],
) -> list[PanelSolution | FailedPanel]:
    """Results of some panels; refused if not in balance or on the ground."""
    panels = _gather(points)
    problem = panels.problem
    depths = -panels.curves[:, :, 1].min(axis=(1, 2))
    ropes = [_describe_ropes(panels, which) for which in (0, 1)]
    missing = np.array(_measure_balance(panels)).T.tolist()
    places = problem.half * (1.0 - np.append(problem.stations.xi, 0.0))
    found: list[PanelSolution | FailedPanel] = []
    for k, (one, parts) in enumerate(zip(points, missing, strict=True)):
        balance = PanelBalance(*parts)
        try:
            _require_sound(float(depths[k]), balance, problem)
        except SolveError as failure:
            found.append(_fail(failure))
            continue
        solution = PanelSolution(
            panel=one.problem.panel,
            foot=_as_point(panels.lower[k, :, 0]),
            mid_foot=_as_point(panels.lower[k, :, 1]),
            head=_as_point(panels.upper[k, :, 0]),
            lower=ropes[0][k],
            upper=ropes[1][k],
            stations=places,
            curves=panels.curves[k],
            balance=balance,
            steps=one.steps,
        )
        found.append(solution)
    return found


def _describe_ropes(panels: _Panels, which: int) -> list[RopeForces]:
    """Lower (0) or upper rope of each panel."""
    problem, loads = panels.problem, panels.loads
    along = loads.along[:, which]
    supports = (panels.lower, panels.upper)[which]
    across = np.hypot(supports[:, 0], supports[:, 1]).max(axis=1) / 2.0
    shear = loads.pulls[:, which, :, :-1] @ problem.shear[which].T
    tensions = np.hypot(along[:, None], np.hypot(shear[:, 0], shear[:, 1]))
    middles = loads.displacements[:, which, :, -1]
    return [
        RopeForces(
            along=pull,
            tension=math.hypot(pull, side),
            mid_displacement=_as_point(middles[k]),
            tensions=tensions[k],
        )
        for k, (pull, side) in enumerate(
            zip(along.tolist(), across.tolist(), strict=True)
        )
    ]


def _require_sound(depth: float, balance: PanelBalance, problem: PanelProblem) -> None:
    """Refuse a panel that lies on the ground, or is not in balance."""
    if depth > _ON_GROUND * problem.strip.chord:
        raise SolveError(
            Outcome.OUT_OF_VALIDITY, say("panel.lies_on_ground", depth=depth)
        )
    if not balance.largest <= _BALANCED:
        raise SolveError(
            Outcome.BALANCE_VIOLATED,
            say("panel.out_of_balance", missing=balance.largest, accepted=_BALANCED),
        )


def _measure_balance(panels: _Panels) -> tuple[Floats, Floats, Floats]:
    """Missing forces and moments, from curves and supports as they came out (P6)."""
    problem, loads = panels.problem, panels.loads
    strip, half = problem.strip, problem.half
    load, weights = strip.load, problem.stations.weights
    size, chord = problem.load_size, strip.chord
    lower, upper = panels.lower, panels.upper
    force = lower.sum(axis=-1) + upper.sum(axis=-1) - 2.0 * half * load
    ends = loads.displacements + np.array([(0.0, 0.0), strip.head])[:, :, None]
    held = _cross(ends, loads.pulls).sum(axis=1)
    turned = _cross(panels.curves, strip.forces).sum(axis=-1)
    lever = half**2 / 2.0 * load - half * (lower[..., 1] + upper[..., 1]) / 2.0
    moved = loads.displacements[..., -1]
    lever = lever - (loads.along[:, :, None] * moved).sum(axis=1)
    return (
        np.hypot(force[:, 0], force[:, 1]) / (2.0 * half * size),
        np.abs(turned - held)[:, :-1] @ weights / (size * chord),
        np.hypot(lever[:, 0], lever[:, 1]) / (half * size * chord),
    )


def _cross(a: Floats, b: Floats) -> Floats:
    """Moment of vectors whose components are the dimension before the last."""
    x, y = a[..., 0, :], a[..., 1, :]
    return np.asarray(x * b[..., 1, :] - y * b[..., 0, :])


def _as_point(vector: Floats) -> Point:
    x, y = vector.tolist()
    return x, y
