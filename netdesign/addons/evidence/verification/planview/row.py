"""A row that stands alone: from a mast to an endless wall.

Theory: planview/THEORY.md, section 3. Lengths along the row are in l_z, loads in
that of an endless wall.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import k0

from netdesign.addons.evidence.verification.planview.waves import (
    FUNCTIONS,
    load_bessel,
    load_waves,
    require_opening,
    solve_expansion,
)
from netdesign.numerics.arrays import Floats


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
