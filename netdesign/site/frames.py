"""Tables of pandas as the input workbook, and values of net rows that are changed."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
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
from netdesign.site.model import ReplacedCell
from netdesign.site.office.sheets import OfficeTables
from netdesign.site.readings import Row, read_cell
from netdesign.words.message import Message, say

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


_Values = dict[tuple[str, str, str], object]  # by table, id and key


def change_values(
    tables: OfficeTables, change: Change, file: str, findings: list[Finding]
) -> tuple[OfficeTables, tuple[ReplacedCell, ...]]:
    """Tables with other values of some net rows: a what-if.

    Parameters
    ----------
    tables : OfficeTables
        As read.
    change : mapping of str to mapping of str to object
        Values by id of the net row and key of the column, in the column's unit. A
        column of the row's net type is changed for every row of that type.
    file : str
        Name of the workbook.
    findings : list of Finding
        Appended to: what is wrong with a value.

    Raises
    ------
    SiteDataError
        Of a row or a column that is not there, of two values for one cell, and of a
        net type that rows have which are not changed likewise.
    """
    lines, replaced = dict(tables.lines), list[ReplacedCell]()
    for (name, line_id, key), value in _place_values(lines, change, file).items():
        table = tables.tables[name]
        assert table is not None  # a line of it has this id
        blank = NamedCell(
            file=file,
            sheet=table.sheet.name,
            row=0,
            column=0,
            named=f"{line_id}, {key}",
        )
        changed = []
        for line in lines[name]:
            was = line[key].cell or blank
            now = was.retype(_read_plain(value))
            if line["id"].word == line_id and now.text != was.text:
                unit = table.find_unit(line[key].field)
                reading = read_cell(now, line[key].field, unit, findings)
                line = {**line, key: reading}
                entry = ReplacedCell(cell=now.place, was=was.text, now=now.text)
                replaced.append(entry)
            changed.append(line)
        lines[name] = changed
    return replace(tables, lines=lines), tuple(replaced)


def _place_values(
    lines: Mapping[str, Sequence[Row]], change: Change, file: str
) -> _Values:
    """Values by the table, the line and the column that they change."""
    rows = {line["id"].word: line for line in lines["rows"]}
    nets = {line["id"].word: line for line in lines["net_types"]}
    findings: list[Finding] = []
    values: _Values = {}

    def refuse(text: str, rule: Message, accepted: Message | str = "") -> None:
        findings.append(Finding(file=file, text=text, rule=rule, accepted=accepted))

    for name, of_row in change.items():
        if name not in rows:
            accepted = say("accepted.words", words=tuple(rows))
            refuse(name, say("frames.no_row"), accepted)
            continue
        net = rows[name]["net_type"].word
        for key, value in of_row.items():
            own, sharing = rows[name].get(key), list[str]()
            place = ("rows", name, key) if own else ("net_types", net, key)
            if net and (own is None or own.field.table == "net_types"):
                sharing = [
                    row_id
                    for row_id, line in rows.items()
                    if line["net_type"].word == net
                    and key not in change.get(row_id, {})
                ]
            if key == "id" or key not in {**rows[name], **nets.get(net, {})}:
                refuse(f"{name}: {key}", say("frames.no_column"))
            elif sharing or values.get(place, value) != value:
                rule = say("frames.shared", key=key, rows=tuple(sharing) or (name,))
                refuse(f"{name}: {key}", rule)
            values[place] = value
    if findings:
        raise SiteDataError(findings)
    return values
