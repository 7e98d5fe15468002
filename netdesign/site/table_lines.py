"""Lines of a table: which hold data, and which a heading, a total or a note between."""

from __future__ import annotations

import re
from itertools import pairwise

from netdesign.site.cells.cells import Cell, Sheet
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.fields import SheetPlan, find_item, normalise
from netdesign.site.headings import Table
from netdesign.words.message import Message, say

# What makes a single text below a table a note and not the start of another line.
_NOTE_WORD = (
    r"(notes?|nota|nb|n\.b|remarks?|remarques?|sources?|anm|anmerkung|bemerkung|hinweis"
    r"|quelle|osservazion[ei])\b"
)
_NOTE = re.compile(_NOTE_WORD, re.IGNORECASE)
_MARKED_NOTE = re.compile(rf"\*|{_NOTE_WORD}\s*[.:]", re.IGNORECASE)
_NOTE_WORDS = 4
_CUTS = (";", ",", "\t", "|")  # one of them may be the delimiter of a line
_TOTAL = re.compile(
    r"(sous-?\s?)?(total|totaux|somme)\b|sub-?total|(zwischen)?summe\b|gesamt"
    r"|(sub)?total[ei]\b|somma\b|sums?\b",
    re.IGNORECASE,
)
_SECTION = re.compile(
    r"(secteur|zone|lot|tronçon|versant|couloir|sector|section|area|abschnitt|sektor"
    r"|zone|los|hang|settore|zona|lotto|tratto|versante)\b",
    re.IGNORECASE,
)
_LINE_OVER_SUM = 4  # numbers of a line, at least, for each of a sum
_WIDE = 3  # columns of a merged cell that heads a part of a table


def find_data_rows(table: Table, findings: list[Finding]) -> tuple[int, ...]:
    """Rows of a table that hold data.

    Parameters
    ----------
    table : Table
        The sheet with its headings.
    findings : list of Finding
        Appended to: every filled line that is not read, and gaps in the table.

    Returns
    -------
    tuple of int
        Ascending numbers of rows.
    """
    sheet, plan, first_row = table.sheet, table.plan, table.first_data_row
    # no line of a table of items may be taken for a note: its value would be lost
    width = 0 if plan.items else len(table.columns)
    filled = sorted(row for row in sheet.rows if row >= first_row and sheet.row(row))
    while filled and _is_note(sheet.row(filled[-1]), width):
        cell = sheet.row(filled.pop())[0]
        findings.append(cell.finding(say("table.note_below"), severity="note"))
    passed = {row: rule for row in filled if (rule := _find_other(table, row, filled))}
    for row, rule in passed.items():
        cell = sheet.row(row)[0]
        findings.append(cell.finding(rule, severity="note"))
    for above, row in pairwise((first_row - 1, *filled)):
        is_at_part = above in passed or row in passed
        is_whole = not plan.items and _is_whole(table, row)
        if row == above + 1 or is_at_part or not table.titles:
            continue
        empty = sheet.cell(above + 1, 1)
        if is_whole:
            findings.append(empty.finding(say("table.gap"), severity="note"))
        else:
            findings.append(
                empty.finding(say("table.empty_row"), say("table.without_gaps"))
            )
    return tuple(row for row in filled if row not in passed)


def _is_note(cells: tuple[Cell, ...], width: int) -> bool:
    """A row holds a note: a single text of so many words that it begins no line.

    A text that another delimiter would cut into a line of the table of ``width``
    columns is that line; without a width only a text marked as a note is one.
    """
    if len(cells) != 1 or not isinstance(cells[0].value, str) or cells[0].formula:
        return False
    text = cells[0].value.strip()
    if _MARKED_NOTE.match(text):
        return True
    parts = 1 + max(text.count(mark) for mark in _CUTS)
    if not width or (parts > 1 and 2 * parts >= width):
        return False
    return bool(_NOTE.match(text)) or len(text.split()) >= _NOTE_WORDS


def _find_other(table: Table, row: int, rows: list[int]) -> Message | None:
    """Rule of a line that holds no data; None of a line of the table."""
    cells = table.sheet.row(row)
    if _repeats_headings(table, cells):
        return say("table.headings_again")
    if _is_part(table.sheet, table.plan, cells, rows):
        return say("table.part")
    if _is_total(table, row):
        return say("table.total")
    return None


def _repeats_headings(table: Table, cells: tuple[Cell, ...]) -> bool:
    above = table.sheet.rows.get(table.heading_row, {})
    return len(cells) > 1 and all(
        cell.column in above
        and normalise(cell.text) == normalise(above[cell.column].text)
        for cell in cells
    )


def _is_part(
    sheet: Sheet, plan: SheetPlan, cells: tuple[Cell, ...], rows: list[int]
) -> bool:
    """A line heads a part of the table: one text, merged wide or named as a part."""
    if len(cells) != 1 or not isinstance(cells[0].value, str) or cells[0].formula:
        return False
    cell, text = cells[0], cells[0].value.strip()
    if find_item(text, plan.items):
        return False
    is_merged = any(
        merged.covers(cell.row, cell.column)
        and merged.row == merged.last_row
        and merged.last_column - merged.column + 1 >= _WIDE
        for merged in sheet.merged
    )
    if is_merged or plan.items:
        return is_merged
    named = _SECTION.match(text)
    if named is None:
        return False
    word = named[0].casefold()  # perhaps that of the ids of this table
    others = (sheet.row(row) for row in rows)
    return not any(
        len(one) > 1 and str(one[0].value).casefold().startswith(word) for one in others
    )


def _is_total(table: Table, row: int) -> bool:
    """A line sums up others: named so, with a quarter of what a line holds at most."""
    first = table.sheet.row(row)[0]
    if not isinstance(first.value, str) or not _TOTAL.match(first.value.strip()):
        return False
    columns = [column.number for column in table.columns.values()]
    filled = sum(not table.sheet.cell(row, column).is_blank for column in columns)
    return _LINE_OVER_SUM * (filled - 1) <= len(columns)


def _is_whole(table: Table, row: int) -> bool:
    """A line has all that a line of the table needs."""
    needed = _list_needed(table)
    return len(needed) > 1 and not any(
        table.sheet.cell(row, column).is_blank for column in needed
    )


def _list_needed(table: Table) -> list[int]:
    """Columns that every line of a table fills in."""
    return [
        table.columns[field.key].number
        for field in table.plan.fields
        if field.required and not field.instead and field.key in table.columns
    ]
