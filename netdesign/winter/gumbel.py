"""Return values of annual maxima: Gumbel's distribution by moments.

Theory: winter/THEORY.md, section 4.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

LEAST_WINTERS = 15  # fewer tell no return value
RETURN_PERIODS = (30.0, 100.0)  # [a]


@dataclass(frozen=True, slots=True, kw_only=True)
class ReturnValue:
    """Value that is exceeded once in so many years.

    Attributes
    ----------
    period : float
        T [a].
    value, error : float
        Estimate and its standard error, in the unit of the maxima.
    """

    period: float
    value: float
    error: float


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

    def find_return_value(self, period: float) -> ReturnValue:
        """Return value with its standard error, eqs (Y6) and (Y7).

        Parameters
        ----------
        period : float
            T [a], above 1.
        """
        reduced = -math.log(-math.log(1.0 - 1.0 / period))
        factor = math.sqrt(6.0) / math.pi * (reduced - float(np.euler_gamma))
        spread = math.sqrt(1.0 + 1.1396 * factor + 1.1 * factor**2)
        return ReturnValue(
            period=period,
            value=self.mean + factor * self.deviation,
            error=self.deviation * spread / math.sqrt(self.count),
        )


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
