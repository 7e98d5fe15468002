"""Joins sheets of a list to tables of the input workbook; cells keep their places."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from netdesign.site.cells.cells import Cell, Sheet, Workbook, name_column
from netdesign.site.cells.findings import Finding, quote
from netdesign.site.columns.fields import (
    KNOWN_UNITS,
    Field,
    SheetPlan,
    normalise,
    split_heading,
)
from netdesign.site.columns.office import TABLES, load_plan
from netdesign.site.headings import (
    Column,
    Table,
    Title,
    find_heading_unit,
    is_numbering,
    is_unit,
    read_unit,
)
from netdesign.site.lists.list_map import ListMap, ListTable
from netdesign.site.lists.targets import Target, read_answer
from netdesign.site.office.sheets import OfficeTables, read_tables
from netdesign.site.tables import complete_table, judge_missing
from netdesign.words.message import say

_ANCHORS = ("foot_anchor", "uphill_anchor", "downhill_anchor", "end_anchor")
_ANCHOR_COLUMNS = {
    key: Column(number=number, unit="")
    for number, key in enumerate(("id", "kind", "ground"), 1)
}


def join_list(
    workbook: Workbook, answers: ListMap, findings: list[Finding]
) -> tuple[Workbook, OfficeTables]:
    """Tables of the input workbook from an office's list, and the list without these.

    Every cell keeps its place in the list. Rows may have the columns of their nets, and
    need no net types then. Anchor types that only the rows name get a line each.

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
    tables: dict[str, Table | None] = dict.fromkeys(TABLES)
    unread = dict.fromkeys(sheets)
    for name, answered in answers.tables.items():
        if name not in sheets:
            rule = say("map.sheet_absent")
            findings.append(Finding(file=answers.file, sheet=name, rule=rule))
        elif answered.becomes:
            del unread[name]
            made = _make_table(sheets[name], answered, answers.file, findings)
            first = tables[answered.becomes]
            tables[answered.becomes] = first or made
            _refuse_second(answered.becomes, first, made, findings)
    rows, needed = tables["rows"], ["rows", "net_types"]
    if rows and "net_height" in map_fields(rows.plan):
        needed.remove("net_types")
        _refuse_second("net_types", rows, tables["net_types"], findings)
    if rows and tables["anchor_types"] is None:
        tables["anchor_types"] = _name_anchors(rows)
    rest = replace(workbook, sheets=(), unread=tuple(unread))
    for name in needed:
        if tables[name] is None:
            findings.extend(judge_missing(rest, load_plan(name)))
    return rest, read_tables(tables, findings)


def _refuse_second(
    name: str, first: Table | None, second: Table | None, findings: list[Finding]
) -> None:
    if first and second:
        title = load_plan(name).title
        rule = say("table.second_sheet", name=title, first=first.sheet.name)
        findings.append(second.sheet.finding(rule))


def _make_table(
    sheet: Sheet, answered: ListTable, file: str, findings: list[Finding]
) -> Table:
    """Table of a sheet by its answers; a heading without an answer is a finding."""
    head = answered.headings_in_line
    lines = list_below(sheet, head)[1 if find_units(sheet, head) else 0 :]
    if lines and is_numbering(sheet.row(lines[0])):
        lines = lines[1:]
    titles = _list_titles(sheet, answered, file, findings)
    read = {title.cell.column for title in titles}
    rows = {
        line: {n: cell for n, cell in sheet.rows.get(line, {}).items() if n in read}
        for line in (head, *lines)
    }
    for number, (name, text) in enumerate(
        answered.always.items(), _find_last(sheet) + 1
    ):
        target = read_answer(name, answered.becomes).target
        if target is not None:
            titles.append(_title(sheet.cell(head, number), target, target.field.unit))
            for line in lines:
                rows[line][number] = replace(sheet.cell(line, number), value=text)
    merged = tuple(cells for cells in sheet.merged if cells.min_row > head)
    table = Table(
        sheet=replace(sheet, rows=rows, merged=merged),
        plan=_plan(answered.becomes, titles),
        titles=titles,
        heading_row=head,
        first_data_row=min(lines, default=head + 1),
        columns={},
        words=answered.words,
        answered_in=file,
    )
    return complete_table(table, findings)


def map_fields(plan: SheetPlan) -> Mapping[str, Field]:
    """Columns of a sheet by key."""
    return {field.key: field for field in plan.fields}


def _plan(becomes: str, titles: Sequence[Title]) -> SheetPlan:
    """Columns that a sheet may have; rows may have those of their nets, too."""
    plan, nets = load_plan(becomes), map_fields(load_plan("net_types"))
    if becomes != "rows":
        return plan
    of_rows = [x.field for x in titles if x.field and x.field.table == "rows"]
    fields = {**map_fields(plan), **{field.key: field for field in of_rows}}
    if len(of_rows) < len(titles):
        named = replace(fields["net_type"], required=False)
        fields = {**nets, **fields, "net_type": named}
    return replace(plan, fields=tuple(fields.values()))


def _title(cell: Cell, target: Target, unit: str) -> Title:
    return Title(cell, target.column.field, target.unit(unit), target.measure)


def _list_titles(
    sheet: Sheet, table: ListTable, file: str, findings: list[Finding]
) -> list[Title]:
    """Headings of a sheet that become columns, with the unit of their numbers."""
    units = find_units(sheet, table.headings_in_line)
    asked = {normalise(heading): heading for heading in table.headings}
    titles: list[Title] = []
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
        titles.append(_title(cell, answer.target, answer.unit or unit))
    for heading in asked.values():
        rule = say("list_map.no_heading", heading=quote(heading))
        findings.append(sheet.finding(rule, say("list_map.again")))
    return titles


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


def _name_anchors(rows: Table) -> Table | None:
    """Anchor types that the rows name; None where they name none."""
    first: dict[str, Cell] = {}
    named = (rows.cell(line, key) for line in rows.rows for key in _ANCHORS)
    for cell in named:
        if cell and not cell.is_blank:
            first.setdefault(" ".join(cell.text.split()).casefold(), cell)
    if not first:
        return None
    plan = load_plan("anchor_types")
    lines = {number: {1: cell} for number, cell in enumerate(first.values(), 1)}
    return Table(
        sheet=Sheet(file=rows.sheet.file, name=plan.name_in("en"), rows=lines),
        plan=plan,
        columns=_ANCHOR_COLUMNS,
        rows=tuple(lines),
    )
