"""Special functions, without what SciPy loads beside them."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import Any

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.numerics.scipy_start import importing_parts_of, importing_scipy


def _load_functions() -> Any:
    with suppress(ImportError), importing_parts_of("scipy.special"):
        from scipy.special import _ufuncs

        return _ufuncs
    with importing_scipy():  # of a SciPy that has them elsewhere
        import scipy.special

        return scipy.special


_functions = _load_functions()
erf, erfc = _functions.erf, _functions.erfc
gamma, gammaln, rgamma = _functions.gamma, _functions.gammaln, _functions.rgamma
psi, eval_gegenbauer = _functions.psi, _functions.eval_gegenbauer
iti0k0, jv = _functions.iti0k0, _functions.jv
k0, k1 = _functions.k0, _functions.k1

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
