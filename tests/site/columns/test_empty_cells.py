"""The table of USAGE.md on empty cells: every optional column, and what it promises."""

import pytest

from netdesign.site.columns.office import TABLES, load_columns
from netdesign.site.reader import read_site
from netdesign.site.template.form import say_empty
from tests.each import each
from tests.make import write_site
from tests.site.columns.empty_cells import USAGE, build_table, find_table
from tests.site.office.drawn import draw_tables


def test_the_table_says_what_the_columns_say():
    assert find_table(USAGE.read_text(encoding="utf-8")) == build_table()


@each("table", TABLES)
def test_the_template_says_of_each_column_what_an_empty_cell_means(table):
    for column in load_columns(table):
        assert bool(say_empty(column, "en")) != column.field.required, column.field.key


def read_rows(path, tables):
    write_site(path, tables)
    return read_site(path).rows


RANGES = (
    *(("net_types", key) for key in ("slack", "post_tilt", "guy_splay")),
    ("net_types", "net_stiffness"),
    *(("net_types", f"{side}_anchor_distance") for side in ("uphill", "downhill")),
    *(("net_types", f"{side}_sag") for side in ("ridge", "lower")),
    ("rows", "glide_factor"),
)


@each("seed", range(3))
@pytest.mark.parametrize(("table", "key"), RANGES)
def test_an_empty_column_that_forces_need_is_a_range(tmp_path, table, key, seed):
    tables = draw_tables(seed)
    for line in tables[table]:
        del line[key]
    for row in read_rows(tmp_path / "site.xlsx", tables):
        found = row.find_assumed(key)
        assert found is not None
        assert found.low < found.high


PANEL = ("ridge_rope", "lower_rope", "ridge_sag", "lower_sag", "mid_anchors")


@each("key", PANEL)
def test_a_panel_of_which_something_is_empty_is_assumed(tmp_path, key):
    tables = draw_tables(4)
    for net in tables["net_types"]:
        net["mid_anchors"] = "yes"
    for rope in tables["ropes"]:
        rope["axial_stiffness"] = 17300
    whole = read_rows(tmp_path / "whole.xlsx", tables)[0]
    for net in tables["net_types"]:
        del net[key]
    less = read_rows(tmp_path / "less.xlsx", tables)[0]
    assert whole.find_assumed(key) is None
    assert (less.find_assumed(key) is None) == (key in ("ridge_rope", "lower_rope"))
    assert len(less.panels) > len(whole.panels) or key == "mid_anchors"
