"""Trend of annual maxima: Mann-Kendall test and Sen's slope.

Theory: winter/THEORY.md, section 8.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

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
