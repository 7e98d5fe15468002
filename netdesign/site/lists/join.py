"""Joins sheets of a list to tables of the input workbook; cells keep their places."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.site.cells.cells import Cell, Sheet, Workbook, name_column
from netdesign.site.cells.findings import Finding, quote
from netdesign.site.columns.fields import (
    KNOWN_UNITS,
    Field,
    normalise,
    split_heading,
)
from netdesign.site.columns.office import TABLES, load_plan
from netdesign.site.headings import (
    Column,
    Table,
    Title,
    find_columns,
    is_numbering,
)
from netdesign.site.lists.list_map import ListMap, ListTable
from netdesign.site.lists.targets import GROUPS, Target, read_answer
from netdesign.site.office.sheets import OfficeTables, read_tables
from netdesign.site.tables import complete_table, inspect_layout, judge_missing
from netdesign.site.titles import (
    find_heading_unit,
    is_unit,
    name_net_type,
    read_unit,
)
from netdesign.words.message import say

_ANCHORS = ("foot_anchor", "uphill_anchor", "downhill_anchor", "end_anchor")
_ANCHOR_COLUMNS = {
    key: Column(number=number, unit="")
    for number, key in enumerate(("id", "kind", "ground"), 1)
}
_NEEDED = ("rows", "net_types")


@dataclass(frozen=True, slots=True, kw_only=True)
class MappedSheet:
    """A sheet of a list whose headings are answered.

    Attributes
    ----------
    sheet : Sheet
        Cells of the columns that are read, also of those that every line has alike.
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
) -> tuple[Workbook, OfficeTables]:
    """Tables of the input workbook from an office's list, and the list without these.

    Every cell keeps its place in the list. Rows whose net is the same by all its
    columns share a net type. Anchor types that only the rows name get a line each.

    Parameters
    ----------
    workbook : Workbook
        Every sheet of the list.
    answers : ListMap
        Answers to all headings of the list.
    findings : list of Finding
        Appended to: answers that do not fit the list, and what is wrong with its
        tables.
    """
    sheets = {sheet.name: sheet for sheet in workbook.sheets}
    mapped: list[MappedSheet] = []
    for name, table in answers.tables.items():
        if name not in sheets:
            rule = say("map.sheet_absent")
            findings.append(Finding(file=answers.file, sheet=name, rule=rule))
        elif table.becomes:
            mapped.append(map_sheet(sheets[name], table, answers.file, findings))
    tables: dict[str, Table | None] = dict.fromkeys(TABLES)
    for source in mapped:
        for name, made in _make_tables(source, findings).items():
            if first := tables[name]:
                title, of_first = load_plan(name).title, first.sheet.name
                rule = say("table.second_sheet", name=title, first=of_first)
                findings.append(made.sheet.finding(rule))
            tables[name] = first or made
    if tables["anchor_types"] is None:
        tables["anchor_types"] = _name_anchors(mapped)
    read = {source.sheet.name for source in mapped}
    unread = tuple(name for name in sheets if name not in read)
    rest = replace(workbook, sheets=(), unread=unread)
    for name in _NEEDED:
        if tables[name] is None:
            findings.extend(judge_missing(rest, load_plan(name)))
    return rest, read_tables(tables, findings)


def map_sheet(
    sheet: Sheet, table: ListTable, file: str, findings: list[Finding]
) -> MappedSheet:
    """Columns of a sheet by its answers; a heading without an answer is a finding."""
    head = table.headings_in_line
    units = find_units(sheet, head)
    columns = _find_targets(sheet, table, file, findings)
    lines = list_below(sheet, head)[1 if units else 0 :]
    if lines and is_numbering(sheet.row(lines[0])):
        lines = lines[1:]
    rows = {
        line: {n: cell for n, cell in sheet.rows.get(line, {}).items() if n in columns}
        for line in (head, *lines)
    }
    for number, (name, text) in enumerate(table.always.items(), _find_last(sheet) + 1):
        target = read_answer(name, table.becomes).target
        if target is not None:
            columns[number] = target, target.field.unit
            for line in lines:
                rows[line][number] = replace(sheet.cell(line, number), value=text)
    merged = tuple(cells for cells in sheet.merged if cells.min_row > head)
    return MappedSheet(
        sheet=replace(sheet, rows=rows, merged=merged),
        table=table,
        columns=columns,
        lines=tuple(lines),
        file=file,
    )


def _find_targets(
    sheet: Sheet, table: ListTable, file: str, findings: list[Finding]
) -> dict[int, tuple[Target, str]]:
    """What the columns of a sheet become, with the unit of their numbers."""
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
    return columns


def _find_last(sheet: Sheet) -> int:
    """Number of the last column that holds something."""
    widths = (max(row, default=0) for row in sheet.rows.values())
    return max((*widths, *(cells.max_col for cells in sheet.merged)), default=0)


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
    unit = find_heading_unit(cell)[0] or units.get(cell.column, "")
    return unit if unit in KNOWN_UNITS else ""


def find_units(sheet: Sheet, line: int) -> Mapping[int, str]:
    """Units by column, where the row below the headings holds units alone."""
    below = list_below(sheet, line)
    cells = sheet.row(below[0]) if below else ()
    plain = Field(key="", units=("-",))
    if not all(is_unit(cell, plain) for cell in cells):
        return {}
    return {cell.column: read_unit(cell)[0] for cell in cells}


def _make_tables(mapped: MappedSheet, findings: list[Finding]) -> dict[str, Table]:
    """Tables of the input workbook that a sheet of a list makes."""
    if mapped.table.becomes != "rows":
        (name,) = GROUPS[mapped.table.becomes]
        titles = _list_titles(mapped, name)
        return {name: complete_table(_make_table(mapped, name, titles), findings)}
    own = mapped.find("rows", "net_type")
    number = own or _find_last(mapped.sheet) + 1
    rows = {line: dict(cells) for line, cells in mapped.sheet.rows.items()}
    for line, cell in _name_nets(mapped, own).items():
        rows[line][number] = cell
    mapped = replace(mapped, sheet=replace(mapped.sheet, rows=rows))
    heading = mapped.sheet.cell(mapped.table.headings_in_line, number)
    titles = [*_list_titles(mapped, "rows")]
    if not own:
        titles.append(Title(heading, _find_field("rows", "net_type")))
    tables = {"rows": complete_table(_make_table(mapped, "rows", titles), findings)}
    of_net = _list_titles(mapped, "net_types")
    if of_net:
        titles = [*of_net, Title(heading, _find_field("net_types", "id"))]
        nets = _make_table(mapped, "net_types", titles)
        nets = replace(nets, columns=find_columns(nets, findings))
        lines = _list_different(nets, tables["rows"].rows)
        tables["net_types"] = replace(nets, rows=lines)
        inspect_layout(tables["net_types"], findings)
    return tables


def _find_field(table: str, key: str) -> Field:
    return next(field for field in load_plan(table).fields if field.key == key)


def _list_titles(mapped: MappedSheet, table: str) -> list[Title]:
    """Headings of a sheet that become columns of a table."""
    head = mapped.table.headings_in_line
    return [
        Title(
            cell=mapped.sheet.cell(head, number),
            field=_find_field(table, target.key),
            unit=target.unit(unit),
            measure=target.measure,
        )
        for number, (target, unit) in mapped.columns.items()
        if target.table == table
    ]


def _make_table(mapped: MappedSheet, table: str, titles: Sequence[Title]) -> Table:
    """Table of a sheet, without its columns and lines."""
    head = mapped.table.headings_in_line
    return Table(
        sheet=mapped.sheet,
        plan=load_plan(table),
        titles=titles,
        heading_row=head,
        first_data_row=min(mapped.lines, default=head + 1),
        columns={},
        words=mapped.table.words,
        answered_in=mapped.file,
    )


def _name_nets(mapped: MappedSheet, own: int | None) -> dict[int, Cell]:
    """Name of the net of each line: as typed, or made of the height of the net."""
    slope = mapped.find("rows", "slope_angle")
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
        if line in names or (cell.is_blank and is_sum):
            continue
        name = name_net_type(cell.text.strip(), values, named)
        names[line] = replace(cell, value=name, formula="")
    return names


def _list_different(nets: Table, lines: Sequence[int]) -> tuple[int, ...]:
    """First line of each net, of the lines with equal cells of the net."""
    first: dict[tuple[str, ...], int] = {}
    for line in lines:
        cells = [nets.sheet.cell(line, x.number) for x in nets.columns.values()]
        if not nets.sheet.cell(line, nets.columns["id"].number).is_blank:
            first.setdefault(tuple(cell.text.strip() for cell in cells), line)
    return tuple(first.values())


def _name_anchors(mapped: Sequence[MappedSheet]) -> Table | None:
    """Anchor types that the rows name; None where they name none."""
    first: dict[str, Cell] = {}
    for source in mapped:
        numbers = [n for key in _ANCHORS if (n := source.find("rows", key))]
        for cell in (source.sheet.cell(y, n) for y in source.lines for n in numbers):
            if not cell.is_blank:
                first.setdefault(" ".join(cell.text.split()).casefold(), cell)
    if not first:
        return None
    plan = load_plan("anchor_types")
    rows = {number: {1: cell} for number, cell in enumerate(first.values(), 1)}
    return Table(
        sheet=Sheet(
            file=next(iter(first.values())).file, name=plan.name_in("en"), rows=rows
        ),
        plan=plan,
        columns=_ANCHOR_COLUMNS,
        rows=tuple(rows),
    )
