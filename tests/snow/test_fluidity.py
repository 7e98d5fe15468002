import math

import pytest

from netdesign.outcome import ModelError
from netdesign.snow.creep_law import (
    BOUTILLIER_2004,
    COLDEST,
    PAPER_FLUIDITY,
    WARMEST,
    compute_fluidity,
    compute_settling_fluidity,
)
from netdesign.units import fluidity_from_mpa_year
from tests.each import each


# FACTS.md, section 4: B = 2A in MPa^-3 a^-1, three digits, from the same law.
@each(
    "celsius, expected",
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


@pytest.mark.parametrize(
    ("density", "printed"), [(100.0, 0.63), (250.0, 0.95), (400.0, 4.0)]
)
def test_settling_fluidities_are_those_of_the_page(density, printed):
    """Middle of 2 m; the formula is written again in test_evidence.py."""
    found = compute_settling_fluidity(BOUTILLIER_2004, density, density * 9.81)
    assert found == pytest.approx(fluidity_from_mpa_year(printed, 3.0), rel=0.01)


def test_snow_under_more_stress_has_the_slower_clock():
    """The law is cubic, settling linear: B goes with the stress to the power 1 - n."""
    once, thrice = (
        compute_settling_fluidity(BOUTILLIER_2004, 310.0, stress)
        for stress in (2.7e3, 8.1e3)
    )
    assert once / thrice == pytest.approx(9.0, rel=1e-12)


@pytest.mark.parametrize(("density", "stress"), [(0.0, 1e3), (300.0, 0.0)])
def test_no_settling_without_snow_or_load(density, stress):
    with pytest.raises(ModelError):
        compute_settling_fluidity(BOUTILLIER_2004, density, stress)
