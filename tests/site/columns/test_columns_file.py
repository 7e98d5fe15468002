"""columns.toml: what it says is known to the program, and names what there is."""

import math
from typing import get_args

import pytest

from netdesign.panel.inputs import LARGEST_GUY_ANGLE, LARGEST_SAG
from netdesign.site.columns.all_tables import SHEETS
from netdesign.site.columns.fields import Kind
from netdesign.site.columns.office import TABLES
from netdesign.snow.ground import LARGEST_GLIDE_FACTOR
from netdesign.structure.splay import LEAST_SPLAY, MOST_SPLAY
from tests.each import each

PLANS = {plan.name: plan for plan in SHEETS}


def find(table, key):
    plan = PLANS[{"quantities": "Ranges", "items": "Project"}.get(table, table)]
    return next(
        one
        for one in (*plan.fields, *plan.items)
        if (one.table, one.key) == (table, key)
    )


# Constants that the program goes by elsewhere
@each(
    "table, key, low, high",
    [
        ("Nets", "glide_factor", 1.0, LARGEST_GLIDE_FACTOR),
        ("Nets", "ridge_sag", 0.0, LARGEST_SAG),
        ("Nets", "lower_sag", 0.0, LARGEST_SAG),
        ("Nets", "guy_splay", math.degrees(LEAST_SPLAY), math.degrees(MOST_SPLAY)),
        ("Ends", "end_guy_angle", 0.0, math.degrees(LARGEST_GUY_ANGLE)),
    ],
)
def test_bounds_are_those_of_the_calculation(table, key, low, high):
    assert find(table, key).bounds == pytest.approx((low, high), rel=1e-12)


def test_what_a_column_names_is_there():
    """Other columns, kinds, sheets; an unknown key, unit or statement is an error."""
    for plan in SHEETS:
        keys = {one.key for one in plan.fields}
        for one in plan.fields:
            beside = [key for usual in one.beside for key in usual.powers]
            named = {*beside, *one.not_with, *one.needs}
            assert named <= keys
            assert one.kind in get_args(Kind)
            assert one.refers_to in ("", *TABLES)
            assert one.bounds[0] <= one.bounds[1]
