"""Rows and net types, joined: what is typed is what a net row has."""

import math

import pytest

from netdesign.cable.net import find_slack
from netdesign.outcome import SiteDataError
from netdesign.site.columns.office import load_columns, load_plan
from netdesign.site.reader import read_site
from netdesign.structure.members import NetPart
from tests.each import each
from tests.make import (
    find_cell,
    lay_out,
    load_rows,
    read_tables,
    write_sheets,
    write_site,
)
from tests.site.office.drawn import draw_tables

LANGUAGES = ("en", "fr", "de")
IN_ROWS = ("rows", "net_types")
CASES = [(seed, LANGUAGES[seed % 3]) for seed in range(12)]


def find_line(tables, table, key):
    return next(one for one in tables[table] if one["id"] == key)


@each("seed", range(3))
def test_a_sag_typed_as_a_share_of_one_is_asked_about(tmp_path, seed):
    tables = draw_tables(seed)
    asked = []
    for factor in (1.0, 0.01):
        for net in tables["net_types"]:
            net["slack"] = factor * (11.0 + seed)
        path = tmp_path / f"{factor}.xlsx"
        write_site(path, tables, "en", {("net_types", "slack"): "sag"})
        asked.append([len(row.questions) for row in read_site(path).rows])
    as_percent, as_share = asked
    assert all(a < b for a, b in zip(as_percent, as_share, strict=True))


@each("seed, language", CASES)
def test_a_row_has_what_its_line_and_its_net_type_say(tmp_path, seed, language):
    tables = draw_tables(seed)
    measure = ("vertical", "normal")[seed % 2]
    sag = ("sag", "slack")[seed % 2]
    if sag == "sag":
        for net in tables["net_types"]:
            net["slack"] = net["slack"] + 9
    path = tmp_path / f"{seed}.xlsx"
    write_site(
        path, tables, language, {("rows", "snow"): measure, ("net_types", "slack"): sag}
    )
    site = read_site(path)
    assert site.project.name == f"Site {seed}"
    density = site.ranges["density"]
    assert (density.low, density.high) == tables["project"][0]["density"]
    for line, row in zip(tables["rows"], site.rows, strict=True):
        net = find_line(tables, "net_types", line["net_type"])
        slope = math.radians(line["slope_angle"])
        factor = math.cos(slope) if measure == "vertical" else 1.0
        slack = net["slack"] / 100
        assert row.slope_angle == pytest.approx(slope)
        assert row.snow_thickness == pytest.approx(line["snow"] * factor)
        assert row.glide_factor == line["glide_factor"]
        assert row.net_height == net["net_height"]
        assert row.slack == pytest.approx(find_slack(slack) if sag == "sag" else slack)
        assert row.layout.post_spacing == line["post_spacing"]
        assert row.layout.post_tilt == pytest.approx(math.radians(net["post_tilt"]))
        assert row.guys.are_shared is (net["guy_anchors"] == "shared")
        assert row.net_stiffness_per_m == 1e3 * net["net_stiffness"]
        assert row.post_count == line["post_count"]
        length = (line["post_count"] - 1) * line["post_spacing"]
        assert row.length == pytest.approx(length)
        strength = next(x for x in row.net_parts if x.member is NetPart.MESH).value
        assert strength == 1e3 * net["mesh_strength"]
        assert row.design_life == tables["project"][0]["design_life"]
        assert row.ground_type == "till"
        assert row.approval.foot_force.value == 1e3 * net["maker_foot"]
        assert row.approval.glide_factor.value == net["glide_most"]
        assert {one.upper.sag for one in row.panels} == {net["ridge_sag"] / 100}
        foot = find_line(tables, "anchor_types", line["foot_anchor"])
        axis = math.radians(foot["dip"]) + slope
        assert row.find_axis("foot_anchor") == pytest.approx(axis)
        tendon = next(
            one
            for one in row.resistances
            if (one.member, one.mode) == ("foot_anchor", "tendon")
        )
        assert tendon.value == 1e3 * foot["tendon"]
        assert tendon.type_id == foot["id"]


@each("seed", range(6))
def test_every_cell_that_a_row_shows_is_where_it_was_typed(tmp_path, seed):
    tables = draw_tables(seed)
    language = LANGUAGES[seed % 3]
    path = tmp_path / f"{seed}.xlsx"
    write_site(path, tables, language)
    site = read_site(path)
    typed = {
        find_cell(table, key, line, language, tables)
        for table, lines in tables.items()
        for line, cells in enumerate(lines)
        for key in cells
    }
    for row in site.rows:
        shown = {one.cell for one in row.inputs if "!" in one.cell and one.text}
        assert shown <= typed
        sheets = {one.partition("!")[0] for one in shown}
        assert {load_plan(one).name_in(language) for one in IN_ROWS} <= sheets


SPOILT = [
    ("rows", "slope_angle", "steep"),
    ("rows", "snow", 0.01),
    ("rows", "glide_factor", "quick"),
    ("rows", "net_type", "SN 99"),
    ("rows", "foot_anchor", "GEWI 9"),
    ("rows", "post_spacing", "1,5,0"),
    ("rows", "ground", "cheese"),
    ("net_types", "net_height", "tall"),
    ("net_types", "slack", -4),
    *(("net_types", key, "S 99") for key in ("ridge_rope", "lower_rope")),
    *(("net_types", "lower_sag", bad) for bad in (31, -0.01, "8 to 12")),
    ("net_types", "ridge_sag", 31),
    ("net_types", "mid_anchors", "some"),
    ("net_types", "guy_count", 3),
    ("anchor_types", "tendon", "strong"),
    ("anchor_types", "proven", "I think so"),
    ("anchor_types", "dip", 120),
    ("ropes", "rope", "thick"),
    ("posts", "yield_strength", 20),
    ("project", "density", "light"),
    ("project", "soil", "nice"),
]


@each("table, key, text", SPOILT)
def test_a_fault_names_its_cell(tmp_path, table, key, text):
    tables = draw_tables(3)
    line = tables[table][0]
    line[key] = text
    if table == "net_types":  # a type that no row names is no fault of a row
        for row in tables["rows"]:
            row["net_type"] = line["id"]
    language = LANGUAGES[len(key) % 3]
    path = write_site(tmp_path / "site.xlsx", tables, language)
    with pytest.raises(SiteDataError) as refused:
        read_site(path)
    errors = [one for one in refused.value.findings if one.severity == "error"]
    place = find_cell(table, key, language=language, tables=tables)
    assert {f"{one.sheet}!{one.cell}" for one in errors} == {place}


@each("seed", range(5))
def test_an_id_is_known_whatever_its_case(seed):
    tables = draw_tables(seed)
    plain = read_tables(tables)
    for line in tables["rows"]:
        for key in ("net_type", "foot_anchor", "end_anchor"):
            line[key] = line[key].lower().replace(" ", "  ")
    for net in tables["net_types"]:
        net["ridge_rope"] = net["ridge_rope"].lower()
    other = read_tables(tables)
    assert [list_types(row) for row in plain.rows] == [
        list_types(row) for row in other.rows
    ]


def list_types(row):
    return [(one.member, one.mode, one.type_id) for one in row.resistances]


def test_a_unit_cell_has_to_say_what_is_measured(tmp_path):
    sheets = lay_out(draw_tables(2))
    column = [one.field.key for one in load_columns("rows")].index("snow")
    sheets["Rows"][3][column] = "m"
    with pytest.raises(SiteDataError) as refused:
        read_site(write_sheets(tmp_path / "site.xlsx", sheets))
    assert {one.cell[:1] for one in refused.value.findings} == {"ABCDEF"[column]}


def test_other_types_may_stand_at_the_ends():
    tables = draw_tables(6)
    inside, other = (one["id"] for one in tables["anchor_types"][:2])
    for line in tables["rows"]:
        line["foot_anchor"] = inside
    tables["anchor_types"][0]["at_end"] = other.lower()
    tables["ropes"][0]["at_end"] = "S 24"
    site = read_tables(tables)
    for row in site.rows:
        at_end = {one.member: one.type_id for one in row.resistances_at("edge")}
        assert at_end["foot_anchor"] == other
        assert at_end["uphill_guy"] == "S 24"
        assert at_end["post"] == "HEA 160"


def test_the_line_of_the_row_s_ground_counts():
    tables = draw_tables(7)
    of_scree = {"ground": "scree", "pull_out": 77, "test_count": 1, "test_mean": 80}
    tables["anchor_types"] += [one | of_scree for one in tables["anchor_types"]]
    scree = tables["anchor_types"][0]
    for number, line in enumerate(tables["rows"]):
        line["foot_anchor"] = scree["id"]
        line["ground"] = ("till", "scree")[number % 2]
    site = read_tables(tables)
    found = [find_tests(row).least for row in site.rows]
    till = 1e3 * tables["anchor_types"][0]["pull_out"]
    assert found == [till, 77e3] * 2


def find_tests(row):
    return next(
        one.tests
        for one in row.resistances
        if (one.member, one.mode) == ("foot_anchor", "pull_out")
    )


def test_a_word_declares_several_checks_of_several_rows():
    tables = draw_tables(11)
    document = {"document": "EX-G7", "author": "B. Example"}
    tables["declared"] = [{"row": "A1, a3", "check": "post base", **document}]
    site = read_tables(tables)
    assert {one.row_id for one in site.declared} == {"A1", "A3"}
    assert {one.mode for one in site.declared} == {"bearing", "sliding"}
    assert {one.proof.document for one in site.declared} == {"EX-G7"}


@pytest.mark.parametrize(
    "word", ["-", "?", "1", "none", "Applied for.", "keine", "non"]
)
def test_a_word_is_no_type_approval(word):
    """The structure would be proven by it."""
    tables = load_rows(["R1"])
    tables["net_types"][0]["approval"] = word
    with pytest.raises(SiteDataError) as refused:
        read_tables(tables)
    assert [one.rule.key for one in refused.value.findings] == ["cell.no_document"]
