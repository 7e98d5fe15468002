"""Return values of annual maxima, and their trend over the years.

Theory: addons/winter/THEORY.md, sections 4, 7, 9 and 10.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from netdesign.numerics.arrays import Floats

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
        """Value exceeded once in so many years, and its error, eqs (Y6) and (Y7).

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
        pivots = (_reduce_gumbel(period) - means) / deviations
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
        reduced = _reduce_tail(period, shape)
        spread = math.sqrt(second - first**2) / shape
        factor = (reduced - (first - 1.0) / shape) / spread
        means, deviations = _draw_tails(self.count, shape)
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

        known = _find_factor(period)
        factor = float(brentq(find_excess, 0.5 * known, 5.0 * known))
        return self.variation * factor / known


@lru_cache(maxsize=4)
def _draw_moments(count: int) -> tuple[Floats, Floats]:
    """Means and deviations of samples of so many draws of Gumbel's distribution."""
    samples = np.random.default_rng(_SEED).gumbel(size=(_SAMPLES, count))
    return samples.mean(axis=1), samples.std(axis=1, ddof=1)


@lru_cache(maxsize=8)
def _draw_tails(count: int, shape: float) -> tuple[Floats, Floats]:
    """Means and deviations of samples of so many draws with a heavier tail."""
    reduced = np.random.default_rng(_SEED).gumbel(size=(_SAMPLES, count))
    samples = np.expm1(shape * reduced) / shape
    return samples.mean(axis=1), samples.std(axis=1, ddof=1)


def _reduce_tail(period: float, shape: float) -> float:
    """Reduced value exceeded once in so many years, with a heavier tail, (Y15)."""
    return math.expm1(shape * _reduce_gumbel(period)) / shape


def _find_ends(pivots: Floats, value: float, unit: float) -> tuple[float, float]:
    """Ends of a value's interval: it moves and stretches with the pivots' quantiles."""
    low, high = np.quantile(pivots, (1.0 - CERTAINTY, CERTAINTY))
    return value + float(low) * unit, value + float(high) * unit


def _find_factor(period: float) -> float:
    """Standard deviations by which a value exceeds the mean, eq. (Y6)."""
    return math.sqrt(6.0) / math.pi * (_reduce_gumbel(period) - _EULER)


def _reduce_gumbel(period: float) -> float:
    """Reduced value of Gumbel's distribution exceeded once in so many years."""
    return -math.log(-math.log(1.0 - 1.0 / period))


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
        """Value exceeded once in so many years, and its error by the samples.

        Parameters
        ----------
        period : float
            T [a], above 1.

        Returns
        -------
        (float, float)
            Estimate and its standard error, in the unit of the maxima.
        """
        reduced = _reduce_gumbel(period)
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
        reduced = _reduce_gumbel(period)
        value = self.location + reduced * self.scale
        found = self.locations + reduced * self.scales
        return _find_ends((value - found) / self.scales, value, self.scale)


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
    fit = _fit_limited(values[None], limit)
    location, scale = (float(one[0]) for one in fit)
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


LEAST_FOR_TREND = 10  # fewer tell no trend
LEVEL = 0.05  # p value below which a trend is taken as shown


@dataclass(frozen=True, slots=True, kw_only=True)
class Trend:
    """Trend of some annual maxima; it changes no return value.

    Attributes
    ----------
    count : int
        Number of winters.
    rank_correlation : float
        Kendall's tau of maxima and years [-]; above 0 where they grow.
    p_value : float
        Of the two-sided test [-].
    slope : float
        Sen's slope, in the unit of the maxima a year.
    """

    count: int
    rank_correlation: float
    p_value: float
    slope: float

    @property
    def is_shown(self) -> bool:
        """The maxima change by more than chance explains."""
        return self.p_value < LEVEL


def find_trend(years: Sequence[int], maxima: Sequence[float]) -> Trend | None:
    """Trend of annual maxima, eqs (Y10) to (Y12).

    None of fewer winters than ``LEAST_FOR_TREND``.

    Parameters
    ----------
    years : sequence of int
        In which each winter begins, all different.
    maxima : sequence of float
        One of each winter, in any unit.
    """
    if len(maxima) < LEAST_FOR_TREND:
        return None
    from scipy.stats import kendalltau, theilslopes

    test = kendalltau(years, maxima)
    is_constant = math.isnan(test.pvalue)  # all maxima are the same
    return Trend(
        count=len(maxima),
        rank_correlation=0.0 if is_constant else float(test.statistic),
        p_value=1.0 if is_constant else float(test.pvalue),
        slope=float(theilslopes(maxima, years).slope),
    )
