"""A workbook with sheet Nets, written again: the same rows, nothing lost silently."""

import copy
import random
import re

import pytest

from netdesign.site.cells.cells import name_column
from netdesign.site.office.rewrite import rewrite
from netdesign.site.reader import read_cells, read_site
from netdesign.site.template.office_workbook import render_input
from netdesign.site.template.workbook import render_workbook
from netdesign.words.catalogue import render
from tests.each import each
from tests.old_example import load_example

LANGUAGES = ("en", "fr", "de")


def write_both(tmp_path, lines, language="en"):
    """Site as the workbook with sheet Nets has it, and written again; what was done."""
    old, new = tmp_path / "old.xlsx", tmp_path / "new.xlsx"
    old.write_bytes(render_workbook(lines, language))
    made = rewrite(read_cells(old), language)
    new.write_bytes(render_input(made.tables, language, made.sheets, made.measures))
    return read_site(old), read_site(new), [render(one, language) for one in made.done]


def list_resistances(row, sites_ends=False):
    given = row.resistances_at("edge") if sites_ends else row.resistances
    return {
        (one.member, one.mode): (
            one.type_id.split(" (")[0],
            one.value and float(f"{one.value:.3g}"),
            one.tests and one.tests.least,
        )
        for one in given
        if one.mode in ("tendon", "pull_out", "rope", "bearing")
    }


def draw_lines(seed):
    """Example with drawn values in its columns of numbers."""
    rng = random.Random(seed)
    lines = copy.deepcopy(load_example())
    for row in lines["Nets"]:
        for key in ("slack", "post_spacing", "uphill_anchor_distance", "post_tilt"):
            if key in row:
                row[key] = round(row[key] * rng.uniform(0.9, 1.1), 3)
    return lines


@each("seed, language", [(n, LANGUAGES[n % 3]) for n in range(6)])
def test_rows_are_the_same(tmp_path, seed, language):
    old, new, _ = write_both(tmp_path, draw_lines(seed), language)
    assert [row.id for row in old.rows] == [row.id for row in new.rows]
    for one, other in zip(old.rows, new.rows, strict=True):
        assert other.slope_angle == one.slope_angle
        assert other.snow_thickness == pytest.approx(one.snow_thickness, abs=1e-4)
        assert other.net_height == pytest.approx(one.net_height, abs=1e-4)
        assert other.slack == pytest.approx(one.slack)
        assert other.layout == one.layout
        assert other.guys == one.guys
        assert other.upslope_length == one.upslope_length
        assert other.glide_factor in (one.glide_factor, 1.0)
        assert other.gap == one.gap
        assert other.post_count == one.post_count
        assert other.ground_type == one.ground_type
        assert list_resistances(other) == list_resistances(one)
        dips = {anchor: axis for anchor, axis in one.axes}
        assert all(axis <= dips[anchor] + 1e-3 for anchor, axis in other.axes)
    assert old.ranges["density"] == new.ranges["density"]


@each("language", LANGUAGES)
def test_every_cell_has_a_place_or_is_named(tmp_path, language):
    lines = draw_lines(1)
    path = tmp_path / "old.xlsx"
    path.write_bytes(render_workbook(lines, language))
    workbook = read_cells(path)
    made = rewrite(workbook, language)
    told = {place for one in made.done for place in one.arguments["places"]}
    kept = " ".join(
        str(value)
        for of in made.tables.values()
        for line in of
        for value in line.values()
    )
    assert told
    # a number that stands nowhere else is either copied or named with its cell
    marked = copy.deepcopy(lines)
    marked["Anchors"][0]["protected_years"] = 137
    marked["Nets"][0]["post_spacing"] = 3.7654
    path.write_bytes(render_workbook(marked, language))
    made = rewrite(read_cells(path), language)
    done = " ".join(render(one, language) for one in made.done)
    kept = [line.get("post_spacing") for line in made.tables["rows"]]
    assert 3.7654 in kept
    assert "137" in done


def test_types_with_the_same_values_are_one_net_type(tmp_path):
    lines = copy.deepcopy(load_example())
    first = lines["Nets"][0]
    lines["Nets"] = [first, {**first, "id": "R8"}, {**first, "id": "R9", "slack": 0.09}]
    lines["Ends"] = []
    lines["Declared"] = []
    _, new, _ = write_both(tmp_path, lines)
    path = tmp_path / "new.xlsx"
    assert path.exists()
    nets = {row.id: (row.net_height, row.slack) for row in new.rows}
    assert nets["R8"] == nets[first["id"]] != nets["R9"]


def test_a_faulty_cell_is_copied_as_it_is(tmp_path):
    lines = copy.deepcopy(load_example())
    path = tmp_path / "old.xlsx"
    path.write_bytes(render_workbook(lines))
    import openpyxl

    book = openpyxl.load_workbook(path)
    headings = [cell.value for cell in book["Nets"][1]]
    column = name_column(1 + headings.index("post spacing [m]"))
    book["Nets"][f"{column}2"] = "about 3"
    book.save(path)
    made = rewrite(read_cells(path), "en")
    assert made.tables["rows"][0]["post_spacing"] == "about 3"


def test_a_list_of_an_office_is_mapped(tmp_path):
    lines = {
        "Nets": [
            {
                "id": "L1",
                "slope_angle": 35,
                "snow_thickness": 3,
                "glide_factor": 1.8,
                "net_height": 3,
                "post_spacing": 3.5,
                "foot_anchor": "N32",
                "altitude": 2050,
            }
        ],
        "Anchors": [{"id": "N32", "tendon": 400, "pull_out": 320, "basis": "tested"}],
        "Ranges": [{"quantity": "density", "unit": "kg/m3"}],
    }
    path = tmp_path / "old.xlsx"
    path.write_bytes(render_workbook(lines))
    made = rewrite(read_cells(path), "en")
    (row,), (net,) = made.tables["rows"], made.tables["net_types"]
    assert row["net_type"] == net["id"]
    assert made.measures["rows", "snow"] == "normal"
    (anchor,) = made.tables["anchor_types"]
    assert (anchor["pull_out"], anchor["proven"]) == (320.0, "tests")
    assert re.fullmatch(r"D_K 3", net["id"])
