import pytest

from netdesign.snow.creep_law import (
    BOUTILLIER_2004,
    PAPER_FLUIDITY,
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
