"""Questions that a workbook leaves open, as a file of answers: ``SITE.map.toml``.

Guesses at what an unknown heading means are the names that are written most alike.
"""

from __future__ import annotations

import json
import re
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from rapidfuzz.fuzz import token_sort_ratio

from netdesign.edge.input_files import make_printable
from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import (
    UNDECLARED,
    TextFormat,
    Workbook,
    name_column,
    split_address,
)
from netdesign.site.cells.findings import Finding
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.all_tables import (
    ANCHORS,
    IGNORE,
    NETS,
    POSTS,
    RANGES,
    ROPES,
    SHEETS,
    UNANSWERED,
    has_no_part,
    is_allowable,
)
from netdesign.site.columns.fields import Field
from netdesign.site.headings import Table, count_known
from netdesign.site.reader import read_cells, read_site
from netdesign.site.readings import IN_CELLS
from netdesign.site.tables import find_tables
from netdesign.site.titles import (
    SCHEMA,
    find_heading_unit,
    find_plan,
    list_meant,
    name_asked,
    read_unit,
)
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

# Measured on 220 headings of eight lists: a wrong one reaches 83, a meaningless one 87,
# and two columns of ours are 90 alike.
_SURE, _APART = 92.0, 5.0
_LEAST, _MOST_LISTED = 40.0, 3
_WORD = re.compile(r"[^\W_]+")
_BRACKET = re.compile(r"[\[(][^\[\]()]*[\])]\s*$")


@dataclass(frozen=True, slots=True)
class Guess:
    """Fields that a heading may mean.

    Attributes
    ----------
    ranked : tuple of Field and float
        The likeliest first, with how alike their names are, of 100.
    field : Field or None
        The one that may be taken; None where only an engineer knows.
    """

    ranked: tuple[tuple[Field, float], ...]
    field: Field | None


def guess(text: str, unit: str, fields: Iterable[Field]) -> Guess:
    """Guess at a heading by the likeness of its words to known names.

    Parameters
    ----------
    text : str
        The heading as typed.
    unit : str
        Its unit; empty where it has none, which then excludes no field.
    fields : iterable of Field
        What it may mean.

    Returns
    -------
    Guess
        An allowable value is never taken for a resistance.
    """
    plain = _list_words(_BRACKET.sub("", text) or text)
    scores = [
        (one, max(token_sort_ratio(plain, _list_words(name)) for name in one.raw_names))
        for one in fields
        if _fits(unit, one)
    ]
    scores.sort(key=lambda one: -one[1])
    best, second = [*(score for _, score in scores), 0.0, 0.0][:2]
    is_sure = best >= _SURE and best - second >= _APART and not is_allowable(text)
    listed = [one for one in scores if one[1] >= _LEAST]
    return Guess(tuple(listed[:_MOST_LISTED]), scores[0][0] if is_sure else None)


def _fits(unit: str, field: Field) -> bool:
    return not unit or unit in (field.units or ("-",))


def _list_words(text: str) -> str:
    """Words without case and accents."""
    decomposed = unicodedata.normalize("NFKD", text.casefold())
    letters = "".join(one for one in decomposed if not unicodedata.combining(one))
    return " ".join(_WORD.findall(letters))


# Findings that an answer to a heading or to an item of a line can settle.
_OF_UNITS = (
    *("heading.no_unit", "heading.no_unit_could_be", "heading.unclear_unit"),
    "heading.unknown_unit",
)
_OF_NAMES = (
    *("heading.ambiguous", "heading.close_to_missing"),
    *("heading.twice", "heading.wrong_answer", "heading.unit_not_wanted"),
    *("item.unknown", "item.unknown_quantity"),
)
_GUESSED = (
    *("heading.close_to_missing", "heading.unknown"),
    *("item.unknown", "item.unknown_quantity"),
)
_LEFT_OPEN = "heading.unanswered"
_OF_SHEETS = ("table.copy", "table.net_rows", "map.no_sheet")
_OF_WORDS = "cell.unknown_word"
_UNREAD = "heading.unknown"
_MARK = "decimal_mark"
_LEAST_KNOWN = 2  # headings of a sheet that is proposed for a planned one
_EXPECTED = (NETS, RANGES, ANCHORS, ROPES, POSTS)


# A line of the file whose answer has a question mark, one that was left before too.
_OPEN = re.compile(r'^(?:"(?:[^"\\]|\\.)*"|\w+) = "(?:[^"\\]|\\.)*\?', re.MULTILINE)


def is_open(line: str) -> bool:
    """A line of a file of answers waits for an answer."""
    return _OPEN.match(line) is not None


@dataclass(frozen=True, slots=True)
class Question:
    """One line of the file: what is asked, a first answer, what is accepted.

    Attributes
    ----------
    sheet, asked : str
        The sheet as typed, and the heading or item; no sheet where it is a sheet that
        is asked for.
    answer : str
        To be completed: it holds a ``?``.
    hints : tuple of Message or str
        What the answer may be.
    is_word : bool
        A word of a cell is asked for.
    likely : str
        Planned sheet that is proposed for the sheet; empty where none is.
    """

    sheet: str
    asked: str
    answer: str
    hints: tuple[Message | str, ...]
    is_word: bool = False
    likely: str = ""


def write_questions(
    path: Path,
    text_format: TextFormat = UNDECLARED,
    language: Language = "en",
) -> tuple[str, int]:
    """Text of the file of answers, and how many of them are missing.

    Parameters
    ----------
    path : Path
        The workbook; answers that stand beside it already are kept.
    text_format : TextFormat
        As for reading.
    language : str
        Of the comments and headings.

    Raises
    ------
    SiteDataError
        If the workbook cannot be read at all, or a file of answers beside it.
    """
    workbook = read_cells(path, text_format)
    answers = workbook.answers
    unread = _collect(path, text_format)
    asked = list(_ask_sheets(path, text_format, workbook, unread))
    # The headings of a sheet are asked for together with what the sheet may be.
    taken = {one.asked: one.likely for one in asked if one.likely}
    findings = _collect(path, text_format, taken)
    workbook = read_cells(path, text_format, taken)
    found = [table for plan in SHEETS for table in find_tables(workbook, plan, [])]
    asks_mark = any(one.rule.key == "number.ambiguous" for one in findings)
    questions = _ask_names(found, findings, language)
    lines = [*_begin(path, workbook, UNANSWERED if asks_mark else "", language)]
    if answers.sheets or asked:
        lines += [*_list_answers("sheets", answers.sheets, asked, language), ""]
    if answers.ranges:
        lines += [*_list_answers("ranges", answers.ranges, [], language), ""]
    for table in found:
        name = table.sheet.name
        place, given = f"headings.{_quote(name)}", answers.headings.get(name, {})
        of_sheet = [one for one in questions if one.sheet == name]
        asked = [one for one in of_sheet if not one.is_word]
        lines += _list_answers(place, given, asked, language)
        lines += [*_list_understood(table, language)]
        lines += [*_list_unread(table, of_sheet, findings), ""]
        asked = [one for one in of_sheet if one.is_word]
        if (words := answers.words.get(name, {})) or asked:
            place = f"words.{_quote(name)}"
            lines += [*_list_answers(place, words, asked, language), ""]
    text = "\n".join(lines) + "\n"
    return text, len(_OPEN.findall(text))


def _collect(
    path: Path,
    text_format: TextFormat,
    sheets: Mapping[str, str] = MappingProxyType({}),
) -> list[Finding]:
    try:
        site = read_site(path, text_format, sheets=sheets)
        findings: Iterable[object] = site.findings
    except SiteDataError as error:
        findings = error.findings
    return [one for one in findings if isinstance(one, Finding)]


def _ask_sheets(
    path: Path, text_format: TextFormat, workbook: Workbook, findings: list[Finding]
) -> Iterator[Question]:
    """Sheets that are asked about, and those with headings of one that is missing."""
    asked = {one.sheet: one for one in findings if one.rule.key in _OF_SHEETS}
    for name, one in asked.items():
        likely = NETS.name if one.rule.key == "table.net_rows" else ""
        yield Question("", name, UNANSWERED, (one.accepted,), likely=likely)
    given = workbook.answers.sheets
    open_names = {
        one
        for one in workbook.unread
        if given.get(one) != IGNORE and find_plan(given.get(one, "")) is None
    }
    missing = [plan for plan in _EXPECTED if not list_meant(workbook, plan)]
    if not missing or not open_names:
        return
    every = read_workbook(path, lambda _: True, text_format=text_format)
    for sheet in every.sheets:
        if sheet.name not in open_names or sheet.is_hidden:
            continue
        counts = {plan.name: count_known(sheet, plan) for plan in missing}
        likely = max(counts, key=lambda name: counts[name])
        if counts[likely] >= _LEAST_KNOWN:
            hints = (say("finding.in_quotes", text=say(f"sheet.{likely}")),)
            yield Question("", sheet.name, UNANSWERED, hints, likely=likely)


def _ask_names(
    tables: Sequence[Table], findings: list[Finding], language: Language
) -> list[Question]:
    by_sheet = {table.sheet.name: table for table in tables}
    asked: dict[tuple[str, str], Question] = {}
    for finding in findings:
        table = by_sheet.get(finding.sheet)
        is_unread = finding.rule.key == _UNREAD and not has_no_part(finding.text)
        if table and finding.cell and (finding.severity == "error" or is_unread):
            question = _ask_word(finding) or _ask(table, finding, language)
            if question:
                asked[question.sheet, question.asked] = question
    return list(asked.values())


def _ask_word(finding: Finding) -> Question | None:
    """A word that its column does not know."""
    if finding.rule.key != _OF_WORDS:
        return None
    hints = (finding.field, finding.accepted)
    return Question(finding.sheet, finding.text, UNANSWERED, hints, is_word=True)


def _ask(table: Table, finding: Finding, language: Language) -> Question | None:
    column, row = split_address(finding.cell)
    key = finding.rule.key
    if key not in (*_OF_UNITS, *_OF_NAMES, _UNREAD, _LEFT_OPEN):
        return None
    is_heading = row <= max(table.heading_row, min(table.rows, default=row + 1) - 1)
    asked = _name_heading(table, column) if is_heading else _name_item(table, row)
    if not asked:
        return None
    hints = tuple(one for one in (finding.rule, finding.accepted) if one)
    answer = UNANSWERED
    if key in _GUESSED:
        answer, hints = _guess(table, finding, language)
    if key == _LEFT_OPEN:
        answer = table.sheet.answers.get(asked, UNANSWERED)
    if key in _OF_UNITS:
        name = _name_field(table, column, language) if is_heading else asked
        answer = f"{name} [{UNANSWERED}]"
    return Question(table.sheet.name, asked, answer, hints)


def _guess(
    table: Table, finding: Finding, language: Language
) -> tuple[str, tuple[Message | str, ...]]:
    """First answer to a name that is unknown, with what it may mean and its cells."""
    column, row = split_address(finding.cell)
    is_heading = row == table.heading_row
    taken = {key for key, place in table.columns.items() if place.number != column}
    every = table.plan.fields if is_heading else table.plan.items
    below = table.sheet.cell(table.units_row, column) if table.units_row else None
    heading = table.sheet.cell(row, column)
    unit = find_heading_unit(heading)
    if is_heading and not unit and below is not None and not below.is_blank:
        unit = read_unit(below)[0]
    found = guess(finding.text, unit, [one for one in every if one.key not in taken])
    listed = " · ".join(
        f"{one.label_in(language)} {score:.0f}" for one, score in found.ranked
    )
    cells = "; ".join(one.text for one in table.examples(column)) if is_heading else ""
    hints = (finding.rule, listed, cells and say("map.cells", cells=cells))
    if found.field is None:
        return UNANSWERED, tuple(filter(None, hints))
    label = found.field.label_in(language)
    has_unit = unit or found.field.unit in ("", "-")
    return (
        label if has_unit else f"{label} [{UNANSWERED}]",
        tuple(filter(None, hints)),
    )


def _name_heading(table: Table, column: int) -> str:
    """Heading of a column, as the file names it; empty where there is none."""
    titles = {cell.column: name_asked(cell) for cell, _ in table.titles}
    own = titles.get(column)
    if own is None:
        return ""
    alike = [one for one in titles.values() if one == own]
    return own if len(alike) == 1 else f"{name_column(column)}: {own}"


def _name_item(table: Table, row: int) -> str:
    if not table.plan.items:
        return ""
    key = table.plan.fields[0].key
    cell = table.cell(row, key)
    return " ".join(str(cell.value).split()) if cell and not cell.is_blank else ""


def _name_field(table: Table, column: int, language: Language) -> str:
    """Label of the field that a column was taken for."""
    keys = {place.number: key for key, place in table.columns.items()}
    known = (one for one in table.plan.fields if one.key == keys.get(column))
    return next((one.label_in(language) for one in known), UNANSWERED)


def _begin(
    path: Path, workbook: Workbook, mark: str, language: Language
) -> Iterator[str]:
    for line in render(say("map.head", file=path.name), language).splitlines():
        yield f"# {line}".rstrip()
    yield f'schema = "{SCHEMA}"'
    yield f"workbook = {_quote(path.name)}"
    given = {",": "comma", ".": "point"}.get(workbook.answers.decimal_mark)
    if given or mark:
        yield f'{_MARK} = "{given or mark}"  # "comma", "point"'
    yield ""


def _list_answers(
    place: str,
    given: Mapping[str, str],
    asked: Sequence[Question],
    language: Language,
) -> Iterator[str]:
    """Table of the file: answers that are there, then what is asked, perhaps again."""
    again = {one.asked for one in asked}
    yield f"[{place}]"
    for key, answer in given.items():
        if UNANSWERED not in answer and key not in again:
            yield f"{_quote(key)} = {_quote(answer)}"
    for one in asked:
        yield _line(one, language)


def _list_understood(table: Table, language: Language) -> Iterator[str]:
    """Headings that need no answer, with what each is taken for."""
    titles = {cell.column: name_asked(cell) for cell, _ in table.titles}
    for field in table.plan.fields:
        column = table.columns.get(field.key)
        if column is None or column.unit is None or not titles:
            continue
        is_given = column.unit not in ("", IN_CELLS)
        unit = f" [{column.unit}]" if is_given else ""
        label = render(field.name, language)
        yield f"# {_quote(titles.get(column.number, ''))} = {_quote(label + unit)}"


def _list_unread(
    table: Table, questions: Sequence[Question], findings: Sequence[Finding]
) -> Iterator[str]:
    """Headings that are not understood, and that nothing asks for."""
    asked = {one.asked for one in questions} | table.sheet.answers.keys()
    for finding in findings:
        if finding.rule.key == _UNREAD and finding.sheet == table.sheet.name:
            name = _name_heading(table, split_address(finding.cell)[0])
            if name and name not in asked:
                yield f'# {_quote(name)} = "ignore"'


def _line(question: Question, language: Language) -> str:
    hints = "; ".join(render(one, language) for one in question.hints)
    comment = " ".join(make_printable(hints).split())
    return f"{_quote(question.asked)} = {_quote(question.answer)}  # {comment}"


def _quote(text: str) -> str:
    return json.dumps(make_printable(text), ensure_ascii=False)
