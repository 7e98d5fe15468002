"""One fault is one finding: what follows from it is not told beside it."""

import random

import pytest

from netdesign.site.reader import read_site
from tests.make import write_site
from tests.study.knowing_less.drawn_tables import draw_tables

UNITS = ["deg", "m normal", "-", "m", "m"]


def put_units_below(sheets):
    """Units of sheet Rows in a row of their own."""
    sheets["Rows"][0] = [str(text).split(" [")[0] for text in sheets["Rows"][0]]
    row = ["unit"] + [None] * (len(sheets["Rows"][0]) - 1)
    measured = [1, 2, 3, 4, 6]
    for column, unit in zip(measured, UNITS, strict=True):
        row[column] = unit
    sheets["Rows"].insert(1, row)
    return measured


@pytest.mark.parametrize("seed", range(6))
def test_an_unknown_unit_does_not_spoil_its_row(sheets, save, refused, seed):
    rng = random.Random(seed)
    column = rng.choice(put_units_below(sheets))
    assert read_site(save(sheets)).rows[0].layout.post_spacing == 3.5
    word = rng.choice(["kips", "ft", "yards", "m.", "daN/m", "°F", "to be asked"])
    sheets["Rows"][1][column] = word
    (finding,) = refused(save(sheets))
    assert str(finding.rule) == "has an unknown unit"
    assert (finding.text, finding.cell[1:]) == (word, "2")


def test_a_missing_sheet_is_one_finding_with_the_ids_that_need_it(
    sheets, save, refused
):
    lines = sheets["Rows"][1:]
    sheets["Rows"] += [[f"R{k}", *lines[0][1:]] for k in range(3, 15)]
    del sheets["Anchors"]
    (finding,) = refused(save(sheets))
    assert (finding.sheet, finding.cell) == ("", "")
    assert str(finding.rule).startswith('lacks the sheet "Anchors": ')
    assert "Rows!H2" in str(finding.accepted)


@pytest.mark.parametrize(
    ("spoil", "rule"),
    [
        (lambda _: [["some", "words"]], "has no row of headings"),
        (
            lambda sheet: [["what", *sheet[0][1:]], *sheet[1:]],
            'lacks the heading "anchor type"',
        ),
    ],
)
def test_ids_of_a_sheet_that_cannot_be_read_are_not_told_one_by_one(
    sheets, save, refused, spoil, rule
):
    sheets["Anchors"] = spoil(sheets["Anchors"])
    findings = [one for one in refused(save(sheets)) if one.severity == "error"]
    assert [str(one.rule) for one in findings] == [rule]


@pytest.mark.parametrize("seed", [4, 7, 11])
def test_a_refused_number_is_told_alone(tmp_path, refused, seed):
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
        (finding,) = refused(write_site(tmp_path / "site.xlsx", tables))
        assert finding.text == "-7300000000", (block, place, key)
        tables[block][place] = line
