"""Every assumed range that counts at its ends is taken there, and told where it counts.

Such a range stands in ``assumed.toml`` and in code: ARCHITECTURE.md, an assumed range.
"""

import pytest

from netdesign.checks import load_standard
from netdesign.site.assumed import assume, load_assumed
from netdesign.study.anchor_ground import _list_sharings
from netdesign.study.guideline_anchors import list_guideline_forces
from netdesign.study.row_to_check import list_variants
from tests.make import read_tables
from tests.study.knowing_less.drawn_tables import draw_tables

SWISS = load_standard("swiss-guideline-2007")
STATICS = [one.key for one in load_assumed().values() if one.kind == "statics"]
NO_CELL = {"net_cut": lambda row: {one.cut for one in row.panels}}


def read_site(key="", value=None):
    """Site of a row of which all is given; a column of that key has another value."""
    tables = draw_tables(5)
    for rope in tables["ropes"]:
        rope.setdefault("axial_stiffness", 21700.0)
    if key:
        table, column = load_assumed()[key].column.split(".")
        for line in tables[table]:
            assert column in line, "nobody can leave this cell empty"
            line[column] = value
    return read_tables(tables)


def list_judged(row):
    """Supports, ends and panels that a row is judged with."""
    variants = [
        one for variant in list_variants(row) for one in _list_sharings(variant)
    ]
    return {*((one.layout, one.guys, one.row_end) for one in variants), *row.panels}


@pytest.mark.parametrize("key", STATICS)
def test_a_row_is_judged_with_more_where_its_statics_are_assumed(key):
    """Nobody would see a range that is told and that nothing takes."""
    (typed,) = read_site().rows
    if key in NO_CELL:
        assert len(NO_CELL[key](typed)) > 1
        return
    (row,) = read_site(key).rows
    assert typed.find_assumed(key) is None
    assert row.find_assumed(key) is not None
    assert len(list_judged(row)) > len(list_judged(typed))


def list_forces(site):
    (row,) = list_guideline_forces(site, SWISS)
    return [one.guideline_kN for one in row.anchors]


@pytest.mark.parametrize("key", [one for one in STATICS if assume(one).is_range])
def test_what_the_guidelines_forces_follow_is_told_beside_them(key):
    site = read_site(key)
    ends = assume(key, site.rows[0].net_height).shown
    low, high = (list_forces(read_site(key, one)) for one in ends)
    (told,) = list_guideline_forces(site, SWISS)
    notes = [one for one in told.notes if one.key == "table.assumed"]
    named = {x.arguments["name"] for one in notes for x in one.arguments["ranges"]}
    assert (low != high) <= (load_assumed()[key].name in named)
