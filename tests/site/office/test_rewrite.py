"""A workbook of version 0.1, written again: the same rows, nothing lost silently."""

import copy
import math
import random
import re
import shlex

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import UNDECLARED, name_column
from netdesign.site.columns.all_tables import load_old_plans
from netdesign.site.columns.office import TABLES
from netdesign.site.office.rewrite import read_old, rewrite
from netdesign.site.reader import read_site
from netdesign.site.template.office_workbook import render_input
from netdesign.words.catalogue import render
from tests.each import each
from tests.make import read_tables
from tests.site.office.old_template import load_example, write_old

LANGUAGES = ("en", "fr", "de")


def write_again(tmp_path, lines, language="en"):
    """What became of a workbook of these lines, and the site of the new one."""
    old = write_old(tmp_path / "old.xlsx", lines, language)
    made = rewrite(read_old(old, UNDECLARED), language)
    of_core = {one: made.tables[one] for one in TABLES if one in made.tables}
    return made, read_tables(of_core, made.measures)


def draw_lines(seed):
    """Example with drawn values in its columns of numbers."""
    rng = random.Random(seed)
    lines = copy.deepcopy(load_example())
    for row in lines["Nets"]:
        for key in ("slack", "post_spacing", "uphill_anchor_distance", "post_tilt"):
            if key in row:
                row[key] = round(row[key] * rng.uniform(0.9, 1.1), 3)
    return lines


def find_type(lines, sheet, name):
    return next(one for one in lines[sheet] if one["id"] == name)


@each("seed, language", [(n, LANGUAGES[n % 3]) for n in range(6)])
def test_rows_have_what_their_lines_said(tmp_path, seed, language):
    lines = draw_lines(seed)
    _, site = write_again(tmp_path, lines, language)
    assert [row.id for row in site.rows] == [one["id"] for one in lines["Nets"]]
    for line, row in zip(lines["Nets"], site.rows, strict=True):
        slope = math.radians(line["slope_angle"])
        thickness = line.get("snow_thickness")
        if thickness is None and "snow_height" in line:
            thickness = line["snow_height"] * math.cos(slope)
        assert row.slope_angle == slope
        assert thickness is None or row.snow_thickness == pytest.approx(
            thickness, abs=1e-4
        )
        assert row.net_height == pytest.approx(line["net_height"], abs=1e-4)
        assert row.slack == pytest.approx(line["slack"])
        assert row.layout.post_spacing == line["post_spacing"]
        assert row.upslope_length == line["upslope_length"]
        assert row.ground.kind == {"no-slip": "no-slip"}.get(
            line["ground_law"], line["ground_law"]
        )
        assert row.ground_type == line.get("ground", "")
        types = {(one.member, one.mode): one for one in row.resistances}
        rope = find_type(lines, "Ropes", line["uphill_guy"])
        if "rope" in rope:
            assert types["uphill_guy", "rope"].value <= 1e3 * rope["rope"] * (1 + 1e-9)
        anchor = find_type(lines, "Anchors", line["foot_anchor"])
        pulled = types["foot_anchor", "pull_out"]
        least = anchor.get("test_least") or anchor.get("pull_out")
        if least and pulled.tests:
            assert pulled.tests.least == 1e3 * least
    density = next(one for one in lines["Ranges"] if one["quantity"] == "density")
    found = site.ranges["density"]
    assert (found.low, found.high) == (density["low"], density["high"])


@each("language", LANGUAGES)
def test_every_cell_has_a_place_or_is_named(tmp_path, language):
    """Of a kind that is told only the first cells are named: so the first lines."""
    lines = draw_lines(LANGUAGES.index(language))
    lines["Nets"][0] |= {"post_base_distance": 1.0, "row_length": 21.0}
    lines["Ends"][0]["end_guy_place"] = 0.5
    rng, marked = random.Random(language), {}
    for sheet in ("Nets", "Ends", "Anchors", "Ropes", "Posts"):
        keys = [field.key for field in load_old_plans()[sheet].fields]
        title = load_old_plans()[sheet].name_in(language)
        for key, value in lines[sheet][0].items():
            if isinstance(value, float) or (isinstance(value, int) and value > 20):
                value = round(value * rng.uniform(0.95, 1.05), 4)
                lines[sheet][0][key] = value
                marked[f"{title}!{name_column(1 + keys.index(key))}2"] = value
    old = write_old(tmp_path / "old.xlsx", lines, language)
    made = rewrite(read_old(old, UNDECLARED), language)
    named = {place for one in made.done for place in one.arguments["places"]}
    named = {str(place).partition(" = ")[0] for place in named}
    kept = {
        value
        for of in made.tables.values()
        for line in of
        for value in line.values()
        if isinstance(value, float)
    }
    assert len(marked) > 20
    for place, value in marked.items():
        assert place in named or kept & {value, round(100 * value, 8)}, place


@each("seed, language", [(n, LANGUAGES[n % 3]) for n in range(6)])
def test_what_the_reader_refuses_is_copied_and_refused_there(tmp_path, seed, language):
    rng = random.Random(seed)
    lines = copy.deepcopy(load_example())
    others = {
        "altitude": 99999.5,
        "upslope_length": -4.5,
        "uphill_anchor_distance": "0 bis 3?",
        "guy_splay": "viel",
        "post_tilt": "-3.3 to 10.0",
        "mesh_strength": "stark",
        "foot_anchor": "N99",
    }
    given = dict(rng.sample(sorted(others.items()), 4))
    lines["Nets"][0] |= given
    with pytest.raises(SiteDataError) as refused:
        write_again(tmp_path, lines, language)
    texts = {one.text for one in refused.value.findings}
    assert set(map(str, given.values())) <= texts


@each("axis", [-60, -80, 20])
def test_a_dip_that_no_bore_has_is_listed(tmp_path, axis):
    lines = copy.deepcopy(load_example())
    for row in lines["Nets"]:
        row["downhill_axis"] = axis
    made, site = write_again(tmp_path, lines)
    assert all(-30 <= one.get("dip", 0) <= 90 for one in made.tables["anchor_types"])
    assert len(site.rows) == len(lines["Nets"])


def test_the_length_of_a_row_becomes_its_posts(tmp_path):
    lines = copy.deepcopy(load_example())
    counts = [row.pop("post_count") for row in lines["Nets"]]
    for row, count in zip(lines["Nets"], counts, strict=True):
        row["row_length"] = (count - 0.4) * row["post_spacing"]
    made, site = write_again(tmp_path, lines)
    assert [row.post_count for row in site.rows] == counts
    assert "rewrite.posts" in [one.arguments["how"].key for one in made.done]


def test_rows_that_take_the_bore_of_another_row_are_named(tmp_path):
    lines = copy.deepcopy(load_example())
    for row in lines["Nets"]:
        row |= {"foot_axis": 57.0, "uphill_axis": 58.5, "downhill_axis": 32.5}
    first, *others = lines["Nets"]
    of_type = [x for x in others if x["downhill_anchor"] == first["downhill_anchor"]]
    keys = [[x.arguments["how"].key for x in write_again(tmp_path, lines)[0].done]]
    assert of_type
    del first["downhill_axis"]
    made, _ = write_again(tmp_path, lines)
    keys.append([one.arguments["how"].key for one in made.done])
    assert ["rewrite.dip_for_all" in each for each in keys] == [False, True]


@each("language", LANGUAGES)
def test_it_is_refused_with_the_command_that_writes_it_again(tmp_path, language):
    path = write_old(tmp_path / "my old site.xlsx", load_example(), language)
    with pytest.raises(SiteDataError) as refused:
        read_site(path)
    (finding,) = refused.value.findings
    told = render(finding.message, language)
    (command,) = re.findall(r"netdesign (map '.*?' --out '.*?')", told)
    assert shlex.split(command)[1] == str(path)


def test_a_workbook_of_today_is_no_old_one(tmp_path):
    made, site = write_again(tmp_path, load_example())
    assert made.tables["rows"]
    path = tmp_path / "new.xlsx"
    path.write_bytes(render_input(made.tables, "en", (), made.measures))
    assert read_old(path, UNDECLARED) is None
    assert [row.layout for row in read_site(path).rows] == [x.layout for x in site.rows]
