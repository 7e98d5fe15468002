"""Loss by corrosion against the table of EN 14199 and sections worked by hand."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.outcome import ModelError
from netdesign.resistance.steel import RoundSection, find_loss, leave_area

# The table as printed, by ground: loss of a face in mm after so many years.
YEARS = (5, 25, 50, 75, 100)
PRINTED = {
    "natural": (0.00, 0.30, 0.60, 0.90, 1.20),
    "contaminated": (0.15, 0.75, 1.50, 2.25, 3.00),
    "organic": (0.20, 1.00, 1.75, 2.50, 3.25),
    "fill": (0.18, 0.70, 1.20, 1.70, 2.20),
    "special": (0.50, 2.00, 3.25, 4.50, 5.75),
}
SOILS = st.sampled_from(sorted(PRINTED))


@pytest.mark.parametrize("soil", PRINTED)
def test_the_table_is_met_at_its_years(soil):
    found = [find_loss(soil, years).value for years in YEARS]
    assert found == pytest.approx(PRINTED[soil])


@pytest.mark.parametrize(
    ("soil", "years", "area", "modulus"),
    [
        ("natural", 50, 0.906, 0.863),
        ("natural", 100, 0.817, 0.739),
        ("fill", 100, 0.679, 0.559),
    ],
)
def test_a_bar_of_25_mm_has_what_was_worked_out_by_hand(soil, years, area, modulus):
    loss = find_loss(soil, years).value / 1e3
    assert leave_area(0.025, 0.0, loss) == pytest.approx(area, abs=6e-4)
    whole, left = (
        RoundSection(outer=outer, strength=5e8).modulus
        for outer in (0.025, 0.025 - 2.0 * loss)
    )
    assert left / whole == pytest.approx(modulus, abs=6e-4)


def test_between_its_years_the_table_is_linear():
    # 38 years in fill: 0.70 + (1.20 - 0.70) 13 / 25
    assert find_loss("fill", 38).value == pytest.approx(0.96)


def test_a_tube_loses_its_outer_face_alone():
    # 52/26: (52 - 2.4)^2 - 26^2 over 52^2 - 26^2
    expected = (49.6**2 - 26.0**2) / (52.0**2 - 26.0**2)
    assert leave_area(0.052, 0.026, 1.2e-3) == pytest.approx(expected)


@given(SOILS, st.integers(1, 99))
def test_more_years_never_lose_less_and_do_not_jump(soil, years):
    loss, next_year = (find_loss(soil, one).value for one in (years, years + 1))
    assert loss <= next_year <= loss + 0.12


@given(SOILS, st.integers(101, 400))
def test_beyond_the_table_nothing_is_said(soil, years):
    with pytest.raises(ModelError, match="100 years"):
        find_loss(soil, years)


@given(st.floats(0.012, 0.1), st.floats(0.0, 0.9), st.floats(0.0, 6e-3))
def test_what_is_left_lies_between_nothing_and_all(outer, share, loss):
    inner = share * outer
    left = leave_area(outer, inner, loss)
    assert 0.0 <= left <= 1.0
    assert leave_area(outer, inner, loss + 1e-4) <= left
    expected = math.pi / 4 * (max(outer - 2 * loss, inner) ** 2 - inner**2)
    whole = math.pi / 4 * (outer**2 - inner**2)
    assert left == pytest.approx(expected / whole, rel=1e-9, abs=1e-12)
