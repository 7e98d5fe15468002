"""Answers to the headings of an office's own list: ``LIST.map.toml``, as it is read."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from netdesign.edge.input_files import (
    MAX_TOML_BYTES,
    is_there,
    parse_toml,
    read_bounded,
)
from netdesign.edge.input_files import explain as explain_cause
from netdesign.outcome import ContentError, SiteDataError
from netdesign.site.cells.cells import Answers, TextFormat, Workbook
from netdesign.site.cells.findings import (
    Finding,
    fold_findings,
    quote,
    refuse_file,
)
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.all_tables import UNANSWERED
from netdesign.site.columns.office import is_heading
from netdesign.site.lists.targets import find_table, read_answer
from netdesign.site.titles import MARKS, name_map
from netdesign.words.message import Message, say

SCHEMA = "netdesign.map/2"
_KEYS = {"schema", "list", "decimal_mark", "tables"}
_OF_TABLE = {"becomes", "headings_in_line", "headings", "words", "always"}
_WANTED = say("map.wanted")


@dataclass(frozen=True, slots=True, kw_only=True)
class ListTable:
    """A sheet of a list, and what becomes of it.

    Attributes
    ----------
    name : str
        Of the sheet.
    becomes : str
        Table of the input workbook; empty where the sheet is not read.
    line : int
        In which its headings stand.
    headings, words, always : mapping of str to str
        Answer by heading as typed; word of the input workbook by text of a cell; and
        column to what stands in every line.
    """

    name: str
    becomes: str
    line: int = 1
    headings: Mapping[str, str] = field(default_factory=dict)
    words: Mapping[str, str] = field(default_factory=dict)
    always: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class ListMap:
    """Answers to a list, with the file that they stand in."""

    answers: Answers
    tables: tuple[ListTable, ...]


def read_list_map(site_file: Path) -> ListMap | None:
    """Answers beside a list; None where none stand there.

    Raises
    ------
    SiteDataError
        With each answer that is missing, or names no column.
    """
    path = name_map(site_file)
    if not is_there(path):
        return None
    try:
        content = read_bounded(path, MAX_TOML_BYTES)
        table = parse_toml(content)
    except (ContentError, OSError) as error:
        cause = error.message if isinstance(error, ContentError) else None
        rule = say("map.faulty", cause=cause or explain_cause(error))
        raise refuse_file(path.name, rule, _WANTED) from error
    if table.get("schema") != SCHEMA:
        rule = say("map.other_schema", schema=SCHEMA)
        raise refuse_file(path.name, rule, _WANTED)
    if fault := _find_fault(table):
        raise refuse_file(path.name, fault, _WANTED)
    mark = MARKS[table.get("decimal_mark", "")]
    digest = hashlib.sha256(content).hexdigest()
    return ListMap(
        answers=Answers(file=path.name, sha256=digest, decimal_mark=mark),
        tables=tuple(_read(name, one) for name, one in table["tables"].items()),
    )


def read_list(path: Path, text_format: TextFormat) -> Workbook:
    """Every sheet of a list."""
    return read_workbook(
        path, lambda _: True, is_heading=is_heading, text_format=text_format
    )


def require_answered(found: ListMap) -> None:
    """Refuse answers that are missing, or that name no column.

    Raises
    ------
    SiteDataError
        With each of them.
    """
    findings = [one for table in found.tables for one in _judge(found, table)]
    if findings:
        raise SiteDataError(findings, fold_findings(findings))


def _judge(found: ListMap, table: ListTable) -> Iterator[Finding]:
    if not table.becomes:
        return
    texts = (*table.headings.items(), *((key, key) for key in table.always))
    for heading, text in texts:
        answer = read_answer(text, table.becomes)
        key = "list_map.unanswered" if answer.is_open else "list_map.no_column"
        if answer.is_open or answer.fault:
            yield _tell(found, table, heading, say(key, answer=quote(text)))
    for column, text in (*table.words.items(), *table.always.items()):
        if UNANSWERED in text:
            rule = say("list_map.unanswered", answer=quote(text))
            yield _tell(found, table, column, rule)


def _tell(found: ListMap, table: ListTable, heading: str, rule: Message) -> Finding:
    return Finding(
        file=found.answers.file,
        sheet=table.name,
        text=heading,
        rule=rule,
        accepted=say("list_map.wanted"),
    )


def _read(name: str, table: Mapping[str, Any]) -> ListTable:
    return ListTable(
        name=name,
        becomes=find_table(table["becomes"]) or "",
        line=table.get("headings_in_line", 1),
        headings=table.get("headings", {}),
        words=table.get("words", {}),
        always=table.get("always", {}),
    )


def _find_fault(table: Mapping[str, Any]) -> Message | None:
    """First fault of the form of the file."""
    stranger = next((key for key in table if key not in _KEYS), None)
    if stranger is not None:
        return say("map.unknown_key", key=quote(stranger))
    if table.get("decimal_mark", "") not in MARKS:
        return say("map.decimal_mark")
    tables = table.get("tables", {})
    if not isinstance(tables, dict) or not tables:
        return say("map.no_table")
    faults = (_find_fault_of(name, one) for name, one in tables.items())
    return next((one for one in faults if one is not None), None)


def _find_fault_of(name: str, table: Any) -> Message | None:
    if not isinstance(table, dict) or not isinstance(table.get("becomes"), str):
        return say("map.no_text", key=quote(name))
    stranger = next((key for key in table if key not in _OF_TABLE), None)
    if stranger is not None:
        return say("map.unknown_key", key=quote(stranger))
    if find_table(table["becomes"]) is None:
        return say("map.no_sheet", answer=quote(table["becomes"]), key=quote(name))
    line = table.get("headings_in_line", 1)
    if not isinstance(line, int) or isinstance(line, bool) or line < 1:
        return say("list_map.no_line", key=quote(name))
    for part in (table.get(one, {}) for one in ("headings", "words", "always")):
        if not isinstance(part, dict):
            return say("map.no_table")
        for key, answer in part.items():
            if not isinstance(answer, str) or not answer.strip():
                return say("map.no_text", key=quote(key))
    return None
