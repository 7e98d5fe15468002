"""Tensions of the net, and its friction where it slides through its nodes, in one step.

Which nodes slide, and how far, follows from one strictly convex function of the
material coordinates S_i of the nodes. Each Newton step keeps the friction as it is,
kinks included, and solves the step's own problem exactly by a sweep from foot to
head and back; so nothing is guessed about which nodes slide, and nothing stalls.
Theory: cable/THEORY.md, eqs (C10), (C11) and (C13) to (C17).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from netdesign.cable.net import compute_turning_angles
from netdesign.numerics.arrays import Floats, Signs
from netdesign.outcome import ModelError, Outcome, name_quantity, require_positive
from netdesign.words.message import say

_ACCEPTED_CLIMB = 0.5
_SHORTEST_STEP = 1e-12
_TO_BOUNDARY = 0.9  # part of the way to T = 0 that one step may go
# Breach of (C14), a difference of logarithms of tensions, that counts as none; what
# rounding makes of the smallest elongation is added.
_TOLERANCE = 1e-10
_ROUNDING = float(np.finfo(float).eps)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SlidingStep:
    """The net after a step; usable only if converged.

    Attributes
    ----------
    outcome : Outcome
        Converged, or why not.
    lengths : ndarray, shape (n + 1,)
        Unstressed lengths lo_i; their sum is that of before [m].
    tensions : ndarray, shape (n + 1,)
        T_i, at least 0; all 0 of a net that is longer than its polygon [N/m].
    slides : ndarray, shape (n,)
        S_i - S_old_i; exactly 0 where the net sticks [m].
    """

    outcome: Outcome
    lengths: Floats
    tensions: Floats
    slides: Floats

    @property
    def slide_signs(self) -> Signs:
        """Direction at each node, shape (n,): 1 net to foot, -1 to head, 0 sticks."""
        return np.sign(self.slides).astype(np.int8)


def solve_sliding(
    final_lengths: Floats,
    old_lengths: Floats,
    bounds: Floats,
    *,
    stiffness: float,
    max_iterations: int = 60,
) -> SlidingStep:
    """Slide the net through its nodes as far as friction asks, (C13) and (C14).

    Parameters
    ----------
    final_lengths : ndarray, shape (n + 1,)
        l_i, lengths of the segments between the nodes as the snow has placed them [m].
    old_lengths : ndarray, shape (n + 1,)
        Unstressed lengths before the step [m].
    bounds : ndarray, shape (n,)
        kappa_i of ``compute_ratio_bounds``; infinite where nothing can slide [-].
    stiffness : float
        ES [N/m].
    max_iterations : int
        Newton steps allowed; 3 to 7 are taken whatever the friction and the mesh.

    Returns
    -------
    SlidingStep
        Never raises for a failed iteration; see its outcome.

    Raises
    ------
    ModelError
        If a length is not above 0, a bound is below 0, or the shapes do not match.

    Verified by
    -----------
    tests/verification/test_sliding_cable.py
    """
    _require_matching(final_lengths, old_lengths, bounds)
    cuts = np.flatnonzero(np.isinf(bounds)) + 1
    parts = []
    for first, end in pairwise([0, *cuts.tolist(), final_lengths.size]):
        problem = _Problem(
            final=final_lengths[first:end],
            old=old_lengths[first:end],
            bounds=bounds[first : end - 1],
        )
        parts.append(_solve_part(problem, max_iterations))
    return _join_parts(parts, final_lengths, stiffness)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Problem:
    """A part of the net that exchanges no length with its neighbours."""

    final: Floats
    old: Floats
    bounds: Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Point:
    """An iterate. Elongations l - lo, not lengths, keep the digits of tensions."""

    elongations: Floats
    slides: Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Part:
    """End of the solve of one part."""

    outcome: Outcome
    lengths: Floats
    slides: Floats


def _solve_part(problem: _Problem, max_iterations: int) -> _Part:
    if problem.final.sum() - problem.old.sum() <= 0.0:  # no length to stretch
        return _slacken(problem)
    point = _start_uniform(problem)
    for iteration in range(max_iterations + 1):
        log_tensions = _log_tensions(problem, point)
        breach = _find_breach(problem, point, log_tensions)
        if breach <= _TOLERANCE + _find_rounding(problem, point):
            return _end(Outcome.CONVERGED, problem, point)
        if iteration == max_iterations:
            break
        following = _take_step(problem, point, log_tensions)
        if following is None:
            return _end(Outcome.DIVERGED, problem, point)
        point = following
    return _end(Outcome.MAX_ITERATIONS, problem, point)


def _slacken(problem: _Problem) -> _Part:
    """Lengths without tension: short segments draw in the surplus of the others."""
    surplus = np.maximum(problem.old - problem.final, 0.0)
    shortage = np.maximum(problem.final - problem.old, 0.0)
    drawn = float(shortage.sum() / surplus.sum()) if shortage.any() else 0.0
    lengths = np.maximum(problem.old + shortage - drawn * surplus, problem.final)
    return _Part(
        outcome=Outcome.CONVERGED,
        lengths=lengths,
        slides=np.cumsum(lengths - problem.old)[:-1],
    )


def _start_uniform(problem: _Problem) -> _Point:
    """Start of the iteration: equal strain in all segments, exact without friction."""
    shrunk = problem.old.sum() / problem.final.sum()
    elongations = problem.final - problem.final * shrunk
    slides = np.cumsum(problem.final - elongations - problem.old)[:-1]
    return _Point(elongations=elongations, slides=slides)


def _log_tensions(problem: _Problem, point: _Point) -> Floats:
    """Log (T_i / ES), shape (n + 1,)."""
    elongations = point.elongations
    logs: Floats = np.log(elongations / (problem.final - elongations))
    return logs


def _find_breach(problem: _Problem, point: _Point, log_tensions: Floats) -> float:
    """Largest residual of (C14)."""
    steps = np.diff(log_tensions)
    sliding = np.abs(steps + problem.bounds * np.sign(point.slides))
    sticking = np.maximum(np.abs(steps) - problem.bounds, 0.0)
    return float(np.where(point.slides != 0.0, sliding, sticking).max(initial=0.0))


def _find_rounding(problem: _Problem, point: _Point) -> float:
    """Rounding of the lengths over the smallest elongation."""
    lengths = np.maximum(problem.final, problem.old)
    return _ROUNDING * float((lengths / point.elongations).max())


def _take_step(problem: _Problem, point: _Point, log_tensions: Floats) -> _Point | None:
    """Newton step on (C13), halved while it climbs; None if it never descends."""
    lengths = problem.final - point.elongations
    compliances = lengths * point.elongations / problem.final
    unslid = log_tensions + (lengths - problem.old) / compliances
    solution, side = _sweep(unslid, compliances, problem.bounds)
    stretch = compliances * (solution - log_tensions)
    travel = -np.cumsum(stretch)[:-1]
    slides = point.slides + travel
    slides = np.where(slides * side > 0.0, slides, 0.0)
    step = min(1.0, _TO_BOUNDARY * _step_to_boundary(point, stretch, lengths))
    descent = -_slope(problem, log_tensions, point.slides, travel, leaving=True)
    while step > _SHORTEST_STEP:
        candidate = _Point(
            elongations=point.elongations + step * stretch,
            slides=slides if step == 1.0 else point.slides + step * travel,
        )
        logs = _log_tensions(problem, candidate)
        climb = _slope(problem, logs, candidate.slides, travel, leaving=False)
        if climb <= _ACCEPTED_CLIMB * abs(descent):
            return candidate
        step /= 2.0
    return None


def _step_to_boundary(point: _Point, stretch: Floats, lengths: Floats) -> float:
    """Largest step that leaves every elongation and every length above 0."""
    shrinking = (-stretch / point.elongations).max()
    lengthening = (stretch / lengths).max()
    return 1.0 / max(float(shrinking), float(lengthening), _ROUNDING)


def _slope(
    problem: _Problem,
    log_tensions: Floats,
    slides: Floats,
    travel: Floats,
    *,
    leaving: bool,
) -> float:
    """Slope of (C13) along the travel; at a kink on its far side, else its near."""
    kink = np.sign(travel) if leaving else -np.sign(travel)
    signs = np.where(slides != 0.0, np.sign(slides), kink)
    return float(travel @ (np.diff(log_tensions) + problem.bounds * signs))


def _sweep(
    unslid: Floats, compliances: Floats, bounds: Floats
) -> tuple[Floats, Floats]:
    """Exact solution of the linearised problem (C16), by the sweep (C17).

    Parameters
    ----------
    unslid : ndarray, shape (n + 1,)
        a_i, logarithms of tensions if nothing had slid [-].
    compliances : ndarray, shape (n + 1,)
        c_i [m].
    bounds : ndarray, shape (n,)
        kappa_i, finite [-].

    Returns
    -------
    solution : ndarray, shape (n + 1,)
        Logarithms of tensions [-].
    side : ndarray, shape (n,)
        Sign of the slide at each node, 0 where it sticks.
    """
    below: list[tuple[float, float]] = []
    above: list[tuple[float, float]] = []
    best: list[float] = []
    limits = bounds.tolist()
    shift = 0.0
    for target, compliance, limit in zip(
        unslid.tolist(), compliances.tolist(), [*limits, 0.0], strict=True
    ):
        root, slope = _walk(-target, compliance, below, above, shift)
        root, slope = _walk(-root, slope, above, below, shift)
        best.append(root)
        # the zero opens into a flat of half width kappa; all kinks move outward
        below.append((-root - shift, slope))
        above.append((root - shift, slope))
        shift += limit
    solution = best.copy()
    for i in range(len(limits) - 1, -1, -1):
        upper = solution[i + 1]
        solution[i] = min(max(best[i], upper - limits[i]), upper + limits[i])
    result = np.array(solution)
    return result, np.sign(np.array(best) - result)[:-1]


def _walk(
    root: float,
    slope: float,
    ahead: list[tuple[float, float]],
    behind: list[tuple[float, float]],
    shift: float,
) -> tuple[float, float]:
    """Follow a piecewise linear function past the kinks ahead, to where it is zero.

    Kinks are (place less ``shift``, increase of slope beyond), the nearest last, with
    places counted outward; passed ones are mirrored onto the stack behind.
    """
    least = slope
    while ahead and ahead[-1][0] + shift < root:
        place, increase = ahead.pop()
        behind.append((-place - 2.0 * shift, -increase))
        rest = slope * (root - place - shift)
        slope = max(slope + increase, least)
        root = place + shift + rest / slope
    return root, slope


def _end(outcome: Outcome, problem: _Problem, point: _Point) -> _Part:
    """Lengths of the last iterate; to the digit the old ones where nothing slid."""
    moved = np.diff(point.slides, prepend=0.0, append=0.0) != 0.0
    return _Part(
        outcome=outcome,
        lengths=np.where(moved, problem.final - point.elongations, problem.old),
        slides=point.slides,
    )


def _join_parts(parts: list[_Part], final: Floats, stiffness: float) -> SlidingStep:
    failed = [p.outcome for p in parts if p.outcome is not Outcome.CONVERGED]
    between = [piece for part in parts for piece in ([0.0], part.slides)][1:]
    lengths = np.concatenate([part.lengths for part in parts])
    return SlidingStep(
        outcome=failed[0] if failed else Outcome.CONVERGED,
        lengths=lengths,
        tensions=compute_tensions(final, lengths, stiffness),
        slides=np.concatenate(between),
    )


def _require_matching(final: Floats, old: Floats, bounds: Floats) -> None:
    require_lengths("final length", final)
    require_lengths("old unstressed length", old)
    if not (old.shape == final.shape == (bounds.size + 1,)):
        raise ModelError(
            say(
                "cable.sliding_sizes",
                final=final.size,
                old=old.size,
                bounds=bounds.size,
            )
        )
    if not (bounds >= 0.0).all():
        raise ModelError(say("cable.ratio_bounds", bounds=repr(bounds)))


def join_points(nodes: Floats, head: Floats) -> Floats:
    """Points of a net: its foot at the origin, its nodes, its head.

    Parameters
    ----------
    nodes : ndarray, shape (2, n)
        Foot and head left out [m, or any unit].
    head : ndarray, shape (2,)
        In that unit.

    Returns
    -------
    ndarray, shape (2, n + 2)
        In that unit.
    """
    points = np.zeros((2, nodes.shape[1] + 2))
    points[:, 1:-1], points[:, -1] = nodes, head
    return points


def compute_segment_lengths(points: Floats) -> Floats:
    """Final lengths of the segments.

    Parameters
    ----------
    points : ndarray, shape (2, n + 2)
        Foot, nodes and head [m].

    Returns
    -------
    ndarray, shape (n + 1,)
        l_i [m].

    Raises
    ------
    ModelError
        If two neighbours coincide or a coordinate is not finite.
    """
    lengths: Floats = np.hypot(*np.diff(points))
    require_lengths("segment length", lengths)
    return lengths


def compute_tensions(
    final_lengths: Floats, unstressed_lengths: Floats, stiffness: float
) -> Floats:
    """Tensions of elastic segments, eq. (C10); a slack segment has none.

    Parameters
    ----------
    final_lengths, unstressed_lengths : ndarray, shape (n + 1,)
        l_i and lo_i [m].
    stiffness : float
        ES, force per width at unit strain [N/m].

    Returns
    -------
    ndarray, shape (n + 1,)
        T_i, at least 0 [N/m].

    Raises
    ------
    ModelError
        If a length or the stiffness is not above 0.
    """
    require_lengths("unstressed length", unstressed_lengths)
    require_positive("net stiffness", stiffness, "N/m")
    strains = (final_lengths - unstressed_lengths) / unstressed_lengths
    tensions: Floats = stiffness * np.maximum(strains, 0.0)
    return tensions


def compute_node_forces(points: Floats, tensions: Floats) -> tuple[Floats, Floats]:
    """Components of the net's forces on the snow at its nodes, eq. (C11).

    Parameters
    ----------
    points : ndarray, shape (2, n + 2)
        Foot, nodes and head [m].
    tensions : ndarray, shape (n + 1,)
        T_i [N/m].

    Returns
    -------
    tuple of ndarray, shape (n,)
        R_n along the bisector of the node, positive where the net presses, and R_t
        across it, positive towards the head [N/m].

    Source
    ------
    The paper's Eq. 11, whose angle theta_{i-1} - theta_i is beta_i here.
    """
    half = compute_turning_angles(points) / 2.0
    normal = (tensions[1:] + tensions[:-1]) * np.sin(half)
    return normal, (tensions[1:] - tensions[:-1]) * np.cos(half)


def require_lengths(name: str, lengths: Floats) -> None:
    """Refuse an array unless all its entries are finite and above zero.

    Parameters
    ----------
    name : str
        For the message.
    lengths : ndarray
        Any shape [m].

    Raises
    ------
    ModelError
        With the first entry that is not.
    """
    sound = np.isfinite(lengths) & (lengths > 0.0)
    if not sound.all():
        first = int(np.argmin(sound))
        raise ModelError(
            say(
                "guard.positive_entry",
                name=name_quantity(name),
                place=first,
                value=float(lengths[first]),
            )
        )
