"""Finds the headings of a sheet by their names, in any order, with their units."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.site.cells.cells import Cell, Sheet, name_column
from netdesign.site.cells.findings import Finding, quote
from netdesign.site.columns.fields import (
    KNOWN_UNITS,
    Field,
    SheetPlan,
    normalise,
    split_heading,
)
from netdesign.site.columns.office import list_texts
from netdesign.site.readings import explain_unit, refuse_stored
from netdesign.site.titles import (
    find_heading_unit,
    find_near,
    find_own_unit,
    is_number,
    is_unit,
    quote_title,
    read_unit,
)
from netdesign.words.message import say

_HEADING_ROWS = 20  # from the first filled one: a title block may stand above them
_LEAST_KNOWN = 2  # headings, to be a row of them
_UNITS_WORDS = ("", "unit", "units", "unite", "unites", "einheit", "einheiten")
_LEAST_NUMBERED = 4  # columns, to be a row of their numbers


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """Place of a field and the unit of its numbers.

    The unit is empty for words and ids, and None where a finding refused it.
    """

    number: int
    unit: str | None


Titles = Sequence[tuple[Cell, Field | None]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """A sheet with its headings.

    Attributes
    ----------
    sheet, plan
        As read, and what it should hold.
    titles : sequence of Cell and Field
        Its headings with the field that each is taken for, or None.
    heading_row, first_data_row : int
        The row that names the fields; the first below headings and units.
    units_row : int or None
        A row of units below the headings.
    columns : mapping of str to Column
        By field key; absent headings are absent.
    rows : tuple of int
        Numbers of the lines that hold something.
    """

    sheet: Sheet
    plan: SheetPlan
    columns: Mapping[str, Column]
    titles: Titles = ()
    heading_row: int = 0
    units_row: int | None = None
    first_data_row: int = 1
    rows: tuple[int, ...] = ()

    def cell(self, row: int, key: str) -> Cell | None:
        """Cell of a field in a row; None without such a heading."""
        column = self.columns.get(key)
        return self.sheet.cell(row, column.number) if column else None

    def list_filled(self, column: int) -> list[Cell]:
        """Filled cells of a column below its heading."""
        rows = (row for row in self.sheet.rows if row >= self.first_data_row)
        cells = (self.sheet.cell(row, column) for row in rows)
        return [cell for cell in cells if not cell.is_blank]


def find_headings(
    sheet: Sheet, plan: SheetPlan, findings: list[Finding]
) -> Table | None:
    """Find the headings of a planned sheet.

    Parameters
    ----------
    sheet : Sheet
        As read.
    plan : SheetPlan
        What it should hold.
    findings : list of Finding
        Appended to: missing, unknown, unclear or duplicated headings, units.

    Returns
    -------
    Table or None
        Without its lines; None if there is no row of headings, which is a finding.
    """
    row, count = find_best_row(sheet, plan, _list_first_rows(sheet))
    if count < _LEAST_KNOWN:
        wanted = tuple(quote_title(field) for field in plan.fields[:3])
        accepted = say("heading.such_as", headings=wanted)
        findings.append(sheet.finding(say("heading.no_row"), accepted))
        return None
    titles = [(cell, plan.find(str(cell.value))) for cell in sheet.row(row)]
    units_row = _find_units_row(sheet, titles, row, findings)
    merged_to = [
        merged.max_row
        for merged in sheet.merged
        if merged.min_row <= row <= merged.max_row and not sheet.rows.get(row + 1)
    ]
    first_data_row = max(row, units_row or row, *merged_to, row) + 1
    first_data_row += _is_numbering(sheet.row(first_data_row))
    while _continues_headings(sheet.row(first_data_row)):
        first_data_row += 1
    table = Table(
        sheet=sheet,
        plan=plan,
        titles=titles,
        heading_row=row,
        units_row=units_row,
        first_data_row=first_data_row,
        columns={},
    )
    return replace(table, columns=_find_columns(table, findings))


def count_headings(sheet: Sheet, plan: SheetPlan) -> int:
    """Largest number of headings of a plan in one row of a sheet, whatever its name."""
    return find_best_row(sheet, plan, _list_first_rows(sheet))[1]


def find_best_row(
    sheet: Sheet, plan: SheetPlan, rows: Iterable[int]
) -> tuple[int, int]:
    """Row that holds the most headings of a plan, and how many; 0 without any."""
    counts = {
        row: sum(
            isinstance(cell.value, str) and plan.find(cell.value) is not None
            for cell in sheet.row(row)
        )
        for row in rows
    }
    best = max(counts, key=lambda row: counts[row], default=0)
    return best, counts.get(best, 0)


def _list_first_rows(sheet: Sheet) -> range:
    first = next((row for row in sheet.rows if sheet.row(row)), 1)
    return range(1, first + _HEADING_ROWS)


def _find_units_row(
    sheet: Sheet, titles: Titles, heading_row: int, findings: list[Finding]
) -> int | None:
    """Row below the headings if it holds units; other texts in it are findings.

    An unknown unit does not make it a line of the table: that would hold a number.
    """
    by_column = {cell.column: (cell, field) for cell, field in titles}
    below = sheet.row(heading_row + 1)
    cells = [
        (cell, field)
        for cell in (() if _is_numbering(below) else below)
        if (field := by_column.get(cell.column, (None, None))[1])
    ]
    measured = [(cell, field) for cell, field in cells if field.units]
    unmeasured = [pair for pair in cells if pair not in measured]
    unit_count = sum(is_unit(*pair) for pair in measured)
    strangers = [cell for cell, field in unmeasured if not is_unit(cell, field)]
    has_units_above = any(
        find_heading_unit(by_column[cell.column][0]) for cell, _ in measured
    )
    is_row = 2 * unit_count > len(measured) or not (strangers or has_units_above)
    if not measured or not is_row or any(is_number(*pair) for pair in cells):
        return None
    for cell in strangers:
        if normalise(str(cell.value)) not in _UNITS_WORDS:
            rule = say("heading.in_units_row")
            findings.append(cell.finding(rule, say("heading.units_or_empty")))
    return heading_row + 1


def _is_numbering(cells: tuple[Cell, ...]) -> bool:
    """A row numbers the columns: (1), (2), (3) and so on."""
    numbers = [str(cell.value).strip(" ()") for cell in cells]
    return len(cells) >= _LEAST_NUMBERED and numbers == [
        str(number) for number in range(1, len(cells) + 1)
    ]


def _continues_headings(cells: tuple[Cell, ...]) -> bool:
    """A row below headings that says units, or what empty cells mean (`office`)."""
    first = normalise(str(cells[0].value)) if cells else ""
    return first in list_texts("unit", "empty")


def _find_columns(table: Table, findings: list[Finding]) -> dict[str, Column]:
    columns: dict[str, Column] = {}
    unknown: list[Cell] = []
    for cell, field in table.titles:
        if field is None:
            unknown.append(cell)
        elif field.key in columns:
            first = name_column(columns[field.key].number)
            rule = say("heading.twice", name=field.name, column=first)
            findings.append(cell.finding(rule, say("heading.one_column")))
        else:
            unit = _find_unit(table, cell, field, findings)
            columns[field.key] = Column(number=cell.column, unit=unit)
    missing = [field for field in table.plan.fields if field.key not in columns]
    judged = [_judge_unknown(cell, missing) for cell in unknown]
    findings.extend(finding for finding, _ in judged)
    near = {field.key for _, field in judged if field}
    findings.extend(
        table.sheet.finding(say("heading.lacks", heading=field.title))
        for field in missing
        if field.required and field.key not in near
    )
    return columns


def _judge_unknown(cell: Cell, missing: list[Field]) -> tuple[Finding, Field | None]:
    """Note a column that is not read; refuse a heading that seems misspelt."""
    if stored := refuse_stored(cell):
        return cell.finding(*stored), None
    near = find_near(str(cell.value), missing)
    if near:
        rule = say("heading.close_to_missing", meant=quote_title(near[0]))
        accepted = say("heading.or_unlike", meant=quote_title(near[0]))
        return cell.finding(rule, accepted), near[0]
    return cell.finding(say("heading.unknown"), severity="note"), None


def _find_unit(
    table: Table, heading: Cell, field: Field, findings: list[Finding]
) -> str | None:
    """Take the unit of a column from its heading, or from the row of units."""
    cell, text = heading, str(heading.value)
    own, full_name = split_heading(text)[0], normalise(text)
    is_name = own != full_name in field.names  # brackets and all
    unit = "" if is_name else find_heading_unit(heading)
    if not field.units:
        if unit in KNOWN_UNITS and unit != "-":  # a number of another field
            rule = say("heading.unit_not_wanted", unit=unit, name=field.name)
            findings.append(heading.finding(rule, field.name))
        return ""
    column = heading.column
    below = table.sheet.cell(table.units_row, column) if table.units_row else None
    if below is not None and not below.is_blank:
        unit_below, _ = read_unit(below)
        if unit not in ("", unit_below):
            rule = say("heading.other_unit", heading=quote(cell.text))
            findings.append(below.finding(rule, say("accepted.one_unit")))
            return None
        unit, cell = unit_below, below
    if not unit and "-" in field.units:
        return "-"
    if unit in field.units:
        return unit
    if not unit and (own := find_own_unit(table.list_filled(column), field)):
        return own
    findings.append(cell.finding(*explain_unit(unit, field), field.name))
    return None
