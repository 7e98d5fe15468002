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


def test_nor_do_half_of_them(sheets, save, refused):
    columns = put_units_below(sheets)
    for column in columns[:6]:
        sheets["Nets"][1][column] = "ft"
    findings = refused(save(sheets))
    assert {str(one.rule) for one in findings} == {"has an unknown unit"}
    assert len(findings) == 6


def test_the_only_unit_of_a_sheet_may_be_the_unknown_one(sheets, save, refused):
    sheets["Ropes"] = [["id", "minimum breaking force"], [None, "kips"], ["G1", 250]]
    (finding,) = refused(save(sheets))
    assert (finding.cell, str(finding.rule)) == ("B2", "has an unknown unit")


@pytest.mark.parametrize("word", ["unit", "Einheiten", "Unités", "-"])
def test_a_row_of_units_may_say_so(sheets, save, word):
    put_units_below(sheets)
    sheets["Nets"][1][0] = word
    assert [row.id for row in read_site(save(sheets)).rows] == ["R1", "R2"]


def test_another_text_in_a_row_of_units_is_a_finding(sheets, save, refused):
    put_units_below(sheets)
    sheets["Nets"][1][0] = "R0"
    (finding,) = refused(save(sheets))
    assert (finding.cell, str(finding.rule)) == ("A2", "is in the row of units")


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


def test_a_sheet_without_an_id_that_is_asked_for_may_be_missing(sheets, save):
    for line in sheets["Nets"][1:]:
        line[13] = None
    del sheets["Posts"]
    assert len(read_site(save(sheets)).rows) == 2


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


def test_a_misspelt_sheet_is_one_finding(sheets, save, refused):
    sheets["Ancors"] = sheets.pop("Anchors")
    (finding,) = refused(save(sheets))
    assert finding.sheet == "Ancors"
    assert '"Anchors", which is missing' in str(finding.rule)


MEASURED = ["net row", "member", "time [d]", "tension [kN]"]


def test_a_faulty_net_row_is_not_unknown_to_what_was_measured(sheets, save, refused):
    sheets["Nets"][1][1] = "4O"
    sheets["Monitoring"] = [MEASURED, *(["R1", "post", k, 9.7] for k in range(40))]
    (finding,) = refused(save(sheets))
    assert (finding.sheet, finding.cell) == ("Nets", "B2")


def test_an_unknown_row_that_was_measured_is_told_once(sheets, save, refused):
    sheets["Monitoring"] = [MEASURED, *(["R7", "post", k, 9.7] for k in range(40))]
    (finding,) = refused(save(sheets))
    assert (finding.sheet, finding.cell) == ("Monitoring", "A2")
