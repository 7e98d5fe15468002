"""Mean density of settled snow by its height, after a model code.

Theory: addons/winter/THEORY.md, section 8.
"""

from __future__ import annotations

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.outcome import require_positive
from netdesign.snow.snowpack import GRAVITY

# JCSS Probabilistic Model Code, Part 2.12 (secondary).
_SETTLED, _FRESH = 5000.0, 1700.0  # unit weights [N/m3]
_DEPTH = 0.85  # [m]


def find_model_code_density(height: float) -> float:
    """Mean density of snow of some height [kg/m3], eq. (Y13).

    Parameters
    ----------
    height : float
        Vertical, above 0 [m].

    Raises
    ------
    ModelError
        If the height is not positive.
    """
    require_positive("snow height", height, "m")
    return _SETTLED / GRAVITY * float(_find_settled(np.array(height)))


def compare_densities(heights: Floats, height: float) -> Floats:
    """Mean densities of snow of some heights over that of one height [-], eq. (Y13).

    Parameters
    ----------
    heights : ndarray, shape (n,)
        Vertical, above 0 [m].
    height : float
        The one that they are compared with [m].

    Returns
    -------
    ndarray, shape (n,)
        One of each height [-].

    Raises
    ------
    ModelError
        If ``height`` is not positive.
    """
    require_positive("snow height", height, "m")
    result: Floats = _find_settled(heights) / _find_settled(np.array(height))
    return result


def _find_settled(heights: Floats) -> Floats:
    """Mean unit weight over that of settled snow [-]."""
    depth = heights / _DEPTH
    # ln(1 + c (exp(x) - 1)), without a large exponential
    rest = np.log(_FRESH / _SETTLED + (1.0 - _FRESH / _SETTLED) * np.exp(-depth))
    result: Floats = (depth + rest) / depth
    return result
