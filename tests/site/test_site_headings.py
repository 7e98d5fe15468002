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
