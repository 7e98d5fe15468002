"""The table of USAGE.md on empty cells: every optional column, and what it promises."""

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.columns.all_tables import PROJECT_ITEMS, SHEETS
from netdesign.site.columns.office import TABLES, load_columns
from netdesign.site.reader import read_site
from netdesign.site.template.empty import say_empty
from tests.each import each
from tests.site.columns.empty_cells import (
    USAGE,
    build_table,
    find_table,
    list_columns,
)
from tests.site_lines import write_lines
from tests.study.knowing_less.drawn_site import draw_lines, empty


def test_the_table_says_what_the_columns_say():
    assert find_table(USAGE.read_text(encoding="utf-8")) == build_table()


@each("plan", SHEETS)
def test_every_optional_column_says_what_is_assumed(plan):
    offered = [one for one in plan.fields if one.is_offered]
    optional = [one for one in offered if not one.required or one.instead]
    items = PROJECT_ITEMS if plan.items[:1] == PROJECT_ITEMS[:1] else plan.items
    assert list_columns(plan) == [*optional, *items]


@each("table", TABLES)
def test_the_template_says_of_each_column_what_an_empty_cell_means(table):
    for column in load_columns(table):
        assert bool(say_empty(column, "en")) != column.field.required, column.field.key


def test_every_statement_says_what_is_empty_and_why():
    for plan in SHEETS:
        for one in list_columns(plan):
            assert len(one.empty["means"]) > 3 < len(one.empty["why"]), one.key


def list_of(meaning):
    return [
        (plan.name, one.key)
        for plan in SHEETS
        for one in plan.fields
        if one.empty and one.empty["means"].startswith(meaning)
    ]


_NAMED = {"post_base_distance": "post_tilt"}  # what is assumed of it


def is_in_use(lines, sheet, key):
    return sheet in lines and any(key in line for line in lines[sheet])


@pytest.mark.parametrize(("sheet", "key"), list_of("assumed range"))
def test_an_empty_column_that_forces_need_is_a_range(tmp_path, sheet, key):
    seen = 0
    for seed in range(40):
        lines = draw_lines(seed)
        if not is_in_use(lines, sheet, key):
            continue
        seen += 1
        cells = [(sheet, number, key) for number in range(len(lines[sheet]))]
        write_lines(tmp_path / "site.xlsx", empty(lines, cells))
        for row in read_site(tmp_path / "site.xlsx").rows:
            found = row.find_assumed(_NAMED.get(key, key))
            assert found is not None
            assert found.low < found.high
        if seen == 2:
            return
    pytest.fail("no drawn site gives this column")


@pytest.mark.parametrize(("sheet", "key"), list_of("worst of what is built"))
def test_a_panel_of_which_something_is_empty_is_assumed(tmp_path, sheet, key):
    lines = next(
        one for one in map(draw_lines, range(40)) if is_in_use(one, sheet, key)
        and one["Nets"][0].get("panel_system") == "rectangular"
    )  # fmt: skip
    write_lines(tmp_path / "whole.xlsx", lines)
    write_lines(tmp_path / "less.xlsx", empty(lines, [(sheet, 0, key)]))
    whole, less = (
        read_site(tmp_path / name).rows[0] for name in ("whole.xlsx", "less.xlsx")
    )
    name = f"column.{sheet}.{key}"
    assert name not in [one.key for one in whole.panel_assumed]
    assert name in [one.key for one in less.panel_assumed]
    assert len(less.panels) > 1 or key == "panel_system" or less.panels == whole.panels


def test_what_is_refused_beside_a_statement_is_refused(tmp_path):
    lines = next(
        one for one in map(draw_lines, range(60))
        if one["Nets"][0]["snow_layers"] == "layered with temperatures"
    )  # fmt: skip
    cells = [("Snow", number, "temperature") for number in range(len(lines["Snow"]))]
    write_lines(tmp_path / "site.xlsx", empty(lines, cells))
    with pytest.raises(SiteDataError):
        read_site(tmp_path / "site.xlsx")
