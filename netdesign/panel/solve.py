"""A panel at rest: strips and ropes by Newton's method on all of them at once.

Theory: panel/THEORY.md, section 3.
"""

from __future__ import annotations

import ctypes
import math

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
from netdesign.panel.solution import (
    FailedPanel,
    PanelBalance,
    PanelSolution,
    RopeForces,
)
from netdesign.panel.strips import Strip, draw_strips, take_strip
from netdesign.structure.layout import Point
from netdesign.words.message import say

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
