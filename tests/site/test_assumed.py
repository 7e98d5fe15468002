"""What is assumed of empty cells: every range lies within what a cell may hold."""

import math

import pytest

from netdesign.site.assumed import assume, assume_ends, load_assumed
from netdesign.site.columns.all_tables import load_old_plans
from netdesign.words.catalogue import LANGUAGES, render
from tests.site.columns.fields import FIELDS as TABLES

OLD = [(*one.fields, *one.items) for one in load_old_plans().values()]
FIELDS = {
    f"{one.table}.{one.key}": one
    for fields in (*TABLES.values(), *OLD)
    for one in fields
}


@pytest.mark.parametrize("key", load_assumed())
def test_what_is_assumed_is_a_column_with_words_in_every_language(key):
    found = load_assumed()[key]
    assert found.column in FIELDS
    assert found.low <= found.high
    assert found.kind != "searched" or found.is_range
    for language in LANGUAGES:
        for text in (found.name, found.text, found.why):
            assert render(text, language)


@pytest.mark.parametrize("key", load_assumed())
def test_what_is_assumed_may_be_typed_without_a_question(key):
    found = load_assumed()[key]
    field = FIELDS[found.column]
    if found.unit == "D_K" or found.word or found.key == "upslope_length":
        return
    assert found.unit in (*field.units, "", "a")  # a count of years has no units
    usual = field.usual
    least, most = (usual.least, usual.most) if usual else field.bounds
    assert least <= found.shown[0] <= found.shown[1] <= most


def test_a_multiple_is_that_of_its_factor():
    found = assume("uphill_anchor_distance", 3.7)
    assert math.isclose(found.low, 0.75 * 3.7)
    assert math.isclose(found.high, 1.25 * 3.7)
    assert assume_ends("density", 281.0, 433.0).shown == (281.0, 433.0)
