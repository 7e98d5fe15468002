"""The only unit conversions: engineer's units at the edge, SI inside.

Every function takes and returns plain numbers (or arrays of them); names say
from what to what. Inside the package everything is SI and radians.
"""

from __future__ import annotations

import math

SECONDS_PER_DAY = 86_400.0
SECONDS_PER_YEAR = 365.25 * SECONDS_PER_DAY
KELVIN_AT_0_C = 273.15
_GIVEN_DECIMALS = 9  # of an angle in degrees, of a force in kN


def newton_from_kilonewton(value: float) -> float:
    """Force in kN to N, per metre of width or not."""
    return value * 1e3


def kilonewton_from_newton(value: float) -> float:
    """Force in N to kN, per metre of width or not."""
    return value / 1e3


def given_kilonewton_from_newton(value: float) -> float:
    """Force in N to the kN as typed, to a billionth."""
    return round(value / 1e3, _GIVEN_DECIMALS)


def kilonewton_if_known(value: float | None) -> float | None:
    """Force in N to kN; none where there is none."""
    return None if value is None else kilonewton_from_newton(value)


def meter_from_millimeter(value: float) -> float:
    """Length in mm to m."""
    return value / 1e3


def square_meter_from_square_centimeter(value: float) -> float:
    """Area in cm2 to m2."""
    return value / 1e4


def fourth_meter_from_fourth_centimeter(value: float) -> float:
    """Second moment of area in cm4 to m4."""
    return value / 1e8


def cubic_meter_from_cubic_centimeter(value: float) -> float:
    """Section modulus in cm3 to m3."""
    return value / 1e6


def pascal_from_kilopascal(value: float) -> float:
    """Stress in kPa to Pa."""
    return value * 1e3


def pascal_from_megapascal(value: float) -> float:
    """Stress in MPa to Pa."""
    return value * 1e6


def radian_from_degree(value: float) -> float:
    """Angle in degrees to radians."""
    return math.radians(value)


def degree_from_radian(value: float) -> float:
    """Angle in radians to degrees."""
    return math.degrees(value)


def given_degree_from_radian(value: float) -> float:
    """Angle in radians to the degrees as typed.

    Degrees that were turned into radians come back with an error in their last digit.
    Nobody gives an angle to a billionth of a degree: rounding to that restores it.
    """
    return round(math.degrees(value), _GIVEN_DECIMALS)


def radian_from_percent(value: float) -> float:
    """Slope in per cent, 100 tan psi, to radians."""
    return math.atan(value / 100.0)


def second_from_day(value: float) -> float:
    """Time in days to seconds."""
    return value * SECONDS_PER_DAY


def day_from_second(value: float) -> float:
    """Time in seconds to days."""
    return value / SECONDS_PER_DAY


def fluidity_from_mpa_year(value: float, creep_exponent: float) -> float:
    """Fluidity in MPa^-n a^-1 to Pa^-n s^-1."""
    return float(value * 1e-6**creep_exponent / SECONDS_PER_YEAR)


def fluidity_per_mpa_year(value: float, creep_exponent: float) -> float:
    """Fluidity in Pa^-n s^-1 to MPa^-n a^-1."""
    return float(value * SECONDS_PER_YEAR / 1e-6**creep_exponent)


def mm_per_day(value: float) -> float:
    """Velocity in m/s to mm per day."""
    return value * 1e3 * SECONDS_PER_DAY


def celsius_from_kelvin(value: float) -> float:
    """Temperature in K to degrees Celsius."""
    return value - KELVIN_AT_0_C


def kelvin_from_celsius(value: float) -> float:
    """Temperature in degrees Celsius to K."""
    return value + KELVIN_AT_0_C
