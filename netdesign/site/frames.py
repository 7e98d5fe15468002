"""Tables of pandas as the input workbook, and values of net rows that are changed."""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date
from typing import Any

from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import Cell, Sheet, Workbook, group_by_row
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.fields import normalise
from netdesign.site.columns.office import (
    PARTS,
    TABLES,
    Column,
    list_measures,
    load_columns,
    load_plan,
    name_measure,
)
from netdesign.site.declared_sheet import put_values
from netdesign.site.model import ReplacedCell
from netdesign.site.office.sheets import find_office_tables
from netdesign.site.readings import Row
from netdesign.words.message import say

Frames = Mapping[str, Any]
Change = Mapping[str, Mapping[str, object]]
_FILE = "frames"


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedCell(Cell):
    """A value of a frame: its address names its line and its column."""

    named: str = ""

    @property
    def address(self) -> str:
        """``A1, post_spacing``."""
        return self.named


def build_workbook(frames: Frames) -> Workbook:
    """Input workbook of some frames.

    Parameters
    ----------
    frames : mapping of str to DataFrame
        By name of a sheet (``Rows``, ``Net types``, ``Anchors``, ``Project``, ...) or
        of a table of `office.toml`. Columns are keys of there, in the unit that the
        template shows, or headings with a unit of their own. Missing values are empty
        cells. Of ``Project`` a mapping of its keys to values will do.

    Raises
    ------
    SiteDataError
        If a name is that of no sheet.
    """
    by_table = {_find_name(name, frames): frame for name, frame in frames.items()}
    sheets: dict[str, list[Cell]] = {}
    for table in TABLES:
        if table not in by_table:
            continue
        title = load_plan(table).name_in("en")
        cells = sheets.setdefault(title, [])
        start = max((cell.row for cell in cells), default=-1) + 2
        lines = _list_lines(by_table[table])
        build = _list_items if table == "project" else _list_cells
        cells.extend(build(table, title, lines, start))
    content = repr(
        [
            (cell.sheet, cell.address, cell.value)
            for cells in sheets.values()
            for cell in cells
        ]
    )
    return Workbook(
        file=_FILE,
        sha256=hashlib.sha256(content.encode()).hexdigest(),
        sheets=tuple(
            Sheet(file=_FILE, name=title, rows=group_by_row(cells))
            for title, cells in sheets.items()
        ),
        unread=(),
    )


def _find_name(name: str, frames: Frames) -> str:
    """Table of a frame by its own name, or by that of its sheet."""
    for table in TABLES:
        is_sheet = table not in PARTS and load_plan(table).matches(name)
        if is_sheet or normalise(name) == normalise(table):
            return table
    names = dict.fromkeys(
        table if table in PARTS else load_plan(table).name_in("en") for table in TABLES
    )
    accepted = say("accepted.words", words=tuple(names))
    rule = say("frames.no_sheet", given=tuple(frames))
    raise SiteDataError([Finding(file=_FILE, sheet=name, rule=rule, accepted=accepted)])


def _list_lines(frame: Any) -> list[Mapping[str, object]]:
    """Lines of a frame, or the only line of a mapping."""
    lines = frame.to_dict("records") if hasattr(frame, "to_dict") else [frame]
    return [
        {
            str(key): plain
            for key, value in line.items()
            if (plain := _read_plain(value)) != ""
        }
        for line in lines
    ]


def _read_plain(value: Any) -> object:
    """Value as a workbook holds it; "" of a missing value."""
    if value is None or value != value or str(value) in ("<NA>", "NaT"):
        return ""
    if isinstance(value, date):
        return value.isoformat()[:10]
    return value.item() if hasattr(value, "item") else value


def _list_cells(
    table: str, title: str, lines: Sequence[Mapping[str, object]], start: int
) -> Iterator[Cell]:
    """Headings, and the lines below them."""
    columns = {column.field.key: column for column in load_columns(table)}
    keys = list(dict.fromkeys(key for line in lines for key in line))
    first = load_columns(table)[0].field.key
    for number, key in enumerate(keys, 1):
        heading = _write_heading(columns[key]) if key in columns else key
        yield _build_cell(title, (start, number), heading, key)
        for row, line in enumerate(lines, start + 1):
            name = line.get(first, f"{row - start}")
            yield _build_cell(title, (row, number), line.get(key), f"{name}, {key}")


def _write_heading(column: Column) -> str:
    """Name of a column with the unit that the template shows."""
    unit = column.unit if column.field.units else ""
    if column.choice:
        unit = name_measure(column.choice, list_measures(column.choice)[0], "en")
    return f"{column.field.label} [{unit}]" if unit else column.field.label


def _list_items(
    table: str, title: str, lines: Sequence[Mapping[str, object]], start: int
) -> Iterator[Cell]:
    """Items of sheet Project, one below the other."""
    heads = {field.key: field.label for field in load_plan(table).fields}
    labels = {field.key: field.label for field in load_plan(table).items}
    for number, key in enumerate(("item", "value"), 1):
        yield _build_cell(title, (start, number), heads[key], heads[key])
    items = [pair for line in lines for pair in line.items()]
    for row, (key, value) in enumerate(items, start + 1):
        yield _build_cell(title, (row, 1), labels.get(key, key), key)
        yield _build_cell(title, (row, 2), value, key)


def _build_cell(sheet: str, place: tuple[int, int], value: object, named: str) -> Cell:
    row, column = place
    return NamedCell(
        file=_FILE, sheet=sheet, row=row, column=column, value=value, named=named
    )


def change_values(
    workbook: Workbook, change: Change, *, is_list: bool = False
) -> tuple[Workbook, tuple[ReplacedCell, ...]]:
    """Workbook with other values of some net rows: a what-if.

    Parameters
    ----------
    workbook : Workbook
        As read.
    change : mapping of str to mapping of str to object
        Values by id of the net row and key of the column, in the column's unit. A
        column of the row's net type is changed for every row of that type.
    is_list : bool
        The workbook is what an office's list makes: its sheets have the names of the
        template and cells of the list. They get the columns that the list has not.

    Raises
    ------
    SiteDataError
        Of a row or a column that is not there, of two values for one cell, and of a
        net type that rows have which are not changed likewise.
    """
    if not change:
        return workbook, ()
    if is_list:
        keys = {key for values in change.values() for key in values}
        sheets = tuple(_add_columns(sheet, keys) for sheet in workbook.sheets)
        workbook = replace(workbook, sheets=sheets)
    lines, nets = _read_lines(workbook)
    findings: list[Finding] = []
    by_place: dict[str, tuple[Cell, object, str]] = {}
    for name, values in change.items():
        if name not in lines:
            fault = workbook.finding(say("frames.no_row"))
            accepted = say("accepted.words", words=tuple(lines))
            findings.append(replace(fault, text=name, accepted=accepted))
            continue
        for key, value in values.items():
            table, cell = _find_cell(lines[name], nets, key)
            if cell is None:
                fault = workbook.finding(say("frames.no_column"))
                findings.append(replace(fault, text=f"{name}: {key}"))
                continue
            sharing = tuple(
                row_id
                for row_id, line in lines.items()
                if key not in change.get(row_id, {})
                and (shared := _find_cell(line, nets, key)[1])
                and shared.place == cell.place
            )
            sheet = load_plan(table).name_in("en") if is_list else cell.sheet
            if sharing or by_place.get(cell.place, (cell, value))[1] != value:
                rule = say("frames.shared", key=key, rows=sharing or (name,))
                findings.append(cell.finding(rule))
            by_place[cell.place] = (cell, value, sheet)
    if findings:
        raise SiteDataError(findings)
    changed = (
        (sheet, cell, _read_plain(value)) for cell, value, sheet in by_place.values()
    )
    return put_values(workbook, changed)


def _add_columns(sheet: Sheet, keys: Collection[str]) -> Sheet:
    """Sheet of rows or net types with the columns of some keys, empty if not there."""
    table = next(
        (name for name in _CHANGED if load_plan(name).name_in("en") == sheet.name), ""
    )
    head = min(sheet.rows)
    headings = {normalise(cell.text.partition("[")[0]) for cell in sheet.row(head)}
    rows, number = dict(sheet.rows), max(map(max, sheet.rows.values()))
    for column in load_columns(table) if table else ():
        if column.field.key in keys and column.field.names.isdisjoint(headings):
            number += 1
            heading = _build_cell(
                sheet.name, (head, number), _write_heading(column), sheet.name
            )
            rows[head] = {**rows[head], number: replace(heading, file=sheet.file)}
    return replace(sheet, rows=rows)


_CHANGED = ("rows", "net_types")


def _read_lines(workbook: Workbook) -> tuple[dict[str, Row], dict[str, Row]]:
    """Lines of the net rows and of the net types, by their ids."""
    unused: list[Finding] = []
    tables = find_office_tables(workbook, unused).lines
    return (
        {line["id"].word: line for line in tables["rows"]},
        {line["id"].word: line for line in tables["net_types"]},
    )


def _find_cell(line: Row, nets: Mapping[str, Row], key: str) -> tuple[str, Cell | None]:
    """Cell of a net row, or of its net type, with its table; None without a column."""
    table, reading = "rows", line.get(key)
    if reading is None and "net_type" in line:
        table, reading = "net_types", nets.get(line["net_type"].word, {}).get(key)
    return table, reading.cell if reading and key != "id" else None
