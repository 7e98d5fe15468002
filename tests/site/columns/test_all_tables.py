import math

import pytest

from netdesign.site.columns.all_tables import SHEETS
from netdesign.site.columns.fields import (
    convert_unit,
    find_item,
    normalise,
    normalise_unit,
    split_heading,
    to_si,
)
from netdesign.structure.members import MEMBER_MODES, NAMED_BY
from tests.each import each
from tests.site.columns.fields import FIELDS, PLANS

BY_SHEET = {plan.name: {field.key: field for field in plan.fields} for plan in SHEETS}


@each("table", FIELDS)
def test_no_heading_names_two_fields(table):
    names = [name for field in FIELDS[table] for name in field.names]
    assert len(names) == len(set(names))
    assert all(names)


@each("table", FIELDS)
def test_labels_are_headings_that_are_read_back(table):
    for field in FIELDS[table]:
        found = find_item(field.heading_for("en"), FIELDS[table])
        assert found is field or PLANS[table].find(field.heading_for("en")) is field


def test_every_member_and_mode_has_its_column():
    for member, mode in MEMBER_MODES:
        sheet = BY_SHEET["Nets"][NAMED_BY.get(member, member)].refers_to
        assert BY_SHEET[sheet][mode].unit == "kN"


@each(
    "heading, name, unit",
    [
        ("Slope angle [deg]", "slopeangle", "deg"),
        ("  SLOPE-ANGLE (°) ", "slopeangle", "deg"),
        ("Épaisseur de neige [m]", "epaisseurdeneige", "m"),
        ("Fussanker", "fussanker", ""),
        ("Fußanker", "fussanker", ""),
        ("density [kg/m³]", "density", "kg/m3"),
        ("net stiffness [KN / ml]", "netstiffness", "kN/m"),
        ("snow height (vertical) [m]", "snowheightvertical", "m"),
        ("x" * 101, "", ""),
    ],
)
def test_headings_are_split_without_case_accents_or_spaces(heading, name, unit):
    assert split_heading(heading) == (name, unit)


def test_names_and_units_keep_what_tells_them_apart():
    assert normalise("uphill anchor") != normalise("uphill anchor distance")
    assert normalise_unit("mm") != normalise_unit("m")
    assert normalise_unit("grad") == "grad"  # degree in German, gon elsewhere


def test_a_slope_of_100_per_cent_is_45_degrees():
    assert convert_unit(100.0, "%", "deg") == pytest.approx(45.0, rel=1e-15)
    assert convert_unit(100.0, "m", "m") == 100.0


def test_si_values():
    assert to_si(180.0, "deg") == math.pi
    assert to_si(2.0, "kN") == 2000.0
    assert to_si(2.0, "kN/m") == 2000.0
    assert to_si(2.0, "m") == 2.0
