"""Design points of a limit state: first-order reliability method (FORM).

Theory: reliability/THEORY.md, section 3.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.reliability.limit_state import LimitState
from netdesign.words.message import Message, say

AGREEMENT = 0.05  # of the indices that several starts end with
_START = 3.0  # distance of a start from the origin
_MOST_STEPS = 60
_CLOSE = 5e-4  # distance to the next step at the end
_NEAR = 0.1  # distance to a known design point at which a way ends there
_APART = 0.5  # distance from which two design points are two
_HALVINGS = 8


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
    at_origin, slope = state.differentiate(np.zeros(len(state.variables)))
    if not (np.isfinite(at_origin) and np.isfinite(slope).all() and slope.any()):
        return NotAvailable(reason=say("reliability.no_margin"))
    sign = 1.0 if at_origin >= 0.0 else -1.0
    points: list[DesignPoint] = []
    for start in _list_starts(slope, sign):
        found = _descend(state, start, sign, points)
        if found is None:
            return NotAvailable(reason=say("reliability.not_converged"))
        points.append(found)
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
    origin = np.zeros(len(state.variables))
    sign = 1.0 if state.evaluate(origin[None])[0] >= 0.0 else -1.0
    return _descend(state, origin if before is None else before.place, sign)


def _descend(
    state: LimitState, start: Floats, sign: float, known: Sequence[DesignPoint] = ()
) -> DesignPoint | None:
    """Design point from one start (HL-RF with a line search); None without one.

    A way that comes close to a known design point ends there.
    """
    caps = state.caps
    place, penalty = np.minimum(start, caps), 0.0
    for _ in range(_MOST_STEPS):
        margin, slope = state.differentiate(place)
        size = float(np.linalg.norm(slope))
        if not np.isfinite(margin) or not np.isfinite(size) or size == 0.0:
            return None
        target = _find_nearest(margin, slope, place, caps)
        if target is None:
            return None
        step = target - place
        if np.linalg.norm(step) <= _CLOSE:
            return DesignPoint(place=target, beta=sign * float(np.linalg.norm(target)))
        penalty = max(penalty, 2.0 * float(np.linalg.norm(place)) / size, 1.0 / size)
        place = _search_line(state, place, step, penalty)
        for one in known:
            if np.linalg.norm(place - one.place) <= _NEAR:
                return one
    return None


def _find_nearest(
    margin: float, slope: Floats, place: Floats, caps: Floats
) -> Floats | None:
    """Point of the linearised limit state nearest to the origin, (U9).

    A variable that would pass its cap stays on it, (U10). None where the others cannot
    reach the limit state.
    """
    free = np.ones(len(place), dtype=bool)
    target = np.zeros(len(place))
    for _ in range(len(place)):
        size = float(slope[free] @ slope[free])
        if size == 0.0:
            return None
        level = slope @ place - margin - slope[~free] @ target[~free]
        target[free] = level / size * slope[free]
        beyond = free & (target > caps)
        if not beyond.any():
            return target
        target[beyond] = caps[beyond]
        free &= ~beyond
    return None


def _search_line(
    state: LimitState, place: Floats, step: Floats, penalty: float
) -> Floats:
    """Place on the way of a step at which the merit is least, (U9a)."""
    places = place + 0.5 ** np.arange(_HALVINGS)[:, None] * step
    margins = state.evaluate(places)
    merits = 0.5 * np.sum(places**2, axis=1) + penalty * np.abs(margins)
    chosen: Floats = places[int(np.argmin(merits))]
    return chosen


def _take_different(points: list[DesignPoint]) -> list[DesignPoint]:
    kept: list[DesignPoint] = []
    for one in points:
        if all(np.linalg.norm(one.place - other.place) > _APART for other in kept):
            kept.append(one)
    return kept
