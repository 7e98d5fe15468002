"""Joins sheets of a list to those of the input workbook; cells keep their places."""

from __future__ import annotations

from collections.abc import Collection, Hashable, Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.site.cells.cells import Cell, Sheet, Workbook, name_column
from netdesign.site.cells.findings import Finding, quote
from netdesign.site.columns.fields import (
    KNOWN_UNITS,
    Field,
    normalise,
    split_heading,
)
from netdesign.site.columns.office import load_columns, load_plan
from netdesign.site.lists.list_map import ListMap, ListTable
from netdesign.site.lists.targets import GROUPS, Target, list_targets, read_answer
from netdesign.site.titles import (
    find_heading_unit,
    is_unit,
    name_net_type,
    read_unit,
)
from netdesign.words.message import say

_ANCHORS = ("foot_anchor", "uphill_anchor", "downhill_anchor", "end_anchor")

# Columns of a built sheet by number: heading, and cells by line of the list.
Columns = dict[int, tuple[str, Mapping[int, Cell]]]


@dataclass(frozen=True, slots=True, kw_only=True)
class MappedSheet:
    """A sheet of a list whose headings are answered.

    Attributes
    ----------
    sheet : Sheet
        As read.
    table : ListTable
        What becomes of it.
    columns : mapping of int to tuple of Target and str
        What its columns become, with the unit of their numbers.
    lines : tuple of int
        Rows below the headings, and below their units, that hold something.
    file : str
        Of the answers.
    """

    sheet: Sheet
    table: ListTable
    columns: Mapping[int, tuple[Target, str]]
    lines: tuple[int, ...]
    file: str

    def find(self, table: str, key: str) -> int | None:
        """Number of the column that becomes a column of the input workbook."""
        place = (table, key)
        columns = self.columns.items()
        return next((n for n, (target, _) in columns if target.place == place), None)

    def cells(self, number: int) -> dict[int, Cell]:
        """Cells of a column by line."""
        return {line: self.sheet.cell(line, number) for line in self.lines}


def join_list(
    workbook: Workbook, answers: ListMap, findings: list[Finding]
) -> Workbook:
    """Build the input workbook from an office's list.

    Every cell keeps its place in the list. Rows whose net is the same by all its
    columns share a net type. Anchor types that only the rows name get a line each.

    Parameters
    ----------
    workbook : Workbook
        Every sheet of the list.
    answers : ListMap
        Answers to all headings of the list.
    findings : list of Finding
        Appended to: answers that do not fit the list.
    """
    sheets = {sheet.name: sheet for sheet in workbook.sheets}
    mapped: list[MappedSheet] = []
    for name, table in answers.tables.items():
        if name not in sheets:
            rule = say("map.sheet_absent")
            findings.append(Finding(file=answers.file, sheet=name, rule=rule))
        elif table.becomes:
            mapped.append(map_sheet(sheets[name], table, answers.file, findings))
    built = [
        _make_sheet(source, table)
        for source in mapped
        for table in GROUPS[source.table.becomes]
    ]
    if not any(source.table.becomes == "anchor_types" for source in mapped):
        built += map(_name_anchors, mapped)
    read = {source.sheet.name for source in mapped}
    return replace(
        workbook,
        sheets=tuple(filter(None, built)),
        unread=tuple(name for name in sheets if name not in read),
    )


def map_sheet(
    sheet: Sheet, table: ListTable, file: str, findings: list[Finding]
) -> MappedSheet:
    """Columns of a sheet by its answers; a heading without an answer is a finding."""
    units = find_units(sheet, table.headings_in_line)
    asked = {normalise(heading): heading for heading in table.headings}
    columns: dict[int, tuple[Target, str]] = {}
    for name, cell in name_headings(sheet, table.headings_in_line):
        own = split_heading(str(cell.value))[0]
        heading = asked.get(normalise(name)) or asked.get(own)
        if heading is None:
            rule = say("list_map.new_heading", file=file)
            findings.append(cell.finding(rule, say("list_map.again")))
            continue
        asked = {key: other for key, other in asked.items() if other != heading}
        answer = read_answer(table.headings[heading], table.becomes)
        if answer.target is None:
            continue
        unit = find_list_unit(cell, units)
        if answer.target.measure and unit and answer.unit not in ("", unit):
            rule = say("list_map.other_unit", unit=unit, other=answer.unit)
            findings.append(cell.finding(rule, say("list_map.one_unit")))
        columns[cell.column] = answer.target, answer.unit or unit
    for heading in asked.values():
        rule = say("list_map.no_heading", heading=quote(heading))
        findings.append(sheet.finding(rule, say("list_map.again")))
    lines = list_below(sheet, table.headings_in_line)[1 if units else 0 :]
    return MappedSheet(
        sheet=sheet, table=table, columns=columns, lines=tuple(lines), file=file
    )


def name_headings(sheet: Sheet, line: int) -> list[tuple[str, Cell]]:
    """Headings as a file of answers names them: with the column where two are equal."""
    cells = sheet.row(line)
    names = [" ".join(str(cell.value).split()) for cell in cells]
    return [
        (
            name if names.count(name) == 1 else f"{name_column(cell.column)}: {name}",
            cell,
        )
        for name, cell in zip(names, cells, strict=True)
    ]


def list_below(sheet: Sheet, line: int) -> list[int]:
    """Filled rows below the headings."""
    return [row for row in sorted(sheet.rows) if row > line and sheet.row(row)]


def find_list_unit(cell: Cell, units: Mapping[int, str]) -> str:
    """Unit that a list gives for a column; empty without a known unit."""
    unit = find_heading_unit(cell) or units.get(cell.column, "")
    return unit if unit in KNOWN_UNITS else ""


def find_units(sheet: Sheet, line: int) -> Mapping[int, str]:
    """Units by column, where the row below the headings holds units alone."""
    below = list_below(sheet, line)
    cells = sheet.row(below[0]) if below else ()
    plain = Field(key="", units=("-",))
    if not all(is_unit(cell, plain) for cell in cells):
        return {}
    return {cell.column: read_unit(cell)[0] for cell in cells}


def _make_sheet(mapped: MappedSheet, table: str) -> Sheet | None:
    """Sheet of the input workbook that a sheet of a list makes."""
    columns: Columns = {
        number: (target.heading(unit), mapped.cells(number))
        for number, (target, unit) in mapped.columns.items()
        if target.table == table
    }
    if table == "net_types" and mapped.table.becomes == "rows" and not columns:
        return None
    widths = [max(row, default=0) for row in mapped.sheet.rows.values()]
    last = max((*widths, *(cells.max_col for cells in mapped.sheet.merged)), default=0)
    for number, (name, text) in enumerate(mapped.table.always.items(), last + 1):
        target = read_answer(name, mapped.table.becomes).target
        if target is not None and target.table == table:
            cells = mapped.cells(number).items()
            filled = {line: replace(cell, value=text) for line, cell in cells}
            columns[number] = target.heading(target.field.unit), filled
    lines: Sequence[int] = mapped.lines
    if mapped.table.becomes == "rows":
        key = "net_type" if table == "rows" else "id"
        own = mapped.find(table, key)
        names = _name_nets(mapped)
        behind = last + len(mapped.table.always) + 1
        columns[own or behind] = _name_column(table, key), names
        lines = lines if table == "rows" else _list_different(columns, names)
    return _build(mapped, table, columns, lines)


def _name_column(table: str, key: str) -> str:
    fields = load_plan(table).fields
    return next(field.label_in("en") for field in fields if field.key == key)


def _build(
    mapped: MappedSheet, table: str, columns: Columns, lines: Collection[int]
) -> Sheet:
    """Sheet with headings of the input workbook, in the list's line."""
    head = mapped.table.headings_in_line
    headings = {
        number: replace(mapped.sheet.cell(head, number), value=heading)
        for number, (heading, _) in columns.items()
    }
    below = {
        line: {n: cells[line] for n, (_, cells) in columns.items() if line in cells}
        for line in lines
    }
    return replace(
        mapped.sheet,
        name=load_plan(table).name_in("en"),
        rows={head: headings, **below},
        merged=tuple(cells for cells in mapped.sheet.merged if cells.min_row > head),
        words=mapped.table.words,
        answered_in=mapped.file,
    )


def _name_nets(mapped: MappedSheet) -> dict[int, Cell]:
    """Name of the net of each line: as typed, or made of the height of the net."""
    own, slope = (mapped.find("rows", key) for key in ("net_type", "slope_angle"))
    typed = mapped.cells(own) if own else {}
    names = {line: cell for line, cell in typed.items() if not cell.is_blank}
    height = mapped.find("net_types", "net_height")
    nets = [
        n for n, (target, _) in mapped.columns.items() if target.table == "net_types"
    ]
    named: dict[Hashable, str] = {}
    for line, cell in mapped.cells(height).items() if height else ():
        values = tuple(mapped.sheet.cell(line, n).text.strip() for n in nets)
        # a line of sums and an empty line have no net whose height could be missing
        is_sum = not slope or mapped.sheet.cell(line, slope).is_blank
        if line in names:
            continue
        if cell.is_blank and is_sum:
            names[line] = cell
            continue
        name = name_net_type(cell.text.strip(), values, named)
        names[line] = replace(cell, value=name, formula="")
    return names


def _list_different(columns: Columns, names: Mapping[int, Cell]) -> list[int]:
    """First line of each net, of the lines with equal cells of the net."""
    first: dict[tuple[str, ...], int] = {}
    for line in sorted(names):
        if not names[line].is_blank:
            cells = (cells[line] for _, cells in columns.values())
            first.setdefault(tuple(cell.text.strip() for cell in cells), line)
    return list(first.values())


def _name_anchors(mapped: MappedSheet) -> Sheet | None:
    """Sheet of the anchor types that the rows name; None where they name none."""
    numbers = [number for key in _ANCHORS if (number := mapped.find("rows", key))]
    cells = (mapped.sheet.cell(line, n) for line in mapped.lines for n in numbers)
    first: dict[str, Cell] = {}
    for cell in cells:
        if not cell.is_blank:
            first.setdefault(" ".join(cell.text.split()).casefold(), cell)
    if not first:
        return None
    columns: Columns = {
        number: (_name_column("anchor_types", key), {})
        for number, key in enumerate(("id", "kind", "ground"), 1)
    }
    sheet = _build(mapped, "anchor_types", columns, ())
    head = mapped.table.headings_in_line
    below = {n: {1: cell} for n, cell in enumerate(first.values(), head + 1)}
    return replace(sheet, rows={**sheet.rows, **below}, merged=())


def list_lacking(becomes: str, own: Collection[tuple[str, str]]) -> list[Target]:
    """Columns that the input workbook needs, and that a sheet lacks.

    Parameters
    ----------
    becomes : str
        Table that the sheet becomes.
    own : collection of tuple of str
        Table and key of the columns that it has.
    """
    needed = {
        (table, column.field.key)
        for table in GROUPS[becomes]
        for column in load_columns(table)
        if column.need == "yes"
    }
    if ("net_types", "net_height") in own:
        needed.discard(("rows", "net_type"))
    elif ("rows", "net_type") in own:
        needed.discard(("net_types", "net_height"))
    lacking = needed.difference(own)
    targets = {target.place: target for target in reversed(list_targets(becomes))}
    return [target for name, target in reversed(targets.items()) if name in lacking]
