import math

import pytest

from netdesign.site.anchor_types import name_column
from netdesign.site.columns.fields import (
    convert_unit,
    find_item,
    normalise,
    normalise_unit,
    split_heading,
    to_si,
)
from netdesign.site.columns.office import list_derived
from netdesign.structure.members import END_MODES, MEMBER_MODES
from tests.each import each
from tests.make import name_heading
from tests.site.columns.fields import FIELDS, PLANS


@each("table", FIELDS)
def test_no_heading_names_two_fields(table):
    names = [name for field in FIELDS[table] for name in field.names]
    assert len(names) == len(set(names))
    assert all(names)


@each("table", FIELDS)
def test_labels_are_headings_that_are_read_back(table):
    for field in FIELDS[table]:
        found = find_item(name_heading(field, "en"), FIELDS[table])
        assert found is field or PLANS[table].find(name_heading(field, "en")) is field


def test_every_member_and_mode_has_its_column():
    named = {field.key: field for x in ("rows", "net_types") for field in FIELDS[x]}
    for member, mode in (*MEMBER_MODES, *END_MODES):
        table = named[name_column(member)].refers_to
        fields = (*FIELDS[table], *list_derived(table))
        assert [one.unit for one in fields if one.key == mode] == ["kN"]


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
