"""Density of settled snow by its depth, after a model code: a second opinion.

Theory: winter/THEORY.md, section 9.
"""

from __future__ import annotations

import math

from netdesign.outcome import require_positive
from netdesign.snow.snowpack import GRAVITY

# JCSS Probabilistic Model Code, Part 2.12 (secondary).
_SETTLED, _FRESH = 5000.0, 1700.0  # unit weights [N/m3]
_DEPTH = 0.85  # [m]


def find_model_code_density(height: float) -> float:
    """Mean density of snow of some height [kg/m3], eq. (Y20).

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
    depth = height / _DEPTH
    # ln(1 + c (exp(x) - 1)), without a large exponential
    rest = math.log(_FRESH / _SETTLED + (1.0 - _FRESH / _SETTLED) * math.exp(-depth))
    return _SETTLED / GRAVITY * (depth + rest) / depth
