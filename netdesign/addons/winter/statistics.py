"""Distributions of annual maxima, and return values with their intervals.

Theory: addons/winter/THEORY.md, sections 4 and 8 to 10.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from netdesign.addons.winter.maxima import AnnualMaximum
from netdesign.numerics.arrays import Floats
from netdesign.words.message import Message, say

LEAST_WINTERS = 15  # fewer tell no return value
RETURN_PERIODS = (30.0, 100.0)  # [a]
CERTAINTY = 0.95  # of each end of a return value's interval
_SAMPLES = 20_000  # by which the ends are found
_SEED = 1958
_EULER = float(np.euler_gamma)
TAILS = (0.1, 0.2)  # shapes of tails heavier than Gumbel's that are shown [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class Gumbel:
    """Gumbel's distribution with the moments of some annual maxima.

    Attributes
    ----------
    count : int
        Number of winters.
    mean, deviation : float
        Of the sample, in the unit of the maxima.
    """

    count: int
    mean: float
    deviation: float

    @property
    def variation(self) -> float:
        """Coefficient of variation [-]."""
        return self.deviation / self.mean if self.mean else math.nan

    def find_return_value(self, period: float) -> tuple[float, float]:
        """Value exceeded once in ``period`` years, and its error, eqs (Y6) and (Y7).

        Parameters
        ----------
        period : float
            T [a], above 1.

        Returns
        -------
        (float, float)
            Estimate and its standard error, in the unit of the maxima.
        """
        factor = _find_factor(period)
        spread = math.sqrt(1.0 + 1.1396 * factor + 1.1 * factor**2)
        error = self.deviation * spread / math.sqrt(self.count)
        return self.mean + factor * self.deviation, error

    def find_interval(self, period: float) -> tuple[float, float]:
        """Ends below and above which the value lies in one of twenty, eq. (Y14).

        Parameters
        ----------
        period : float
            T [a], above 1.

        Returns
        -------
        (float, float)
            Lower and upper end, in the unit of the maxima.

        Verified by
        -----------
        tests/verification/test_return_values.py
        """
        means, deviations = _draw_moments(self.count)
        pivots = (_reduce(period) - means) / deviations
        return _find_ends(pivots, self.mean, self.deviation)

    def find_tail(self, period: float, shape: float) -> tuple[float, float]:
        """Value and its upper end, were the tail heavier, eqs (Y15) to (Y18).

        Parameters
        ----------
        period : float
            T [a], above 1.
        shape : float
            xi of a generalised extreme value distribution with these moments [-], above
            0 and below a half.

        Returns
        -------
        (float, float)
            Estimate, and the end above which the value lies in one of twenty, in the
            unit of the maxima.

        Verified by
        -----------
        tests/verification/test_return_values.py
        """
        first, second = math.gamma(1.0 - shape), math.gamma(1.0 - 2.0 * shape)
        reduced = _reduce(period, shape)
        spread = math.sqrt(second - first**2) / shape
        factor = (reduced - (first - 1.0) / shape) / spread
        means, deviations = _draw_moments(self.count, shape)
        ends = _find_ends((reduced - means) / deviations, self.mean, self.deviation)
        return self.mean + factor * self.deviation, ends[1]

    def find_predictive_variation(self, period: float) -> float:
        """Coefficient of variation that allows for the few winters, eq. (Y23) [-].

        Of the Gumbel distribution with the same mean, whose value of ``period`` a
        further winter exceeds once in so many samples of ``count`` winters.

        Parameters
        ----------
        period : float
            T [a], above 1.

        Verified by
        -----------
        tests/verification/test_return_values.py
        """
        from scipy.optimize import brentq

        means, deviations = _draw_moments(self.count)

        def find_excess(z: float) -> float:
            exceeded = -np.expm1(-np.exp(-(means + z * deviations)))
            return math.log(period * float(exceeded.mean()))

        exact = _find_factor(period)
        factor = float(brentq(find_excess, 0.5 * exact, 5.0 * exact))
        return self.variation * factor / exact


@lru_cache(maxsize=8)
def _draw_moments(count: int, shape: float = 0.0) -> tuple[Floats, Floats]:
    """Means and deviations of samples of ``count`` draws: Gumbel's, or a heavier tail.

    ``shape`` is that of the tail [-].
    """
    samples = np.random.default_rng(_SEED).gumbel(size=(_SAMPLES, count))
    if shape:
        samples = np.expm1(shape * samples) / shape
    return samples.mean(axis=1), samples.std(axis=1, ddof=1)


def _find_ends(pivots: Floats, value: float, unit: float) -> tuple[float, float]:
    """Ends of a value's interval: it moves and stretches with the pivots' quantiles."""
    low, high = np.quantile(pivots, (1.0 - CERTAINTY, CERTAINTY))
    return value + float(low) * unit, value + float(high) * unit


def _find_factor(period: float) -> float:
    """Standard deviations by which a value exceeds the mean, eq. (Y6)."""
    return math.sqrt(6.0) / math.pi * (_reduce(period) - _EULER)


def _reduce(period: float, shape: float = 0.0) -> float:
    """Reduced value exceeded once in ``period`` years; (Y15) with a heavier tail."""
    gumbel = -math.log(-math.log(1.0 - 1.0 / period))
    return math.expm1(shape * gumbel) / shape if shape else gumbel


_BOOTSTRAP = 1000  # samples of a fit above a limit
_HALVINGS = 45
LEAST_ABOVE = 8  # maxima above the limit (assumed)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LimitedGumbel:
    """Gumbel's distribution of maxima of which those below a limit are not known.

    Attributes
    ----------
    count, below : int
        Number of winters, and of those below the limit.
    limit : float
        In the unit of the maxima.
    location, scale : float
        By maximum likelihood, in the unit of the maxima.
    locations, scales : ndarray, shape (n_samples,)
        Of samples that are drawn with both and have the same limit.
    """

    count: int
    below: int
    limit: float
    location: float
    scale: float
    locations: Floats
    scales: Floats

    @property
    def mean(self) -> float:
        """Mean, in the unit of the maxima."""
        return self.location + _EULER * self.scale

    @property
    def variation(self) -> float:
        """Coefficient of variation [-]."""
        return math.pi / math.sqrt(6.0) * self.scale / self.mean

    def find_return_value(self, period: float) -> tuple[float, float]:
        """Value exceeded once in ``period`` years, and its error by the samples.

        Parameters
        ----------
        period : float
            T [a], above 1.

        Returns
        -------
        (float, float)
            Estimate and its standard error, in the unit of the maxima.
        """
        reduced = _reduce(period)
        error = float(np.std(self.locations + reduced * self.scales))
        return self.location + reduced * self.scale, error

    def find_interval(self, period: float) -> tuple[float, float]:
        """Ends below and above which the value lies in one of twenty, eq. (Y22).

        Parameters
        ----------
        period : float
            T [a], above 1.

        Returns
        -------
        (float, float)
            Lower and upper end, in the unit of the maxima.

        Verified by
        -----------
        tests/verification/test_limited_gumbel.py
        """
        reduced = _reduce(period)
        value = self.location + reduced * self.scale
        of_samples = self.locations + reduced * self.scales
        return _find_ends((value - of_samples) / self.scales, value, self.scale)


def fit_limited(maxima: Sequence[float], limit: float) -> LimitedGumbel | None:
    """Gumbel's distribution of maxima that are known above a limit alone.

    Parameters
    ----------
    maxima : sequence of float
        One of each winter, in any unit; those below the limit may be any number below.
    limit : float
        In the unit of the maxima.

    Returns
    -------
    LimitedGumbel or None
        None of fewer than ``LEAST_WINTERS``, or of fewer than ``LEAST_ABOVE`` above
        the limit.

    Verified by
    -----------
    tests/verification/test_limited_gumbel.py
    """
    values = np.maximum(np.array(maxima, dtype=np.float64), limit)
    above = int((values > limit).sum())
    if values.size < LEAST_WINTERS or above < LEAST_ABOVE:
        return None
    location, scale = (float(part[0]) for part in _fit_limited(values[None], limit))
    rng = np.random.default_rng(_SEED)
    drawn = rng.gumbel(location, scale, size=(_BOOTSTRAP, values.size))
    locations, scales = _fit_limited(np.maximum(drawn, limit), limit)
    return LimitedGumbel(
        count=values.size,
        below=values.size - above,
        limit=limit,
        location=location,
        scale=scale,
        locations=locations,
        scales=scales,
    )


def _fit_limited(samples: Floats, limit: float) -> tuple[Floats, Floats]:
    """Location and scale of samples, shape (m, n) -> (m,) each; by halving (Y20).

    Samples with fewer than two values above the limit are left out.
    """
    is_known = samples > limit
    number = is_known.sum(axis=1)
    is_enough = number > 1
    samples, number = samples[is_enough], number[is_enough]
    mean = (samples * is_known[is_enough]).sum(axis=1) / number
    least = samples.min(axis=1)
    above = samples - least[:, None]
    low, high = np.zeros_like(mean), mean - least
    for _ in range(_HALVINGS):
        scale = (low + high) / 2.0
        weights = np.exp(-above / scale[:, None])
        weighted = (above * weights).sum(axis=1) / weights.sum(axis=1)
        is_large = scale + weighted > mean - least
        low, high = np.where(is_large, low, scale), np.where(is_large, scale, high)
    return least + scale * np.log(number / weights.sum(axis=1)), scale


def fit_gumbel(maxima: Sequence[float]) -> Gumbel | None:
    """Distribution of annual maxima; None of fewer than ``LEAST_WINTERS``.

    Parameters
    ----------
    maxima : sequence of float
        One of each winter, in any unit.
    """
    if len(maxima) < LEAST_WINTERS:
        return None
    values = np.array(maxima)
    return Gumbel(
        count=values.size,
        mean=float(values.mean()),
        deviation=float(values.std(ddof=1)),
    )


LEFT_OUT = 0.1  # of the complete winters may count for nothing


@dataclass(frozen=True, kw_only=True)
class Sample:
    """Complete winters of a row.

    Attributes
    ----------
    maxima : tuple of AnnualMaximum
        One of each winter, in their order.
    """

    maxima: tuple[AnnualMaximum, ...]

    @property
    def counted(self) -> list[AnnualMaximum]:
        """Winters with a proven maximum or a bound."""
        return [
            maximum
            for maximum in self.maxima
            if maximum.is_proven or maximum.bound is not None
        ]

    @property
    def bounds(self) -> list[float]:
        """Bounds of the winters that are known by one alone [N/m]."""
        return [maximum.bound for maximum in self.maxima if maximum.bound is not None]

    @property
    def left_out(self) -> list[str]:
        """Names of the winters with neither, in which the net held the snow."""
        return [
            maximum.winter
            for maximum in self.maxima
            if maximum.ending == "doubtful" and maximum.bound is None
        ]

    @cached_property
    def fit(self) -> Gumbel | LimitedGumbel | None:
        """Distribution of the maxima [N/m]; by moments where all counted are known.

        None where ``lack`` says why.
        """
        pulls = [maximum.foot for maximum in self.counted]
        if self._find_obstacle():
            return None
        return (
            fit_limited(pulls, max(self.bounds)) if self.bounds else fit_gumbel(pulls)
        )

    @property
    def lack(self) -> Message | None:
        """Reason why there are no return values; None where there are."""
        obstacle = self._find_obstacle()
        if obstacle or self.fit:
            return obstacle
        if len(self.counted) < LEAST_WINTERS:
            count = len(self.counted)
            return say("winter_sample.few", least=LEAST_WINTERS, count=count)
        return say("winter_sample.few_above", least=LEAST_ABOVE)

    def _find_obstacle(self) -> Message | None:
        """Reason why the winters may not stand for all; None where they may."""
        above = [
            maximum.winter for maximum in self.maxima if maximum.ending == "overtopped"
        ]
        if above:
            return say("winter_sample.overtopped", winters=tuple(above))
        if len(self.left_out) > LEFT_OUT * len(self.maxima):
            return say("winter_sample.unbounded", winters=tuple(self.left_out))
        return None
