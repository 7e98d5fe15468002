"""From a sheet to lines of readings: finds headings, units and data rows."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise

from netdesign.site.cells import Cell, Sheet, Workbook, name_column
from netdesign.site.diagnostics import Finding, Refusal, add_nearest, quote
from netdesign.site.fields import Field, SheetPlan, normalise_unit, split_heading
from netdesign.site.readings import Reading, Row, read_cell, read_nothing, refuse_stored

_LAST_HEADING_ROW = 20  # a title block may stand above the headings


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """Where a field stands and the unit of its numbers.

    The unit is empty for words and ids, and None where a finding refused it.
    """

    number: int
    unit: str | None


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
    heading_row = _find_heading_row(sheet, plan)
    if heading_row is None:
        wanted = ", ".join(quote(field.heading) for field in plan.fields[:3])
        refusal = Refusal("has no row of headings", f"a row such as {wanted}, ...")
        findings.append(sheet.finding(refusal))
        return None
    units_row = _find_units_row(sheet, plan, heading_row)
    columns = _find_columns(sheet, plan, heading_row, units_row, findings)
    first_row = (units_row or heading_row) + 1
    table = Table(
        sheet=sheet,
        plan=plan,
        columns=columns,
        rows=_find_data_rows(sheet, first_row, findings),
    )
    _inspect_layout(table, heading_row, findings)
    return table


def read_rows(table: Table, findings: list[Finding]) -> Iterator[Row]:
    """Read every line of a table, field by field; faults go to ``findings``."""
    for row in table.rows:
        yield {
            field.key: read_field(table, field.key, row, findings)
            for field in table.plan.fields
        }


def read_field(table: Table, key: str, row: int, findings: list[Finding]) -> Reading:
    """Read one field of one line; a fault goes to ``findings``."""
    field = next(field for field in table.plan.fields if field.key == key)
    column = table.columns.get(key)
    if column is None:
        if field.required:  # the missing heading is a finding already
            return Reading(field=field, state="faulty")
        return read_nothing(field, None)
    cell = table.sheet.cell(row, column.number)
    if column.unit is None:  # so is the unit
        return Reading(field=field, state="faulty", cell=cell)
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


def _match_field(cell: Cell, plan: SheetPlan) -> Field | None:
    name, _ = split_heading(str(cell.value))
    return next((field for field in plan.fields if name in field.names), None)


def _find_heading_row(sheet: Sheet, plan: SheetPlan) -> int | None:
    """Row with the most known headings; one alone may be a title by chance."""
    counts = {
        row: sum(_match_field(cell, plan) is not None for cell in sheet.row(row))
        for row in range(1, _LAST_HEADING_ROW + 1)
    }
    best = max(counts, key=lambda row: counts[row])
    return best if counts[best] >= 2 else None


def _find_units_row(sheet: Sheet, plan: SheetPlan, heading_row: int) -> int | None:
    """Row below the headings if it holds nothing but units."""
    row = heading_row + 1
    known = {unit for field in plan.fields for unit in field.units}
    units = [_read_unit(cell) for cell in sheet.row(row)]
    is_units = units and all(
        unit in known or in_brackets for unit, in_brackets in units
    )
    return row if is_units else None


def _find_columns(
    sheet: Sheet,
    plan: SheetPlan,
    heading_row: int,
    units_row: int | None,
    findings: list[Finding],
) -> dict[str, Column]:
    columns: dict[str, Column] = {}
    for cell in sheet.row(heading_row):
        field = _match_field(cell, plan)
        if field is None:
            findings.append(_note_unknown(cell, plan))
        elif field.key in columns:
            first = name_column(columns[field.key].number)
            rule = f'names "{field.label}" again, after column {first}'
            findings.append(cell.finding(Refusal(rule, "one column for each quantity")))
        else:
            below = sheet.cell(units_row, cell.column) if units_row else None
            unit = _find_unit(cell, below, field, findings)
            columns[field.key] = Column(number=cell.column, unit=unit)
    _report_missing_headings(sheet, plan, columns, findings)
    return columns


def _note_unknown(cell: Cell, plan: SheetPlan) -> Finding:
    stored = refuse_stored(cell)
    headings = [field.heading for field in plan.fields]
    accepted = add_nearest("a known heading", str(cell.value), headings)
    unknown = Refusal("is no known heading: the column is not read", accepted)
    return cell.finding(stored or unknown, severity="error" if stored else "note")


def _find_unit(
    heading: Cell, below: Cell | None, field: Field, findings: list[Finding]
) -> str | None:
    """Take the unit of a column from its heading or from the row of units."""
    if not field.units:
        return ""
    _, unit = split_heading(str(heading.value))
    cell = heading
    if below is not None and not below.is_blank:
        unit_below, _ = _read_unit(below)
        if unit not in ("", unit_below):
            rule = f"is another unit than that of the heading, {quote(heading.text)}"
            findings.append(below.finding(Refusal(rule, "one unit")))
            return None
        unit, cell = unit_below, below
    if not unit and "-" in field.units:
        return "-"
    if unit in field.units:
        return unit
    rule = "has an unknown unit" if unit else "has no unit"
    accepted = " or ".join(f"[{unit}]" for unit in field.units)
    findings.append(cell.finding(Refusal(rule, accepted), field.label))
    return None


def _read_unit(cell: Cell) -> tuple[str, bool]:
    """Read a unit in a cell of its own, and whether it stands in brackets."""
    text = str(cell.value).strip()
    bracketed = re.fullmatch(r"[\[(](.*)[\])]", text)
    return normalise_unit(bracketed[1] if bracketed else text), bracketed is not None


def _report_missing_headings(
    sheet: Sheet,
    plan: SheetPlan,
    found: Mapping[str, Column],
    findings: list[Finding],
) -> None:
    missing = [
        f'lacks the heading "{field.heading}"'
        for field in plan.fields
        if field.required and field.key not in found
    ]
    if plan.one_of and not any(key in found for key in plan.one_of):
        labels = [field.heading for field in plan.fields if field.key in plan.one_of]
        missing.append("lacks a heading: " + " or ".join(map(quote, labels)))
    findings.extend(sheet.finding(Refusal(rule)) for rule in missing)


def _find_data_rows(
    sheet: Sheet, first_row: int, findings: list[Finding]
) -> tuple[int, ...]:
    filled = sorted(row for row in sheet.rows if row >= first_row and sheet.row(row))
    for above, row in pairwise((first_row - 1, *filled)):
        if row > above + 1:
            refusal = Refusal("is in an empty row", "lines without gaps: delete it")
            findings.append(sheet.cell(above + 1, 1).finding(refusal))
    return tuple(filled)


def _inspect_layout(table: Table, heading_row: int, findings: list[Finding]) -> None:
    """Refuse merged cells in the table; note what a reader does not see."""
    sheet = table.sheet
    for merged in sheet.merged:
        if merged.last_row >= heading_row:
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
    _note_columns_without_heading(table, heading_row, findings)


def _note_columns_without_heading(
    table: Table, heading_row: int, findings: list[Finding]
) -> None:
    noted: set[int] = set()
    for row in table.rows:
        for cell in table.sheet.row(row):
            heading = table.sheet.cell(heading_row, cell.column)
            if heading.is_blank and cell.column not in noted:
                noted.add(cell.column)
                refusal = Refusal("stands below no heading: the column is not read")
                findings.append(cell.finding(refusal, severity="note"))
