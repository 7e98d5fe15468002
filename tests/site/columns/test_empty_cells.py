"""The table of USAGE.md on empty cells: every optional column, and what it promises."""

import re
from pathlib import Path

import pytest

from netdesign.errors import SiteDataError
from netdesign.site.columns.all_tables import SHEETS
from netdesign.site.reader import read_site
from tests.study.knowing_less.drawn_site import draw_lines, empty, write_lines

USAGE = Path(__file__).resolve().parents[3] / "netdesign" / "USAGE.md"
LINE = re.compile(r"^\| (\w+) \| (.+?) \| (.+?) \| (.+?) \|$", re.MULTILINE)


def read_table():
    """Columns by sheet, and what each cell of the table says of them."""
    text = USAGE.read_text(encoding="utf-8")
    start = text.index("| sheet | columns | left empty |")
    for sheet, columns, meaning, why in LINE.findall(text[start:]):
        if sheet != "sheet":
            yield sheet, re.split("[,;] ", columns), meaning, why


def list_optional(plan):
    names = [str(one.name) for one in plan.fields if not one.required or one.instead]
    return sorted([*names, *(str(one.name) for one in plan.items)])


@pytest.mark.parametrize("plan", SHEETS, ids=[plan.name for plan in SHEETS])
def test_every_optional_column_stands_in_the_table_once(plan):
    told = [
        name
        for sheet, names, *_ in read_table()
        if sheet == plan.name
        for name in names
    ]
    assert sorted(told) == list_optional(plan)


def test_every_line_says_what_is_empty_and_why():
    for sheet, names, meaning, why in read_table():
        assert len(meaning) > 3 < len(why), (sheet, names)


def find_key(sheet, name):
    plan = next(one for one in SHEETS if one.name == sheet)
    return next(one.key for one in plan.fields if str(one.name) == name)


def list_of(meaning):
    return [
        (sheet, find_key(sheet, name))
        for sheet, names, told, _ in read_table()
        if told.startswith(meaning) and sheet not in ("Ranges", "Project")
        for name in names
    ]


def is_in_use(lines, sheet, key):
    return sheet in lines and any(key in line for line in lines[sheet])


@pytest.mark.parametrize(("sheet", "key"), list_of("row not proven"))
def test_a_column_that_every_force_needs_leaves_the_row_open(tmp_path, sheet, key):
    seen = 0
    for seed in range(40):
        lines = draw_lines(seed)
        if not is_in_use(lines, sheet, key):
            continue
        seen += 1
        cells = [(sheet, number, key) for number in range(len(lines[sheet]))]
        write_lines(tmp_path / "site.xlsx", empty(lines, cells))
        for row in read_site(tmp_path / "site.xlsx").rows:
            assert row.unsaid
        if seen == 3:
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
        read_site(tmp_path / name).rows[0].panel for name in ("whole.xlsx", "less.xlsx")
    )
    name = f"column.{sheet}.{key}"
    assert name not in [one.key for one in whole.assumed]
    assert name in [one.key for one in less.assumed]
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
