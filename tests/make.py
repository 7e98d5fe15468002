"""Sites as an office types them: tables of the input workbook by key, soon written.

A table is a list of lines, a line a mapping by the keys of `site/columns/office.toml`,
in the units that its template shows; words are its English ones, a pair is a range.
The workbook has every column at the place of the template, without formats and notes.
"""

import tomllib
from pathlib import Path

import xlsxwriter
from pandas import DataFrame
from xlsxwriter.utility import xl_col_to_name

from netdesign.site.columns.all_tables import MONITORING, UNCERTAINTY, WINTER
from netdesign.site.columns.office import (
    PARTS,
    PROJECT_HEADS,
    TABLES,
    load_columns,
    load_plan,
    load_text,
    name_measure,
)
from netdesign.site.reader import read_frames
from netdesign.words.catalogue import render

MEASURES = {
    ("rows", "snow"): "normal",
    ("net_types", "slack"): "slack",
    ("layers", "thickness"): "normal",
}
VERTICAL = {("rows", "snow"): "vertical"}
_HERE = Path(__file__).parent
_HEADINGS, _BELOW = 2, 3  # row of a sheet's headings, from 0; rows down to its lines
_OF_ADDONS = (MONITORING, WINTER, UNCERTAINTY)


def load_tables(name):
    """Tables of a file beside this module, as new each time."""
    kept = tomllib.loads((_HERE / f"{name}.toml").read_text(encoding="utf-8"))
    tables = {"project": [kept.pop("project")]}
    for table, one in kept.items():
        lines = (zip(one["columns"], line, strict=True) for line in one["lines"])
        tables[table] = [
            {key: value for key, value in line if value != ""} for line in lines
        ]
    return tables


def draw_untidy(draw):
    """Tables of three rows whose decimal numbers are varied; snow is vertical."""

    def vary(cell):
        if isinstance(cell, list):
            return tuple(map(vary, cell))
        is_drawn = isinstance(cell, float)
        return float(f"{cell * draw.uniform(0.97, 1.03):.3g}") if is_drawn else cell

    return {
        table: [{key: vary(cell) for key, cell in line.items()} for line in lines]
        for table, lines in load_tables("untidy").items()
    }


def write_tiny(path, edit=None):
    """Workbook of one row that is soon solved; ``edit`` may change its tables."""
    tables = load_tables("tiny")
    if edit:
        edit(tables)
    return write_site(path, tables)


def load_rows(rows=(), *, leans=True, cells=None):
    """Tables of some of the seven rows, each with a net type of its own.

    A net that does not lean over a range keeps to its least inclination. ``cells`` are
    those of a row or of its net type that differ, by row and column.
    """
    tables = load_tables("seven_rows")
    kept = rows or [line["id"] for line in tables["rows"]]
    for table, key in (("rows", "id"), ("declared", "row")):
        tables[table] = [line for line in tables[table] if line[key] in kept]
    nets = {line["id"]: line for line in tables["net_types"]}
    of_rows = {one.field.key for one in load_columns("rows")}
    for line in tables["rows"]:
        for key, value in (cells or {}).get(line["id"], {}).items():
            (line if key in of_rows else nets[line["net_type"]])[key] = value
    if not leans:
        tables["project"][0]["inclination"] = 25
    return tables


def write_rows(path, rows=(), *, leans=False, cells=None):
    """Workbook of some of the seven rows; of one inclination they are soon solved."""
    return write_site(path, load_rows(rows, leans=leans, cells=cells))


def write_site(path, tables, language="en", measures=None):
    """Workbook of these tables; returns its path.

    ``measures`` has what a unit cell says that it measures, by table and key.
    """
    return write_sheets(path, lay_out(tables, language, measures))


def read_tables(tables, measures=None):
    """Site of these tables, without a file in between: a third of the time."""
    said, frames = MEASURES | (measures or {}), {}
    for table, lines in tables.items():
        if not lines:
            continue
        columns = {one.field.key: one for one in load_columns(table)}
        headings = {key: key for key in columns}
        for key in (one for one in columns if columns[one].choice):
            field, choice = columns[key].field, columns[key].choice
            measure = name_measure(choice, said[table, key], "en")
            headings[key] = f"{field.label} [{measure}]"
        frames[table] = DataFrame(
            [
                {headings[k]: _say(columns[k].field, x, "en") for k, x in one.items()}
                for one in lines
            ],
            dtype=object,
        )
    return read_frames(frames)


def write_sheets(path, sheets):
    """Workbook of sheets by name, each a list of lines."""
    book = xlsxwriter.Workbook(str(path), {"in_memory": True})
    for name, lines in sheets.items():
        sheet = book.add_worksheet(name)
        for row, line in enumerate(lines):
            for column, value in enumerate(line):
                if isinstance(value, str) and value:
                    sheet.write_string(row, column, value)
                elif value is not None and value != "":
                    sheet.write_number(row, column, value)
    book.close()
    return path


def lay_out(tables, language="en", measures=None):
    """Cells of these tables by sheet, each a list of lines."""
    said = MEASURES | (measures or {})
    sheets = {}
    for table in (one for one in TABLES if one not in PARTS):
        lines = tables.get(table, [])
        sheets[load_plan(table).name_in(language)] = [[]] * _HEADINGS + (
            _lay_out_project(lines, language)
            if table == "project"
            else _lay_out_block(table, lines, language, said)
        )
    parts = [[], []]
    for table in PARTS:
        parts.append([f"block of {table}"])
        parts += _lay_out_block(table, tables.get(table, []), language, said)
        parts.append([])
    sheets[load_plan(PARTS[0]).name_in(language)] = parts
    for plan in (one for one in _OF_ADDONS if one.name in tables):
        fields = plan.fields
        sheets[plan.name] = [
            [name_heading(one, language) for one in fields],
            *_say_lines(fields, tables[plan.name], language),
        ]
    return sheets


def find_cell(table, key, line=0, language="en", tables=None):
    """Cell of a value, as ``Rows!B6``; of sheet Parts it hangs on the ``tables``."""
    number = [one.field.key for one in load_columns(table)].index(key)
    name = load_plan(table).name_in(language)
    if table == "project":
        return f"{name}!B{_HEADINGS + 2 + number}"
    start = _HEADINGS
    if table in PARTS:
        before = PARTS[: PARTS.index(table)]
        start += 1 + sum(
            _BELOW + 2 + len((tables or {}).get(one, ())) for one in before
        )
    return f"{name}!{xl_col_to_name(number)}{start + _BELOW + line + 1}"


def name_heading(field, language):
    """Name of a column in a language, with its unit in brackets."""
    label = field.label_in(language)
    return f"{label} [{field.unit}]" if field.unit else label


def _lay_out_project(lines, language):
    heads = {one.key: one.label_in(language) for one in load_plan("project").fields}
    columns = load_columns("project")
    (values,) = _say_lines([one.field for one in columns], lines or [{}], language)
    return [
        [heads[key] for key in PROJECT_HEADS],
        *(
            [one.field.label_in(language), value, one.unit if one.field.units else ""]
            for one, value in zip(columns, values, strict=True)
        ),
    ]


def _lay_out_block(table, lines, language, measures):
    """Headings, units, what is assumed, and lines."""
    columns = load_columns(table)
    units = [
        name_measure(one.choice, measures[table, one.field.key], language)
        if one.choice
        else one.unit
        if one.field.units
        else ""
        for one in columns
    ]
    return [
        [one.field.label_in(language) for one in columns],
        [load_text("unit", language), *units[1:]],
        [load_text("empty", language)],
        *_say_lines([one.field for one in columns], lines, language),
    ]


def _say_lines(fields, lines, language):
    return [
        [_say(one, line.get(one.key), language) for one in fields] for line in lines
    ]


def _say(field, value, language):
    """Value as a user of that language types it."""
    if isinstance(value, tuple):
        mark, to = load_text("comma", language), load_text("to", language)
        return f" {to} ".join(f"{end:.15g}".replace(".", mark) for end in value)
    if isinstance(value, str) and value in field.words:
        return render(field.name_word(value), language)
    return value
