"""Gap whose snow is neither pushed nor pulled by the snow below it.

Theory: planview/THEORY.md, section 3.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.special import erf, erfc

from netdesign.addons.evidence.verification.planview.gap import GapFlow
from netdesign.addons.evidence.verification.planview.waves import (
    FUNCTIONS,
    load_bessel,
    load_waves,
    require_opening,
    solve_expansion,
)
from netdesign.numerics.arrays import Floats

_PLACES = 400  # in the gap


def solve_free_gap(half: float, *, functions: int = FUNCTIONS) -> GapFlow:
    """Velocity in the gap and the excess load beside it; (W10) and (W11).

    Parameters
    ----------
    half : float
        h, half the gap over l_z, above 0 and at most ``WIDEST_HALF`` [-].
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
    coefficients, error = solve_expansion(_build_matrix(half, functions), half / 2.0)
    angles = math.pi * np.arange(1, _PLACES + 1) / (_PLACES + 1)
    return GapFlow(
        half=half,
        places=np.cos(angles),
        velocities=_find_velocities(coefficients, angles),
        weights=half * math.pi / (_PLACES + 1) * np.sin(angles),
        excess=_find_excess(half, coefficients),
        error=half * math.pi / 4.0 * error,
    )


def _build_matrix(half: float, functions: int) -> Floats:
    """Power of each pair of functions, (W11); that of h = 0 is a diagonal."""
    waves, each = load_waves(), load_bessel(1.0, functions)
    rest = np.hypot(waves.numbers, half) - waves.numbers
    smooth = (each * (waves.weights * rest / waves.numbers**2)) @ each.T
    return smooth + np.diag(0.5 / (2.0 * np.arange(functions) + 1.0))


def _find_velocities(coefficients: Floats, angles: Floats) -> Floats:
    number = np.arange(coefficients.size)
    order = 2.0 * number + 1.0
    return np.asarray(
        np.sin(np.outer(angles, order)) @ ((-1.0) ** number * coefficients / order)
    )


def _find_excess(half: float, coefficients: Floats) -> float:
    """Half of the gap, less half of what slips through it, (W7)."""
    return half - half * math.pi / 4.0 * float(coefficients[0])


def find_isolated_load(distances: Floats) -> Floats:
    """Load beside the end of a long row that stands alone, (W12).

    Parameters
    ----------
    distances : ndarray
        From the end, above 0, over l_z [-].
    """
    return np.asarray(
        np.exp(-distances) / np.sqrt(math.pi * distances) + erf(np.sqrt(distances))
    )


def find_isolated_excess(distance: float) -> float:
    """Excess from the end of a long row that stands alone to a distance, (W12).

    Parameters
    ----------
    distance : float
        Over l_z; infinite for the whole excess [-].
    """
    if math.isinf(distance):
        return 0.5
    root = math.sqrt(distance)
    fading = root * math.exp(-distance) / math.sqrt(math.pi)
    return float(0.5 * erf(root) - distance * erfc(root) + fading)
