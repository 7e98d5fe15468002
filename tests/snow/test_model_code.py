"""Density of settled snow by its depth, after a model code."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.outcome import ModelError
from netdesign.snow.snowpack import find_model_code_density


@given(st.floats(0.01, 500.0), st.floats(1.01, 3.0))
def test_deeper_snow_is_denser_and_never_denser_than_in_the_end(height, factor):
    thin, deep = (find_model_code_density(h) for h in (height, factor * height))
    assert 1700 / 9.81 < thin < deep < 5000 / 9.81


@pytest.mark.parametrize("height", [0.0, -1.0, float("nan")])
def test_snow_without_a_height_is_refused(height):
    with pytest.raises(ModelError):
        find_model_code_density(height)
