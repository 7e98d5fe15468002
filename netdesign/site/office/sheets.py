"""Finds the sheets of the input workbook, and their tables."""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.site.cells.cells import Sheet, Workbook
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import FURTHER, load_old_plans
from netdesign.site.columns.fields import split_heading
from netdesign.site.columns.office import (
    PARTS,
    TABLES,
    load_plan,
)
from netdesign.site.headings import Table, find_best_row
from netdesign.site.readings import Reading, Row
from netdesign.site.tables import find_table, read_rows

SHEETS_ALONE = tuple(table for table in TABLES if table not in PARTS)
_LEAST_OLD = 4  # headings of a sheet Nets


@dataclass(frozen=True, slots=True, kw_only=True)
class OfficeTables:
    """Tables of the workbook by their name in `office.toml`, and their lines."""

    tables: Mapping[str, Table | None]
    lines: Mapping[str, Sequence[Row]]

    def find_measure(self, name: str, key: str) -> str:
        """What the unit cell of a column says it measures; empty where it says none."""
        table = self.tables.get(name)
        column = table.columns.get(key) if table else None
        return column.measure if column else ""

    def doubt_formulas(self, addresses: Container[str]) -> OfficeTables:
        """Tables whose formulas at some addresses may have an old result."""

        def doubt(reading: Reading) -> Reading:
            cell = reading.cell
            if cell is None or not cell.formula or cell.address not in addresses:
                return reading
            return replace(reading, cell=cell.follow_change())

        lines = {
            name: [{key: doubt(x) for key, x in line.items()} for line in of_table]
            for name, of_table in self.lines.items()
        }
        return replace(self, lines=lines)


def read_tables(
    tables: Mapping[str, Table | None], findings: list[Finding]
) -> OfficeTables:
    """Tables with their lines, whose faults go to ``findings``."""
    lines = {name: read_rows(table, findings) for name, table in tables.items()}
    return OfficeTables(tables=tables, lines=lines)


def is_read(name: str) -> bool:
    """A name is that of a sheet of the input workbook."""
    return any(plan.matches(name) for plan in (*map(load_plan, TABLES), *FURTHER))


def is_old(workbook: Workbook) -> bool:
    """A workbook is of version 0.1: its sheet Nets has headings of the template.

    An office's own list has other headings, by which columns are read, too.
    """
    rows, nets = load_plan("rows"), load_old_plans()["Nets"]
    own = next(field.names for field in rows.fields if field.key == "net_type")
    first_names = (
        names[:1] for field in nets.fields for names in field.headings.values()
    )
    template = {split_heading(name)[0] for names in first_names for name in names}
    is_found = False
    for sheet in workbook.sheets:
        headings = _list_headings(sheet, find_best_row(sheet, nets, sheet.rows)[0])
        if rows.matches(sheet.name) and not own.isdisjoint(headings):
            return False
        count = sum(heading in template for heading in headings)
        is_template = _LEAST_OLD <= count >= len(headings) / 2
        is_found = is_found or (nets.matches(sheet.name) and is_template)
    return is_found


def _list_headings(sheet: Sheet, number: int) -> list[str]:
    cells = sheet.row(number)
    return [
        split_heading(cell.value)[0] for cell in cells if isinstance(cell.value, str)
    ]


def find_office_tables(
    workbook: Workbook,
    findings: list[Finding],
    alone: Sequence[str] = SHEETS_ALONE,
    elsewhere: Sequence[str] = (),
) -> OfficeTables:
    """Tables of the workbook with their lines; faults go to ``findings``.

    Parameters
    ----------
    workbook : Workbook
        As read.
    findings : list of Finding
        Appended to.
    alone, elsewhere : sequence of str
        Tables that are looked for beside those of sheet Parts, and those that need not
        be there.
    """
    plans = {
        name: replace(load_plan(name), required=False)
        if name in elsewhere
        else load_plan(name)
        for name in alone
    }
    tables = {
        name: find_table(workbook, plan, findings) for name, plan in plans.items()
    }
    tables |= _find_parts(workbook, findings)
    return read_tables(tables, findings)


def _find_parts(
    workbook: Workbook, findings: list[Finding]
) -> Iterator[tuple[str, Table | None]]:
    """Blocks of sheet Parts, one below the other, each with headings of its own."""
    plan = load_plan(PARTS[0])
    sheet = next((sheet for sheet in workbook.sheets if plan.matches(sheet.name)), None)
    best = {
        name: find_best_row(sheet, load_plan(name), sheet.rows)
        for name in PARTS
        if sheet
    }
    starts = {name: row for name, (row, count) in best.items() if count > 1}
    ends = sorted(starts.values())[1:]
    for name in PARTS:
        if sheet is None or name not in starts:
            yield name, None
            continue
        end = next((start for start in ends if start > starts[name]), 0)
        block = _cut(sheet, starts[name], end)
        yield (
            name,
            find_table(replace(workbook, sheets=(block,)), load_plan(name), findings),
        )


def _cut(sheet: Sheet, start: int, end: int) -> Sheet:
    """Rows of a block from its headings to the title of the next, 0 for none."""
    last = end or max(sheet.rows) + 1
    if end and len(sheet.row(end - 1)) == 1:
        last = end - 1
    rows = {row: cells for row, cells in sheet.rows.items() if start <= row < last}
    merged = tuple(cells for cells in sheet.merged if start <= cells.min_row < last)
    return replace(sheet, rows=rows, merged=merged)
