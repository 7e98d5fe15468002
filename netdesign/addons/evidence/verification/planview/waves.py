"""A row that stands alone, from a mast to an endless wall, and what it is made of.

Lengths over which a wall holds snow back follow from the creep law and the base's drag;
gaps and rows are expanded on Bessel functions along the wall. Theory:
planview/THEORY.md, sections 1 and 3. Wave numbers are times half the opening, lengths
along the row in l_z, loads in that of an endless wall.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.special import gamma, jv, k0, rgamma

from netdesign.addons.evidence.verification.slab import (
    PROFILE_SHARE,
    Slab,
    compute_influence_length,
)
from netdesign.numerics.arrays import Floats
from netdesign.outcome import require_positive, require_within


@dataclass(frozen=True, slots=True, kw_only=True)
class Scales:
    """Lengths of the plan view.

    Attributes
    ----------
    longitudinal, lateral : float
        l_x, l_z: the wall's influence fades like exp(-x / l_x) upslope of it and
        exp(-z / l_z) beside its end [m].
    retarded_share : float
        Part of the pressure on an endless wall that holds snow back; the rest is the
        pressure at rest, which the end does not change [-].
    """

    longitudinal: float
    lateral: float
    retarded_share: float


def compute_scales(slab: Slab, slip_length: float) -> Scales:
    """Lengths of a slab on a ground with linear slip; (W3) and (W5).

    Parameters
    ----------
    slab : Slab
        Snow.
    slip_length : float
        D* of linear creep; 0 without slip [m].

    Raises
    ------
    ModelError
        If the slip length is negative or not finite.

    Verified by
    -----------
    tests/verification/test_plan_view.py
    """
    longitudinal = compute_influence_length(slab, slip_length)
    drag = slab.thickness * (slip_length + PROFILE_SHARE * slab.thickness)
    return Scales(
        longitudinal=longitudinal,
        lateral=math.sqrt(drag),
        retarded_share=longitudinal / (longitudinal + slab.side_length),
    )


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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RowLoad:
    """Load on a row that stands alone.

    Attributes
    ----------
    half : float
        h, half the row's length [-].
    coefficients : ndarray, shape (n,)
        Of the load, (W13) [-].
    total : float
        Load on the whole row [-].
    error : float
        Of ``total``: its change with fewer functions [-].
    """

    half: float
    coefficients: Floats
    total: float
    error: float


def solve_row(half: float, *, functions: int = FUNCTIONS) -> RowLoad:
    """Load along a row without neighbours; (W13).

    Parameters
    ----------
    half : float
        h, half the length over l_z, above 0 and at most ``WIDEST_HALF`` [-].
    functions : int
        Of the expansion, 5 to ``MOST_FUNCTIONS``.

    Raises
    ------
    ModelError
        If a number is out of its range.

    Verified by
    -----------
    tests/verification/test_plan_view.py
    """
    require_opening(half, functions)
    coefficients, error = solve_expansion(_build_matrix(half, functions), 1.0 / half)
    return RowLoad(
        half=half,
        coefficients=coefficients,
        total=half * math.pi * float(coefficients[0]),
        error=half * math.pi * error,
    )


def find_row_load(row: RowLoad, places: Floats) -> Floats:
    """Load along the row, (W13).

    Parameters
    ----------
    row : RowLoad
        Solved row.
    places : ndarray
        Over h, between -1 and 1, the row's ends, where the load is infinite [-].
    """
    angle = np.arccos(places)[..., None]
    number = np.arange(row.coefficients.size)
    waves = np.cos(2.0 * number * angle) @ ((-1.0) ** number * row.coefficients)
    return np.asarray(waves / np.sin(angle[..., 0]))


_PLACES = 2000  # along the row


def find_row_velocity(row: RowLoad, distances: Floats) -> Floats:
    """Velocity upslope of the row's middle, over the undisturbed one; (W21).

    Parameters
    ----------
    row : RowLoad
        Solved row.
    distances : ndarray
        Upslope of the row, in l_x, above 0 [-].

    Verified by
    -----------
    tests/verification/test_plan_view.py
    """
    angles = math.pi * (np.arange(_PLACES) + 0.5) / _PLACES
    places = np.cos(angles)
    loads = find_row_load(row, places) * np.sin(angles)
    apart = np.hypot(distances[..., None], row.half * places)
    return np.asarray(1.0 - row.half * np.mean(loads * k0(apart), axis=-1))


def _build_matrix(half: float, functions: int) -> Floats:
    """Velocity of each pair of loads, (W13); that of h = 0 is a diagonal."""
    waves, each = load_waves(), load_bessel(0.0, functions)
    rest = 1.0 / np.hypot(waves.numbers, half) - 1.0 / waves.numbers
    matrix = np.asarray((each * (waves.weights * rest)) @ each.T)
    number = np.arange(1, functions)
    matrix[number, number] += 0.25 / number
    # J_0^2 / k has no integral down to 0: its part there is taken apart, (W14)
    is_long = waves.numbers < 1.0
    ends = waves.weights[is_long] @ (1.0 / waves.numbers[is_long])
    matrix[0, 0] += math.log(2.0) - np.euler_gamma + ends
    return matrix
