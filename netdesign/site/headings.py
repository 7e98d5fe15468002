"""Finds the headings of a sheet: in any order, merged or grouped, with their units."""

from __future__ import annotations

import difflib
import re
from collections.abc import Mapping
from dataclasses import dataclass

from netdesign.site.cells.cells import Cell, MergedRange, Sheet, name_column
from netdesign.site.cells.findings import Finding, Refusal, quote
from netdesign.site.cells.numbers import parse_number
from netdesign.site.columns.fields import (
    LANGUAGES,
    Field,
    Language,
    SheetPlan,
    normalise,
    split_heading,
)
from netdesign.site.columns.unit_names import (
    KNOWN_UNITS,
    UNCLEAR_UNITS,
    convert_unit,
    normalise_unit,
)
from netdesign.site.readings import refuse_stored
from netdesign.words.message import Message, say

_LAST_HEADING_ROW = 20  # a title block may stand above the headings
_UNITS_WORDS = ("", "unit", "units", "unite", "unites", "einheit", "einheiten")
# How alike a heading must be to a missing one to count as that, misspelt.
_MISSPELT = 0.8


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """Place of a field and the unit of its numbers.

    The unit is empty for words and ids, and None where a finding refused it.
    """

    number: int
    unit: str | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Headings:
    """Rows and columns of the headings.

    Attributes
    ----------
    row : int
        The row that names the fields; groups may stand above it.
    first_data_row : int
        Below headings and units.
    columns : mapping of str to Column
        By field key; absent headings are absent.
    language : str
        That of most of the headings.
    group_rows : frozenset of int
        Rows above that hold merged groups of headings, or headings merged downwards.
    """

    row: int
    first_data_row: int
    columns: Mapping[str, Column]
    language: Language
    group_rows: frozenset[int] = frozenset()


@dataclass(frozen=True, slots=True)
class _Title:
    """One heading: the cell that holds it and the group that it belongs to."""

    cell: Cell
    group: str

    @property
    def names(self) -> tuple[str, ...]:
        """Possible names, those with its group first: ``anchor | foot``, ``foot``."""
        own, _ = split_heading(str(self.cell.value))
        group, _ = split_heading(self.group)
        grouped = (group + own, own + group) if group else ()
        return (*grouped, own)

    @property
    def unit(self) -> str:
        """Unit in its brackets, or in those of its group."""
        return split_heading(str(self.cell.value))[1] or split_heading(self.group)[1]


def find_headings(
    sheet: Sheet, plan: SheetPlan, findings: list[Finding]
) -> Headings | None:
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
    Headings or None
        None if there is no row of headings; that is a finding.
    """
    row = _find_row(sheet, plan)
    if row is None:
        wanted = tuple(quote_title(field) for field in plan.fields[:3])
        accepted = say("heading.such_as", headings=wanted)
        refusal = Refusal(say("heading.no_row"), accepted)
        findings.append(sheet.finding(refusal))
        return None
    units_row = _find_units_row(sheet, plan, row, findings)
    merged_to = [
        merged.last_row
        for merged in sheet.merged
        if merged.row <= row <= merged.last_row and not sheet.rows.get(row + 1)
    ]
    first_data_row = max(row, units_row or row, *merged_to, row) + 1
    columns = _find_columns(sheet, plan, row, units_row, first_data_row, findings)
    names = {name for title in _list_titles(sheet, row) for name in title.names}
    return Headings(
        row=row,
        first_data_row=first_data_row,
        columns=columns,
        language=plan.find_language(names),
        group_rows=frozenset(
            above
            for merged in sheet.merged
            for above in range(merged.row, merged.last_row + 1)
            if merged.last_row >= row - 1 and above < row
        ),
    )


def _list_titles(sheet: Sheet, row: int) -> list[_Title]:
    """Headings of a row; a cell merged downwards into it counts as in the row."""
    cells = {cell.column: cell for cell in sheet.row(row)}
    for merged in sheet.merged:
        if merged.row < row <= merged.last_row and merged.column == merged.last_column:
            cell = sheet.cell(merged.row, merged.column)
            if not cell.is_blank:
                cells.setdefault(merged.column, cell)
    return [
        _Title(cells[column], _find_group(sheet, row, column))
        for column in sorted(cells)
    ]


def _find_group(sheet: Sheet, row: int, column: int) -> str:
    """Text of a cell just above that is merged across this column and others."""
    for merged in sheet.merged:
        is_wide = merged.last_column > merged.column and merged.last_row == row - 1
        if is_wide and merged.covers(row - 1, column):
            return str(sheet.cell(merged.row, merged.column).value or "")
    return ""


def _match_field(title: _Title, plan: SheetPlan) -> Field | None:
    for name in title.names:
        for field in plan.fields:
            if name in field.names:
                return field
    return None


def _find_row(sheet: Sheet, plan: SheetPlan) -> int | None:
    """Row with the most known headings; one alone may be a title by chance."""
    known = {name for field in plan.fields for name in field.names} | {
        normalise(name) for name in plan.unclear
    }
    counts = {
        row: sum(
            not known.isdisjoint(title.names) for title in _list_titles(sheet, row)
        )
        for row in range(1, _last_row(sheet) + 1)
    }
    best = max(counts, key=lambda row: counts[row], default=0)
    return best if best and counts[best] >= 2 else None


def _last_row(sheet: Sheet) -> int:
    """Last row that headings are looked for in, counted from the first filled one."""
    first = next((row for row in sheet.rows if sheet.row(row)), 1)
    return first + _LAST_HEADING_ROW - 1


def _find_units_row(
    sheet: Sheet, plan: SheetPlan, heading_row: int, findings: list[Finding]
) -> int | None:
    """Row below the headings if it holds units; other texts in it are findings.

    One unit that nobody knows does not make it a line of the table, which would have
    a number somewhere.
    """
    titles = {title.cell.column: title for title in _list_titles(sheet, heading_row)}
    fields = {column: _match_field(title, plan) for column, title in titles.items()}
    cells = [
        (cell, field)
        for cell in sheet.row(heading_row + 1)
        if (field := fields.get(cell.column))
    ]
    measured = [(cell, field) for cell, field in cells if field.units]
    others = [one for one in cells if one not in measured]
    known = sum(_is_unit(*one) for one in measured)
    strangers = [cell for cell, field in others if not _is_unit(cell, field)]
    has_units_above = any(titles[cell.column].unit for cell, _ in measured)
    is_row = 2 * known > len(measured) or not (strangers or has_units_above)
    if not measured or not is_row or any(_is_number(*one) for one in cells):
        return None
    for cell in strangers:
        if normalise(str(cell.value)) not in _UNITS_WORDS:
            rule = say("heading.in_units_row")
            refusal = Refusal(rule, say("heading.units_or_empty"))
            findings.append(cell.finding(refusal))
    return heading_row + 1


def _is_unit(cell: Cell, field: Field) -> bool:
    """A cell holds a unit; a 1 is one only where the field may have none."""
    unit, in_brackets = _read_unit(cell)
    is_known = unit in KNOWN_UNITS and (unit != "-" or unit in field.units)
    return in_brackets or is_known


def _is_number(cell: Cell, field: Field) -> bool:
    number = parse_number(cell.value, cell.decimal_mark)
    return not isinstance(number, Refusal) and not _is_unit(cell, field)


def _read_unit(cell: Cell) -> tuple[str, bool]:
    """Read a unit in a cell of its own, and whether it stands in brackets."""
    text = str(cell.value).strip()
    bracketed = re.fullmatch(r"[\[(](.*)[\])]", text)
    return normalise_unit(bracketed[1] if bracketed else text), bracketed is not None


def _find_columns(
    sheet: Sheet,
    plan: SheetPlan,
    row: int,
    units_row: int | None,
    first_data_row: int,
    findings: list[Finding],
) -> dict[str, Column]:
    columns: dict[str, Column] = {}
    claimed: set[str] = set()  # by headings that are refused as unclear
    unknown: list[Cell] = []
    for title in _list_titles(sheet, row):
        cell, field = title.cell, _match_field(title, plan)
        unclear = plan.find_unclear(title.names[-1])
        if field is None and unclear:
            readings = tuple(quote_title(one) for one in unclear)
            rule = say("heading.ambiguous", readings=readings)
            refusal = Refusal(rule, say("heading.one_of_these"))
            findings.append(cell.finding(refusal))
            claimed |= {one.key for one in unclear}
        elif field is None:
            unknown.append(cell)
        elif field.key in columns:
            first = name_column(columns[field.key].number)
            rule = say("heading.twice", name=field.name, column=first)
            refusal = Refusal(rule, say("heading.one_column"))
            findings.append(cell.finding(refusal))
        else:
            below = sheet.cell(units_row, cell.column) if units_row else None
            example = sheet.cell(first_data_row, cell.column)
            unit = _find_unit(title, below, example, field, findings)
            columns[field.key] = Column(number=cell.column, unit=unit)
    missing = [field for field in plan.fields if field.key not in columns]
    findings.extend(_judge_unknown(cell, plan, missing) for cell in unknown)
    _report_missing(sheet, plan, {*columns, *claimed}, findings)
    return columns


def _judge_unknown(cell: Cell, plan: SheetPlan, missing: list[Field]) -> Finding:
    """Note a column that is not read; refuse one that seems a missing one, misspelt."""
    if stored := refuse_stored(cell):
        return cell.finding(stored)
    name, _ = split_heading(str(cell.value))
    names = {known: field for field in missing for known in field.names}
    close = difflib.get_close_matches(name, names, n=1, cutoff=_MISSPELT)
    if close:
        meant = quote_title(names[close[0]])
        rule = say("heading.close_to_missing", meant=meant)
        return cell.finding(Refusal(rule, say("heading.or_unlike", meant=meant)))
    refusal = Refusal(say("heading.unknown"), _name_nearest(str(cell.value), plan))
    return cell.finding(refusal, severity="note")


def quote_title(field: Field) -> Message:
    """Heading of a field in quotes."""
    return say("finding.in_quotes", text=field.title)


def _name_nearest(text: str, plan: SheetPlan) -> Message:
    """A known heading, with those whose names in any language are near to a text."""
    known = {
        field.heading_for(language): field
        for language in LANGUAGES
        for field in plan.fields
    }
    near = difflib.get_close_matches(text, known, n=3)
    titles = {known[name].key: quote_title(known[name]) for name in near}
    accepted = say("heading.known")
    if not titles:
        return accepted
    return say("finding.nearest", accepted=accepted, near=tuple(titles.values()))


def _find_unit(
    title: _Title,
    below: Cell | None,
    example: Cell,
    field: Field,
    findings: list[Finding],
) -> str | None:
    """Take the unit of a column from its heading or from the row of units."""
    if not field.units:
        return ""
    unit, cell = title.unit, title.cell
    if below is not None and not below.is_blank:
        unit_below, _ = _read_unit(below)
        if unit not in ("", unit_below):
            rule = say("heading.other_unit", heading=quote(cell.text))
            findings.append(below.finding(Refusal(rule, say("accepted.one_unit"))))
            return None
        unit, cell = unit_below, below
    if not unit and "-" in field.units:
        return "-"
    if unit in field.units:
        return unit
    rule = _describe_missing_unit(example, field)
    if unit:
        unclear = UNCLEAR_UNITS.get(unit)
        rule = (
            say("heading.unclear_unit", readings=unclear)
            if unclear
            else say("heading.unknown_unit")
        )
    refusal = Refusal(rule, name_units(field))
    findings.append(cell.finding(refusal, field.name))
    return None


def name_units(field: Field) -> Message:
    """Units that a column may have, in brackets."""
    units = tuple(f"[{unit}]" for unit in field.units)
    return say("accepted.units", units=units)


def _describe_missing_unit(example: Cell, field: Field) -> Message:
    """Say that a column has no unit, and what its first number could be in each."""
    number = parse_number(example.value, example.decimal_mark)
    if isinstance(number, Refusal):
        return say("heading.no_unit")
    readings: list[str] = []
    for unit in field.units:
        value = convert_unit(number, unit, field.unit)
        if field.bounds[0] <= value <= field.bounds[1]:
            same = "" if unit == field.unit else f" ({value:.4g} {field.unit})"
            readings.append(f"{number:g} {unit}{same}")
    if len(readings) < 2:
        return say("heading.no_unit")
    return say(
        "heading.no_unit_could_be", cell=example.address, readings=tuple(readings)
    )


def _report_missing(
    sheet: Sheet, plan: SheetPlan, found: set[str], findings: list[Finding]
) -> None:
    missing = [
        say("heading.lacks", heading=field.title)
        for field in plan.fields
        if field.required and field.key not in found
    ]
    if plan.one_of and found.isdisjoint(plan.one_of):
        fields = [field for field in plan.fields if field.key in plan.one_of]
        headings = tuple(map(quote_title, fields))
        missing.append(say("heading.lacks_one_of", headings=headings))
    findings.extend(sheet.finding(Refusal(rule)) for rule in missing)


def find_cover(sheet: Sheet, row: int, column: int) -> MergedRange | None:
    """Merged range that hides a cell behind its first one, if there is one."""
    for merged in sheet.merged:
        if merged.covers(row, column) and (merged.row, merged.column) != (row, column):
            return merged
    return None
