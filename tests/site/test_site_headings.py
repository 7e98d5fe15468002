"""Headings that are merged, unclear or nearly right; notes below tables."""

import datetime
import math

import pytest

from netdesign.site.reader import read_site

GROUPED = {  # column: group, own heading
    "snow thickness [m]": ("snow", "thickness [m]"),
    "snow height vertical [m]": ("snow", "height vertical [m]"),
    "net height [m]": ("net", "height [m]"),
    "net stiffness [kN/m]": ("net", "stiffness [kN/m]"),
}


def group(sheets):
    """Two rows of headings in place of one; gives the places to merge."""
    headings = sheets["Nets"][0]
    above = [GROUPED.get(text, (None,))[0] for text in headings]
    below = [GROUPED.get(text, (None, text))[1] for text in headings]
    # only the first cell of a merged group keeps its text
    shown = [
        name if k == 0 or above[k - 1] != name else None for k, name in enumerate(above)
    ]
    sheets["Nets"][:1] = [shown, below]
    return ["C1:D1", "I1:J1"]


def test_groups_merged_above_headings_are_refused(sheets, save, refused):
    places = group(sheets)

    def merge(workbook):
        for place in places:
            workbook["Nets"].merge_cells(place)

    found = refused(save(sheets, merge))
    told = {one.cell for one in found if one.rule.key == "heading.group"}
    assert told == {place.split(":")[0] for place in places}


def test_a_title_merged_above_the_headings_is_none_of_them(sheets, save):
    sheets["Nets"].insert(0, ["Net rows of the north side"])

    def merge(workbook):
        workbook["Nets"].merge_cells("A1:F1")

    assert len(read_site(save(sheets, merge)).rows) == 2


def test_a_group_that_is_not_merged_says_nothing(sheets, save, refused):
    group(sheets)
    rules = {
        (f.cell, str(f.rule)) for f in refused(save(sheets)) if f.severity == "error"
    }
    assert (
        "I2",
        "is ambiguous: "
        + " or ".join(
            f'"{name}"'
            for name in (
                "snow thickness [m]",
                "snow height vertical [m]",
                "net height [m]",
            )
        ),
    ) in rules


def test_a_heading_merged_over_two_columns_of_numbers_is_refused(sheets, save, refused):
    sheets["Nets"][0][3] = None
    sheets["Nets"][1][3] = 3.5

    def merge(workbook):
        workbook["Nets"].merge_cells("C1:D1")

    (finding,) = refused(save(sheets, merge))
    assert (finding.cell, str(finding.rule)) == (
        *("D2", "is below a heading merged over C1:D1"),
    )


@pytest.mark.parametrize("heading", ["snow depth [m]", "hauteur [m]", "Höhe [m]"])
def test_a_heading_with_several_meanings_is_refused_with_them(
    sheets, save, refused, heading
):
    sheets["Nets"][0][2] = heading
    findings = refused(save(sheets))
    finding = next(one for one in findings if one.cell == "C1")
    assert str(finding.rule).startswith(
        'is ambiguous: "snow thickness [m]" or "snow height vertical [m]"'
    )


def test_a_heading_whose_sides_mean_two_columns_is_refused(sheets, save, refused):
    sheets["Ranges"][0][2] = "de / high"
    finding = next(one for one in refused(save(sheets)) if one.cell == "C1")
    assert finding.sheet == "Ranges"
    assert str(finding.rule).startswith("is no known heading, but close to")


@pytest.mark.parametrize("heading", ["slak [-]", "slack agreed"])
def test_an_optional_heading_nearly_right_is_refused_not_defaulted(
    sheets, save, refused, heading
):
    sheets["Nets"][0].append(heading)
    for line in sheets["Nets"][1:]:
        line.append(0.1)
    if heading == "slak [-]":
        (finding,) = refused(save(sheets))
        assert str(finding.rule) == (
            'is no known heading, but close to "slack [-]", which is missing'
        )
    else:  # quite another name: read as what it is, a column of somebody else's
        site = read_site(save(sheets))
        assert site.rows[0].slack == 0.02
        assert any("slack agreed" in note for note in map(str, site.notes))


def test_notes_below_a_table_are_listed_and_not_read(sheets, save):
    sheets["Nets"] += [
        [None],
        ["* heights from the survey of 2023"],
        [None, "Bemerkung: R2 im Wald"],
    ]
    site = read_site(save(sheets))
    assert len(site.rows) == 2
    notes = [note for note in map(str, site.notes) if "is a note below" in note]
    assert notes == [
        'site.xlsx › Nets › B6: "Bemerkung: R2 im Wald" is a note below the table: it '
        'is not read; likewise A5 "* heights from the survey of 2023"'
    ]


@pytest.mark.parametrize("line", [["R3"], ["R3 new"], [None, 40], ["R3", 40]])
def test_a_line_begun_is_no_note(sheets, save, refused, line):
    sheets["Nets"].append(line)
    assert {f.cell for f in refused(save(sheets))} >= {"C4", "E4"}


def test_a_note_between_lines_is_refused(sheets, save, refused):
    sheets["Nets"].insert(2, ["these rows are to be checked again"])
    assert {f.cell for f in refused(save(sheets))} >= {"B3", "C3"}


def test_a_hidden_column_is_read_and_noted(sheets, save):
    def hide(workbook):
        workbook["Nets"].column_dimensions["B"].hidden = True

    site = read_site(save(sheets, hide))
    (note,) = map(str, site.notes)
    assert 'Nets › B1: "slope angle [deg]" is in a hidden column' in note
    assert site.rows[0].inputs[1].value == 40.0


def test_macros_are_ignored_with_a_remark(sheets, save):
    import zipfile

    path = save(sheets)
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr("xl/vbaProject.bin", b"macros")
    (note,) = map(str, read_site(path.rename(path.with_suffix(".xlsm"))).notes)
    assert note == "site.xlsm: the file holds macros: they are ignored"


def test_numbers_may_have_their_units_in_their_cells(sheets, save):
    sheets["Nets"][0][8] = "net height"
    sheets["Nets"][1][8], sheets["Nets"][2][8] = "3,5 m", "300 cm"
    rows = read_site(save(sheets)).rows
    assert [row.net_height for row in rows] == [3.5, 3.0]


# Cell below a heading without unit, beside one in metres, and what is wrong with it
@pytest.mark.parametrize(
    ("cell", "rule"),
    [
        (3, "has no unit"),
        ("3", "has no unit"),
        ("3 ft", "has an unknown unit"),
        ("3 kN", "has an unknown unit"),
        ("35 m", "is out of range"),
        ("3,000 m", "is ambiguous: 3.000 or 3000"),
        ("3 m?", "has an unknown unit"),
    ],
)
def test_a_number_without_its_unit_among_others_is_refused(
    sheets, save, refused, cell, rule
):
    sheets["Nets"][0][8] = "net height"
    sheets["Nets"][1][8], sheets["Nets"][2][8] = "3.5 m", cell
    (finding,) = refused(save(sheets))
    assert (finding.cell, str(finding.rule)) == ("I3", rule)


@pytest.mark.parametrize(
    ("cell", "rule"),
    [
        ("350 cm", "is in cm, the unit of the column is m"),
        ("3.5 kN", "is in kN, the unit of the column is m"),
        ("ca. 3.5 m", "is not a number"),
        ("3.5 m (plan)", "is not a number"),
        ("3-4", "holds two numbers"),
        ("3,5 m2", "is not a number"),
    ],
)
def test_a_number_in_another_unit_than_its_column_is_refused(
    sheets, save, refused, cell, rule
):
    sheets["Nets"][1][8] = cell
    (finding,) = refused(save(sheets))
    assert (finding.cell, str(finding.rule)) == ("I2", rule)


def test_two_units_in_one_heading_are_refused(sheets, save, refused):
    sheets["Nets"][0][1] = "slope angle (deg) [%]"
    (finding,) = refused(save(sheets))
    assert finding.cell == "B1"
    assert str(finding.rule).startswith("is no known heading, but close to")


# Both ends of a range in one cell, its unit in the line, and the ends
@pytest.mark.parametrize(
    ("typed", "unit", "ends"),
    [
        ("250-450", "kg/m3", (250.0, 450.0)),
        ("0,25 à 0,45", "t/m³", (250.0, 450.0)),
        ("250 kg/m³ – 450 kg/m³", None, (250.0, 450.0)),
        (300, "kg/m3", (300.0, 300.0)),
        ("300", "kg/m3", (300.0, 300.0)),
    ],
)
def test_both_ends_may_stand_in_one_cell(sheets, save, typed, unit, ends):
    sheets["Ranges"] = [
        ["quantity", "range", "unit"],
        ["density", typed, unit],
        ["friction angle", "15° bis 45°", None],
    ]
    ranges = read_site(save(sheets)).ranges
    assert (ranges["density"].low, ranges["density"].high) == ends
    assert math.degrees(ranges["friction_angle"].high) == pytest.approx(45.0)


@pytest.mark.parametrize(
    ("typed", "rule"),
    [
        ("450-250", "is below the low end in Ranges!B2"),
        ("250-450-500", "is not a number"),
        ("250/450", "is not a number"),
        ("1,250-1,450", "is ambiguous: 1.250 or 1250"),
        ("250 - 450 °", "is in °, the unit of the column is kg/m3"),
        ("ca. 300", "is not a number"),
        (datetime.datetime(2026, 5, 10), "is a date or time, not a number"),
    ],
)
def test_what_is_no_range_is_refused(sheets, save, refused, typed, rule):
    sheets["Ranges"] = [
        ["quantity", "range", "unit"],
        ["density", typed, "kg/m3"],
        ["friction angle", "15-45", "°"],
    ]
    rules = {(one.cell, str(one.rule)) for one in refused(save(sheets))}
    assert ("B2", rule) in rules
    assert {cell for cell, _ in rules} == {"B2"}


def test_lines_between_the_lines_of_a_table_are_told(sheets, save):
    first, second = sheets["Nets"][1:]
    sheets["Nets"][1:] = [
        ["Secteur Nord"],
        first,
        ["Sous-total", None, None, None, 20],
        [],
        [*sheets["Nets"][0]],
        ["Zone Sud"],
        second,
        ["TOTAL", None, None, None, 35],
    ]
    site = read_site(save(sheets))
    assert [row.id for row in site.rows] == ["R1", "R2"]
    told = {one.cell: one.rule.key for one in site.findings}
    assert told == {
        **{"A2": "table.part", "A4": "table.total", "A6": "table.headings_again"},
        **{"A7": "table.part", "A9": "table.total"},
    }


@pytest.mark.parametrize(
    "line",
    [
        ["Total", 40, 3.0, None, 20, "free", None, None, 3.5],  # more than half of it
        ["R3"],
        ["Nord"],
        ["R3", None, None, None, 20],
    ],
)
def test_a_line_that_may_be_a_net_row_is_never_passed_over(sheets, save, refused, line):
    sheets["Nets"].insert(2, line)
    assert {one.cell[1:] for one in refused(save(sheets))} == {"3"}


def test_a_name_with_a_unit_is_asked_for(sheets, save, refused):
    """A length of the line is none of its ids."""
    sheets["Nets"][0][0] = "ligne [m]"
    (finding,) = refused(save(sheets))
    assert (finding.cell, str(finding.rule)) == (
        "A1",
        "has the unit m, but id has none",
    )
