import math

import pytest

from netdesign.errors import ModelError
from netdesign.snow.fluidity import (
    COLDEST,
    PAPER_FLUIDITY,
    WARMEST,
    compute_fluidity,
)
from netdesign.units import fluidity_to_mpa_year


# FACTS.md, section 4: B = 2A in MPa^-3 a^-1, three digits, from the same law.
@pytest.mark.parametrize(
    ("celsius", "expected"),
    [(-20, 10.5), (-15, 18.2), (-10, 30.9), (-5, 101), (-2, 202), (0, 317)],
)
def test_values_of_the_source(celsius, expected):
    found = fluidity_to_mpa_year(compute_fluidity(273.15 + celsius), 3.0)
    assert found == pytest.approx(expected, rel=5e-3)


def test_paper_value():
    assert fluidity_to_mpa_year(PAPER_FLUIDITY, 3.0) == pytest.approx(20.0, rel=1e-14)


def test_branches_meet():
    below, above = compute_fluidity(263.15), compute_fluidity(263.1500001)
    assert above == pytest.approx(below, rel=5e-3)  # coefficients of four digits


@pytest.mark.parametrize("temperature", [COLDEST, WARMEST])
def test_bounds_are_accepted(temperature):
    assert compute_fluidity(temperature) > 0.0


@pytest.mark.parametrize(
    "temperature",
    [math.nextafter(COLDEST, 0), math.nextafter(WARMEST, 400), math.nan, math.inf],
)
def test_beyond_is_refused(temperature):
    with pytest.raises(ModelError, match="snow temperature"):
        compute_fluidity(temperature)
