import math

import pytest

from netdesign.site.columns.fields import (
    UNCLEAR_UNITS,
    convert_unit,
    normalise_unit,
)
from tests.each import each
from tests.site.columns.fields import FIELDS, QUANTITIES


@each(
    "typed, unit",
    [
        *(("°", "deg"), ("Degrés", "deg"), ("%", "%"), ("pour cent", "%")),
        *(("kN/ml", "kN/m"), ("KN", "kN"), ("MN", "MN"), ("N", "N")),
        *(("kg/m³", "kg/m3"), ("kg/m^3", "kg/m3"), ("KG / M3", "kg/m3")),
        *(("t/m³", "t/m3"), ("°C", "degC"), ("mm", "mm"), ("CM", "cm"), ("–", "-")),
        *(("mN", "mN"), ("Grad", "grad"), ("T", "t"), ("mN/m²", "mN/m2")),
        *(("N/mm²", "MPa"), ("Mpa", "MPa"), ("MN/m²", "MPa"), ("kN/m²", "kPa")),
        *(("cm⁴", "cm4"), ("mm²", "mm2"), ("Tage", "d"), ("j", "d"), ("heures", "h")),
    ],
)
def test_units_are_folded_to_one_spelling(typed, unit):
    assert normalise_unit(typed) == unit


@each(
    "value, unit, first, result",
    [
        (100.0, "%", "deg", 45.0),
        (0.0, "%", "deg", 0.0),
        (math.pi, "rad", "deg", 180.0),
        (50.0, "gon", "deg", 45.0),
        (350.0, "cm", "m", 3.5),
        (2755.0, "mm", "m", 2.755),
        (0.38, "MN", "kN", 380.0),
        (380_000.0, "N", "kN", 380.0),
        (12.5, "MN/m", "kN/m", 12_500.0),
        (5.0, "%", "-", 0.05),
        (0.27, "t/m3", "kg/m3", 270.0),
        (0.4, "g/cm3", "kg/m3", 400.0),
        (-7.25, "degC", "degC", -7.25),
        (0.028, "m", "mm", 28.0),
        (2.8, "cm", "mm", 28.0),
        (3400.0, "mm2", "cm2", 34.0),
        (3_180_000.0, "mm4", "cm4", 318.0),
        (0.25, "MPa", "kPa", 250.0),
        (36.0, "h", "d", 1.5),
    ],
)
def test_conversions_by_hand(value, unit, first, result):
    assert convert_unit(value, unit, first) == pytest.approx(result, rel=1e-15)


def test_every_unit_of_every_column_can_be_converted_and_is_clear():
    tables = (*FIELDS.values(), *QUANTITIES.values())
    for field in (field for fields in tables for field in fields):
        for unit in field.units:
            assert normalise_unit(unit) == unit
            assert unit not in UNCLEAR_UNITS
            # zero is zero in every unit of these tables
            assert convert_unit(0.0, unit, field.unit) == 0.0
