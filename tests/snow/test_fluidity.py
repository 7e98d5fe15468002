import math

import pytest

from netdesign.errors import ModelError
from netdesign.snow.fluidity import (
    COLDEST,
    PAPER_FLUIDITY,
    WARMEST,
    compute_fluidity,
)
from netdesign.units import fluidity_from_mpa_year


# FACTS.md, section 4: B = 2A in MPa^-3 a^-1, three digits, from the same law.
@pytest.mark.parametrize(
    ("celsius", "expected"),
    [(-20, 10.5), (-15, 18.2), (-10, 30.9), (-5, 101), (-2, 202), (0, 317)],
)
def test_values_of_the_source(celsius, expected):
    found = compute_fluidity(273.15 + celsius)
    assert found == pytest.approx(fluidity_from_mpa_year(expected, 3.0), rel=5e-3)


def test_paper_value():
    """20 MPa^-3 a^-1, with a year of 365.25 days."""
    year = 365.25 * 24.0 * 3600.0
    assert pytest.approx(20.0 / (1e6**3 * year), rel=1e-14) == PAPER_FLUIDITY


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
