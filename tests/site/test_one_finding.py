"""One fault is one finding: what follows from it is not told beside it."""

import random

import pytest

from netdesign.site.reader import read_site

UNITS = ["deg", "m", "m", "m", "m", "-", "m", "kN/m", "m"]


def put_units_below(sheets):
    """Units of sheet Nets in a row of their own."""
    sheets["Nets"][0] = [str(text).split(" [")[0] for text in sheets["Nets"][0]]
    row = [None] * len(sheets["Nets"][0])
    measured = [1, 2, 3, 4, 6, 7, 8, 9, 10]
    for column, unit in zip(measured, UNITS, strict=True):
        row[column] = unit
    sheets["Nets"].insert(1, row)
    return measured


@pytest.mark.parametrize("seed", range(6))
def test_an_unknown_unit_does_not_spoil_its_row(sheets, save, refused, seed):
    rng = random.Random(seed)
    column = rng.choice(put_units_below(sheets))
    assert read_site(save(sheets)).rows[0].net_stiffness_per_m == 9e6
    word = rng.choice(["kips", "ft", "yards", "m.", "daN/m", "°F", "to be asked"])
    sheets["Nets"][1][column] = word
    (finding,) = refused(save(sheets))
    assert str(finding.rule) == "has an unknown unit"
    assert (finding.text, finding.cell[1:]) == (word, "2")


def test_a_line_of_numbers_is_no_row_of_units(sheets, save):
    """The number 1 is also how some write that a quantity has no unit."""
    sheets["Ropes"][1:] = [[1, 1], ["G1", 250]]
    sheets["Nets"][2][12] = 1
    first, second = read_site(save(sheets)).rows
    assert {one.value for one in first.resistances if one.mode == "rope"} == {
        187.5e3,
        None,
    }
    assert 750.0 in {one.value for one in second.resistances}


@pytest.mark.parametrize("name", ["Anchors", "Ropes", "Posts"])
def test_a_missing_sheet_is_one_finding_with_the_ids_that_need_it(
    sheets, save, refused, name
):
    lines = sheets["Nets"][1:]
    sheets["Nets"] += [[f"R{k}", *lines[0][1:]] for k in range(3, 15)]
    del sheets[name]
    (finding,) = refused(save(sheets))
    assert (finding.sheet, finding.cell) == ("", "")
    assert str(finding.rule).startswith(f'lacks the sheet "{name}": ')
    first = {"Anchors": "Nets!L2", "Ropes": "Nets!M2", "Posts": "Nets!N2"}[name]
    assert first in str(finding.accepted)


@pytest.mark.parametrize(
    ("spoil", "rule"),
    [
        (lambda _: [["some", "words"]], "has no row of headings"),
        (lambda sheet: [["what", *sheet[0][1:]], *sheet[1:]], 'lacks the heading "id"'),
    ],
)
def test_ids_of_a_sheet_that_cannot_be_read_are_not_told_one_by_one(
    sheets, save, refused, spoil, rule
):
    sheets["Anchors"] = spoil(sheets["Anchors"])
    findings = [one for one in refused(save(sheets)) if one.severity == "error"]
    assert [str(one.rule) for one in findings] == [rule]


MEASURED = ["net row", "member", "time [d]", "tension [kN]"]
