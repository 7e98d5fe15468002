"""From sheets of a list to those of the input workbook; each cell keeps its place."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

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
from netdesign.site.titles import find_heading_unit, is_unit, read_unit
from netdesign.words.message import say

_ANCHORS = ("foot_anchor", "uphill_anchor", "downhill_anchor", "end_anchor")
_SLOPE = ("rows", "slope_angle")
_COLUMN = re.compile(r"([A-Z]{1,3}): (.*)", re.DOTALL)  # of an answer
_LETTERS = "abcdefghijklmnopqrstuvwxyz"


@dataclass(frozen=True, slots=True, kw_only=True)
class MappedColumn:
    """A column of a list and the one that it becomes, with the unit of its numbers."""

    number: int
    target: Target
    unit: str


@dataclass(frozen=True, slots=True, kw_only=True)
class MappedSheet:
    """A sheet of a list whose headings are answered.

    Attributes
    ----------
    sheet : Sheet
        As read.
    table : ListTable
        What becomes of it.
    columns : tuple of MappedColumn
        Those that are read.
    lines : tuple of int
        Rows below the headings, and below their units, that hold something.
    file : str
        Of the answers.
    """

    sheet: Sheet
    table: ListTable
    columns: tuple[MappedColumn, ...]
    lines: tuple[int, ...]
    file: str

    def find(self, table: str, key: str) -> MappedColumn | None:
        """Column that becomes one of a sheet."""
        names = (table, key)
        return next(
            (x for x in self.columns if (x.target.table, x.target.key) == names), None
        )


def join_list(workbook: Workbook, found: ListMap, findings: list[Finding]) -> Workbook:
    """Input workbook that an office's list makes.

    Every cell keeps its place in the list. Rows whose net is the same by all its
    columns share a net type; anchor types that nothing is said of have a line each.

    Parameters
    ----------
    workbook : Workbook
        Every sheet of the list.
    found : ListMap
        Answers to it, none of them missing.
    findings : list of Finding
        Appended to: what of the answers does not fit.
    """
    by_name = {one.name: one for one in workbook.sheets}
    mapped: list[MappedSheet] = []
    for table in found.tables:
        sheet = by_name.get(table.name)
        if sheet is None:
            told = say("map.sheet_absent")
            findings.append(
                Finding(file=found.answers.file, sheet=table.name, rule=told)
            )
        elif table.becomes:
            mapped.append(map_sheet(sheet, table, found, findings))
    sheets = [made for one in mapped for made in _make_sheets(one)]
    if not any(one.table.becomes == "anchor_types" for one in mapped):
        named = map(_name_anchors, mapped)
        sheets += [one for one in named if one is not None]
    return replace(
        workbook,
        sheets=tuple(sheets),
        unread=tuple(
            one for one in by_name if one not in {x.table.name for x in mapped}
        ),
        answers=found.answers,
    )


def map_sheet(
    sheet: Sheet, table: ListTable, found: ListMap, findings: list[Finding]
) -> MappedSheet:
    """Columns of a sheet by the answers; a heading without one is a finding."""
    cells = sheet.row(table.line)
    units = find_units(sheet, table)
    columns = []
    seen: set[str] = set()
    for cell in cells:
        key = next((one for one in table.headings if _is_asked(cell, one)), None)
        if key is None:
            rule = say("list_map.new_heading", file=found.answers.file)
            findings.append(cell.finding(rule, say("list_map.again")))
            continue
        seen.add(key)
        answer = read_answer(table.headings[key], table.becomes)
        if answer.target is None:
            continue
        own = find_list_unit(cell, units)
        unit = answer.unit or own
        if answer.target.measure and own and answer.unit and own != answer.unit:
            rule = say("list_map.other_unit", unit=own, other=answer.unit)
            findings.append(cell.finding(rule, say("list_map.one_unit")))
        columns.append(
            MappedColumn(number=cell.column, target=answer.target, unit=unit)
        )
    for key in table.headings.keys() - seen:
        rule = say("list_map.no_heading", heading=quote(key))
        findings.append(sheet.finding(rule, say("list_map.again")))
    lines = [row for row in sorted(sheet.rows) if row > table.line and sheet.row(row)]
    if units and lines:
        lines = lines[1:]
    return MappedSheet(
        sheet=sheet,
        table=table,
        columns=tuple(columns),
        lines=tuple(lines),
        file=found.answers.file,
    )


def name_asked(cell: Cell) -> str:
    """Heading as a file of answers names it."""
    return " ".join(str(cell.value).split())


def _is_asked(cell: Cell, key: str) -> bool:
    """A key of the answers names this heading."""
    in_column = _COLUMN.fullmatch(key)
    if in_column and in_column[1] != name_column(cell.column):
        return False
    asked = normalise(in_column[2] if in_column else key)
    text = str(cell.value)
    names = {normalise(one) for one in (text, text.partition("[")[0])}
    return asked in names | {split_heading(text)[0]}


def find_list_unit(cell: Cell, units: Mapping[int, str]) -> str:
    """Unit that a list says of a column; empty where it says none that is known."""
    unit = find_heading_unit(cell) or units.get(cell.column, "")
    return unit if unit in KNOWN_UNITS else ""


def find_units(sheet: Sheet, table: ListTable) -> Mapping[int, str]:
    """Units by column, where the row below the headings has them and nothing else."""
    number = next(
        (row for row in sorted(sheet.rows) if row > table.line and sheet.row(row)), None
    )
    cells = sheet.row(number) if number is not None else ()
    plain = Field(key="", units=("-",))
    if not cells or not all(is_unit(one, plain) for one in cells):
        return {}
    return {one.column: read_unit(one)[0] for one in cells}


def _make_sheets(mapped: MappedSheet) -> Iterator[Sheet]:
    """Sheets of the input workbook that a sheet of a list makes."""
    names = _name_nets(mapped) if mapped.table.becomes == "rows" else {}
    for table in GROUPS[mapped.table.becomes]:
        columns = [one for one in mapped.columns if one.target.table == table]
        rows = _begin(mapped, table, columns)
        for line in mapped.lines:
            cells = {one.number: mapped.sheet.cell(line, one.number) for one in columns}
            rows[line] = {**cells, **_say_always(mapped, table, line)}
        if table == "net_types" and mapped.table.becomes == "rows":
            if not columns:
                continue
            rows = _keep_nets(rows, names, mapped)
        elif table == "rows":
            _name_in_rows(rows, names, mapped)
        yield replace(
            mapped.sheet,
            name=load_plan(table).name_in("en"),
            rows=rows,
            merged=tuple(x for x in mapped.sheet.merged if x.row > mapped.table.line),
            words=mapped.table.words,
            answered_in=mapped.file,
        )


def _begin(
    mapped: MappedSheet, table: str, columns: Sequence[MappedColumn]
) -> dict[int, dict[int, Cell]]:
    """Headings of a sheet, in the line and the columns of the list's."""
    line = mapped.table.line
    cells = {
        one.number: replace(
            mapped.sheet.cell(line, one.number), value=one.target.heading(one.unit)
        )
        for one in columns
    }
    blank = partial(Cell, file=mapped.sheet.file, sheet=mapped.sheet.name, row=line)
    for number, target, _ in _list_always(mapped, table):
        cells[number] = blank(column=number, value=target.heading(target.field.unit))
    return {line: cells}


def _list_always(mapped: MappedSheet, table: str) -> Iterator[tuple[int, Target, str]]:
    """Columns with one text in every line, behind those of the list."""
    number = _find_width(mapped.sheet)
    for name, text in mapped.table.always.items():
        number += 1
        target = read_answer(name, mapped.table.becomes).target
        if target is not None and target.table == table:
            yield number, target, text


def _say_always(mapped: MappedSheet, table: str, line: int) -> dict[int, Cell]:
    return {
        number: Cell(
            file=mapped.sheet.file,
            sheet=mapped.sheet.name,
            row=line,
            column=number,
            value=text,
        )
        for number, _, text in _list_always(mapped, table)
    }


def _find_width(sheet: Sheet) -> int:
    return max((max(row, default=0) for row in sheet.rows.values()), default=0)


def _name_nets(mapped: MappedSheet) -> dict[int, Cell]:
    """Name of the net of each line: as typed, or made of what is said of the net."""
    own = mapped.find("rows", "net_type")
    nets = [one for one in mapped.columns if one.target.table == "net_types"]
    height, slope = mapped.find("net_types", "net_height"), mapped.find(*_SLOPE)
    named: dict[tuple[str, ...], str] = {}
    names: dict[int, Cell] = {}
    for line in mapped.lines:
        typed = mapped.sheet.cell(line, own.number) if own else None
        if typed is not None and not typed.is_blank:
            names[line] = typed
        elif height is not None:
            cell = mapped.sheet.cell(line, height.number)
            values = tuple(mapped.sheet.cell(line, x.number).text.strip() for x in nets)
            # neither a line of sums nor an empty one has a net whose height is missing
            if cell.is_blank and (not slope or _is_blank(mapped, line, slope)):
                names[line] = cell
                continue
            if values not in named:
                stem = f"D_K {cell.text.strip()}"
                count = sum(one.startswith(stem) for one in named.values())
                named[values] = f"{stem} {_LETTERS[count]}" if count else stem
            names[line] = replace(cell, value=named[values], formula="")
    return names


def _is_blank(mapped: MappedSheet, line: int, column: MappedColumn) -> bool:
    return mapped.sheet.cell(line, column.number).is_blank


def _name_in_rows(
    rows: dict[int, dict[int, Cell]], names: Mapping[int, Cell], mapped: MappedSheet
) -> None:
    """Put the names of the nets in a column of the rows, which is needed there."""
    own = mapped.find("rows", "net_type")
    number = own.number if own else _find_width(mapped.sheet) + _AFTER
    if own is None:
        rows[mapped.table.line][number] = _head(mapped, "rows", "net_type", number)
    for line, name in names.items():
        rows[line][number] = name


_AFTER = 50  # columns behind those of a list, where no other column stands


def _head(mapped: MappedSheet, table: str, key: str, number: int) -> Cell:
    target = next(one.field for one in load_columns(table) if one.field.key == key)
    return Cell(
        file=mapped.sheet.file,
        sheet=mapped.sheet.name,
        row=mapped.table.line,
        column=number,
        value=target.label_in("en"),
    )


def _keep_nets(
    rows: Mapping[int, dict[int, Cell]], names: Mapping[int, Cell], mapped: MappedSheet
) -> dict[int, dict[int, Cell]]:
    """Lines of the net types: the first of those that say the same of a name."""
    number = _find_width(mapped.sheet) + _AFTER
    line = mapped.table.line
    kept = {line: {**rows[line], number: _head(mapped, "net_types", "id", number)}}
    seen = set()
    for row, cells in rows.items():
        if row == line or row not in names or names[row].is_blank:
            continue
        said = (names[row].text.strip(), *(one.text.strip() for one in cells.values()))
        if said not in seen:
            seen.add(said)
            kept[row] = {**cells, number: names[row]}
    return kept


def _name_anchors(mapped: MappedSheet) -> Sheet | None:
    """Sheet of the anchor types that the rows name; None where they name none."""
    columns = [one for key in _ANCHORS if (one := mapped.find("rows", key))]
    first: dict[str, Cell] = {}
    for line in mapped.lines:
        for one in columns:
            cell = mapped.sheet.cell(line, one.number)
            if not cell.is_blank:
                first.setdefault(" ".join(cell.text.split()).casefold(), cell)
    if not first:
        return None
    # headings are known as such by three of them
    heads = {
        number: replace(_head(mapped, "anchor_types", key, number), row=1)
        for number, key in enumerate(("id", "kind", "ground"), 1)
    }
    rows = {1: heads}
    rows |= {number: {1: cell} for number, cell in enumerate(first.values(), 2)}
    name = load_plan("anchor_types").name_in("en")
    return replace(mapped.sheet, name=name, rows=rows, merged=())


def list_lacking(becomes: str, own: Collection[tuple[str, str]]) -> list[Target]:
    """Columns that the input workbook cannot do without, and that a sheet has not.

    Parameters
    ----------
    becomes : str
        Table that the sheet becomes.
    own : collection of tuple of str
        Table and key of the columns that it has.
    """
    needed = {
        (table, one.field.key)
        for table in GROUPS[becomes]
        for one in load_columns(table)
        if one.need == "yes"
    }
    if ("net_types", "net_height") in own:
        needed.discard(("rows", "net_type"))
    elif ("rows", "net_type") in own:
        needed.discard(("net_types", "net_height"))
    found: dict[tuple[str, str], Target] = {}
    for one in list_targets(becomes):
        if (one.table, one.key) in needed.difference(own):
            found.setdefault((one.table, one.key), one)
    return list(found.values())
