"""Bessel functions along the wall, on which gaps and rows are expanded.

Theory: planview/THEORY.md, section 3. Wave numbers are times half the opening.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.special import gamma, jv, rgamma

from netdesign.numerics.arrays import Floats
from netdesign.outcome import require_positive, require_within

MOST_FUNCTIONS = 16
FUNCTIONS = 12
FEWER = 4  # functions left out for the error
# Half an opening from which on its ends do not feel each other: exp(-2 h) is left.
WIDEST_HALF = 8.0
_POINTS = 8  # of Gauss in a panel
_FINEST = 32  # halvings of the panels towards 0
_PANEL = 2.0  # width of the panels beyond 1: a third of a wave
_LAST = 301.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Waves:
    """Quadrature over wave numbers.

    Attributes
    ----------
    numbers, weights : ndarray, shape (K,)
        Wave numbers, ascending, and their weights [-].
    """

    numbers: Floats
    weights: Floats


@lru_cache(maxsize=1)
def load_waves() -> Waves:
    """Points and weights, made once."""
    steps = np.arange(1.0 + _PANEL, _LAST + 1.0, _PANEL)
    ends = np.concatenate([[0.0], 0.5 ** np.arange(_FINEST, -1, -1), steps])
    points, weights = np.polynomial.legendre.leggauss(_POINTS)
    half = np.diff(ends)[:, None] / 2.0
    return Waves(
        numbers=(ends[:-1, None] + half * (1.0 + points)).ravel(),
        weights=(half * weights).ravel(),
    )


def load_bessel(first: float, functions: int) -> Floats:
    """Bessel functions of the orders first, first + 2, ..., made once.

    Parameters
    ----------
    first : float
        Least order, above -1/2.
    functions : int
        How many of them.

    Returns
    -------
    ndarray, shape (functions, K)
        At the points of ``load_waves`` [-].
    """
    count = FUNCTIONS if functions <= FUNCTIONS else MOST_FUNCTIONS
    return _load_orders(first, count)[:functions]


@lru_cache(maxsize=8)
def _load_orders(first: float, count: int) -> Floats:
    """Each of them takes milliseconds; more than the usual ones are rarely wanted."""
    orders = first + 2.0 * np.arange(count)[:, None]
    return np.asarray(jv(orders, load_waves().numbers))


def integrate_root(first: Floats, second: Floats) -> Floats:
    """Integral of J_first(k) J_second(k) / sqrt(k) from 0 to infinity.

    Weber and Schafheitlin; Watson 1944, section 13.41.

    Parameters
    ----------
    first, second : ndarray
        Orders, together above -1/2.
    """
    half = (first + second) / 2.0
    apart = (first - second) / 2.0
    below = rgamma(0.75 - apart) * rgamma(0.75 + apart) * rgamma(half + 0.75)
    return np.asarray(gamma(0.5) / 2.0**0.5 * gamma(half + 0.25) * below)


def solve_expansion(matrix: Floats, drive: float) -> tuple[Floats, float]:
    """Coefficients under a drive of the first function, and the error of the first.

    Parameters
    ----------
    matrix : ndarray, shape (n, n)
        Power of each pair of functions [-].
    drive : float
        Power of the first one [-].

    Returns
    -------
    ndarray, shape (n,)
        Coefficients [-].
    float
        How much the first one differs with ``FEWER`` functions less [-].
    """
    drives = np.zeros(len(matrix))
    drives[0] = drive
    coefficients = np.asarray(np.linalg.solve(matrix, drives))
    fewer = np.linalg.solve(matrix[:-FEWER, :-FEWER], drives[:-FEWER])
    return coefficients, abs(float(coefficients[0] - fewer[0]))


def require_opening(half: float, functions: int) -> None:
    """Refuse an opening, or a count of functions, that the expansion does not reach.

    Parameters
    ----------
    half : float
        Half a gap, or half a row, over l_z [-].
    functions : int
        Of the expansion.

    Raises
    ------
    ModelError
        If one is out of its range.
    """
    require_positive("half opening", half)
    require_within("half opening", half, 0.0, WIDEST_HALF)
    require_within("functions", functions, FEWER + 1, MOST_FUNCTIONS)
