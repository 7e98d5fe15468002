"""Panel between the posts: columns of sheets Nets and Ropes to inputs of the model."""

import math

import pytest

from netdesign.panel.inputs import CUTS
from netdesign.site.reader import read_site
from netdesign.structure.members import END_ANCHORS, END_MODES, NetPart
from netdesign.words.catalogue import LANGUAGES, render

HEADINGS = {
    "panel system": "rectangular",
    "cut of the net": "upper",
    "ridge rope": "B1",
    "sag of the ridge rope [%]": 5.3,
    "lower rope": "B2",
    "sag of the lower rope [-]": 0.041,
    "foot anchors in mid-panel": "yes",
}


@pytest.fixture
def with_panel(sheets):
    """A panel in the first row; sheet Ropes with the ropes of its borders."""
    sheets["Ropes"] = [
        ["id", "minimum breaking force [kN]", "axial stiffness [kN]"],
        *sheets["Ropes"][1:],
        ["B1", 241, 17300],
        ["B2", None, 18700],
    ]
    for line in sheets["Ropes"][1:-2]:
        line[2:] = [None]
    head, first = sheets["Nets"][:2]
    head += HEADINGS
    first += HEADINGS.values()
    return sheets


def put(sheets, heading, value):
    sheets["Nets"][1][sheets["Nets"][0].index(heading)] = value


def lack(row):
    return "" if row.panel_lack is None else render(row.panel_lack, "en")


def test_panel_in_si_with_what_its_ropes_bear(with_panel, save):
    row, other = read_site(save(with_panel)).rows
    (panel,) = row.panels
    assert panel.post_spacing == row.layout.post_spacing
    assert (panel.upper.stiffness, panel.lower.stiffness) == (17.3e6, 18.7e6)
    assert panel.upper.sag == pytest.approx(0.053, rel=1e-12)
    assert panel.lower.sag == 0.041
    assert (panel.cut, panel.has_mid_anchors) == ("upper", True)
    ridge, below = map(row.find_net_part, (NetPart.RIDGE_ROPE, NetPart.LOWER_ROPE))
    assert (ridge.value, below.value) == (pytest.approx(0.75 * 241e3), None)
    assert (ridge.type_id, below.type_id) == ("B1", "B2")
    assert (ridge.mode, below.mode) == ("rope", "rope")
    assert row.panel_lack is None
    assert other.panel_assumed
    assert other.panel_lack is None


def test_a_workbook_without_the_columns_takes_the_panels_that_are_built(sheets, save):
    for row in read_site(save(sheets)).rows:
        assert {one.cut for one in row.panels} == set(CUTS)
        for side in ("lower", "upper"):
            ropes = [getattr(one, side) for one in row.panels]
            sags = {one.sag for one in ropes}
            assert (min(sags), max(sags)) == (0.08, 0.15)
            stiffnesses = {one.stiffness for one in ropes}
            assert (min(stiffnesses), max(stiffnesses)) == (3e6, 150e6)
        assert row.panel_lack is None


@pytest.mark.parametrize(
    "heading", [one for one in HEADINGS if one != "foot anchors in mid-panel"]
)
def test_what_is_missing_is_named_and_assumed(with_panel, save, heading):
    """What is given stays as it is, in every panel that is tried."""
    (whole,) = read_site(save(with_panel)).rows[0].panels
    put(with_panel, heading, None)
    row = read_site(save(with_panel)).rows[0]
    told = [render(one, "en") for one in row.panel_assumed]
    assert told == [heading.split(" [")[0]]
    given = {
        "cut of the net": lambda one: one.cut,
        "sag of the ridge rope [%]": lambda one: one.upper.sag,
        "sag of the lower rope [-]": lambda one: one.lower.sag,
        "ridge rope": lambda one: one.upper.stiffness,
        "lower rope": lambda one: one.lower.stiffness,
    }
    for key, find in given.items():
        found = {find(one) for one in row.panels}
        assert (found == {find(whole)}) is (key != heading), key


def test_a_rope_without_stiffness_is_named(with_panel, save):
    with_panel["Ropes"][-1][2] = None
    row = read_site(save(with_panel)).rows[0]
    (told,) = row.panel_assumed
    assert "axial stiffness of rope B2" in render(told, "en")
    assert len({one.lower.stiffness for one in row.panels}) > 1
    assert {one.upper.stiffness for one in row.panels} == {17.3e6}


def test_mid_anchors_that_nobody_states_are_none(with_panel, save):
    put(with_panel, "foot anchors in mid-panel", None)
    row = read_site(save(with_panel)).rows[0]
    assert {one.has_mid_anchors for one in row.panels} == {False}
    assert [render(one, "en") for one in row.panel_assumed] == [
        "net anchors at the foot in mid-panel"
    ]


def test_triangular_nets_are_named_as_not_covered(with_panel, save):
    put(with_panel, "panel system", "triangular")
    row = read_site(save(with_panel)).rows[0]
    assert row.panels == ()
    words = {"en": "triangular", "fr": "triangulaires", "de": "dreieckige "}
    for language in LANGUAGES:
        assert words[language] in render(row.panel_lack, language)


@pytest.mark.parametrize(
    ("heading", "value"),
    [
        ("panel system", "hexagonal"),
        ("cut of the net", "tailored"),
        ("ridge rope", "B9"),
        ("lower rope", "A1"),
        ("sag of the ridge rope [%]", 31),
        ("sag of the lower rope [-]", -0.01),
        ("foot anchors in mid-panel", "some"),
    ],
)
def test_bad_input_is_one_finding_with_its_cell(
    with_panel, save, refused, heading, value
):
    put(with_panel, heading, value)
    (finding,) = refused(save(with_panel))
    column = with_panel["Nets"][0].index(heading)
    letters = chr(65 + column) if column < 26 else "A" + chr(65 + column - 26)
    assert (finding.sheet, finding.cell) == ("Nets", f"{letters}2")


@pytest.fixture
def with_end(with_panel):
    with_panel["Ends"] = [
        [
            *("net row", "lateral anchor", "end guy", "end guy anchor"),
            "angle of the end guy to the row [deg]",
        ],
        ["R1", "A1", "G1", "A2", 41],
    ]
    return with_panel


def held(row):
    return {(one.member, one.mode): one for one in row.row_end.resistances}


def test_what_holds_the_row_along_itself(with_end, save):
    row, other = read_site(save(with_end)).rows
    found = held(row)
    beside = [(one, mode) for mode in ("bending", "direction") for one in END_ANCHORS]
    assert tuple(found) == (*END_MODES, *beside)
    assert row.row_end.guy_angle == pytest.approx(math.radians(41.0), rel=1e-12)
    assert found["lateral_anchor", "tendon"].value == 0.8 * 400e3
    assert found["lateral_anchor", "pull_out"].basis == "tested"
    assert found["end_guy", "rope"].value == 0.75 * 250e3
    assert found["end_guy_anchor", "pull_out"].value is None
    # judged all the same, with nothing that holds it
    assert {one.value for one in other.row_end.resistances} == {None}
    assert {one.cell for one in row.inputs} >= {"Ends!B2", "Ends!E2"}
    assert row.end_resistances is None  # the types inside


def test_a_row_of_panels_without_a_line_of_ends_has_nothing_that_holds_it(
    with_panel, save
):
    row = read_site(save(with_panel)).rows[0]
    assert row.row_end.guy_angle == math.radians(45.0)
    assert {one.value for one in row.row_end.resistances} == {None}
