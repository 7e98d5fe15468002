"""One fault is one finding: what follows from it is not told beside it."""

import random

import pytest

from netdesign.outcome import SiteDataError
from tests.make import read_tables
from tests.study.knowing_less.drawn_tables import draw_tables

UNITS = ["deg", "m normal", "-", "m", "m"]


def put_units_below(book):
    """Units of sheet Rows in a row of their own."""
    book["Rows"][0] = [str(text).split(" [")[0] for text in book["Rows"][0]]
    row = ["unit"] + [None] * (len(book["Rows"][0]) - 1)
    measured = [1, 2, 3, 4, 6]
    for column, unit in zip(measured, UNITS, strict=True):
        row[column] = unit
    book["Rows"].insert(1, row)
    return measured


@pytest.mark.parametrize("seed", range(6))
def test_an_unknown_unit_does_not_spoil_its_row(book, seed):
    rng = random.Random(seed)
    column = rng.choice(put_units_below(book))
    assert book.read().rows[0].layout.post_spacing == 3.5
    word = rng.choice(["kips", "ft", "yards", "m.", "daN/m", "°F", "to be asked"])
    book["Rows"][1][column] = word
    (finding,) = book.refuse()
    assert str(finding.rule) == "has an unknown unit"
    assert (finding.text, finding.cell[1:]) == (word, "2")


@pytest.mark.parametrize("seed", [4, 7, 11])
def test_a_refused_number_is_told_alone(seed):
    """Beside it nothing is asked for, and no column of its line counts as empty."""
    tables = draw_tables(seed, is_tested=True)
    numbers = [
        (block, place, key)
        for block, lines in tables.items()
        for place, line in enumerate(lines or ())
        for key, value in line.items()
        if block not in ("project", "declared") and isinstance(value, float)
    ]
    for block, place, key in random.Random(seed).sample(numbers, 30):
        line = tables[block][place]
        tables[block][place] = line | {key: -7.3e9}
        with pytest.raises(SiteDataError) as caught:
            read_tables(tables)
        (finding,) = caught.value.findings
        assert float(finding.text) == -7.3e9, (block, place, key)
        tables[block][place] = line
