"""Meaning of the name of a sheet, heading or item: as answered, else by its text.

Answers stand beside a workbook in ``SITE.map.toml``. ``netdesign map`` writes the file
with what is asked; the engineer fills it in; every later run reads it by itself.
"""

from __future__ import annotations

import difflib
import hashlib
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

from netdesign.edge.input_files import (
    MAX_TOML_BYTES,
    is_there,
    parse_toml,
    read_bounded,
)
from netdesign.edge.input_files import explain as explain_cause
from netdesign.outcome import ContentError
from netdesign.site.cells.cells import (
    UNASKED,
    Answers,
    Cell,
    Sheet,
    Workbook,
    name_column,
)
from netdesign.site.cells.findings import (
    Finding,
    Refusal,
    note_file,
    quote,
    refuse_file,
)
from netdesign.site.cells.numbers import parse_number, read_grade
from netdesign.site.columns.all_tables import (
    IGNORE,
    NETS,
    RANGES,
    SHEETS,
    UNANSWERED,
    Lexicon,
    Meaning,
)
from netdesign.site.columns.fields import (
    KNOWN_UNITS,
    Field,
    SheetPlan,
    convert_unit,
    normalise,
    normalise_unit,
    split_heading,
)
from netdesign.site.readings import IN_CELLS, explain_unit
from netdesign.words.message import Message, say

# How alike a heading or the name of a sheet must be to a missing one, misspelt.
_MISSPELT = 0.8
_COLUMN = re.compile(r"([A-Z]{1,3}): (.*)", re.DOTALL)  # of an answer


def name_asked(cell: Cell) -> str:
    """Heading as a file of answers names it."""
    return " ".join(str(cell.value).split())


def find_heading_unit(cell: Cell) -> str:
    """Unit in the brackets of a heading; empty where there is none."""
    return split_heading(str(cell.value))[1]


def understand(cell: Cell, lexicon: Lexicon, answers: Mapping[str, str]) -> Meaning:
    """Meaning of a heading: as answered, else by its text.

    An answer names a field by its key, or by a heading of any language.
    """
    given = (answer for key, answer in answers.items() if is_asked(cell, key))
    answer = next(given, "")
    if not answer:
        return lexicon.match(str(cell.value))
    if answer == UNANSWERED and (known := lexicon.match(str(cell.value))).field:
        return known  # asked before it was understood
    if answer in (IGNORE, UNANSWERED):
        return Meaning(answer=answer)
    field = lexicon.fields.get(answer.partition("[")[0].strip())
    meaning = Meaning(field) if field else lexicon.match(answer)
    return replace(meaning, answer=answer, unit=split_heading(answer)[1])


def is_asked(cell: Cell, key: str) -> bool:
    """A key of the answers names this heading."""
    in_column = _COLUMN.fullmatch(key)
    if in_column and in_column[1] != name_column(cell.column):
        return False
    asked = normalise(in_column[2] if in_column else key)
    text = str(cell.value)
    names = {normalise(one) for one in (text, text.partition("[")[0])}
    return asked in names | {split_heading(text)[0]}


def is_unit(cell: Cell, field: Field) -> bool:
    """A cell holds a unit; a 1 is one only where the field may have none."""
    unit, in_brackets = read_unit(cell)
    is_known = unit in KNOWN_UNITS and (unit != "-" or unit in field.units)
    return in_brackets or is_known


def is_number(cell: Cell, field: Field) -> bool:
    """A cell holds a number, and no unit."""
    number = parse_number(cell.value, cell.decimal_mark)
    return not isinstance(number, Refusal) and not is_unit(cell, field)


def read_unit(cell: Cell) -> tuple[str, bool]:
    """Read a unit in a cell of its own, and whether it stands in brackets."""
    text = str(cell.value).strip()
    bracketed = re.fullmatch(r"[\[(](.*)[\])]", text)
    return normalise_unit(bracketed[1] if bracketed else text), bracketed is not None


def find_own_unit(cells: list[Cell], field: Field) -> str:
    """Unit of a column whose heading has none: in its cells, or that of a grade."""
    if any(normalise_unit(cell.own_unit) in field.units for cell in cells):
        return IN_CELLS
    has_grades = cells and all(read_grade(cell.value) is not None for cell in cells)
    return field.unit if field.is_grade and has_grades else ""


def refuse_unit(unit: str, cells: list[Cell], field: Field) -> Refusal:
    """Reason why a column has no unit that its field knows."""
    plain = explain_unit(unit, field)
    return plain if unit else Refusal(_describe_missing_unit(cells, field), *plain[1:])


def _describe_missing_unit(cells: list[Cell], field: Field) -> Message:
    """Say that a column has no unit, and what its first number could be in each."""
    if not cells:
        return say("heading.no_unit")
    example = cells[0]
    number = parse_number(example.value, example.decimal_mark)
    if isinstance(number, Refusal):
        return say("heading.no_unit")
    readings: list[Message] = []
    for unit in field.units:
        value = convert_unit(number, unit, field.unit)
        if field.bounds[0] <= value <= field.bounds[1]:
            readings.append(_describe_reading(number, unit, value, field.unit))
    if len(readings) < 2:
        return say("heading.no_unit")
    return say(
        "heading.no_unit_could_be", cell=example.address, readings=tuple(readings)
    )


def _describe_reading(
    number: float, unit: str, other: float, other_unit: str
) -> Message:
    """A number with the unit that it may have, and what it is in the field's unit."""
    if unit == other_unit:
        return say("text.number_in", number=number, unit=unit)
    return say(
        "text.number_in_two",
        number=number,
        unit=unit,
        other=other,
        other_unit=other_unit,
    )


def explain(meaning: Meaning, sheet: Sheet) -> Refusal | None:
    """Reason why a heading is not read; None where nobody knows it."""
    if meaning.is_ignored:
        return Refusal(say("heading.ignored", file=sheet.answered_in))
    if UNANSWERED in meaning.answer:
        rule = say("heading.unanswered", file=sheet.answered_in)
        return Refusal(rule, say("heading.unanswered_wanted"))
    if meaning.answer and meaning.field is None:  # it names no heading, or several
        rule = say("heading.wrong_answer", answer=quote(meaning.answer))
        return Refusal(rule, say("heading.answer_wanted", file=sheet.answered_in))
    if not meaning.readings:
        return None
    readings = tuple(quote_title(one) for one in meaning.readings)
    rule = say("heading.ambiguous", readings=readings)
    return Refusal(rule, say("heading.one_of_these"))


def find_near(text: str, fields: Iterable[Field]) -> list[Field]:
    """Fields with a heading so like a text that the text may be that, misspelt."""
    names = {name: one for one in fields for name in one.names}
    own = split_heading(text)[0]
    close = difflib.get_close_matches(own, names, n=2, cutoff=_MISSPELT)
    return list({names[one].key: names[one] for one in close}.values())


def quote_title(field: Field) -> Message:
    """Heading of a field in quotes."""
    return say("finding.in_quotes", text=field.title)


SCHEMA = "netdesign.map/1"
MARKS: Mapping[str, Literal["", ",", "."]] = {"": "", "comma": ",", "point": "."}
_KEYS = ("schema", "workbook", "decimal_mark", "sheets", "headings", "words", "ranges")


def name_map(site_file: Path) -> Path:
    """Place of the answers to a workbook or folder.

    >>> name_map(Path("site.xlsx")).name
    'site.map.toml'
    """
    return site_file.with_name(f"{site_file.stem}.map.toml")


def read_answers(site_file: Path) -> Answers:
    """Answers beside a workbook; none where there is no such file.

    Raises
    ------
    SiteDataError
        If the file cannot be read, or holds anything else.
    """
    path = name_map(site_file)
    if not is_there(path):
        return UNASKED
    try:
        content = read_bounded(path, MAX_TOML_BYTES)
        table = parse_toml(content)
    except ContentError as error:
        rule = say("map.faulty", cause=error.message)
        raise refuse_file(path.name, rule, _WANTED) from error
    except OSError as error:
        rule = say("book.not_opened", cause=explain_cause(error))
        raise refuse_file(path.name, rule, _WANTED) from error
    fault = _find_fault(table)
    if fault:
        raise refuse_file(path.name, fault, _WANTED)
    return Answers(
        file=path.name,
        sha256=hashlib.sha256(content).hexdigest(),
        sheets=table.get("sheets", {}),
        headings=table.get("headings", {}),
        words=table.get("words", {}),
        ranges=table.get("ranges", {}),
        decimal_mark=MARKS[table.get("decimal_mark", "")],
    )


_WANTED = say("map.wanted")


def _find_fault(table: Mapping[str, Any]) -> Message | None:
    """First fault of the tables of the file."""
    stranger = next((key for key in table if key not in _KEYS), None)
    if stranger is not None:
        return say("map.unknown_key", key=quote(stranger))
    if table.get("schema", SCHEMA) != SCHEMA:
        return say("map.other_schema", schema=SCHEMA)
    if table.get("decimal_mark", "") not in MARKS:
        return say("map.decimal_mark")
    sheets = table.get("sheets", {})
    by_sheet = [table.get(key, {}) for key in ("headings", "words")]
    tables = [sheets, table.get("ranges", {})]
    for one in by_sheet:
        tables += one.values() if isinstance(one, dict) else ()
    for one in (*by_sheet, *tables):
        if not isinstance(one, dict):
            return say("map.no_table")
    for one in tables:
        for key, answer in one.items():
            if not isinstance(answer, str) or not answer.strip():
                return say("map.no_text", key=quote(key))
    return None


def find_plan(name: str) -> SheetPlan | None:
    """Planned sheet of that name, in any language."""
    return next((plan for plan in SHEETS if _is_named(name, plan)), None)


def _is_named(name: str, plan: SheetPlan) -> bool:
    """A name is that of the planned sheet; of net rows, also of one structure."""
    is_structure = plan.name == NETS.name and plan.is_structure(name)
    return is_structure or plan.matches(name)


def is_meant(name: str, plan: SheetPlan, answers: Answers) -> bool:
    """A sheet is the planned one: as answered, else by its name."""
    answer = answers.sheets.get(name)
    if answer is None or (answer != IGNORE and find_plan(answer) is None):
        return _is_named(name, plan)  # open, or a finding already
    return answer != IGNORE and _is_named(answer, plan)


def is_near(name: str, plan: SheetPlan) -> bool:
    """A name is that of a planned sheet, perhaps misspelt."""
    known = [normalise(one) for one in plan.raw_names]
    stem = name.removesuffix(".csv")  # of a file: "site - Nets.csv"
    words = {normalise(stem), normalise(re.split("[-_]", stem)[-1])}
    return any(
        difflib.get_close_matches(word, known, n=1, cutoff=_MISSPELT) for word in words
    )


def list_meant(workbook: Workbook, plan: SheetPlan) -> list[Sheet]:
    """Sheets of a workbook that are the planned one."""
    answers = workbook.answers
    return [one for one in workbook.sheets if is_meant(one.name, plan, answers)]


def list_near(workbook: Workbook, plan: SheetPlan) -> list[str]:
    """Names of sheets that are not read, near to the planned one's, not answered."""
    unread = (one for one in workbook.unread if one not in workbook.answers.sheets)
    return [name for name in unread if is_near(name, plan)]


def is_absent(workbook: Workbook, plan: SheetPlan) -> bool:
    """A workbook has no sheet of the plan's name, nor of a name near to it."""
    return not (list_meant(workbook, plan) or list_near(workbook, plan))


def give_answers(workbook: Workbook, answers: Answers) -> Workbook:
    """Workbook whose sheets know what was answered."""
    sheets = tuple(
        replace(
            sheet,
            answers=answers.headings.get(sheet.name, {}),
            words=answers.words.get(sheet.name, {}),
            answered_in=answers.file,
        )
        for sheet in workbook.sheets
    )
    return replace(workbook, answers=answers, sheets=sheets)


def judge_answers(workbook: Workbook) -> list[Finding]:
    """Note that answers were used; refuse those to sheets that are not there."""
    answers = workbook.answers
    if not answers.file:
        return []
    used = say("map.used", file=answers.file, sha256=answers.sha256)
    names = {sheet.name for sheet in workbook.sheets}
    absent = [one for one in answers.sheets if one not in names | {*workbook.unread}]
    answered = dict.fromkeys((*answers.headings, *answers.words))
    unread = [one for one in answered if one not in names]
    return [
        note_file(workbook.file, used),
        *(_refuse(answers, say("map.sheet_absent"), one) for one in absent),
        *_list_wrong_sheets(answers),
        *(_refuse(answers, say("map.sheet_not_read"), one) for one in unread),
        *(one for sheet in workbook.sheets for one in _list_unused_words(sheet)),
        *_list_ranges_twice(workbook),
    ]


def _list_wrong_sheets(answers: Answers) -> Iterator[Finding]:
    """Answers that name no sheet."""
    for name, answer in answers.sheets.items():
        if answer not in (IGNORE, UNANSWERED) and find_plan(answer) is None:
            rule = say("map.no_sheet", answer=quote(answer), key=quote(name))
            yield _refuse(answers, rule, name)


def _list_ranges_twice(workbook: Workbook) -> Iterator[Finding]:
    """Ranges that are answered beside a sheet of ranges."""
    own = list_meant(workbook, RANGES)
    if own and workbook.answers.ranges:
        yield _refuse(workbook.answers, say("map.ranges_twice"), own[0].name)


def _list_unused_words(sheet: Sheet) -> Iterator[Finding]:
    """Words that no cell has: the sheet has changed since."""
    cells = (cell for row in sheet.rows.values() for cell in row.values())
    typed = {normalise(cell.text) for cell in cells} if sheet.words else set()
    for word in sheet.words:
        if normalise(word) not in typed:
            rule = say("heading.unused_word", file=sheet.answered_in, word=quote(word))
            yield sheet.finding(rule, severity="note")


def _refuse(answers: Answers, rule: Message, name: str) -> Finding:
    return Finding(file=answers.file, sheet=name, rule=rule, accepted=_WANTED)
