"""Return values of annual maxima, and their trend over the years.

Theory: winter/THEORY.md, sections 4 and 8.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

LEAST_WINTERS = 15  # fewer tell no return value
RETURN_PERIODS = (30.0, 100.0)  # [a]


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
        reduced = -math.log(-math.log(1.0 - 1.0 / period))
        factor = math.sqrt(6.0) / math.pi * (reduced - float(np.euler_gamma))
        spread = math.sqrt(1.0 + 1.1396 * factor + 1.1 * factor**2)
        error = self.deviation * spread / math.sqrt(self.count)
        return self.mean + factor * self.deviation, error


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
    """Trend of annual maxima, eqs (Y17) to (Y19).

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
