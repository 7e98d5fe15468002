"""A panel at rest: strips and ropes by Newton's method on all of them at once.

First: the result, forces on supports and ropes. Theory: panel/THEORY.md, section 3.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from netdesign.core.arguments import locate
from netdesign.core.library import find_core, require_sound
from netdesign.coupling.solution import Solution
from netdesign.numerics.arrays import Floats, Ints, Mask
from netdesign.outcome import Outcome, require_within
from netdesign.panel.equations import (
    PanelProblem,
    RopeLoads,
    build_problem,
    derive_missing,
    describe_panels,
    guess_points,
    read_loads,
    read_point,
)
from netdesign.panel.inputs import Panel
from netdesign.panel.strips import Strip, draw_strips, take_strip
from netdesign.structure.layout import Point
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
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
    """

    along: float
    tension: float
    mid_displacement: Point


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
    balance : float
        Largest force or moment that is missing, (P6), over load (and chord) [-].
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
    balance: float
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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SolvedPanels:
    """Panels of one strip, n of them, as arrays; NaN of one that failed. SI units.

    Attributes
    ----------
    panels : tuple of Panel, shape (n,)
        What was solved.
    failures : dict of int to FailedPanel
        By place, why one has no forces.
    foot, mid_foot, head : ndarray, shape (n, 2)
        (x, y) of the force on the foot anchor beside a post, on that in mid-panel and
        on a post head [N].
    along, tension : ndarray, shape (n, 2)
        H and T of lower and upper rope [N].
    mid_displacement : ndarray, shape (n, 2, 2)
        (x, y) of each rope in mid-panel [m].
    stations, curves, balance, steps : ndarray, shape (n, ..)
        As a `PanelSolution` has them.
    """

    panels: tuple[Panel, ...]
    failures: dict[int, FailedPanel]
    foot: Floats
    mid_foot: Floats
    head: Floats
    along: Floats
    tension: Floats
    mid_displacement: Floats
    stations: Floats
    curves: Floats
    balance: Floats
    steps: Ints

    def describe(self, place: int) -> PanelSolution | FailedPanel:
        """Solution of the panel at a place, or why it has none."""
        if place in self.failures:
            return self.failures[place]
        lower, upper = (
            RopeForces(
                along=float(self.along[place, rope]),
                tension=float(self.tension[place, rope]),
                mid_displacement=_as_point(self.mid_displacement[place, rope]),
            )
            for rope in (0, 1)
        )
        return PanelSolution(
            panel=self.panels[place],
            foot=_as_point(self.foot[place]),
            mid_foot=_as_point(self.mid_foot[place]),
            head=_as_point(self.head[place]),
            lower=lower,
            upper=upper,
            stations=self.stations[place],
            curves=self.curves[place],
            balance=float(self.balance[place]),
            steps=int(self.steps[place]),
        )


# Share of the chord that a cut must leave between two ropes; choice of this program.
LEAST_NET = 0.1
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
_SOLVED, _NOT_FOUND, _TOO_MANY_STEPS = 0, 1, 2  # as in panel.c
_UNSOLVED = {
    _NOT_FOUND: FailedPanel(
        outcome=Outcome.NO_EQUILIBRIUM, reason=say("panel.not_found")
    ),
    _TOO_MANY_STEPS: FailedPanel(
        outcome=Outcome.MAX_ITERATIONS, reason=Outcome.MAX_ITERATIONS.message
    ),
}
_NO_NET = FailedPanel(outcome=Outcome.OUT_OF_VALIDITY, reason=say("panel.no_net_left"))


def solve_panel(
    solution: Solution, panel: Panel, *, stations: int = STATIONS
) -> PanelSolution | FailedPanel:
    """Solve a panel of a row whose section at the post has been solved.

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
    solved = solve_strips(take_strip(solution), (panel,), stations=stations)
    return solved.describe(0)


def solve_strips(
    strip: Strip, panels: Sequence[Panel], *, stations: int = STATIONS
) -> SolvedPanels:
    """Solve panels whose strips are like the net at the post, as ``solve_panel``.

    Parameters
    ----------
    strip : Strip
        At the post.
    panels : sequence of Panel
        At least one; of one spacing and kind of anchors, with ropes and cuts.
    stations : int
        K, strips on half the panel, 1 to 10 [-].

    Raises
    ------
    ModelError
        If K is out of its range.
    """
    require_within("stations", stations, 1, LARGEST_COUNT)
    problem = build_problem(strip, panels, stations)
    chord, points = problem.strip.chord, guess_points(problem)
    has_net = (chord - problem.ropes.cut_off).min(axis=1) > LEAST_NET * chord
    points[~has_net] = np.nan
    core = find_core()
    if core is None:
        ends = [_solve(problem, place, point) for place, point in enumerate(points)]
        steps, codes = np.array(ends).T
    else:
        steps, codes = _solve_compiled(core, problem, points)
    points[codes != _SOLVED] = np.nan
    failures = {
        k: _UNSOLVED[code] if has_net[k] else _NO_NET
        for k, code in enumerate(codes.tolist())
        if code != _SOLVED
    }
    return _read_panels(problem, points, steps, failures)


def _solve(problem: PanelProblem, place: int, point: Floats) -> tuple[int, int]:
    """Move a point to where nothing is missing: steps, and how they ended.

    A step is halved until the next one, by the same derivatives, would be shorter:
    that needs no common measure of gaps and lengths (Deuflhard's natural test).
    """
    state = read_point(problem, place, point)
    for number in range(1, _MOST_STEPS + 1):
        try:
            inverse = np.linalg.inv(derive_missing(problem, place, state))
        except np.linalg.LinAlgError:
            return number, _NOT_FOUND
        step = -inverse @ state.missing
        share = min(1.0, _LONGEST_STEP / max(_LONGEST_STEP, *np.abs(step[-2:])))
        for _ in range(_HALVINGS):
            tried = read_point(problem, place, point + share * step)
            left = float(np.linalg.norm(inverse @ tried.missing))
            is_last = left <= _STILL
            if is_last or left <= (1.0 - share / 4.0) * float(np.linalg.norm(step)):
                break
            share /= 2.0
        else:
            return number, _NOT_FOUND
        point += share * step
        if is_last:
            return number, _SOLVED
        state = tried
    return _MOST_STEPS, _TOO_MANY_STEPS


def _solve_compiled(
    core: ctypes.PyDLL, problem: PanelProblem, points: Floats
) -> tuple[Ints, Ints]:
    """Move the points of all panels by the compiled core, as `_solve` moves one."""
    argument, kept = describe_panels(problem)
    argument.still, argument.longest_step = _STILL, _LONGEST_STEP
    argument.most_steps, argument.most_halvings = _MOST_STEPS, _HALVINGS
    ends = np.empty((len(points), 2), dtype=np.int32)
    where = (ctypes.c_void_p(locate(array)) for array in (points, ends))
    require_sound(core.nd_panels(ctypes.byref(argument), len(points), *where))
    del kept  # the core had its addresses
    steps, codes = ends.T.astype(np.int64)
    return steps, codes


def _read_panels(
    problem: PanelProblem,
    points: Floats,
    steps: Ints,
    failures: dict[int, FailedPanel],
) -> SolvedPanels:
    """Results at the points; refused where out of balance or on the ground."""
    loads, count = read_loads(problem, points), len(points)
    curves = draw_strips(
        problem.strip,
        problem.lengths.ravel(),
        np.moveaxis(loads.displacements, 0, 2).reshape(2, 2, -1),
        np.moveaxis(loads.pulls[:, 0], 0, 1).reshape(2, -1),
    ).reshape(*problem.lengths.shape, 2, -1)
    stations = problem.ropes.stations
    supports = tuple(  # x and y, post and mid-panel, of both bays
        2.0
        * problem.half
        * loads.pulls[:, rope, :, :-1]
        @ span.end_shear.T
        * _BOTH_WAYS
        for rope, span in enumerate((stations.lower, stations.upper))
    )
    balance = _measure_balance(problem, loads, curves, supports)
    across = np.stack(
        [np.hypot(x[:, 0], x[:, 1]).max(axis=1) for x in supports], axis=1
    )
    places = problem.half * (1.0 - np.append(stations.xi, 0.0))
    return SolvedPanels(
        panels=problem.ropes.panels,
        failures=_refuse(problem, curves, balance) | failures,
        foot=supports[0][:, :, 0],
        mid_foot=supports[0][:, :, 1],
        head=supports[1][:, :, 0],
        along=loads.along,
        tension=np.hypot(loads.along, across / 2.0),
        mid_displacement=loads.displacements[..., -1],
        stations=np.broadcast_to(places, (count, places.size)),
        curves=curves,
        balance=balance,
        steps=steps,
    )


_BOTH_WAYS = np.array([1.0, -1.0])


def _refuse(
    problem: PanelProblem, curves: Floats, balance: Floats
) -> dict[int, FailedPanel]:
    """Refuse panels that lie on the ground, or are not in balance."""
    depths = -curves[:, :, 1].min(axis=(1, 2))
    lies: Mask = depths > _ON_GROUND * problem.strip.chord
    refused = {}
    for k in np.flatnonzero(lies | ~(balance <= _BALANCED)).tolist():
        if lies[k]:
            outcome, reason = (
                Outcome.OUT_OF_VALIDITY,
                say("panel.lies_on_ground", depth=float(depths[k])),
            )
        else:
            amount = float(balance[k])
            outcome, reason = (
                Outcome.BALANCE_VIOLATED,
                say("panel.out_of_balance", missing=amount, accepted=_BALANCED),
            )
        refused[k] = FailedPanel(outcome=outcome, reason=reason)
    return refused


def _measure_balance(
    problem: PanelProblem,
    loads: RopeLoads,
    curves: Floats,
    supports: tuple[Floats, ...],
) -> Floats:
    """Largest missing force or moment (n,), of curves and supports as they are (P6).

    Of the load on feet and heads; of the strips about the foot's line; of half the
    panel about the post's section.
    """
    strip, half = problem.strip, problem.half
    load, weights = strip.load, problem.ropes.stations.weights
    size, chord = problem.load_size, strip.chord
    lower, upper = supports
    force = lower.sum(axis=-1) + upper.sum(axis=-1) - 2.0 * half * load
    ends = loads.displacements + np.array([(0.0, 0.0), strip.head])[:, :, None]
    held = _cross(ends, loads.pulls).sum(axis=1)
    turned = _cross(curves, strip.forces).sum(axis=-1)
    lever = half**2 / 2.0 * load - half * (lower[..., 1] + upper[..., 1]) / 2.0
    moved = loads.displacements[..., -1]
    lever = lever - (loads.along[:, :, None] * moved).sum(axis=1)
    parts = (
        np.hypot(force[:, 0], force[:, 1]) / (2.0 * half * size),
        np.abs(turned - held)[:, :-1] @ weights / (size * chord),
        np.hypot(lever[:, 0], lever[:, 1]) / (half * size * chord),
    )
    return np.asarray(np.max(parts, axis=0))


def _cross(a: Floats, b: Floats) -> Floats:
    """Moment of vectors whose components are the dimension before the last."""
    x, y = a[..., 0, :], a[..., 1, :]
    return np.asarray(x * b[..., 1, :] - y * b[..., 0, :])


def _as_point(vector: Floats) -> Point:
    x, y = vector.tolist()
    return x, y
