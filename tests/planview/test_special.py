"""Quadrature against SciPy's, functions against those that everybody gets."""

import numpy as np
import pytest
import scipy.special
from hypothesis import given
from hypothesis import strategies as st

from netdesign.planview import special
from tests.each import each

FUNCTIONS = ("erf", "erfc", "eval_gegenbauer", "gamma", "gammaln", "iti0k0", "jv")
FUNCTIONS += ("k1", "psi", "rgamma")


@given(st.integers(1, 400), st.floats(0.07, 1.0))
def test_places_and_weights_are_those_of_scipy(count, order):
    places, weights = special.find_gegenbauer_places(count, order)
    expected, shares = scipy.special.roots_gegenbauer(count, order)
    np.testing.assert_allclose(places, expected, rtol=0.0, atol=1e-15)
    np.testing.assert_allclose(weights, shares, rtol=2e-9)


@given(st.integers(2, 60), st.floats(0.07, 1.0), st.data())
def test_powers_are_integrated_exactly(count, order, data):
    """Of even degree up to 2 n - 2, by Euler's beta function."""
    half = data.draw(st.integers(0, count - 1))
    places, weights = special.find_gegenbauer_places(count, order)
    exact = scipy.special.beta(half + 0.5, order + 0.5)
    assert (weights * places ** (2 * half)).sum() == pytest.approx(exact, rel=1e-9)


@each("name", FUNCTIONS)
def test_functions_are_those_of_scipy(name):
    assert getattr(special, name) is getattr(scipy.special, name)
