import datetime
import math

import pytest
import xlsxwriter

from netdesign.envelope.ranges import Interval
from netdesign.resistance.ground import PullOutTests
from netdesign.site import net_rows
from netdesign.site.reader import read_site
from netdesign.snow.ground import (
    LARGEST_GLIDE_FACTOR,
    GroundLaw,
    build_ground_from_glide_factor,
)
from netdesign.structure.members import DEPENDENT_MODES, LIFTED_MODE, MEMBER_MODES
from netdesign.words.catalogue import LANGUAGES, render

HEADINGS = 0
FIRST, SECOND = 1, 2


def column(sheets, heading, sheet="Nets"):
    """Index of the column whose heading starts so."""
    return next(
        index
        for index, text in enumerate(sheets[sheet][HEADINGS])
        if str(text).startswith(heading)
    )


def put(sheets, heading, value, line=FIRST, sheet="Nets"):
    sheets[sheet][line][column(sheets, heading, sheet)] = value


def places_and_rules(findings):
    return [(f"{f.sheet}!{f.cell}", str(f.rule)) for f in findings]


def echoes(net_row):
    return {str(echo.label): echo for echo in net_row.inputs}


# What a sound workbook gives


def test_values_arrive_in_si_units(sheets, save):
    row = read_site(save(sheets)).rows[0]
    assert row.id == "R1"
    assert row.slope_angle == math.radians(40)
    assert row.snow_thickness == 3.0
    assert row.upslope_length == 20.0
    assert row.ground == GroundLaw(kind="free")
    assert row.net_height == 3.5
    assert row.net_stiffness_per_m == 9e6
    assert row.layout.post_spacing == 3.5


def test_ranges_are_read_and_an_inclination_not_given_is_assumed(sheets, save):
    site = read_site(save(sheets))
    density, friction = site.ranges["density"], site.ranges["friction_angle"]
    assert (density.low, density.high) == (270.0, 400.0)
    assert (friction.low, friction.high) == (math.radians(15), math.radians(45))
    inclination = site.ranges["inclination"]
    assert (inclination.low, inclination.high) == (math.radians(25), math.radians(35))
    shown = {str(echo.label): echo for echo in site.range_inputs}
    assert shown["density, low"].cell == "Ranges!B2"
    assert shown["density, low"].unit == "kg/m3"
    assert not any("inclination" in one for one in shown)
    assert all(row.find_assumed("inclination") for row in site.rows)


def test_empty_cells_of_net_and_support_are_ranges(sheets, save):
    site = read_site(save(sheets))
    row = site.rows[0]
    shown = echoes(row)
    for label in ("slack", "post tilt", "uphill anchor distance"):
        assert (shown[label].text, shown[label].value) == ("", "")
    slack, tilt = row.find_assumed("slack"), row.find_assumed("post_tilt")
    assert site.at_row(row).ranges["slack"] == Interval(low=slack.low, high=slack.high)
    assert tilt.low <= row.layout.post_tilt <= tilt.high
    for key in ("uphill_anchor_distance", "downhill_anchor_distance"):
        found, placed = row.find_assumed(key), getattr(row.layout, key)
        assert found.low < placed < found.high
        assert found.low < row.net_height < found.high


def test_vertical_height_becomes_thickness_normal_to_the_slope(sheets, save):
    put(sheets, "snow thickness", None)
    put(sheets, "snow height", 4.0)
    row = read_site(save(sheets)).rows[0]
    assert row.snow_thickness == pytest.approx(4.0 * math.cos(math.radians(40)))
    derived = echoes(row)["snow thickness, from the snow height vertical"]
    assert (derived.value, derived.cell) == (row.snow_thickness, "Nets!D2")
    assert str(derived.derivation) == "4 m · cos 40°"


def test_glide_factor_and_slip_length_give_sliding_ground(sheets, save):
    put(sheets, "ground law", "sliding")
    put(sheets, "glide factor", "1,8")
    put(sheets, "ground law", "Sliding", SECOND)
    put(sheets, "slip length", 2.5, SECOND)
    first, second = read_site(save(sheets)).rows
    assert first.ground == build_ground_from_glide_factor(1.8, 3.0)
    assert second.ground == GroundLaw(kind="sliding", slip_length=2.5)
    derived = echoes(first)["slip length, from the glide factor"]
    assert derived.value == first.ground.slip_length
    assert (first.glide_factor, second.glide_factor) == (1.8, None)
    assert echoes(second)["slip length"].derivation is None


def redo(formula):
    """Value of a printed formula, as a reader with a calculator finds it."""
    plain = formula.replace(" m ", " ").replace("·", "*").replace("−", "-")
    assert set(plain) <= set("0123456789.+-*/() ")
    return eval(plain, {"__builtins__": {}})  # of digits and signs only


@pytest.mark.parametrize("glide", [1.0203, 1.37, 2.713, 3.2])
def test_a_slip_length_can_be_redone_from_what_stands_beside_it(sheets, save, glide):
    put(sheets, "ground law", "sliding")
    put(sheets, "glide factor", glide)
    put(sheets, "snow thickness", None)
    put(sheets, "snow height", 3.137)
    row = read_site(save(sheets)).rows[0]
    derivation = echoes(row)["slip length, from the glide factor"].derivation
    formula, where = str(derivation).split(", between ")
    assert redo(formula) == pytest.approx(row.ground.slip_length, rel=1e-5)
    assert where.endswith("for boutillier-2004")


def test_the_largest_glide_factor_is_that_of_the_table(sheets, save, refused):
    put(sheets, "ground law", "sliding")
    put(sheets, "glide factor", LARGEST_GLIDE_FACTOR)
    assert read_site(save(sheets)).rows[0].glide_factor == LARGEST_GLIDE_FACTOR
    put(sheets, "glide factor", 3.35)
    (finding,) = refused(save(sheets))
    assert "3.346" in str(finding.accepted)


def test_there_is_a_resistance_for_every_member_and_mode(sheets, save):
    row = read_site(save(sheets)).rows[0]
    found = {(r.member, r.mode): r for r in row.resistances}
    beside = [
        (f"{one}_anchor", mode)
        for mode in ("bending", "direction")
        for one in ("foot", "uphill", "downhill")
    ]
    assert tuple(found) == (*MEMBER_MODES, *beside, *DEPENDENT_MODES, LIFTED_MODE)
    pull_out = found["foot_anchor", "pull_out"]
    assert (pull_out.value, pull_out.basis) == (None, "tested")
    assert pull_out.tests == PullOutTests(count=1, least=300e3, mean=300e3)
    assert (pull_out.type_id, pull_out.source) == ("A1", "Anchors!C2")
    assert found["foot_anchor", "tendon"].basis == "declared"
    assert found["uphill_guy", "rope"].value == 0.75 * 250e3
    assert found["post", "compression"].value == 380e3


def test_a_resistance_left_empty_or_a_member_without_type_has_none(sheets, save):
    row = read_site(save(sheets)).rows[1]
    found = {(r.member, r.mode): r for r in row.resistances}
    pull_out = found["foot_anchor", "pull_out"]
    assert (pull_out.value, pull_out.basis) == (None, "")
    assert (pull_out.type_id, pull_out.source) == ("A2", "Anchors!C3")
    guy = found["uphill_guy", "rope"]
    assert (guy.value, guy.type_id, guy.source) == (None, "", "Nets!M3")
    assert found["downhill_guy", "rope"].source == "Nets"  # no such column


def test_a_formula_counts_by_its_stored_result(sheets, tmp_path):
    path = tmp_path / "site.xlsx"
    with xlsxwriter.Workbook(path) as workbook:
        for name, rows in sheets.items():
            sheet = workbook.add_worksheet(name)
            for number, row in enumerate(rows):
                sheet.write_row(number, 0, row)
        workbook.get_worksheet_by_name("Nets").write_formula("C2", "=6/2", value=3)
    row = read_site(path).rows[0]
    assert row.snow_thickness == 3.0
    assert echoes(row)["snow thickness"].text == "=6/2"


# What is noted, never dropped silently


def test_unknown_columns_sheets_and_hidden_rows_are_noted(sheets, save):
    sheets["Nets"][HEADINGS] += ["remark", None]
    sheets["Nets"][FIRST] += ["steep", 7]
    sheets["Letters"] = [["Dear"]]

    def hide(workbook):
        workbook["Nets"].row_dimensions[3].hidden = True
        workbook["Ropes"].sheet_state = "hidden"

    notes = "\n".join(map(str, read_site(save(sheets, hide)).notes))
    assert 'Nets › O1: "remark" is no known heading' in notes
    assert 'Nets › P2: "7" has no heading above it' in notes
    assert "Letters: the sheet has no part in the check" in notes
    assert 'Nets › A3: "R2" is in a hidden row' in notes
    assert "Ropes: the sheet is hidden" in notes


# What is refused: one fault, one finding


@pytest.mark.parametrize(
    ("heading", "value", "rule"),
    [
        ("slope angle", "0,45O", "is not a number"),
        ("slope angle", "40 degs", "is not a number"),
        ("slope angle", "40 gon", "is in gon, the unit of the column is deg"),
        ("slope angle", "1,234", "is ambiguous: 1.234 or 1234"),
        ("slope angle", True, "is a truth value, not a number"),
        ("slope angle", 9.9, "is out of range"),
        ("slope angle", 75.1, "is out of range"),
        ("slope angle", None, "is empty"),
        ("slope angle", "   ", "is empty"),
        ("slope angle", "#REF!", "is an error value"),
        ("slope angle", "=30+10", "is a formula without a stored result"),
        ("upslope length", "#N/A", "is an error value"),
        ("id", None, "is empty"),
        ("id", datetime.datetime(2026, 1, 2), "is not a name"),
        ("id", "x" * 201, "is too long"),
        ("ground law", "slippery", "is not a known word"),
    ],
)
def test_a_bad_cell_is_refused_at_its_address(
    sheets, save, refused, heading, value, rule
):
    put(sheets, heading, value)
    (finding,) = refused(save(sheets))
    assert str(finding.rule) == rule
    assert finding.cell == f"{'ABCDEFGHIJKLMN'[column(sheets, heading)]}2"
    assert str(finding.accepted)


def test_a_percent_format_counts_as_shown_and_against_degrees_is_refused(
    sheets, save, refused
):
    sheets["Nets"][HEADINGS].append("slack")
    sheets["Nets"][FIRST].append(0.05)

    def show_slack_as_percent(workbook):
        workbook["Nets"]["O2"].number_format = "0%"

    def show_slope_as_percent(workbook):
        workbook["Nets"]["B2"].number_format = "0.00%"

    assert read_site(save(sheets, show_slack_as_percent)).rows[0].slack == 0.05
    (finding,) = refused(save(sheets, show_slope_as_percent))
    assert str(finding.rule) == (
        "is ambiguous: its format shows 4000 %, the file holds 40, the unit of the "
        "column is deg"
    )
    sheets["Nets"][HEADINGS][1] = "slope angle [%]"
    sheets["Nets"][FIRST][1], sheets["Nets"][SECOND][1] = 0.7, 70
    rows = read_site(save(sheets, show_slope_as_percent)).rows
    assert rows[0].slope_angle == rows[1].slope_angle
    assert rows[0].slope_angle == pytest.approx(math.atan(0.7), rel=1e-15)
    assert echoes(rows[0])["slope angle"].text == "70 %"


@pytest.mark.parametrize(
    ("heading", "rule"),
    [
        (
            "slope angle",
            "has no unit: B2 could be 40 deg or 40 % (21.8 deg) or 40 gon (36 deg)",
        ),
        ("slope angle [mil]", "has an unknown unit"),
        ("slope angle [grad]", "is ambiguous: [deg] or [gon]"),
    ],
)
def test_a_missing_or_unknown_unit_is_refused(sheets, save, refused, heading, rule):
    sheets["Nets"][HEADINGS][1] = heading
    (finding,) = refused(save(sheets))
    assert (finding.cell, str(finding.rule)) == ("B1", rule)
    assert str(finding.accepted) == "[deg] or [%] or [rad] or [gon]"


def test_two_units_for_one_column_are_refused(sheets, save, refused):
    sheets["Nets"].insert(1, [None, "[%]"])
    (finding,) = refused(save(sheets))
    assert (finding.cell, finding.text) == ("B2", "[%]")
    assert str(finding.rule).startswith("is not the unit")


def test_thickness_and_height_of_another_slope_exclude_each_other(
    sheets, save, refused
):
    put(sheets, "snow height", 4.4)  # 3.0 / cos 40 deg = 3.92
    put(sheets, "snow thickness", None, SECOND)
    both, neither = refused(save(sheets))
    assert (both.cell, both.text) == ("D2", "4.4")
    assert str(both.rule) == "is given beside snow thickness in Nets!C2"
    assert (neither.cell, neither.text) == ("C3", "")
    assert str(neither.rule).startswith("is empty: neither")


@pytest.mark.parametrize(
    ("law", "slip", "glide", "cell", "rule"),
    [
        ("sliding", 2.0, 1.8, "H2", "is given beside slip length in Nets!G2"),
        ("free", 2.0, None, "G2", 'does not fit ground law "free"'),
        ("no-slip", None, 1.8, "H2", 'does not fit ground law "no-slip"'),
        ("sliding", None, 3.46, "H2", "is out of range"),
        ("sliding", None, 1.0005, "H2", "has no slip length"),
    ],
)
def test_ground_law_and_its_number_must_agree(
    sheets, save, refused, law, slip, glide, cell, rule
):
    put(sheets, "ground law", law)
    put(sheets, "slip length", slip)
    put(sheets, "glide factor", glide)
    (finding,) = refused(save(sheets))
    assert finding.cell == cell
    assert str(finding.rule).startswith(rule)


def drop_column(sheets, label):
    """Sheet Nets without a column; its place from zero."""
    place = next(n for n, one in enumerate(sheets["Nets"][0]) if one.startswith(label))
    for line in sheets["Nets"]:
        del line[place]
    return place


@pytest.mark.parametrize(("slip", "glide"), [(None, 1.8), (2.0, None)])
@pytest.mark.parametrize("is_there", [True, False])
def test_a_glide_without_a_ground_law_means_sliding(
    sheets, save, slip, glide, is_there
):
    put(sheets, "slip length", slip)
    put(sheets, "glide factor", glide)
    put(sheets, "ground law", "sliding")
    put(sheets, "ground law", "free", SECOND)
    typed = read_site(save(sheets)).rows[0]
    put(sheets, "ground law", None)
    if not is_there:
        put(sheets, "glide factor", 1.4, SECOND)
        put(sheets, "slip length", None, SECOND)
        drop_column(sheets, "ground law")
    row = read_site(save(sheets)).rows[0]
    assert row.ground == typed.ground
    assert row.ground.kind == "sliding"
    (echo,) = [one for one in row.inputs if one.label.key == "column.Nets.ground_law"]
    (source,) = [
        one
        for one in row.inputs
        if isinstance(one.value, float) and one.value == (slip or glide)
        and one.label.key in ("column.Nets.slip_length", "column.Nets.glide_factor")
    ]  # fmt: skip
    assert (echo.text, echo.value, echo.cell) == ("", "sliding", source.cell)
    told = [render(echo.derivation, language) for language in LANGUAGES]
    assert all(source.cell in one for one in told)
    names = {"en": "sliding ground", "fr": "sol glissant", "de": "gleitender Boden"}
    assert [one.partition(":")[0].strip() for one in told] == [
        names[language] for language in LANGUAGES
    ]


@pytest.mark.parametrize(
    ("slip", "glide", "cell", "rule"),
    [
        (2.0, 1.8, "H2", "is given beside slip length"),
    ],
)
@pytest.mark.parametrize("is_there", [True, False])
def test_two_glides_are_refused_without_a_ground_law(
    sheets, save, refused, slip, glide, cell, rule, is_there
):
    put(sheets, "ground law", None)
    put(sheets, "slip length", slip)
    put(sheets, "glide factor", glide)
    if not is_there:
        put(sheets, "glide factor", 1.4, SECOND)
        drop_column(sheets, "ground law")
    (finding,) = refused(save(sheets))
    assert finding.cell == (cell if is_there else "G2")
    assert str(finding.rule).startswith(rule)


def test_an_id_that_no_sheet_defines_is_refused_with_near_matches(
    sheets, save, refused
):
    put(sheets, "foot anchor", "A11")
    put(sheets, "uphill guy", "Seil")
    anchor, guy = refused(save(sheets))
    assert (anchor.cell, str(anchor.rule)) == ("L2", "is no id of sheet Anchors")
    assert '(nearest: "A1"' in str(anchor.accepted)
    assert (guy.cell, str(guy.rule)) == ("M2", "is no id of sheet Ropes")
    assert "nearest" not in str(guy.accepted)


def test_ids_used_twice_are_refused_with_the_first_place(sheets, save, refused):
    put(sheets, "id", "R1", SECOND)
    sheets["Posts"].append(["P1", 200])
    post, net = refused(save(sheets))
    assert (post.cell, str(post.rule)) == ("A3", "is used twice: also in Posts!A2")
    assert (net.cell, str(net.rule)) == ("A3", "is used twice: also in Nets!A2")


def test_missing_sheets_are_refused(sheets, save, refused):
    del sheets["Nets"], sheets["Ranges"]
    (nets,) = refused(save(sheets))
    assert str(nets.rule) == 'lacks the sheet "Nets"'


def test_more_net_rows_than_a_report_holds_are_refused(
    sheets, save, refused, monkeypatch
):
    most = 37
    monkeypatch.setattr(net_rows, "MAX_NET_ROWS", most)
    first = sheets["Nets"][FIRST]
    sheets["Nets"][FIRST:] = [[f"W{k}", *first[1:]] for k in range(most)]
    assert len(read_site(save(sheets)).rows) == most
    sheets["Nets"].append(["one more", *first[1:]])
    (finding,) = refused(save(sheets))
    assert (finding.sheet, str(finding.rule)) == ("Nets", "has 38 net rows")
    assert str(finding.accepted) == "at most 37 in one site: divide it"


def test_a_gap_before_a_whole_line_is_noted(sheets, save):
    sheets["Nets"][SECOND:SECOND] = [[None], [None]]
    site = read_site(save(sheets))
    (finding,) = site.findings
    assert (finding.cell, len(site.rows)) == ("A3", 2)
    assert str(finding.rule) == "is in an empty row; the lines below it are read"


def test_merged_cells_are_refused_below_the_headings_only(sheets, save, refused):
    sheets["Nets"].insert(0, ["Title"])
    title_only = save(sheets, lambda book: book["Nets"].merge_cells("A1:D1"))
    assert len(read_site(title_only).rows) == 2
    merged = save(sheets, lambda book: book["Nets"].merge_cells("K3:K4"))
    finding, *others = refused(merged)
    assert (finding.cell, str(finding.rule)) == ("K3", "is merged over K3:K4")
    assert [other.cell for other in others] == ["K4"]  # emptied by the merge


# Ranges


@pytest.mark.parametrize(
    ("line", "cell", "rule"),
    [
        (["density", 270, 400], "A2", "has no unit"),
        (["density [lb]", 270, 400], "A2", "has an unknown unit"),
        (["wetness [-]", 1, 2], "A2", "is no known quantity"),
        (["friction angle [deg]", 1, 2], "A3", "is given twice"),
        (["density [kg/m3]", 99, 400], "B2", "is out of range"),
        (["density [kg/m3]", 270, 901], "C2", "is out of range"),
        (["density [kg/m3]", 270, None], "C2", "is empty beside Ranges!B2"),
        (["density [kg/m3]", 400, 270], "C2", "is below the low end in Ranges!B2"),
    ],
)
def test_faults_of_a_range_are_refused(sheets, save, refused, line, cell, rule):
    sheets["Ranges"][FIRST] = line
    findings = refused(save(sheets))
    assert (findings[0].cell, str(findings[0].rule)) == (cell, rule)
    assert not findings[1:]


@pytest.mark.parametrize("count", [1, 3, "3"])
def test_a_count_of_samples_is_refused_with_what_to_do(sheets, save, refused, count):
    """A grid of cases is no way to a verdict; the column of old workbooks is read."""
    sheets["Ranges"][HEADINGS].append("samples")
    assert read_site(save(sheets)).ranges["density"].high == 400.0
    sheets["Ranges"][FIRST].append(count)
    (finding,) = refused(save(sheets))
    assert (finding.sheet, finding.cell) == ("Ranges", "D2")
    assert str(finding.rule) == "counts the cases of a grid, which is gone"
    assert str(finding.accepted).startswith("an empty cell: the worst case is searched")


# All at once


def test_eleven_faults_are_eleven_findings_in_one_pass(sheets, save, refused):
    put(sheets, "slope angle", "0,45O")
    put(sheets, "snow thickness", 40)
    put(sheets, "upslope length", "#REF!")
    put(sheets, "net height", "=7/2")
    put(sheets, "foot anchor", "A-1")
    put(sheets, "id", "R1", SECOND)
    put(sheets, "ground law", "slidin", SECOND)
    sheets["Nets"].insert(SECOND, [None])
    put(sheets, "tendon", "1,234", sheet="Anchors")
    sheets["Ropes"][HEADINGS][1] = "minimum breaking force"
    sheets["Ranges"][FIRST][1:3] = [400, 270]
    assert sorted(places_and_rules(refused(save(sheets)))) == [
        ("Anchors!B2", "is ambiguous: 1.234 or 1234"),
        ("Nets!A3", "is in an empty row; the lines below it are read"),
        ("Nets!A4", "is used twice: also in Nets!A2"),
        ("Nets!B2", "is not a number"),
        ("Nets!C2", "is out of range"),
        ("Nets!E2", "is an error value"),
        ("Nets!F4", "is not a known word"),
        ("Nets!I2", "is a formula without a stored result"),
        ("Nets!L2", "is no id of sheet Anchors"),
        ("Ranges!C2", "is below the low end in Ranges!B2"),
        ("Ropes!B1", "has no unit"),
    ]
