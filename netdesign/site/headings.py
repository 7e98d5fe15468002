"""Finds the headings of a sheet by their names, in any order, with their units."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from netdesign.site.cells.cells import Cell, Sheet, Workbook, name_column
from netdesign.site.cells.findings import Finding, Refusal, quote
from netdesign.site.cells.numbers import parse_number, read_grade
from netdesign.site.columns.fields import (
    KNOWN_UNITS,
    Field,
    SheetPlan,
    normalise,
    normalise_unit,
    split_heading,
)
from netdesign.site.columns.office import list_choices, list_texts
from netdesign.site.readings import explain_unit, refuse_stored
from netdesign.words.message import Message, say

_HEADING_ROWS = 20  # from the first filled one: a title block may stand above them
_LEAST_KNOWN = 2  # headings, to be a row of them
# Least likeness to a missing heading or sheet that makes a name a misspelling of it.
_MISSPELT = 0.8
_LEAST_NUMBERED = 4  # columns, to be a row of their numbers


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """Place of a field and the unit of its numbers.

    Attributes
    ----------
    number : int
        Of the column in its sheet.
    unit : str or None
        Empty for words and ids; None where a finding refused it.
    measure : str
        Which of several quantities the unit cell names: ``vertical``.
    """

    number: int
    unit: str | None
    measure: str = ""


class Title(NamedTuple):
    """A heading: the field that it is taken for, and what is said of its unit.

    Attributes
    ----------
    cell : Cell
        Of the heading.
    field : Field or None
        None of a column that is not read.
    unit : str or None
        As it is said; None where the heading and the row below it differ.
    measure : str
        As of `Column`.
    unit_cell : Cell or None
        Where the unit stands, if not in the heading.
    """

    cell: Cell
    field: Field | None
    unit: str | None = ""
    measure: str = ""
    unit_cell: Cell | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """A sheet with its headings.

    Attributes
    ----------
    sheet, plan
        As read, and what it should hold.
    titles : sequence of Title
        Its headings.
    heading_row, first_data_row : int
        The row that names the fields; the first below headings and units.
    columns : mapping of str to Column
        By field key; absent headings are absent.
    rows : tuple of int
        Numbers of the lines that hold something.
    words : mapping of str to str
        Answers to words of its cells, by their texts.
    answered_in : str
        File of the answers.
    """

    sheet: Sheet
    plan: SheetPlan
    columns: Mapping[str, Column]
    titles: Sequence[Title] = ()
    heading_row: int = 0
    first_data_row: int = 1
    rows: tuple[int, ...] = ()
    words: Mapping[str, str] = field(default_factory=dict)
    answered_in: str = ""

    def cell(self, row: int, key: str) -> Cell | None:
        """Cell of a field in a row; None without such a heading."""
        column = self.columns.get(key)
        return self.sheet.cell(row, column.number) if column else None

    def find_unit(self, field: Field) -> str:
        """Unit of a field's numbers; its own where the sheet has no such column."""
        column = self.columns.get(field.key)
        return (column.unit if column else field.unit) or ""

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
        Without its columns and lines; None if there is no row of headings, which is a
        finding.
    """
    row, count = find_best_row(sheet, plan, _list_first_rows(sheet))
    if count < _LEAST_KNOWN:
        wanted = tuple(quote_title(column) for column in plan.fields[:3])
        accepted = say("heading.such_as", headings=wanted)
        findings.append(sheet.finding(say("heading.no_row"), accepted))
        return None
    headings = [(cell, plan.find(str(cell.value))) for cell in sheet.row(row)]
    units_row = _find_units_row(sheet, headings, row)
    merged_to = [
        merged.max_row
        for merged in sheet.merged
        if merged.min_row <= row <= merged.max_row and not sheet.rows.get(row + 1)
    ]
    first_data_row = max(row, units_row or row, *merged_to, row) + 1
    first_data_row += is_numbering(sheet.row(first_data_row))
    while _continues_headings(sheet.row(first_data_row)):
        first_data_row += 1
    return Table(
        sheet=sheet,
        plan=plan,
        titles=[
            _read_title(sheet, *heading, units_row, findings) for heading in headings
        ],
        heading_row=row,
        first_data_row=first_data_row,
        columns={},
    )


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
    sheet: Sheet, headings: Sequence[tuple[Cell, Field | None]], heading_row: int
) -> int | None:
    """Row below the headings if more than half of its cells are units.

    An unknown unit does not make it a line of the table: that would hold a number.
    """
    fields = {cell.column: field for cell, field in headings if field}
    below = sheet.row(heading_row + 1)
    cells = [(cell, fields[cell.column]) for cell in below if cell.column in fields]
    measured = [pair for pair in cells if pair[1].units]
    is_row = 2 * sum(is_unit(*pair) for pair in measured) > len(measured)
    has_numbers = is_numbering(below) or any(is_number(*pair) for pair in cells)
    return heading_row + 1 if measured and is_row and not has_numbers else None


def is_numbering(cells: tuple[Cell, ...]) -> bool:
    """A row numbers the columns: (1), (2), (3) and so on."""
    numbers = [str(cell.value).strip(" ()") for cell in cells]
    return len(cells) >= _LEAST_NUMBERED and numbers == [
        str(number) for number in range(1, len(cells) + 1)
    ]


def _continues_headings(cells: tuple[Cell, ...]) -> bool:
    """A row below headings that says units, or what empty cells mean (`office`)."""
    first = normalise(str(cells[0].value)) if cells else ""
    return first in list_texts("unit", "empty")


def find_columns(table: Table, findings: list[Finding]) -> dict[str, Column]:
    """Columns of a table by its titles; what is wrong with these goes to ``findings``.

    Those are missing, unknown, unclear or duplicated headings, and units.
    """
    columns: dict[str, Column] = {}
    unknown: list[Cell] = []
    for title in table.titles:
        cell, field = title.cell, title.field
        if field is None:
            unknown.append(cell)
        elif field.key in columns:
            first = name_column(columns[field.key].number)
            rule = say("heading.twice", name=field.name, column=first)
            findings.append(cell.finding(rule, say("heading.one_column")))
        else:
            unit = _settle_unit(table, title, field, findings)
            columns[field.key] = Column(
                number=cell.column, unit=unit, measure=title.measure
            )
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


def _read_title(
    sheet: Sheet,
    cell: Cell,
    field: Field | None,
    units_row: int | None,
    findings: list[Finding],
) -> Title:
    """Heading with its unit, from its brackets or from the row of units."""
    if field is None:
        return Title(cell, None)
    text = str(cell.value)
    own, full_name = split_heading(text)[0], normalise(text)
    is_name = own != full_name in field.names  # brackets and all
    unit, measure = ("", "") if is_name else find_heading_unit(cell)
    below = sheet.cell(units_row, cell.column) if units_row else None
    if below is None or below.is_blank or not field.units:
        return Title(cell, field, unit, measure)
    unit_below, measure_below = read_unit(below)
    if unit not in ("", unit_below):
        rule = say("heading.other_unit", heading=quote(cell.text))
        findings.append(below.finding(rule, say("accepted.one_unit")))
        return Title(cell, field, None)
    return Title(cell, field, unit_below, measure_below or measure, below)


def _settle_unit(
    table: Table, title: Title, field: Field, findings: list[Finding]
) -> str | None:
    """Unit of a column, as its title says it, or as all of its cells do."""
    cell, unit = title.cell, title.unit
    if unit is None:
        return None
    if not field.units:
        if unit in KNOWN_UNITS and unit != "-":  # a number of another field
            rule = say("heading.unit_not_wanted", unit=unit, name=field.name)
            findings.append(cell.finding(rule, field.name))
        return ""
    if not unit and "-" in field.units:
        return "-"
    if unit in field.units:
        return unit
    if not unit and (own := find_own_unit(table.list_filled(cell.column), field)):
        return own
    place = title.unit_cell or cell
    findings.append(place.finding(*explain_unit(unit, field), field.name))
    return None


_IN_BRACKETS = re.compile(r"[\[(](.*)[\])]")


def find_heading_unit(cell: Cell) -> tuple[str, str]:
    """Unit in the brackets of a heading, and what it measures; empty without them."""
    return _split_measure(split_heading(str(cell.value))[1])


def read_unit(cell: Cell) -> tuple[str, str]:
    """Unit in a cell of its own, and what it measures: "m" and "vertical"."""
    text = str(cell.value).strip()
    bracketed = _IN_BRACKETS.fullmatch(text)
    return _split_measure(normalise_unit(bracketed[1] if bracketed else text))


def _split_measure(unit: str) -> tuple[str, str]:
    return list_choices().get(normalise(unit), (unit, ""))


def is_unit(cell: Cell, field: Field) -> bool:
    """A cell holds a unit; a 1 is a unit only where the field may have none."""
    unit, _ = read_unit(cell)
    is_known = unit in KNOWN_UNITS and (unit != "-" or unit in field.units)
    return is_known or _IN_BRACKETS.fullmatch(str(cell.value).strip()) is not None


def is_number(cell: Cell, field: Field) -> bool:
    """A cell holds a number, and no unit."""
    number = parse_number(cell.value, cell.decimal_mark)
    return not isinstance(number, Refusal) and not is_unit(cell, field)


def find_own_unit(cells: list[Cell], field: Field) -> str:
    """Unit of a column whose heading has none: of all its cells, or of their grades."""
    units = {normalise_unit(cell.own_unit) for cell in cells}
    if units and all(read_grade(cell.value) is not None for cell in cells):
        return field.unit if field.is_grade else ""
    return next(iter(units.intersection(field.units)), "") if len(units) == 1 else ""


def find_near(text: str, fields: Iterable[Field]) -> list[Field]:
    """Fields with a heading so like a text that the text may be that, misspelt."""
    names = {name: field for field in fields for name in field.names}
    own = split_heading(text)[0]
    close = difflib.get_close_matches(own, names, n=2, cutoff=_MISSPELT)
    return list({names[name].key: names[name] for name in close}.values())


def quote_title(field: Field) -> Message:
    """Heading of a field in quotes."""
    return say("finding.in_quotes", text=field.title)


def list_meant(workbook: Workbook, plan: SheetPlan) -> list[Sheet]:
    """Sheets of a workbook that are the planned one."""
    return [sheet for sheet in workbook.sheets if plan.matches(sheet.name)]


def list_near(workbook: Workbook, plan: SheetPlan) -> list[str]:
    """Names of sheets that are not read, near to the planned one's."""
    names = [normalise(name) for name in plan.raw_names]
    return [
        name
        for name in workbook.unread
        if difflib.get_close_matches(normalise(name), names, n=1, cutoff=_MISSPELT)
    ]
