"""columns.toml: what it says is known to the program, and names what there is."""

import math
import tomllib
from typing import get_args

import pytest

from netdesign.panel.inputs import CUTS, LARGEST_GUY_ANGLE, LARGEST_SAG
from netdesign.resistance.catalogue import list_terminations, load_catalogue
from netdesign.resistance.products import find_product
from netdesign.site.columns.all_tables import (
    SHEETS,
    load_file,
)
from netdesign.site.columns.fields import KNOWN_UNITS, Kind
from netdesign.snow.ground import LARGEST_GLIDE_FACTOR
from netdesign.structure.axis import LEAST_AXIS, MOST_AXIS
from netdesign.structure.layout import DEFAULT_POST_TILT
from netdesign.structure.splay import LEAST_SPLAY, MOST_SPLAY
from tests.each import each

PLANS = {plan.name: plan for plan in SHEETS}
CATALOGUE = load_catalogue()


def find(table, key):
    plan = PLANS[{"quantities": "Ranges", "items": "Project"}.get(table, table)]
    return next(
        one
        for one in (*plan.fields, *plan.items)
        if (one.table, one.key) == (table, key)
    )


def test_every_table_of_the_file_is_read():
    lists = {
        entry["items"]
        for entry in load_file("columns")["sheets"].values()
        if "items" in entry
    }
    assert set(load_file("columns")) == {"units", "empty", "sheets", *PLANS, *lists}
    assert list(load_file("columns")["sheets"]) == list(PLANS)


def test_no_list_of_units_and_no_statement_is_left_over():
    columns = [
        entry
        for table, entries in load_file("columns").items()
        if table not in ("units", "empty", "sheets")
        for entry in entries.values()
    ]
    for key in ("units", "empty"):
        assert {one[key] for one in columns if key in one} == set(
            load_file("columns")[key]
        )
    for units in load_file("columns")["units"].values():
        assert set(units) <= set(KNOWN_UNITS)


# Constants that the program goes by elsewhere
@each(
    "table, key, low, high",
    [
        ("Nets", "glide_factor", 1.0, LARGEST_GLIDE_FACTOR),
        ("quantities", "glide_factor", 1.01, LARGEST_GLIDE_FACTOR),
        ("Nets", "ridge_sag", 0.0, LARGEST_SAG),
        ("Nets", "lower_sag", 0.0, LARGEST_SAG),
        *(
            ("Nets", key, math.degrees(LEAST_AXIS), math.degrees(MOST_AXIS))
            for key in ("foot_axis", "uphill_axis", "downhill_axis")
        ),
        ("Nets", "guy_splay", math.degrees(LEAST_SPLAY), math.degrees(MOST_SPLAY)),
        ("Ends", "end_guy_angle", 0.0, math.degrees(LARGEST_GUY_ANGLE)),
    ],
)
def test_bounds_are_those_of_the_calculation(table, key, low, high):
    assert find(table, key).bounds == pytest.approx((low, high), rel=1e-12)


def test_the_default_tilt_is_that_of_a_support():
    default = find("Nets", "post_tilt").default
    assert math.radians(default) == DEFAULT_POST_TILT


@pytest.mark.parametrize(
    ("table", "key", "words"),
    [
        ("Nets", "net_cut", tuple(CUTS)),
        (
            *("Anchors", "ground"),
            (*CATALOGUE["bond"]["ground"], "scree", "gneiss", "rock"),
        ),
        ("Ropes", "construction", tuple(CATALOGUE["rope"]["construction"])),
        ("Ropes", "termination", tuple(list_terminations())),
        ("Posts", "buckling_curve", tuple(CATALOGUE["buckling"]["curve"])),
    ],
)
def test_words_are_those_of_the_catalogue(table, key, words):
    assert find(table, key).words == words


def test_the_note_on_the_ground_tells_every_ground_of_the_catalogue():
    note = load_file("words/en")["Anchors"]["ground"]
    told = (
        f"{name}: {one['text']}" for name, one in CATALOGUE["bond"]["ground"].items()
    )
    assert note.endswith("; ".join(told))


def test_a_product_has_what_its_columns_must_agree_with():
    names = ("HEB120", "CHS 76.1x3.6", "GEWI 28", "IBO R32", "6x19 18 mm")
    known = {value for name in names for value in find_product(name).values}
    for plan in SHEETS:
        for field in plan.fields:
            assert set(field.of_product) <= known


def test_a_range_has_the_units_bounds_and_usual_numbers_of_its_column():
    for one in PLANS["Ranges"].items:
        if one.column:
            column = find("Nets", one.column)
            assert (one.units, one.usual) == (column.units, column.usual)
            assert one.zero_says_none == column.zero_says_none
            assert one.bounds[1] == column.bounds[1]
            assert not one.beside


def test_what_a_column_names_is_there():
    """Other columns, kinds, sheets; an unknown key, unit or statement is an error."""
    for plan in SHEETS:
        keys = {one.key for one in plan.fields}
        assert keys.issuperset(plan.one_of)
        for one in plan.fields:
            beside = [key for usual in one.beside for key in usual.powers]
            named = {*beside, *one.instead, *one.not_beside, one.alternative_to}
            named |= {*one.computed_from, *one.computed_with}
            assert named - {""} <= keys
            assert one.kind in get_args(Kind)
            assert one.refers_to in ("", *PLANS)
            assert one.bounds[0] <= one.bounds[1]


def test_a_column_that_stands_twice_is_refused():
    with pytest.raises(tomllib.TOMLDecodeError):
        tomllib.loads("[Nets.slack]\nbounds = [0, 1]\n[Nets.slack]\nbounds = [0, 2]\n")
