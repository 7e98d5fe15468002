"""Reliability index of a limit state: design points by FORM, sampling about them.

Theory: addons/reliability/THEORY.md, sections 3 and 4.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from netdesign.addons.reliability.variables import LimitState
from netdesign.numerics.arrays import Floats
from netdesign.outcome import ModelError
from netdesign.words.message import say

AGREEMENT = 0.05  # of the indices that several starts end with
_START = 3.0  # distance of a start from the origin
_MOST_STEPS = 60
_CLOSE = 5e-3  # distance to the next step at the end: 1e-5 of the index
_APART = 0.5  # distance from which two design points are two
_HALVINGS = 8
_MEMORY = 1  # steps back with whose merit a whole step is compared, too
_ON_IT = 1e-3  # margin below which a place counts as on the limit state


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


def find_design_points(state: LimitState) -> list[DesignPoint]:
    """Different design points, the nearest first; from several starts.

    Raises
    ------
    ModelError
        If a start does not converge, or two disagree.
    """
    (at_origin,), (slope,) = state.differentiate(np.zeros((1, len(state.variables))))
    if not (np.isfinite(at_origin) and np.isfinite(slope).all() and slope.any()):
        raise ModelError(say("reliability.no_margin"))
    sign = 1.0 if at_origin >= 0.0 else -1.0
    ends = _descend(state, np.array(list(_list_starts(slope, sign))), sign)
    points = [end for end in ends if end is not None]
    if len(points) < len(ends):
        raise ModelError(say("reliability.not_converged"))
    points.sort(key=lambda end: abs(end.beta))
    low, high = points[0].beta, points[-1].beta
    if abs(high - low) > AGREEMENT:
        raise ModelError(say("reliability.disagree", low=low, high=high))
    return _take_different(points)


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


def follow_design_point(state: LimitState, before: DesignPoint | None) -> DesignPoint:
    """One design point, from that of a state that differs little, or from the origin.

    Raises
    ------
    ModelError
        If it does not converge.
    """
    start = np.zeros(len(state.variables)) if before is None else before.place
    sign = 1.0 if state.evaluate(np.zeros((1, len(start))))[0] >= 0.0 else -1.0
    (following,) = _descend(state, start[None], sign)
    if following is None:
        raise ModelError(say("reliability.not_converged"))
    return following


def _descend(
    state: LimitState, starts: Floats, sign: float
) -> list[DesignPoint | None]:
    """Design points from starts of shape (n, variables); None where there is none.

    HL-RF, all starts at once, with a line search where a whole step is no gain.
    """
    caps = state.caps
    ends: list[DesignPoint | None] = [None] * len(starts)
    active = np.arange(len(starts))
    places, weights = np.minimum(starts, caps), np.zeros(len(starts))
    margins, slopes = state.differentiate(places)
    past = np.empty((2, 0, len(starts)))
    for _ in range(_MOST_STEPS):
        targets = np.array(
            [
                _find_nearest(*parts, caps)
                for parts in zip(margins, slopes, places, strict=True)
            ]
        )
        sizes = np.linalg.norm(targets - places, axis=1)
        for number in np.flatnonzero(sizes <= _CLOSE):
            beta = sign * float(np.linalg.norm(targets[number]))
            ends[active[number]] = DesignPoint(place=targets[number], beta=beta)
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
    return ends


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
    for point in points:
        if all(np.linalg.norm(point.place - other.place) > _APART for other in kept):
            kept.append(point)
    return kept


LARGEST_ERROR = 0.02  # standard error of an index that is stated
_GOAL = 0.018  # at which the sampling ends
_BATCH = 500
_MOST_BATCHES = 150
SEED = 1945


@dataclass(frozen=True, slots=True, kw_only=True)
class Estimate:
    """Index with its standard error, and the number of samples."""

    beta: float
    standard_error: float
    samples: int

    @property
    def is_sound(self) -> bool:
        """The error is known and small enough to state the index."""
        return self.standard_error < LARGEST_ERROR


def estimate_betas(
    state: LimitState,
    centres: Floats,
    shifts: Sequence[float] = (0.0,),
    seed: int = SEED,
) -> list[Estimate]:
    """Reliability indices by the same samples, (U12) to (U14).

    Parameters
    ----------
    state : LimitState
        Its margins are evaluated.
    centres : ndarray, shape (n, variables)
        Places around which samples are drawn, in standard normal space.
    shifts : sequence of float
        What is added to every margin, for each index.
    seed : int
        Of the samples.
    """
    random = np.random.default_rng(seed)
    values = np.empty((len(shifts), 0))
    estimates: list[Estimate] = []
    for _ in range(_MOST_BATCHES):
        drawn = _sample(state, centres, shifts, random)
        values = np.concatenate([values, drawn], axis=1)
        estimates = [_rate(weights) for weights in values]
        if all(estimate.standard_error <= _GOAL for estimate in estimates):
            break
    return estimates


def _sample(
    state: LimitState,
    centres: Floats,
    shifts: Sequence[float],
    random: np.random.Generator,
) -> Floats:
    """Weights of the failures in one batch, 0 of all others; shape (shifts, n)."""
    drawn = random.integers(len(centres), size=_BATCH)
    u = centres[drawn] + random.standard_normal((_BATCH, centres.shape[1]))
    margins = state.evaluate(np.minimum(u, state.caps))
    fails = np.array([margins + shift < 0.0 for shift in shifts])
    # logarithms of the mixture's density over the standard normal one
    exponents = u @ centres.T - 0.5 * np.sum(centres**2, axis=1)
    most = exponents.max(axis=1)
    ratio = np.exp(exponents - most[:, None]).mean(axis=1)
    weights: Floats = np.where(fails, np.exp(-most) / ratio, 0.0)
    return weights


def _rate(weights: Floats) -> Estimate:
    """Index of the mean weight, which estimates the probability of failure."""
    from scipy.special import ndtri

    probability = float(weights.mean())
    if not 0.0 < probability < 1.0:
        return Estimate(beta=math.nan, standard_error=math.inf, samples=len(weights))
    beta = -float(ndtri(probability))
    error = float(weights.std(ddof=1)) / math.sqrt(len(weights))
    density = math.exp(-0.5 * beta**2) / math.sqrt(2.0 * math.pi)
    return Estimate(beta=beta, standard_error=error / density, samples=len(weights))


@dataclass(frozen=True, slots=True, kw_only=True)
class Reliability:
    """Notional reliability of one limit state.

    Attributes
    ----------
    beta, standard_error : float
        Index by sampling, and its error by sampling alone.
    beta_shifted : float or None
        Index with the margins shifted; None where its error is too large.
    beta_by_form : float
        Distance of the design point.
    alpha_squared : tuple of float
        Shares of the variables in that distance, in their order.
    design_point : tuple of float
        Values of the variables there, each in its unit, at most its cap.
    samples : int
        Number of samples.
    """

    beta: float
    standard_error: float
    beta_shifted: float | None
    beta_by_form: float
    alpha_squared: tuple[float, ...]
    design_point: tuple[float, ...]
    samples: int


def find_reliability(state: LimitState, shift: float | None = None) -> Reliability:
    """Reliability of a limit state.

    Parameters
    ----------
    state : LimitState
        Its margins, in any unit.
    shift : float, optional
        By which the margins differ from those of another state, whose index is asked
        for too.

    Raises
    ------
    ModelError
        With the reason why there is none.

    Verified by
    -----------
    tests/verification/test_reliability.py
    """
    points = find_design_points(state)
    nearest, shifts = points[0], [0.0]
    centres = np.array([point.place for point in points])
    if shift is not None:
        # near the design point of the margins with the shift: one step of (U9)
        (margin,), (slope,) = state.differentiate(nearest.place[None])
        beside = _find_nearest(margin + shift, slope, nearest.place, state.caps)
        if np.isfinite(beside).all():
            centres, shifts = np.vstack([centres, beside]), [0.0, shift]
    estimate, *others = estimate_betas(state, centres, shifts)
    if not estimate.is_sound:
        raise ModelError(say("reliability.not_sampled"))
    (values,) = state.place(nearest.place[None])
    return Reliability(
        beta=estimate.beta,
        standard_error=estimate.standard_error,
        beta_shifted=next((other.beta for other in others if other.is_sound), None),
        beta_by_form=nearest.beta,
        alpha_squared=tuple(float(share) for share in nearest.alpha_squared),
        design_point=tuple(float(value) for value in np.asarray(values)),
        samples=estimate.samples,
    )
