"""Net types and parts that stand in another workbook: an office's own library."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from netdesign.site.cells.cells import TextFormat
from netdesign.site.cells.findings import Finding
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.office import is_heading, load_plan
from netdesign.site.office.sheets import OfficeTables, find_office_tables
from netdesign.site.readings import Reading, Row, refuse
from netdesign.words.message import say

_TABLES = ("net_types", "ropes", "posts", "links")
_KEYS = {"links": "type"}  # that names a line; else its id


@dataclass(frozen=True, slots=True, kw_only=True)
class Library:
    """Lines of a library, whose cells name its file.

    Attributes
    ----------
    file, sha256 : str
        Of the workbook.
    tables : OfficeTables
        Its sheets Net types and Parts.
    """

    file: str
    sha256: str
    tables: OfficeTables


def read_library(
    path: Path, text_format: TextFormat, findings: list[Finding]
) -> Library:
    """Sheets Net types and Parts of a workbook; faults go to ``findings``."""
    plans = tuple(map(load_plan, _TABLES))

    def is_wanted(name: str) -> bool:
        return any(plan.matches(name) for plan in plans)

    workbook = read_workbook(path, is_wanted, is_heading, text_format)
    tables = find_office_tables(workbook, findings, ("net_types",))
    lines = {
        name: [_place(line, workbook.file) for line in tables.lines[name]]
        for name in _TABLES
    }
    return Library(
        file=workbook.file, sha256=workbook.sha256, tables=replace(tables, lines=lines)
    )


def _place(line: Row, file: str) -> dict[str, Reading]:
    """Line whose cells name the file that they stand in."""
    return {
        key: replace(
            reading,
            cell=reading.cell
            and replace(reading.cell, sheet=f"[{file}]{reading.cell.sheet}"),
        )
        for key, reading in line.items()
    }


def add_lines(
    own: Mapping[str, list[Row]],
    others: Mapping[str, Sequence[Row]],
    findings: list[Finding],
) -> dict[str, list[Row]]:
    """Lines by table, with the lines of a library whose ids are new.

    Parameters
    ----------
    own, others : mapping of str to sequence of Row
        Lines of the workbook, and of the library.
    findings : list of Finding
        Appended to: an id that means one thing here and another there.
    """
    joined = {table: list(lines) for table, lines in own.items()}
    for table in _TABLES:
        key = _KEYS.get(table, "id")
        here, there = _group(own[table], key), _group(others[table], key)
        for name, lines in there.items():
            if name not in here:
                joined[table] += lines
            elif list(map(_bare, here[name])) != list(map(_bare, lines)):
                rule = say("nets.used_twice", place=lines[0][key].place)
                refuse(here[name][0][key], rule, say("office.once"), findings)
    return joined


def _group(lines: Sequence[Row], key: str) -> dict[str, list[Row]]:
    by_name: dict[str, list[Row]] = {}
    for line in lines:
        if line[key].word:
            by_name.setdefault(line[key].word, []).append(line)
    return by_name


def _bare(line: Row) -> dict[str, object]:
    """Values and ranges of a line by key, without its place."""
    return {
        key: (reading.value, reading.span)
        for key, reading in line.items()
        if reading.state == "given"
    }
