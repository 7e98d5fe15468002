"""Special functions, without what SciPy loads beside them."""

from __future__ import annotations

import math

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.numerics.scipy_start import importing_parts_of, importing_scipy

try:
    with importing_parts_of("scipy.special"):
        from scipy.special._ufuncs import erf as erf
        from scipy.special._ufuncs import erfc as erfc
        from scipy.special._ufuncs import eval_gegenbauer as eval_gegenbauer
        from scipy.special._ufuncs import gamma as gamma
        from scipy.special._ufuncs import gammaln as gammaln
        from scipy.special._ufuncs import iti0k0 as iti0k0
        from scipy.special._ufuncs import jv as jv
        from scipy.special._ufuncs import k1 as k1
        from scipy.special._ufuncs import psi as psi
        from scipy.special._ufuncs import rgamma as rgamma
except ImportError:  # a SciPy that has them elsewhere
    with importing_scipy():
        from scipy.special import (
            eval_gegenbauer,
            gammaln,
        )

_STEPS = 6  # of Newton: the fourth is below the last digit (2 to 1,000 places)


def find_gegenbauer_places(count: int, order: float) -> tuple[Floats, Floats]:
    """Places and weights of a quadrature with the weight (1 - x^2)^(order - 1/2).

    Parameters
    ----------
    count : int
        Of the places: the zeros of Gegenbauer's polynomial of that degree.
    order : float
        alpha, above 0 and at most 1 [-].

    Returns
    -------
    ndarray, ndarray, shape (count,)
        Ascending places in (-1, 1); weights [-].

    Verified by
    -----------
    tests/planview/test_special.py
    """
    number = np.arange(count, 0, -1)
    x = np.cos(math.pi * (number + (order - 1.0) / 2.0) / (count + order))
    for _ in range(_STEPS):
        slope = 2.0 * order * eval_gegenbauer(count - 1, order + 1.0, x)
        x = x - eval_gegenbauer(count, order, x) / slope
    x = (x - x[::-1]) / 2.0
    slope = 2.0 * order * eval_gegenbauer(count - 1, order + 1.0, x)
    size = gammaln(count + 2.0 * order) - gammaln(count + 1.0) - 2.0 * gammaln(order)
    scale = math.pi * 2.0 ** (2.0 - 2.0 * order) * math.exp(size)
    return x, scale / ((1.0 - x**2) * slope**2)
