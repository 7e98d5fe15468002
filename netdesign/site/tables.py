"""From a sheet to lines of readings: which lines hold data, what their cells say."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from netdesign.site.cells.cells import Cell, Sheet, Workbook
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import IGNORE
from netdesign.site.columns.fields import Field, SheetPlan, find_item, normalise
from netdesign.site.headings import Table, find_headings
from netdesign.site.readings import (
    Reading,
    Row,
    read_cell,
    read_nothing,
    refuse,
)
from netdesign.site.titles import find_near, list_meant, list_near
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
        findings.extend(_judge_missing(workbook, plan))
        return None
    for double in sheets[1:]:
        rule = say("table.second_sheet", name=plan.title, first=sheets[0].name)
        findings.append(double.finding(rule))
    table = find_headings(sheets[0], plan, findings)
    if table is None:
        return None
    table = replace(table, rows=find_data_rows(table, findings))
    _inspect_layout(table, findings)
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
    return read_answered(table.sheet, cell, field, column.unit, findings)


def read_answered(
    sheet: Sheet, cell: Cell, field: Field, unit: str, findings: list[Finding]
) -> Reading:
    """Read one cell; a word of an office's list as it is answered in its map."""
    answers = {normalise(text): word for text, word in sheet.words.items()}
    answer = answers.get(normalise(cell.text), "") if field.kind == "word" else ""
    if not answer or cell.is_blank:
        return read_cell(cell, field, unit, findings)
    file = sheet.answered_in
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


def _judge_missing(workbook: Workbook, plan: SheetPlan) -> list[Finding]:
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


def _inspect_layout(table: Table, findings: list[Finding]) -> None:
    """Refuse merged cells in the table; note what a reader does not see."""
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
    if sheet.is_hidden:
        findings.append(sheet.finding(say("table.hidden_sheet"), severity="note"))
    first = (sheet.row(row)[0] for row in table.rows if row in sheet.hidden_rows)
    rule = say("table.hidden_row")
    findings.extend(cell.finding(rule, severity="note") for cell in first)
    # cells of other sheets become questions about the net rows that rest on them
    inspected = table.rows if table.plan.name in _NOT_ASKED else (table.heading_row,)
    cells = (
        cell for row in inspected for cell in sheet.row(row) if cell.column in read
    )
    accepted = say("accepted.undoubted")
    findings.extend(cell.finding(cell.doubt, accepted) for cell in cells if cell.doubt)
    rule = say("table.hidden_column")
    headings = (sheet.cell(table.heading_row, number) for number in read)
    findings.extend(
        cell.finding(rule, severity="note")
        for cell in headings
        if cell.column in sheet.hidden_columns
    )
    findings.extend(_refuse_items_above(table))
    _judge_columns_without_heading(table, findings)


_NOT_ASKED = ("project", "declared", "Winter", "Monitoring", "Uncertainty")


def _refuse_items_above(table: Table) -> Iterator[Finding]:
    """Refuse items that stand above the headings of their table."""
    for row in range(1, table.heading_row):
        cells = table.sheet.row(row)
        if len(cells) > 1 and find_item(str(cells[0].value), table.plan.items):
            rule = say("table.above_headings")
            yield cells[0].finding(rule, say("table.below_headings"))


def _judge_columns_without_heading(table: Table, findings: list[Finding]) -> None:
    judged = {column.number for column in table.columns.values()}
    judged |= {cell.column for cell in table.sheet.row(table.heading_row)}
    for row in table.rows:
        for column, cell in table.sheet.rows[row].items():
            if column in judged or cell.is_blank:
                continue
            judged.add(column)
            cover = table.sheet.find_merged(table.heading_row, column)
            first = (cover.min_row, cover.min_col) if cover else ()
            if cover and first != (table.heading_row, column):
                rule = say("table.below_merged", range=cover.coord)
                findings.append(cell.finding(rule, say("table.heading_each")))
            elif table.sheet.is_delimited or (table.plan.items and table.titles):
                # a delimiter too many: what stands here may belong to the left of it
                rule = say("table.no_heading")
                findings.append(cell.finding(rule, say("table.as_many_cells")))
            else:
                findings.append(
                    cell.finding(say("table.no_heading_unread"), severity="note")
                )


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


# Words that mark a single text below a table as a note, not as the start of a line.
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
        Appended to: every filled line that is not read.

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
    passed = {
        row: rule for row in filled if (rule := _find_skip_rule(table, row, filled))
    }
    for row, rule in passed.items():
        cell = sheet.row(row)[0]
        findings.append(cell.finding(rule, severity="note"))
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


def _find_skip_rule(table: Table, row: int, rows: list[int]) -> Message | None:
    """Reason why a line holds no data; None of a line of the table."""
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
    merged = sheet.find_merged(cell.row, cell.column)
    size = merged.size if merged else {"rows": 1, "columns": 1}
    is_merged = size["rows"] == 1 and size["columns"] >= _WIDE
    if is_merged or plan.items:
        return is_merged
    match = _SECTION.match(text)
    if match is None:
        return False
    word = match[0].casefold()  # perhaps that of the ids of this table
    lines = (sheet.row(row) for row in rows)
    return not any(
        len(line) > 1 and str(line[0].value).casefold().startswith(word)
        for line in lines
    )


def _is_total(table: Table, row: int) -> bool:
    """A line sums up others: named so, with a quarter of what a line holds at most."""
    first = table.sheet.row(row)[0]
    if not isinstance(first.value, str) or not _TOTAL.match(first.value.strip()):
        return False
    columns = [column.number for column in table.columns.values()]
    filled = sum(not table.sheet.cell(row, column).is_blank for column in columns)
    return _LINE_OVER_SUM * (filled - 1) <= len(columns)
