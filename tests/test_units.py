import math
import random

import pytest

from netdesign import units
from tests.each import each

PAIRS = [
    (units.newton_from_kilonewton, units.kilonewton_from_newton),
    (units.radian_from_degree, units.degree_from_radian),
    (units.second_from_day, units.day_from_second),
    (units.kelvin_from_celsius, units.celsius_from_kelvin),
]


@each(
    "convert, given, expected",
    [
        (units.newton_from_kilonewton, 2.5, 2500.0),
        (units.kilonewton_from_newton, 2500.0, 2.5),
        (units.meter_from_millimeter, 28.0, 0.028),
        (units.square_meter_from_square_centimeter, 34.0, 0.0034),
        (units.fourth_meter_from_fourth_centimeter, 318.0, 318e-8),
        (units.cubic_meter_from_cubic_centimeter, 144.1, 144.1e-6),
        (units.pascal_from_kilopascal, 95.0, 95_000.0),
        (units.pascal_from_megapascal, 500.0, 500e6),
        (units.radian_from_degree, 180.0, math.pi),
        (units.degree_from_radian, math.pi / 6.0, 30.0),
        (units.radian_from_percent, 100.0, math.pi / 4.0),
        (units.radian_from_percent, 0.0, 0.0),
        (units.second_from_day, 2.0, 2.0 * 24.0 * 3600.0),
        (units.day_from_second, 3600.0, 1.0 / 24.0),
        (units.mm_per_day, 1.0 / 86_400.0, 1000.0),
        (units.mm_per_day, 0.0, 0.0),
        (units.celsius_from_kelvin, 273.15, 0.0),
        (units.kelvin_from_celsius, -10.0, 263.15),
    ],
)
def test_known_values(convert, given, expected):
    assert convert(given) == pytest.approx(expected, rel=1e-15, abs=0.0)


@each("there, back", PAIRS)
@each("value", [-40.0, 0.0, 1e-9, 1.0, 366.8, 1e7])
def test_there_and_back(there, back, value):
    assert back(there(value)) == pytest.approx(value, rel=1e-12, abs=1e-12)
    assert there(back(value)) == pytest.approx(value, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("exponent", [1.0, 2.5, 3.0])
def test_fluidity_of_a_year(exponent):
    """1 MPa = 1e6 Pa, 1 a = 365.25 d; 20 MPa^-3 a^-1 in the paper."""
    year = 365.25 * 24.0 * 3600.0
    assert units.fluidity_from_mpa_year(20.0, exponent) == pytest.approx(
        20.0 / (1e6**exponent * year), rel=1e-14
    )
    assert units.fluidity_per_mpa_year(1.7e-27, exponent) == pytest.approx(
        1.7e-27 * 1e6**exponent * year, rel=1e-14
    )


def test_a_slope_in_per_cent_is_not_one_in_degrees():
    assert units.radian_from_percent(45.0) == pytest.approx(math.atan(0.45), rel=1e-15)
    assert units.radian_from_percent(45.0) < 0.6 * units.radian_from_degree(45.0)


@pytest.mark.parametrize("decimals", [0, 1, 4, 6])
def test_angles_come_back_as_they_were_given(decimals):
    """To the last bit, which the plain way there and back does not keep."""
    draw = random.Random(417 + decimals)
    given = [round(draw.uniform(-85.3, 85.3), decimals) for _ in range(500)]
    radians = [units.radian_from_degree(angle) for angle in given]
    assert [units.given_degree_from_radian(angle) for angle in radians] == given
    assert [units.degree_from_radian(angle) for angle in radians] != given


def test_forces_are_told_as_they_were_given():
    """kN/m to the last digit of what was typed; the number itself is N/m."""
    draw = random.Random(91)
    given = [round(draw.uniform(0.3, 98765.0), 3) for _ in range(300)]
    told = [units.given_kilonewton_from_newton(1e3 * force) for force in given]
    assert told == given
    assert units.given_kilonewton_from_newton(1234.5678901234) == 1.23456789


def test_a_force_that_is_not_known_stays_so():
    assert units.kilonewton_if_known(None) is None
    assert units.kilonewton_if_known(1234.5) == 1.2345
