"""A panel at rest: strips and ropes in turn until neither moves the other.

Theory: panel/THEORY.md, section 3.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from netdesign.coupling.solution import Solution
from netdesign.errors import SolveError
from netdesign.guards import require_within
from netdesign.numerics.arrays import Floats
from netdesign.numerics.fixed_point import mix_anderson
from netdesign.outcome import Outcome
from netdesign.panel.inputs import Panel, Rope
from netdesign.panel.ropes import estimate_force_along, solve_force_along
from netdesign.panel.solution import (
    FailedPanel,
    PanelBalance,
    PanelSolution,
    RopeForces,
)
from netdesign.panel.stations import Span, Stations, build_stations
from netdesign.panel.strips import (
    Strip,
    cut_lengths,
    draw_strips,
    pull_strips,
    take_strip,
)
from netdesign.structure.layout import Point
from netdesign.words.message import say

# Stations of half a panel: the error falls to a tenth or so with each, where the net is
# taut to a quarter; six cost hardly more than four.
STATIONS = 6
LARGEST_COUNT = 10  # the polynomial through more loses digits
_STILL = 1e-10  # movement of a rope in the last round, over the chord
_MOST_ROUNDS = 200
_DEPTH = 8
_DAMPING = 1.0  # 8 rounds instead of the 10 that one half takes
_HALVINGS = 8
_START_SAG = 0.02  # at least: a straight rope would have no direction
_BALANCED = 1e-8
_ON_GROUND = 1e-9  # depth below the ground, over the chord


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Problem:
    panel: Panel
    strip: Strip
    stations: Stations
    lengths: Floats

    @property
    def ropes(self) -> tuple[tuple[Rope, Span], tuple[Rope, Span]]:
        """Lower and upper rope."""
        return (
            (self.panel.lower, self.stations.lower),
            (self.panel.upper, self.stations.upper),
        )

    @property
    def half(self) -> float:
        """Half the post spacing [m]."""
        return self.panel.post_spacing / 2.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Round:
    """Pulls of strips on given ropes, and the ropes under these pulls."""

    point: Floats  # displacements of the ropes (2, 2, K + 1) [m]
    pulls: Floats  # on lower and upper rope (2, 2, K) [N/m]
    along: Sequence[float]  # of the two ropes [N]
    image: Floats  # displacements under these pulls (2, 2, K + 1) [m]


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
        return _solve(_build_problem(strip, panel, stations))
    except SolveError as failure:
        return FailedPanel(outcome=failure.outcome, reason=failure.reason)


def _build_problem(strip: Strip, panel: Panel, count: int) -> _Problem:
    stations = build_stations(count, has_mid_anchors=panel.has_mid_anchors)
    return _Problem(
        panel=panel,
        strip=strip,
        stations=stations,
        lengths=cut_lengths(panel, strip, stations),
    )


def _solve(problem: _Problem) -> PanelSolution:
    played, wanted = list[_Round](), _start(problem)
    while len(played) < _MOST_ROUNDS:
        now = _play_between(problem, wanted, played[-1] if played else None)
        played.append(now)
        moved = float(np.abs(now.image - now.point).max())
        if not math.isfinite(moved):
            raise SolveError(Outcome.NONFINITE)
        if moved <= _STILL * problem.strip.chord:
            return _build_solution(problem, now, len(played))
        points, images = [one.point for one in played], [one.image for one in played]
        wanted = mix_anderson(points, images, depth=_DEPTH, damping=_DAMPING)
    raise SolveError(Outcome.MAX_ITERATIONS)


def _play_between(problem: _Problem, wanted: Floats, last: _Round | None) -> _Round:
    """Round on the wanted ropes, or as near to them as strips can be hung."""
    if last is None:
        return _play(problem, wanted, last)
    for _ in range(_HALVINGS):
        try:
            return _play(problem, wanted, last)
        except SolveError:  # ropes that passed each other on the way
            wanted = (wanted + last.point) / 2.0
    return _play(problem, wanted, last)


def _start(problem: _Problem) -> Floats:
    """Parabolas along the chord, the ropes drawn towards each other."""
    along = problem.strip.head / problem.strip.chord
    lower, upper = (
        problem.panel.post_spacing * max(rope.sag, _START_SAG) * span.drape
        for rope, span in problem.ropes
    )
    return np.array([np.outer(along, lower), np.outer(-along, upper)])


def _play(problem: _Problem, displacements: Floats, last: _Round | None) -> _Round:
    """Strips on these ropes, then the ropes under what the strips pull with."""
    strip, half = problem.strip, problem.half
    known = (
        last.pulls[0]
        if last
        else np.repeat(strip.foot_pull[:, None], problem.stations.xi.size, axis=1)
    )
    pulls = pull_strips(strip, problem.lengths[:-1], displacements[..., :-1], known)
    along = tuple(
        _find_along(problem, rope, span, load, last.along[number] if last else None)
        for number, ((rope, span), load) in enumerate(
            zip(problem.ropes, pulls, strict=True)
        )
    )
    image = [
        half**2 / force * load @ span.deflection.T
        for force, load, (_, span) in zip(along, pulls, problem.ropes, strict=True)
    ]
    return _Round(
        point=displacements,
        pulls=pulls,
        along=along,
        image=np.array(image),
    )


def _find_along(
    problem: _Problem, rope: Rope, span: Span, load: Floats, known: float | None
) -> float:
    """Force along the row of a rope under the strips' pulls (2, K)."""
    if known is None:
        mean = float(np.hypot(*(load @ problem.stations.weights)))
        known, _ = estimate_force_along(mean, problem.panel.post_spacing, rope)
    shear = problem.half * load @ span.shear.T
    return solve_force_along(shear, rope, known)


def _build_solution(problem: _Problem, end: _Round, rounds: int) -> PanelSolution:
    """Result of the last round; refused if it is not in balance or on the ground."""
    curves = _draw_curves(problem, end)
    _require_clear_of_ground(problem, curves)
    lower, upper = (
        2.0 * problem.half * load @ span.end_shear.T * [1.0, -1.0]
        for load, (_, span) in zip(end.pulls, problem.ropes, strict=True)
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
        stations=problem.half * (1.0 - np.append(problem.stations.xi, 0.0)),
        curves=curves,
        balance=balance,
        rounds=rounds,
    )


def _describe_rope(
    problem: _Problem, end: _Round, which: int, supports: Floats
) -> RopeForces:
    """Lower (0) or upper rope, from the forces of both bays on its supports (2, 2)."""
    along = end.along[which]
    across = float(np.hypot(*supports).max()) / 2.0
    _, span = problem.ropes[which]
    shear = problem.half * end.pulls[which] @ span.shear.T
    return RopeForces(
        along=along,
        tension=math.hypot(along, across),
        mid_displacement=_as_point(end.image[which][:, -1]),
        tensions=np.asarray(np.hypot(along, np.hypot(*shear))),
    )


def _draw_curves(problem: _Problem, end: _Round) -> Floats:
    """Curves of the strips and of the one in mid-panel, in the section's axes."""
    strip, lengths = problem.strip, problem.lengths
    known = np.column_stack([end.pulls[0], end.pulls[0][:, -1]])
    pulls = pull_strips(strip, lengths, end.image, known)
    return draw_strips(strip, lengths, end.image, pulls[0])


def _require_clear_of_ground(problem: _Problem, curves: Floats) -> None:
    depth = -float(curves[:, 1].min())
    if depth > _ON_GROUND * problem.strip.chord:
        raise SolveError(
            Outcome.OUT_OF_VALIDITY, say("panel.lies_on_ground", depth=depth)
        )


def _measure_balance(
    problem: _Problem, end: _Round, curves: Floats, lower: Floats, upper: Floats
) -> PanelBalance:
    """Missing forces and moments, from curves and supports as they came out (P6)."""
    strip, half = problem.strip, problem.half
    load, weights = strip.load, problem.stations.weights
    size, chord = float(np.hypot(*load)), strip.chord
    force = lower.sum(axis=1) + upper.sum(axis=1) - 2.0 * half * load
    ends = [end.image[0], end.image[1] + strip.head[:, None]]
    held = sum(
        _cross(at[:, :-1], pull) for at, pull in zip(ends, end.pulls, strict=True)
    )
    turned = _cross(curves[:-1].transpose(1, 0, 2), strip.forces[:, None]).sum(axis=1)
    lever = half**2 / 2.0 * load - half * (lower[:, 1] + upper[:, 1]) / 2.0
    for along, moved in zip(end.along, end.image, strict=True):
        lever = lever - along * moved[:, -1]
    return PanelBalance(
        force=float(np.hypot(*force)) / (2.0 * half * size),
        moment_in_section=float(np.abs(turned - held) @ weights) / (size * chord),
        moment_along_row=float(np.hypot(*lever)) / (half * size * chord),
    )


def _cross(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[0] * b[1] - a[1] * b[0])


def _as_point(vector: Floats) -> Point:
    x, y = vector
    return float(x), float(y)
