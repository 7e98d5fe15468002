"""From a sheet to lines of readings: finds the data rows, reads them field by field."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator
from dataclasses import replace

from netdesign.site.cells.cells import Cell, Sheet, Workbook
from netdesign.site.cells.findings import Finding, add_nearest
from netdesign.site.columns.all_tables import NETS
from netdesign.site.columns.fields import (
    Field,
    SheetPlan,
    find_item,
    normalise,
)
from netdesign.site.columns.lexicon import (
    IGNORE,
    UNANSWERED,
    UNKNOWN,
    Lexicon,
    Meaning,
)
from netdesign.site.headings import Table, find_cover, find_headings
from netdesign.site.readings import (
    Reading,
    Row,
    read_cell,
    read_nothing,
    read_without_unit,
    refuse,
)
from netdesign.site.table_lines import find_data_rows
from netdesign.site.titles import (
    Title,
    explain,
    find_near,
    is_meant,
    quote_title,
    understand,
)
from netdesign.words.catalogue import LANGUAGES
from netdesign.words.message import Message, say

# How alike the name of a sheet must be to a missing one to count as that, misspelt.
_MISSPELT = 0.8


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
    return next(iter(find_tables(workbook, plan, findings)), None)


def find_tables(
    workbook: Workbook, plan: SheetPlan, findings: list[Finding]
) -> tuple[Table, ...]:
    """All sheets of one plan, with their headings; of net rows one a structure."""
    sheets = _find_sheets(workbook, plan, findings)
    is_one = plan.name != NETS.name
    plain = [sheet for sheet in sheets if is_one or plan.matches(sheet.name)]
    for double in plain[1:]:
        rule = say("table.second_sheet", name=plan.title, first=plain[0].name)
        findings.append(double.finding(rule))
    read = [sheet for sheet in sheets if sheet not in plain[1:]]
    found = (_take_table(sheet, plan, findings) for sheet in read)
    return tuple(table for table in found if table is not None)


def _take_table(sheet: Sheet, plan: SheetPlan, findings: list[Finding]) -> Table | None:
    table = find_headings(sheet, plan, findings)
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


def read_field(table: Table, key: str, row: int, findings: list[Finding]) -> Reading:
    """Read one field of one line; a fault goes to ``findings``."""
    field = next(field for field in table.plan.fields if field.key == key)
    return _read_field(table, field, row, findings)


def _read_field(
    table: Table, field: Field, row: int, findings: list[Finding]
) -> Reading:
    column = table.columns.get(field.key)
    if column is None:
        has_instead = any(key in table.columns for key in field.instead)
        if field.required and not has_instead:  # a finding already
            return Reading(field=field, state="faulty")
        return read_nothing(field, None)
    cell = table.sheet.cell(row, column.number)
    if column.unit is None:  # so is the unit
        return read_without_unit(cell, field, findings)
    return read_answered(table.sheet, cell, field, column.unit, findings)


def read_answered(
    sheet: Sheet, cell: Cell, field: Field, unit: str, findings: list[Finding]
) -> Reading:
    """Read one cell; a word that nobody knows as somebody has answered."""
    answer = _find_word(sheet, field, cell)
    if answer:
        return _read_word(sheet, field, cell, answer, findings)
    return read_cell(cell, field, unit, findings)


def _find_word(sheet: Sheet, field: Field, cell: Cell) -> str:
    """Answer to a word that nobody knows; empty where none is needed."""
    if field.kind != "word" or cell.is_blank:
        return ""
    answers = {normalise(text): word for text, word in sheet.words.items()}
    answer = answers.get(normalise(cell.text), "")
    return "" if answer == UNANSWERED else answer


def _read_word(
    sheet: Sheet, field: Field, cell: Cell, answer: str, findings: list[Finding]
) -> Reading:
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


def _find_sheets(
    workbook: Workbook, plan: SheetPlan, findings: list[Finding]
) -> list[Sheet]:
    sheets = [
        sheet
        for sheet in workbook.sheets
        if is_meant(sheet.name, plan, workbook.answers)
    ]
    if not sheets:
        findings.extend(_judge_missing(workbook, plan))
    else:
        findings.extend(_ask_for_copies(workbook, plan, sheets[0].name))
    return sheets


def _ask_for_copies(
    workbook: Workbook, plan: SheetPlan, first: str
) -> Iterator[Finding]:
    """Refuse sheets named as the planned one and something more, until answered."""
    for name in workbook.unread:
        is_open = workbook.answers.sheets.get(name, UNANSWERED) == UNANSWERED
        if is_open and name not in workbook.hidden and plan.begins(name):
            rule = say("table.copy", name=first)
            accepted = say("table.copy_accepted", name=first)
            yield workbook.finding(rule, accepted, name)


def is_about(name: Cell, table: Table) -> bool:
    """A name may mean an item of a table, though perhaps misspelt or unclear."""
    lexicon = Lexicon.of(table.plan.items, table.plan)
    meaning = understand(Title(name), lexicon, table.sheet.answers)
    is_known = bool(meaning.field or meaning.readings or meaning.answer)
    start = _MARKS.split(str(name.value))[0]
    near = (find_item(start, table.plan.items), find_near(start, table.plan.items))
    return is_known or any(near)


def is_near(name: str, plan: SheetPlan) -> bool:
    """A name is that of a planned sheet, perhaps misspelt."""
    known = [normalise(one) for one in plan.raw_names]
    stem = name.removesuffix(".csv")  # of a file: "site - Nets.csv"
    words = {normalise(stem), normalise(re.split("[-_]", stem)[-1])}
    return any(
        difflib.get_close_matches(word, known, n=1, cutoff=_MISSPELT) for word in words
    )


def is_absent(workbook: Workbook, plan: SheetPlan) -> bool:
    """A workbook has no sheet of the plan's name, nor of a name near to it."""
    answers = workbook.answers
    return not any(
        is_meant(sheet.name, plan, answers) for sheet in workbook.sheets
    ) and not any(
        is_near(name, plan) for name in workbook.unread if name not in answers.sheets
    )


def _judge_missing(workbook: Workbook, plan: SheetPlan) -> list[Finding]:
    """Refuse a sheet that seems the missing one, misspelt; or the lack of it."""
    unread = (name for name in workbook.unread if name not in workbook.answers.sheets)
    near = [name for name in unread if is_near(name, plan)]
    wanted = say("finding.in_quotes", text=plan.title)
    if near:
        rule = say("table.close_to_missing", wanted=wanted)
        accepted = say("heading.or_unlike", meant=wanted)
        return [workbook.finding(rule, accepted, near[0])]
    if not plan.required:
        return []
    rule = say("table.lacks_sheet", wanted=wanted)
    # in each language; what else is read would be a list that nobody reads
    names = dict.fromkeys(plan.name_in(one) for one in LANGUAGES)
    accepted = say("table.name_accepted", names=tuple(names))
    return [workbook.finding(rule, accepted)]


def _inspect_layout(table: Table, findings: list[Finding]) -> None:
    """Refuse merged cells in the table; note what a reader does not see."""
    sheet = table.sheet
    read = [column.number for column in table.columns.values()]
    for merged in sheet.merged:
        columns = range(merged.column, merged.last_column + 1)
        rows = range(merged.row, merged.last_row + 1)
        if any(one in columns for one in read) and any(
            one in rows for one in table.rows
        ):
            cell = sheet.cell(merged.row, merged.column)
            rule = say("table.merged", range=merged.text)
            findings.append(cell.finding(rule, say("accepted.single_cells")))
    if sheet.is_hidden:
        findings.append(sheet.finding(say("table.hidden_sheet"), severity="note"))
    hidden = [
        *(
            (sheet.row(row)[0], rule)
            for rule, rows in (
                (say("table.hidden_row"), sheet.hidden_rows),
                (say("table.struck_row"), sheet.struck_rows),
            )
            for row in table.rows
            if row in rows
        ),
        *(
            (sheet.cell(table.heading_row, number), say("table.hidden_column"))
            for number in read
            if number in sheet.hidden_columns
        ),
    ]
    findings.extend(cell.finding(rule, severity="note") for cell, rule in hidden)
    findings.extend(_note_lines_above(table))
    _judge_columns_without_heading(table, findings)


def _note_lines_above(table: Table) -> Iterator[Finding]:
    """Lines above the headings: a title block, or lines of a table put too high."""
    for row in range(1, table.heading_row):
        cells = table.sheet.row(row)
        is_read = any(one.name.row == row for one in table.above)
        if len(cells) < 2 or row in table.group_rows or is_read:
            continue
        item = find_item(str(cells[0].value), table.plan.items)
        yield cells[0].finding(
            say("table.above_headings"),
            say("table.below_headings") if item else "",
            severity="error" if item else "note",
        )


def _judge_columns_without_heading(table: Table, findings: list[Finding]) -> None:
    known = {column.number for column in table.columns.values()}
    known |= {cell.column for cell in table.sheet.row(table.heading_row)}
    for row in table.rows:
        for cell in table.sheet.row(row):
            if cell.column in known:
                continue
            known.add(cell.column)
            cover = find_cover(table.sheet, table.heading_row, cell.column)
            if cover:
                rule = say("table.below_merged", range=cover.text)
                findings.append(cell.finding(rule, say("table.heading_each")))
            elif table.sheet.is_delimited or (table.plan.items and table.titles):
                # a delimiter too many: what stands here may belong to the left of it
                rule = say("table.no_heading")
                findings.append(cell.finding(rule, say("table.as_many_cells")))
            else:
                findings.append(
                    cell.finding(say("table.no_heading_unread"), severity="note")
                )


_MARKS = re.compile(r"[;,|:=\t]")  # what may stand between an item and its value


def match_item(
    name: Reading, table: Table, what: str, findings: list[Finding]
) -> Meaning:
    """Item that a line names.

    Parameters
    ----------
    name : Reading
        Cell with the item's name.
    table : Table
        Its plan lists the items.
    what : str
        ``item`` or ``quantity``; for the finding.
    findings : list of Finding
        Appended to, where no item has that name: a line that cannot be read must
        not end as a default.

    Returns
    -------
    Meaning
        Without a field where there is a finding.
    """
    if name.cell is None:
        return UNKNOWN
    lexicon = Lexicon.of(table.plan.items, table.plan)
    meaning = understand(Title(name.cell), lexicon, table.sheet.answers)
    if meaning.is_ignored:
        rule = say("item.ignored", file=table.sheet.answered_in)
        refuse(name, rule, "", findings, severity="note")
    elif meaning.answer and meaning.field:
        file = table.sheet.answered_in
        rule = say("heading.answered", name=meaning.field.name, file=file)
        refuse(name, rule, "", findings, severity="note")
    elif meaning.field is None:
        refuse(name, *_explain(name.word, table, what, meaning), findings)
    return meaning


def _explain(
    text: str, table: Table, what: str, meaning: Meaning
) -> tuple[Message, Message | str]:
    """Rule and what is accepted."""
    start = _MARKS.split(text)[0]
    lexicon = Lexicon.of(table.plan.items, table.plan)
    for one in (meaning, lexicon.match(start)):
        if refusal := explain(one, table.sheet):
            return refusal
    both = find_item(start, table.plan.items)
    if both and start != text:
        is_item = what == "item"
        rule = say("item.in_one_cell" if is_item else "item.quantity_in_one_cell")
        return rule, say("item.alone", name=quote_title(both))
    rule = say("item.unknown" if what == "item" else "item.unknown_quantity")
    names = tuple(field.title for field in table.plan.items)
    known = [name for field in table.plan.items for name in field.raw_names]
    accepted = say("item.accepted", names=names)
    return rule, add_nearest(accepted, start.strip(), dict.fromkeys(known, ""))
