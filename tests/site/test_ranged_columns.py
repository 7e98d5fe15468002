"""Quantities of sheet Nets that range over all rows of a site."""

import math

import pytest

from netdesign.envelope.ranges import Case
from netdesign.site.columns.all_tables import FURTHER_QUANTITIES
from netdesign.site.reader import read_site
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from tests.each import each
from tests.small_site import build_row

# Nets column by the line of sheet Ranges that takes its place
LINES = {
    "slack": ["slack [%]", 1.3, 4.7],
    "net stiffness": ["net stiffness [kN/m]", 4100, 11300],
    "upslope length": ["upslope length [m]", 12.5, 21.7],
    "snow thickness": ["snow thickness [m]", 2.15, 2.85],
}
COLUMNS = {"slack": None, "net stiffness": 9, "upslope length": 4, "snow thickness": 2}


def give(sheets, *lines):
    sheets["Ranges"] += map(list, lines)


def empty(sheets, column):
    for line in sheets["Nets"][1:]:
        line[column] = None


def case(**others):
    return Case(
        density=311.0, friction_angle=0.4, inclination=0.5, others=tuple(others.items())
    )


def test_ranges_take_the_place_of_columns(sheets, save):
    give(sheets, *LINES.values())
    sheets["Ranges"][2][1:3] = [27.5, 27.5]  # six ranges at most
    for column in filter(None, COLUMNS.values()):
        empty(sheets, column)
    site = read_site(save(sheets))
    spans = {name: site.ranges[name] for name in site.ranges.further}
    assert {name: (one.low, one.high) for name, one in spans.items()} == {
        "thickness": (2.15, 2.85),
        "upslope_length": (12.5, 21.7),
        "slack": (pytest.approx(0.013), pytest.approx(0.047)),
        "net_stiffness": (4.1e6, 11.3e6),
    }
    shown = {str(echo.label): echo for echo in site.range_inputs}
    assert (shown["slack, low"].text, shown["slack, low"].cell) == (
        "1.3 %",
        "Ranges!B4",
    )
    assert "slack, low" not in {str(echo.label) for echo in site.rows[0].inputs}


def test_a_row_has_the_severe_end_and_the_values_of_a_case(sheets, save):
    give(sheets, LINES["slack"], LINES["snow thickness"])
    empty(sheets, 2)
    row = read_site(save(sheets)).rows[1]
    assert (row.slack, row.snow_thickness) == (pytest.approx(0.013), 2.85)
    assert row.at(case()) is row
    at = row.at(case(slack=0.031, thickness=2.22))
    assert (at.slack, at.snow_thickness) == (0.031, 2.22)
    assert at.upslope_length == row.upslope_length
    high = row.at(case(snow_height=2.9))
    assert high.snow_thickness == pytest.approx(2.9 * math.cos(math.radians(35)))


def test_a_typed_glide_factor_follows_the_thickness(sheets, save):
    """Its slip length is a share of the thickness; a typed slip length is none."""
    sheets["Nets"][1][5:8] = ["sliding", None, 1.7]
    sheets["Nets"][2][5:8] = ["sliding", 1.9, None]
    empty(sheets, 2)
    give(sheets, LINES["snow thickness"])
    factor, slip = read_site(save(sheets)).rows
    at = case(thickness=2.3)
    assert factor.at(at).ground == build_ground_from_glide_factor(1.7, 2.3)
    assert factor.ground == build_ground_from_glide_factor(1.7, 2.85)
    assert slip.at(at).ground == slip.ground


FURTHER = [one.key for one in FURTHER_QUANTITIES]
GLIDE = {"slip_length", "glide_factor"}


@each("name", FURTHER)
def test_every_quantity_that_ranges_changes_a_row(name):
    ground = build_ground_from_glide_factor(1.4, 2.5)
    row = build_row("R", ground=ground, glide_factor=1.4, snow_thickness=2.5)
    value = 1.5 if name in GLIDE else 2.37
    value = 0.0437 if name == "slack" else value
    assert row.at(case(**{name: value})) != row
    assert row.at(case(**{name: value})) != row.at(case(**{name: 1.01 * value}))


@pytest.mark.parametrize("name", sorted(GLIDE))
@pytest.mark.parametrize("kind", ["free", "no-slip"])
def test_a_row_that_does_not_slide_takes_no_glide(name, kind):
    row = build_row("R", ground=GroundLaw(kind=kind))
    with pytest.raises(ValueError, match=name):
        row.at(case(**{name: 1.3}))


@pytest.mark.parametrize(("name", "column"), [c for c in COLUMNS.items() if c[1]])
def test_what_ranges_and_is_given_too_is_refused_at_the_cell(
    sheets, save, refused, name, column
):
    give(sheets, LINES[name])
    sheets["Nets"][2][column] = None
    (finding,) = refused(save(sheets))
    assert finding.sheet == "Nets"
    assert finding.cell == f"{'ABCDEFGHIJ'[column]}2"
    assert str(finding.rule) == "is given beside the range in Ranges!B4"
    assert str(finding.accepted) == "an empty cell, or no range"


def test_glide_that_ranges_needs_sliding_ground_in_every_row(sheets, save, refused):
    sheets["Nets"][1][5] = "sliding"
    give(sheets, ["glide factor", 1.3, 1.9])
    (finding,) = refused(save(sheets))
    assert (finding.cell, finding.text) == ("F3", "no-slip")
    assert str(finding.rule) == (
        "does not slide, but Ranges!B4 has a range of glide factor"
    )


@pytest.mark.parametrize(
    ("lines", "cell", "rule"),
    [
        ([["slack", 0.01, 0.05]], "A4", "has no unit"),
        ([["slack [-]", 0.05, 0.01]], "C4", "is below the low end in Ranges!B4"),
        ([["slack [-]", 0.01, 0.31]], "C4", "is out of range"),
        ([["slack [-]", 0.01, None]], "C4", "is empty beside Ranges!B4"),
        ([["glide factor", 1.0, 1.5]], "B4", "is out of range"),
        ([LINES["slack"], ["slack [-]", 0.01, 0.03]], "A5", "is given twice"),
        (
            [["slip length [m]", 1, 2], ["glide factor", 1.3, 1.7]],
            "A5",
            "is the same quantity as in Ranges!A4",
        ),
        (
            [LINES["snow thickness"], ["snow height vertical [m]", 3, 3.2]],
            "A5",
            "is the same quantity as in Ranges!A4",
        ),
    ],
)
def test_faults_of_further_ranges_are_one_finding_each(
    sheets, save, refused, lines, cell, rule
):
    for row in sheets["Nets"][1:]:
        row[2], row[5] = None, "sliding"
        row[3] = None if "snow" in str(lines) else 2.7
        row[7] = None if "gl" in str(lines) or "slip" in str(lines) else 1.5
    give(sheets, *lines)
    (finding,) = refused(save(sheets))
    assert (finding.sheet, finding.cell, str(finding.rule)) == ("Ranges", cell, rule)


def test_layers_follow_a_thickness_that_ranges(sheets, save, refused):
    sheets["Snow"] = [
        ["net row", "layer", "layer thickness [m]", "density [kg/m3]"],
        ["R1", 1, 0.8, 390],
        ["R1", 2, 1.7, 295],
    ]
    empty(sheets, 2)
    give(sheets, LINES["snow thickness"])
    row = read_site(save(sheets)).rows[0]
    at = row.at(case(thickness=2.25))
    assert [one.thickness for one in at.layers_at(311.0)] == pytest.approx(
        [0.8 * 0.9, 1.7 * 0.9], rel=1e-12
    )
    sheets["Snow"][2][2] = 2.2
    (finding,) = refused(save(sheets))
    assert (finding.sheet, finding.cell) == ("Snow", "C2")
    assert "layers of 3 m in all, outside the range" in str(finding.rule)
