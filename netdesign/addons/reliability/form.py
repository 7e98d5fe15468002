"""Design points of a limit state: first-order reliability method (FORM).

Theory: addons/reliability/THEORY.md, section 3.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from netdesign.addons.reliability.limit_state import LimitState
from netdesign.numerics.arrays import Floats
from netdesign.words.message import Message, say

AGREEMENT = 0.05  # of the indices that several starts end with
_START = 3.0  # distance of a start from the origin
_MOST_STEPS = 60
_CLOSE = 5e-3  # distance to the next step at the end: 1e-5 of the index
_APART = 0.5  # distance from which two design points are two
_HALVINGS = 8
_MEMORY = 1  # steps back with whose merit a whole step is compared, too
_ON_IT = 1e-3  # margin below which a place counts as on the limit state


@dataclass(frozen=True, slots=True, kw_only=True)
class NotAvailable:
    """Reliability that is not available, with the reason."""

    reason: Message


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DesignPoint:
    """Most probable point of failure.

    Attributes
    ----------
    place : ndarray, shape (variables,)
        In standard normal space.
    beta : float
        Distance from the origin; negative where the origin is failure.
    """

    place: Floats
    beta: float

    @property
    def alpha_squared(self) -> Floats:
        """Shares of the variables in the squared distance; their sum is 1, (U11)."""
        shares: Floats = self.place**2 / np.sum(self.place**2)
        return shares


def find_design_points(state: LimitState) -> tuple[DesignPoint, ...] | NotAvailable:
    """Different design points, the nearest first; from several starts.

    Not available where a start does not converge, or where two disagree.
    """
    (at_origin,), (slope,) = state.differentiate(np.zeros((1, len(state.variables))))
    if not (np.isfinite(at_origin) and np.isfinite(slope).all() and slope.any()):
        return NotAvailable(reason=say("reliability.no_margin"))
    sign = 1.0 if at_origin >= 0.0 else -1.0
    found = _descend(state, np.array(list(_list_starts(slope, sign))), sign)
    points = [one for one in found if one is not None]
    if len(points) < len(found):
        return NotAvailable(reason=say("reliability.not_converged"))
    points.sort(key=lambda one: abs(one.beta))
    low, high = points[0].beta, points[-1].beta
    if abs(high - low) > AGREEMENT:
        return NotAvailable(reason=say("reliability.disagree", low=low, high=high))
    return tuple(_take_different(points))


def _list_starts(slope: Floats, sign: float) -> Iterator[Floats]:
    """The origin, and a place along each variable towards the limit state.

    To both sides of a variable that the margin at the origin does not feel.
    """
    yield np.zeros(len(slope))
    for k, steep in enumerate(slope):
        for side in (-sign * np.sign(steep),) if steep else (-1.0, 1.0):
            start = np.zeros(len(slope))
            start[k] = _START * side
            yield start


def follow_design_point(
    state: LimitState, before: DesignPoint | None
) -> DesignPoint | None:
    """One design point, from that of a state that differs little, or from the origin.

    None where it does not converge.
    """
    start = np.zeros(len(state.variables)) if before is None else before.place
    sign = 1.0 if state.evaluate(np.zeros((1, len(start))))[0] >= 0.0 else -1.0
    (found,) = _descend(state, start[None], sign)
    return found


def approach_design_point(
    state: LimitState, point: DesignPoint, shift: float
) -> Floats:
    """Place near the design point of the margins plus ``shift``: one step of (U9).

    NaN where the step has no end.
    """
    (margin,), (slope,) = state.differentiate(point.place[None])
    return _find_nearest(margin + shift, slope, point.place, state.caps)


def _descend(
    state: LimitState, starts: Floats, sign: float
) -> list[DesignPoint | None]:
    """Design points from starts of shape (n, variables); None where there is none.

    HL-RF, all starts at once, with a line search where a whole step is no gain.
    """
    caps = state.caps
    found: list[DesignPoint | None] = [None] * len(starts)
    active = np.arange(len(starts))
    places, weights = np.minimum(starts, caps), np.zeros(len(starts))
    margins, slopes = state.differentiate(places)
    past = np.empty((2, 0, len(starts)))
    for _ in range(_MOST_STEPS):
        targets = np.array(
            [
                _find_nearest(*one, caps)
                for one in zip(margins, slopes, places, strict=True)
            ]
        )
        sizes = np.linalg.norm(targets - places, axis=1)
        for one in np.flatnonzero(sizes <= _CLOSE):
            beta = sign * float(np.linalg.norm(targets[one]))
            found[active[one]] = DesignPoint(place=targets[one], beta=beta)
        on = sizes > _CLOSE  # False also of a start without a target
        if not on.any():
            break
        active, places, targets = active[on], places[on], targets[on]
        margins, slopes = margins[on], slopes[on]
        now = _find_weights(margins, slopes, places, targets)
        weights = np.maximum(weights[on], now)
        now_at = _measure(places, margins)[:, None]
        past = np.concatenate([past[:, -_MEMORY:, on], now_at], axis=1)
        limits = (past[0] + weights * past[1]).max(axis=0)
        places, margins, slopes = _step(state, places, targets, weights, limits)
    return found


def _step(
    state: LimitState, places: Floats, targets: Floats, weights: Floats, limits: Floats
) -> tuple[Floats, Floats, Floats]:
    """Next places with margins and gradients: the targets, or nearer than those."""
    following = targets.copy()
    margins, slopes = state.differentiate(following)
    far, off = _measure(following, margins)
    worse = far + weights * off >= limits
    if worse.any():
        steps = targets[worse] - places[worse]
        nearer = _search_lines(state, places[worse], steps, weights[worse])
        following[worse] = nearer
        margins[worse], slopes[worse] = state.differentiate(nearer)
    return following, margins, slopes


def _measure(places: Floats, margins: Floats) -> Floats:
    """Both parts of the merit (U9a): half the squared distance, and the margin."""
    return np.stack([0.5 * np.sum(places**2, axis=-1), np.abs(margins)])


def _find_nearest(margin: float, slope: Floats, place: Floats, caps: Floats) -> Floats:
    """Point of the linearised limit state nearest to the origin, (U9).

    A variable that would pass its cap stays on it, (U10). NaN where the others cannot
    reach the limit state.
    """
    free = np.ones(len(place), dtype=bool)
    target = np.zeros(len(place))
    for _ in range(len(place)):
        size = float(slope[free] @ slope[free])
        if not (math.isfinite(margin) and math.isfinite(size) and size > 0.0):
            break
        level = slope @ place - margin - slope[~free] @ target[~free]
        target[free] = level / size * slope[free]
        beyond = free & (target > caps)
        if not beyond.any():
            return target
        target[beyond] = caps[beyond]
        free &= ~beyond
    return np.full(len(place), math.nan)


def _find_weights(
    margins: Floats, slopes: Floats, places: Floats, targets: Floats
) -> Floats:
    """Weights w of the margin in the merit, (U9b)."""
    least = np.linalg.norm(places, axis=1) / np.linalg.norm(slopes, axis=1)
    far = 0.5 * np.sum(targets**2, axis=1) / np.maximum(np.abs(margins), _ON_IT)
    result: Floats = 2.0 * np.maximum(least, far)
    return result


def _search_lines(
    state: LimitState, places: Floats, steps: Floats, weights: Floats
) -> Floats:
    """Places on the ways of steps at which the merits are least, (U9a)."""
    shares = 0.5 ** np.arange(_HALVINGS)[:, None]
    tried = places[:, None] + shares * steps[:, None]
    margins = state.evaluate(tried.reshape(-1, places.shape[1])).reshape(-1, _HALVINGS)
    far, off = _measure(tried, margins)
    merits = far + weights[:, None] * off
    chosen: Floats = tried[np.arange(len(places)), merits.argmin(axis=1)]
    return chosen


def _take_different(points: list[DesignPoint]) -> list[DesignPoint]:
    kept: list[DesignPoint] = []
    for one in points:
        if all(np.linalg.norm(one.place - other.place) > _APART for other in kept):
            kept.append(one)
    return kept
