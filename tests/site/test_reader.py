import datetime
import math

import pytest

from netdesign.site import net_rows

HEADINGS = 0
FIRST, SECOND = 1, 2


def echoes(net_row):
    return {str(echo.label): echo for echo in net_row.inputs}


# What a sound workbook gives


def test_ranges_are_read_and_an_inclination_not_given_is_assumed(book):
    site = book.read()
    density, friction = site.ranges["density"], site.ranges["friction_angle"]
    assert (density.low, density.high) == (270.0, 400.0)
    assert (friction.low, friction.high) == (math.radians(15), math.radians(45))
    inclination = site.ranges["inclination"]
    assert (inclination.low, inclination.high) == (math.radians(25), math.radians(35))
    shown = {str(echo.label): echo for echo in site.range_inputs}
    assert shown["density of the snow, low"].cell == "Project!B2"
    assert shown["density of the snow, low"].unit == "kg/m3"
    assert not any("inclination" in one for one in shown)
    assert all(row.find_assumed("inclination") for row in site.rows)


def redo(formula):
    """Value of a printed formula, as a reader with a calculator finds it."""
    plain = formula.replace(" m ", " ").replace("·", "*").replace("−", "-")
    assert set(plain) <= set("0123456789.+-*/() ")
    return eval(plain, {"__builtins__": {}})  # of digits and signs only


@pytest.mark.parametrize("glide", [1.0203, 1.37, 2.713, 3.2])
def test_a_slip_length_can_be_redone_from_what_stands_beside_it(book, glide):
    book.put("glide", glide)
    book["Rows"][HEADINGS][2] = "snow height [m vertical]"
    book.put("snow", 3.137)
    row = book.read().rows[0]
    derivation = echoes(row)["slip length, from the glide factor N"].derivation
    formula, where = str(derivation).split(", between ")
    assert redo(formula) == pytest.approx(row.ground.slip_length, rel=1e-5)
    assert where.endswith("for boutillier-2004")


def test_a_resistance_left_empty_or_a_member_without_type_has_none(book):
    row = book.read().rows[1]
    found = {(r.member, r.mode): r for r in row.resistances}
    pull_out = found["foot_anchor", "pull_out"]
    assert (pull_out.value, pull_out.basis) == (None, "")
    assert (pull_out.type_id, pull_out.source) == ("A2", "Anchors!C3")
    guy = found["uphill_guy", "rope"]
    assert (guy.value, guy.type_id, guy.source) == (None, "", "Net types!D3")
    assert found["downhill_guy", "rope"].source == "Rows"  # no such column


# What is noted, never dropped silently


def test_unknown_columns_and_sheets_are_noted(book):
    book["Rows"][HEADINGS] += ["remark", None]
    book["Rows"][FIRST] += ["steep", 7]
    book["Letters"] = [["Dear"]]
    notes = "\n".join(map(str, book.read().notes))
    assert 'Rows › K1: "remark" is no known heading' in notes
    assert 'Rows › L2: "7" has no heading above it' in notes
    assert "Letters: the sheet has no part in the check" in notes


# What is refused: one fault, one finding


@pytest.mark.parametrize(
    ("heading", "value", "rule"),
    [
        ("slope", "0,45O", "is not a number"),
        ("slope", "40 degs", "is not a number"),
        ("slope", "40 gon", "is in gon, the unit of the column is °"),
        ("slope", "1,234", "is ambiguous: 1.234 or 1234"),
        ("slope", True, "is a truth value, not a number"),
        ("slope", 9.9, "is out of range"),
        ("slope", 75.1, "is out of range"),
        ("slope", None, "is empty"),
        ("slope", "   ", "is empty"),
        ("slope", "#REF!", "is an error value"),
        ("slope", "=30+10", "is a formula without a stored result"),
        ("upslope", "#N/A", "is an error value"),
        ("row", None, "is empty"),
        ("row", datetime.datetime(2026, 1, 2), "is not a name"),
        ("row", "x" * 201, "is too long"),
        ("ground", "slippery", "is not a known word"),
        ("glide", "quick", "is not a number"),
        ("glide", 3.46, "is out of range"),
        ("glide", 1.0005, "has no slip length"),
        ("post spacing", "350 cm", "is in cm, the unit of the column is m"),
        ("post spacing", "3.5 kN", "is in kN, the unit of the column is m"),
        ("post spacing", "ca. 3.5 m", "is not a number"),
        ("post spacing", "3.5 m (plan)", "is not a number"),
        ("post spacing", "3-4", "holds two numbers"),
        ("post spacing", "3,5 m2", "is not a number"),
        ("posts", 7.5, "is not a whole number"),
    ],
)
def test_a_bad_cell_is_refused_at_its_address(book, heading, value, rule):
    book.put(heading, value)
    (finding,) = book.refuse()
    assert str(finding.rule) == rule
    assert finding.cell == f"{'ABCDEFGHIJ'[book.find(heading)]}2"
    assert str(finding.accepted)


# Cell below a heading without unit, beside one in metres, and what is wrong with it
# or with the heading: its cells do not all have one unit
@pytest.mark.parametrize(
    ("cell", "place", "rule"),
    [
        (3, "G1", "has no unit"),
        ("3", "G1", "has no unit"),
        ("3 ft", "G1", "has no unit"),
        ("3 kN", "G1", "has no unit"),
        ("35 m", "G3", "is out of range"),
        ("3,000 m", "G3", "is ambiguous: 3.000 or 3000"),
        ("3 m?", "G1", "has no unit"),
    ],
)
def test_a_number_without_its_unit_among_others_is_refused(book, cell, place, rule):
    book["Rows"][0][6] = "post spacing b"
    book["Rows"][1][6], book["Rows"][2][6] = "3.5 m", cell
    (finding,) = book.refuse()
    assert (finding.cell, str(finding.rule)) == (place, rule)


@pytest.mark.parametrize(
    ("heading", "rule"),
    [
        (
            "slope ψ",
            "has no unit",
        ),
        ("slope ψ [mil]", "has an unknown unit"),
        ("slope ψ [grad]", "is ambiguous: [°] or [gon]"),
    ],
)
def test_a_missing_or_unknown_unit_is_refused(book, heading, rule):
    book["Rows"][HEADINGS][1] = heading
    (finding,) = book.refuse()
    assert (finding.cell, str(finding.rule)) == ("B1", rule)
    assert str(finding.accepted) == "[°] or [%] or [rad] or [gon]"


def test_two_units_for_one_column_are_refused(book):
    book["Rows"].insert(1, ["unit", "[%]"])
    (finding,) = book.refuse()
    assert (finding.cell, finding.text) == ("B2", "[%]")
    assert str(finding.rule).startswith("is not the unit")


def test_two_columns_of_one_heading_are_refused(book):
    book["Rows"][HEADINGS].append("SLOPE ψ [%]")
    (finding,) = book.refuse()
    assert (finding.cell, finding.rule.key) == ("K1", "heading.twice")


@pytest.mark.parametrize("heading", ["post spacingg b [m]", "post spacing (m) [cm]"])
def test_a_needed_heading_nearly_right_is_refused(book, heading):
    book["Rows"][HEADINGS][6] = heading
    (finding,) = book.refuse()
    assert finding.cell == "G1"
    assert str(finding.rule).startswith("is no known heading, but close to")


@pytest.mark.parametrize("heading", ["post tlt δ [deg]", "tilt agreed"])
def test_an_optional_heading_nearly_right_is_refused_not_defaulted(book, heading):
    book["Net types"][0].append(heading)
    for line in book["Net types"][1:]:
        line.append(12)
    if heading == "tilt agreed":  # quite another name: a column of somebody else's
        site = book.read()
        assert site.rows[0].find_assumed("post_tilt")
        assert any(heading in note for note in map(str, site.notes))
        return
    (finding,) = book.refuse()
    assert str(finding.rule) == (
        'is no known heading, but close to "post tilt δ [°]", which is missing'
    )


def test_an_id_that_no_sheet_defines_is_refused_with_near_matches(book):
    book.put("net anchor", "A11")
    book.put("uphill guy", "Seil", sheet="Net types")
    anchor, guy = book.refuse()
    assert (anchor.cell, str(anchor.rule)) == ("H2", "is no id of sheet Anchors")
    assert '(nearest: "A1"' in str(anchor.accepted)
    assert (guy.sheet, guy.cell) == ("Net types", "D2")
    assert "nearest" not in str(guy.accepted)


def test_ids_used_twice_are_refused_with_the_first_place(book):
    book.put("row", "R1", SECOND)
    book["Anchors"].append(["a1", 200, None, None])  # in any case
    rules = {(one.sheet, one.cell): str(one.rule) for one in book.refuse()}
    assert rules["Rows", "A3"] == "is used twice: also in Rows!A2"
    assert rules["Anchors", "A4"] == "is used twice: also in Anchors!A2"


def test_more_net_rows_than_a_report_holds_are_refused(book, monkeypatch):
    most = 37
    monkeypatch.setattr(net_rows, "MAX_NET_ROWS", most)
    first = book["Rows"][FIRST]
    book["Rows"][FIRST:] = [[f"W{k}", *first[1:]] for k in range(most)]
    assert len(book.read().rows) == most
    book["Rows"].append(["one more", *first[1:]])
    (finding,) = book.refuse()
    assert (finding.sheet, str(finding.rule)) == ("Rows", "has 38 net rows")
    assert str(finding.accepted) == "at most 37 in one site: divide it"


def test_empty_lines_and_names_of_parts_are_passed_over(book):
    book["Rows"][SECOND:SECOND] = [[None], [None], ["Secteur Nord"]]
    site = book.read()
    assert [one.rule.key for one in site.findings] == ["table.note"]
    assert len(site.rows) == 2


def test_merged_cells_are_refused_below_the_headings_only(book):
    book["Rows"].insert(0, ["Title"])
    assert len(book.read(lambda made: made["Rows"].merge_cells("A1:D1")).rows) == 2
    finding, *others = book.refuse(lambda made: made["Rows"].merge_cells("G3:G4"))
    assert (finding.cell, str(finding.rule)) == ("G3", "is merged over G3:G4")
    assert [other.cell for other in others] == ["G4"]  # emptied by the merge


@pytest.mark.parametrize(
    "line",
    [
        ["Total", 40, 3.0, "free", 20, "N1"],  # more than half of it
        ["R3"],
        ["Nord"],
        ["R3", None, None, None, 20],
    ],
)
def test_a_line_that_may_be_a_net_row_is_never_passed_over(book, line):
    book["Rows"].insert(2, line)
    assert {one.cell[1:] for one in book.refuse()} == {"3"}


# Ranges in cells


@pytest.mark.parametrize(
    ("typed", "unit", "ends"),
    [
        ("250-450", "kg/m3", (250.0, 450.0)),
        ("0,25 à 0,45", "t/m³", (250.0, 450.0)),
        ("250 kg/m³ – 450 kg/m³", "kg/m3", (250.0, 450.0)),
        ("250 bis 450", None, (250.0, 450.0)),
        (300, "kg/m3", (300.0, 300.0)),
        ("300", "kg/m3", (300.0, 300.0)),
    ],
)
def test_a_cell_may_hold_both_ends(book, typed, unit, ends):
    book["Project"][1][1:] = [typed, unit]
    ranges = book.read().ranges
    assert (ranges["density"].low, ranges["density"].high) == ends
    assert math.degrees(ranges["friction_angle"].high) == pytest.approx(45.0)


@pytest.mark.parametrize(
    ("typed", "rule"),
    [
        ("450-250", "is below the low end in Project!B2"),
        ("99 to 400", "is out of range"),
        ("270 to 901", "is out of range"),
        ("250-450-500", "is not a number"),
        ("250/450", "is not a number"),
        ("1,250-1,450", "is ambiguous: 1.250 or 1250"),
        ("250 - 450 °", "is in °, the unit of the column is kg/m³"),
        ("ca. 300", "is not a number"),
        (datetime.datetime(2026, 5, 10), "is a date or time, not a number"),
    ],
)
def test_what_is_no_range_is_refused(book, typed, rule):
    book["Project"][1][1] = typed
    rules = {(one.cell, str(one.rule)) for one in book.refuse()}
    assert ("B2", rule) in rules
    assert {cell for cell, _ in rules} == {"B2"}


@pytest.mark.parametrize(
    ("line", "cell", "rule"),
    [
        (["density of the snow", 270, "lb"], "C2", "heading.unknown_unit"),
        (["wetness", 1, "-"], "A2", "item.unknown"),
        (["friction angle net/snow", 20, "deg"], "A3", "item.twice"),
    ],
)
def test_a_line_of_the_project_that_is_none_is_refused(book, line, cell, rule):
    book["Project"][1] = line
    (finding,) = book.refuse()
    assert (finding.sheet, finding.cell) == ("Project", cell)
    assert finding.rule.key == rule


# All at once


def test_net_rows_on_a_sheet_of_another_name_are_refused(book):
    """Half a site must not vanish."""
    book["Rows north"] = [list(line) for line in book["Rows"]]
    (finding,) = book.refuse()
    assert (finding.sheet, finding.rule.key) == ("Rows north", "table.net_rows")
