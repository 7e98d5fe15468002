"""Answers to the headings of an office's own list: ``LIST.map.toml``, as it is read."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated, ClassVar, Final, Literal

from pydantic import AfterValidator, Field, TypeAdapter, ValidationError

from netdesign.edge.input_files import (
    MAX_TOML_BYTES,
    explain,
    explain_shape,
    is_there,
    parse_toml,
    read_bounded,
)
from netdesign.outcome import ContentError, SiteDataError
from netdesign.site.cells.cells import TextFormat, Workbook
from netdesign.site.cells.findings import Finding, fold_findings, quote, refuse_file
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.office import is_heading
from netdesign.site.lists.targets import find_table, is_unanswered, read_answer
from netdesign.words.message import say

MARKS: dict[str, Literal["", ",", "."]] = {"": "", "comma": ",", "point": "."}
SCHEMA: Final = "netdesign.map/2"
_SHAPE = {"extra": "forbid"}


def _find_becomes(text: str) -> str:
    table = find_table(text)
    if table is None:
        raise ContentError(say("map.no_sheet", answer=quote(text)))
    return table


@dataclass(frozen=True, slots=True, kw_only=True)
class ListTable:
    """A sheet of a list, and the table that it becomes.

    Attributes
    ----------
    becomes : str
        Table of the input workbook; empty where the sheet is not read.
    headings_in_line : int
        Line in which its headings stand.
    headings, words, always : mapping of str to str
        Answer by heading as typed; word of the input workbook by text of a cell; and
        text of every line by column.
    """

    __pydantic_config__: ClassVar = _SHAPE

    becomes: Annotated[str, AfterValidator(_find_becomes)]
    headings_in_line: Annotated[int, Field(strict=True, ge=1)] = 1
    headings: dict[str, str] = field(default_factory=dict)
    words: dict[str, str] = field(default_factory=dict)
    always: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class ListMap:
    """Answers to a list, as their file has them, by the name of a sheet of the list."""

    __pydantic_config__: ClassVar = _SHAPE

    schema: Literal["netdesign.map/2"]
    list: str = ""
    decimal_mark: Literal["", "comma", "point"] = ""
    tables: dict[str, ListTable]
    file: str = ""
    sha256: str = ""


def name_map(site_file: Path) -> Path:
    """Place of the answers to a list.

    >>> name_map(Path("site.xlsx")).name
    'site.map.toml'
    """
    return site_file.with_name(f"{site_file.stem}.map.toml")


def read_list_map(site_file: Path) -> ListMap | None:
    """Read the answers beside a list; None without such a file.

    Raises
    ------
    SiteDataError
        With each fault of the form of the file.
    """
    path = name_map(site_file)
    if not is_there(path):
        return None
    wanted = say("map.wanted")
    try:
        content = read_bounded(path, MAX_TOML_BYTES)
        given = {"file": path.name, "sha256": hashlib.sha256(content).hexdigest()}
        answers = parse_toml(content)
        return TypeAdapter(ListMap).validate_python({**answers, **given})
    except ValidationError as error:
        findings = [
            Finding(
                file=path.name,
                text=".".join(map(str, fault["loc"])),
                rule=say("text.as_given", text=explain_shape(fault)),
                accepted=wanted,
            )
            for fault in error.errors()
        ]
        raise SiteDataError(findings, fold_findings(findings)) from None
    except (ContentError, OSError) as error:
        rule = say("map.faulty", cause=explain(error))
        raise refuse_file(path.name, rule, wanted) from error


def read_list(path: Path, text_format: TextFormat) -> Workbook:
    """Read every sheet of a list."""
    return read_workbook(
        path, lambda _: True, is_heading=is_heading, text_format=text_format
    )


def read_answered_list(path: Path, answers: ListMap, declared: TextFormat) -> Workbook:
    """Read a list with complete answers, and with the decimal mark that they give.

    Raises
    ------
    SiteDataError
        With each answer that is missing, or names no column.
    """
    findings = [
        finding
        for name, table in answers.tables.items()
        for finding in _judge(answers.file, name, table)
    ]
    if findings:
        raise SiteDataError(findings, fold_findings(findings))
    return read_list(path, declare_mark(declared, answers))


def declare_mark(declared: TextFormat, answers: ListMap) -> TextFormat:
    """Form of a list's text, with the decimal mark of its answers if none is typed."""
    mark = declared.decimal_mark or MARKS[answers.decimal_mark]
    return replace(declared, decimal_mark=mark)


def _judge(file: str, name: str, table: ListTable) -> Iterator[Finding]:
    """Answers of a sheet that are missing, or name no column."""
    if not table.becomes:
        return
    columns = (*table.headings.items(), *((key, key) for key in table.always))
    texts = (*columns, *table.words.items(), *table.always.items())
    faults = [
        *(
            (key, say("list_map.unanswered", answer=quote(text)))
            for key, text in texts
            if is_unanswered(text)
        ),
        *(
            (key, say("list_map.no_column", answer=quote(text)))
            for key, text in columns
            if read_answer(text, table.becomes).fault
        ),
    ]
    for key, rule in faults:
        yield Finding(
            file=file,
            sheet=name,
            text=key,
            rule=rule,
            accepted=say("list_map.wanted"),
        )
