"""Answers beside a workbook: what its headings mean, in ``SITE.map.toml``.

``netdesign map`` writes the file with what is asked; the engineer fills it in; every
later run reads it by itself.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

from netdesign.edge.causes import explain
from netdesign.edge.given_files import (
    MAX_TOML_BYTES,
    is_there,
    parse_toml,
    read_bounded,
)
from netdesign.outcome import ContentError
from netdesign.site.cells.cells import UNASKED, Answers, Sheet, Workbook
from netdesign.site.cells.findings import (
    Finding,
    note_file,
    quote,
    refuse_file,
)
from netdesign.site.columns.all_tables import NETS, SHEETS
from netdesign.site.columns.fields import SheetPlan, normalise
from netdesign.site.columns.lexicon import IGNORE, UNANSWERED
from netdesign.words.message import Message, say

SCHEMA = "netdesign.map/1"
MARKS: Mapping[str, Literal["", ",", "."]] = {"": "", "comma": ",", "point": "."}
_KEYS = ("schema", "workbook", "decimal_mark", "sheets", "headings", "words")


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
        rule = say("book.not_opened", cause=explain(error))
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
    tables = [sheets]
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
    answer = answers.sheets.get(name, UNANSWERED)
    if answer != IGNORE and find_plan(answer) is None:  # open, or a finding already
        return _is_named(name, plan)
    return answer != IGNORE and _is_named(answer, plan)


def give_answers(workbook: Workbook, answers: Answers) -> Workbook:
    """Workbook whose sheets know what was answered."""
    return replace(
        workbook,
        answers=answers,
        sheets=tuple(_give(sheet, answers) for sheet in workbook.sheets),
    )


def _give(sheet: Sheet, answers: Answers) -> Sheet:
    return replace(
        sheet,
        answers=answers.headings.get(sheet.name, {}),
        words=answers.words.get(sheet.name, {}),
        answered_in=answers.file,
    )


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
    ]


def _list_wrong_sheets(answers: Answers) -> Iterator[Finding]:
    """Answers that name no sheet."""
    for name, answer in answers.sheets.items():
        if answer not in (IGNORE, UNANSWERED) and find_plan(answer) is None:
            rule = say("map.no_sheet", answer=quote(answer), key=quote(name))
            yield _refuse(answers, rule, name)


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
