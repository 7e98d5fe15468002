"""From a sheet to lines of readings: which lines hold data, what their cells say."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache

from netdesign.site.cells.cells import Cell, Workbook
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import IGNORE, load_file
from netdesign.site.columns.fields import Field, SheetPlan, find_item, normalise
from netdesign.site.headings import (
    Table,
    find_columns,
    find_headings,
    find_near,
    list_meant,
    list_near,
)
from netdesign.site.readings import (
    Reading,
    Row,
    read_cell,
    read_nothing,
    refuse,
)
from netdesign.words.catalogue import LANGUAGES
from netdesign.words.message import Message, say


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
        Appended to: missing or duplicated headings, units, merged cells.

    Returns
    -------
    Table or None
        None if the sheet or its row of headings is missing; that is a finding
        unless the plan does not require the sheet.
    """
    sheets = list_meant(workbook, plan)
    if not sheets:
        findings.extend(judge_missing(workbook, plan))
        return None
    for double in sheets[1:]:
        rule = say("table.second_sheet", name=plan.title, first=sheets[0].name)
        findings.append(double.finding(rule))
    table = find_headings(sheets[0], plan, findings)
    return complete_table(table, findings) if table else None


def complete_table(table: Table, findings: list[Finding]) -> Table:
    """Table with its columns and lines; what is wrong with them goes to findings."""
    table = replace(table, columns=find_columns(table, findings))
    table = replace(table, rows=find_data_rows(table, findings))
    inspect_layout(table, findings)
    return table


def read_rows(table: Table | None, findings: list[Finding]) -> list[Row]:
    """Lines of a table, field by field; none without it. Faults go to ``findings``."""
    if table is None:
        return []
    return [
        {
            field.key: _read_field(table, field, row, findings)
            for field in table.plan.fields
        }
        for row in table.rows
    ]


def _read_field(
    table: Table, field: Field, row: int, findings: list[Finding]
) -> Reading:
    column = table.columns.get(field.key)
    if column is None:
        if field.required:  # a finding already
            return Reading(field=field, state="faulty")
        return read_nothing(field, None)
    cell = table.sheet.cell(row, column.number)
    if column.unit is None:  # a finding already
        return Reading(field=field, state="faulty", text=cell.text, cell=cell)
    return _read_answered(table, cell, field, column.unit, findings)


def _read_answered(
    table: Table, cell: Cell, field: Field, unit: str, findings: list[Finding]
) -> Reading:
    """Read one cell; a word of an office's list as it is answered in its map."""
    answers = {normalise(text): word for text, word in table.words.items()}
    answer = answers.get(normalise(cell.text), "") if field.kind == "word" else ""
    if not answer or cell.is_blank:
        return read_cell(cell, field, unit, findings)
    file = table.answered_in
    if answer == IGNORE:
        rule = say("heading.word_ignored", file=file)
        findings.append(cell.finding(rule, severity="note"))
        return read_nothing(field, cell)
    reading = read_cell(replace(cell, value=answer), field, "", findings)
    if reading.state != "given":
        return reading
    word = field.name_word(reading.word)
    rule = say("heading.word_answered", word=word, file=file)
    findings.append(cell.finding(rule, severity="note"))
    return replace(reading, text=cell.text, cell=cell)


def judge_missing(workbook: Workbook, plan: SheetPlan) -> list[Finding]:
    """Refuse a sheet whose name seems misspelt; else the lack of the sheet."""
    near = list_near(workbook, plan)
    wanted = say("finding.in_quotes", text=plan.title)
    if near:
        rule = say("table.close_to_missing", wanted=wanted)
        accepted = say("heading.or_unlike", meant=wanted)
        return [workbook.finding(rule, accepted, near[0])]
    if not plan.required:
        return []
    rule = say("table.lacks_sheet", wanted=wanted)
    # only the name in each language: all that are accepted would be a long list
    names = dict.fromkeys(plan.name_in(language) for language in LANGUAGES)
    accepted = say("table.name_accepted", names=tuple(names))
    return [workbook.finding(rule, accepted)]


def inspect_layout(table: Table, findings: list[Finding]) -> None:
    """Refuse merged cells in the table, and cells in doubt; note what is not read."""
    sheet = table.sheet
    read = [column.number for column in table.columns.values()]
    for merged in sheet.merged:
        columns = range(merged.min_col, merged.max_col + 1)
        rows = range(merged.min_row, merged.max_row + 1)
        if any(number in columns for number in read) and any(
            row in rows for row in table.rows
        ):
            cell = sheet.cell(merged.min_row, merged.min_col)
            rule = say("table.merged", range=merged.coord)
            findings.append(cell.finding(rule, say("accepted.single_cells")))
    # cells of other sheets become questions about the net rows that rest on them
    inspected = table.rows if table.plan.name in _NOT_ASKED else (table.heading_row,)
    cells = (
        cell for row in inspected for cell in sheet.row(row) if cell.column in read
    )
    accepted = say("accepted.undoubted")
    findings.extend(cell.finding(cell.doubt, accepted) for cell in cells if cell.doubt)
    _judge_columns_without_heading(table, findings)


_NOT_ASKED = ("project", "declared", "Winter", "Monitoring", "Uncertainty")


def _judge_columns_without_heading(table: Table, findings: list[Finding]) -> None:
    judged = {column.number for column in table.columns.values()}
    judged |= {cell.column for cell in table.sheet.row(table.heading_row)}
    # a delimiter too many: what stands here may belong to the left of it
    is_shifted = table.sheet.is_delimited or bool(table.plan.items)
    for row in table.rows:
        for cell in table.sheet.row(row):
            if cell.column in judged:
                continue
            judged.add(cell.column)
            if is_shifted:
                rule = say("table.no_heading")
                findings.append(cell.finding(rule, say("table.as_many_cells")))
            else:
                rule = say("table.no_heading_unread")
                findings.append(cell.finding(rule, severity="note"))


def match_item(
    name: Reading, items: tuple[Field, ...], findings: list[Finding]
) -> Field | None:
    """Item that a line names; none is a finding: it must not end as a default."""
    field = find_item(name.word, items)
    if field is None:
        likely = find_near(name.word, items) or items
        accepted = say("item.accepted", names=tuple(item.title for item in likely))
        refuse(name, say("item.unknown"), accepted, findings)
    return field


_CUTS = (";", ",", "\t", "|")  # one of them may be the delimiter of a line
_NOTE_WORDS = 4  # of a single text, which begins no line
_LINE_OVER_SUM = 4  # numbers of a line, at least, for each of a sum


@cache
def _load_words(kind: str) -> re.Pattern[str]:
    """Words with which a line begins that holds no data: ``part``, ``total``."""
    words = map(re.escape, load_file("heading_words")["lines"][kind])
    return re.compile(rf"({'|'.join(words)})\b", re.IGNORECASE)


def find_data_rows(table: Table, findings: list[Finding]) -> tuple[int, ...]:
    """Rows of a table that hold data; every other filled line is a note.

    Parameters
    ----------
    table : Table
        The sheet with its headings.
    findings : list of Finding
        Appended to.

    Returns
    -------
    tuple of int
        Ascending numbers of rows.
    """
    sheet, rows = table.sheet, []
    for row in (row for row in sorted(sheet.rows) if row >= table.first_data_row):
        cells = sheet.row(row)
        rule = _find_skip_rule(table, cells) if cells else None
        if rule:
            findings.append(cells[0].finding(rule, severity="note"))
        elif cells:
            rows.append(row)
    return tuple(rows)


def _find_skip_rule(table: Table, cells: tuple[Cell, ...]) -> Message | None:
    """Reason why a line holds no data; None of a line of the table."""
    if not isinstance(cells[0].value, str) or cells[0].formula:
        return None
    text = cells[0].value.strip()
    if len(cells) == 1 and _is_note(table, text):
        return say("table.note")
    numbers = {column.number for column in table.columns.values()}
    filled = sum(cell.column in numbers for cell in cells)
    is_short = _LINE_OVER_SUM * (filled - 1) <= len(table.columns)
    if is_short and _load_words("total").match(text):
        return say("table.total")
    headings = {title.cell.column: normalise(title.cell.text) for title in table.titles}
    is_again = all(headings.get(x.column) == normalise(x.text) for x in cells)
    return say("table.headings_again") if is_again and len(cells) > 1 else None


def _is_note(table: Table, text: str) -> bool:
    """A line of a single text is a note, or the name of a part of the table.

    It has so many words that it begins no line, or begins with a word of a note. No
    line of items is a note without such a word: its value would be lost.
    """
    if text.startswith("*") or _load_words("note").match(text):
        return True
    parts = 1 + max(text.count(mark) for mark in _CUTS)  # by another delimiter
    if table.plan.items or (parts > 1 and 2 * parts >= len(table.columns)):
        return False
    return bool(_load_words("part").match(text)) or len(text.split()) >= _NOTE_WORDS
