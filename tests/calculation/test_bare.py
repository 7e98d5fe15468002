"""The band of a quantity alone is that of the quantity, whatever is worked out."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.calculation.quantity import (
    above_zero,
    at_value,
    cos,
    largest,
    leaf,
    sin,
    smallest,
    sqrt,
    strip,
    tan,
)
from netdesign.outcome import ModelError

BANDS = st.tuples(*[st.floats(0.5, 60.0)] * 3).map(sorted)
FORMULAS = (
    lambda a, b, t: a * b + 2.0 * a * cos(t),
    lambda a, b, t: a * a / (b * cos(t)) - 0.5 * b,
    lambda a, b, t: sqrt(a * a + b * b) / sin(t),
    lambda a, b, t: largest(a, b, smallest(a * 3.0, b)) * tan(t),
    lambda a, b, t: above_zero(a - b) + at_value(b) * tan(t) / 2,
    lambda a, b, t: (1 / (2 * cos(t))) * a + (1 + a / b) * b,
    lambda a, b, t: largest(a, b, 7.0) * sin(t) - 1.0,
)


def build(band, symbol, unit="-"):
    low, value, high = band
    return leaf(symbol, value, unit, "", band=(low, high))


@given(BANDS, BANDS, BANDS, st.sampled_from(FORMULAS))
def test_a_bare_quantity_has_the_same_band(a, b, t, formula):
    whole = [build(a, "a"), build(b, "b"), build(t, "t", "deg")]
    found, bare = formula(*whole), formula(*map(strip, whole))
    assert (bare.low, bare.value, bare.high) == (found.low, found.value, found.high)


def test_what_is_outside_the_range_of_an_operation_is_refused():
    low = strip(leaf("x", 1.0, "-", "", band=(-1.0, 2.0)))
    for formula in (lambda x: x * x, lambda x: 1.0 / x, sqrt):
        with pytest.raises(ModelError):
            formula(low)


def test_one_that_is_missing_stays_itself():
    missing = leaf("x", None, "kN", "")
    assert strip(missing) is missing
