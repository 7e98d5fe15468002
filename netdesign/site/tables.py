"""From a sheet to lines of readings: finds the data rows, reads them field by field."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise

from netdesign.site.cells import Cell, Sheet, Workbook
from netdesign.site.diagnostics import Finding, Refusal, add_nearest
from netdesign.site.fields import Field, SheetPlan
from netdesign.site.headings import Column, Headings, find_cover, find_headings
from netdesign.site.readings import (
    Reading,
    Row,
    read_cell,
    read_nothing,
    read_without_unit,
)

# What makes a single text below a table a note and not the start of another line.
_NOTE = re.compile(
    r"(\*|note|nota|nb\b|n\.b\.|remark|remarque|source|anm|bemerkung|hinweis|quelle)",
    re.IGNORECASE,
)
_NOTE_WORDS = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """A sheet whose headings were understood."""

    sheet: Sheet
    plan: SheetPlan
    columns: Mapping[str, Column]  # by field key; absent headings are absent
    rows: tuple[int, ...]  # numbers of the lines that hold something

    def cell(self, row: int, key: str) -> Cell | None:
        """Cell of a field in a row; None without such a heading."""
        column = self.columns.get(key)
        return self.sheet.cell(row, column.number) if column else None


def find_table(
    workbook: Workbook, plan: SheetPlan, findings: list[Finding]
) -> Table | None:
    """Find a planned sheet and its headings.

    Parameters
    ----------
    workbook : Workbook
        As read.
    plan : SheetPlan
        The sheet that is looked for.
    findings : list of Finding
        Appended to: missing or duplicated headings, units, merged cells, gaps.

    Returns
    -------
    Table or None
        None if the sheet or its row of headings is missing; that is a finding
        unless the plan does not require the sheet.
    """
    sheet = _find_sheet(workbook, plan, findings)
    if sheet is None:
        return None
    headings = find_headings(sheet, plan, findings)
    if headings is None:
        return None
    table = Table(
        sheet=sheet,
        plan=plan,
        columns=headings.columns,
        rows=_find_data_rows(sheet, headings.first_data_row, findings),
    )
    _inspect_layout(table, headings, findings)
    return table


def read_rows(table: Table, findings: list[Finding]) -> Iterator[Row]:
    """Read every line of a table, field by field; faults go to ``findings``."""
    for row in table.rows:
        yield {
            field.key: _read_field(table, field, row, findings)
            for field in table.plan.fields
        }


def read_field(table: Table, key: str, row: int, findings: list[Finding]) -> Reading:
    """Read one field of one line; a fault goes to ``findings``."""
    field = next(field for field in table.plan.fields if field.key == key)
    return _read_field(table, field, row, findings)


def _read_field(
    table: Table, field: Field, row: int, findings: list[Finding]
) -> Reading:
    column = table.columns.get(field.key)
    if column is None:
        if field.required:  # the missing heading is a finding already
            return Reading(field=field, state="faulty")
        return read_nothing(field, None)
    cell = table.sheet.cell(row, column.number)
    if column.unit is None:  # so is the unit
        return read_without_unit(cell, field, findings)
    return read_cell(cell, field, column.unit, findings)


def _find_sheet(
    workbook: Workbook, plan: SheetPlan, findings: list[Finding]
) -> Sheet | None:
    sheets = [sheet for sheet in workbook.sheets if plan.matches(sheet.name)]
    if not sheets and plan.required:
        names = " or ".join((plan.name, *plan.aliases))
        findings.append(
            Finding(
                file=workbook.file,
                rule=f'lacks the sheet "{plan.name}"',
                accepted=add_nearest(f"the name {names}", plan.name, workbook.unread),
            )
        )
    for double in sheets[1:]:
        refusal = Refusal(f'is a second sheet "{plan.name}", after {sheets[0].name}')
        findings.append(double.finding(refusal))
    return sheets[0] if sheets else None


def _find_data_rows(
    sheet: Sheet, first_row: int, findings: list[Finding]
) -> tuple[int, ...]:
    filled = sorted(row for row in sheet.rows if row >= first_row and sheet.row(row))
    while filled and _is_note(sheet.row(filled[-1])):
        refusal = Refusal("is a note below the table: it is not read")
        cell = sheet.row(filled.pop())[0]
        findings.append(cell.finding(refusal, severity="note"))
    for above, row in pairwise((first_row - 1, *filled)):
        if row > above + 1:
            refusal = Refusal("is in an empty row", "lines without gaps: delete it")
            findings.append(sheet.cell(above + 1, 1).finding(refusal))
    return tuple(filled)


def _is_note(cells: tuple[Cell, ...]) -> bool:
    """Whether a row holds a single text that can be no line begun: many words."""
    if len(cells) != 1 or not isinstance(cells[0].value, str) or cells[0].formula:
        return False
    text = cells[0].value.strip()
    return bool(_NOTE.match(text)) or len(text.split()) >= _NOTE_WORDS


def _inspect_layout(table: Table, headings: Headings, findings: list[Finding]) -> None:
    """Refuse merged cells in the table; note what a reader does not see."""
    sheet = table.sheet
    last_row = max(table.rows, default=0)
    for merged in sheet.merged:
        if headings.first_data_row <= merged.last_row and merged.row <= last_row:
            cell = sheet.cell(merged.row, merged.column)
            refusal = Refusal(f"is merged over {merged.text}", "single cells")
            findings.append(cell.finding(refusal))
    if sheet.is_hidden:
        refusal = Refusal("is hidden; it was read all the same")
        findings.append(sheet.finding(refusal, severity="note"))
    for row in table.rows:
        if row in sheet.hidden_rows:
            refusal = Refusal("is in a hidden row; it was read all the same")
            findings.append(sheet.row(row)[0].finding(refusal, severity="note"))
    for column in table.columns.values():
        if column.number in sheet.hidden_columns:
            cell = sheet.cell(headings.row, column.number)
            refusal = Refusal("is in a hidden column; it was read all the same")
            findings.append(cell.finding(refusal, severity="note"))
    _judge_columns_without_heading(table, headings, findings)


def _judge_columns_without_heading(
    table: Table, headings: Headings, findings: list[Finding]
) -> None:
    known = {column.number for column in table.columns.values()}
    known |= {cell.column for cell in table.sheet.row(headings.row)}
    for row in table.rows:
        for cell in table.sheet.row(row):
            if cell.column in known:
                continue
            known.add(cell.column)
            cover = find_cover(table.sheet, headings.row, cell.column)
            if cover:
                rule = f"stands below a heading merged over {cover.text}"
                findings.append(
                    cell.finding(Refusal(rule, "a heading for each column"))
                )
            else:
                refusal = Refusal("stands below no heading: the column is not read")
                findings.append(cell.finding(refusal, severity="note"))
