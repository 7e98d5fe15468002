"""Net types and parts of another workbook: an office's own library."""

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
    found : OfficeTables
        Its sheets Net types and Parts.
    """

    file: str
    sha256: str
    found: OfficeTables


def read_library(
    path: Path, text_format: TextFormat, findings: list[Finding]
) -> Library:
    """Sheets Net types and Parts of a workbook; faults go to ``findings``."""
    plans = tuple(map(load_plan, _TABLES))

    def is_wanted(name: str) -> bool:
        return any(plan.matches(name) for plan in plans)

    workbook = read_workbook(path, is_wanted, is_heading, text_format)
    found = find_office_tables(workbook, findings, ("net_types",))
    lines = {
        name: [_place(line, workbook.file) for line in found.lines[name]]
        for name in _TABLES
    }
    return Library(
        file=workbook.file, sha256=workbook.sha256, found=replace(found, lines=lines)
    )


def _place(line: Row, file: str) -> dict[str, Reading]:
    """Line whose cells are those of another file."""
    return {
        key: replace(
            one, cell=one.cell and replace(one.cell, sheet=f"[{file}]{one.cell.sheet}")
        )
        for key, one in line.items()
    }


def add_lines(
    own: Mapping[str, list[Row]],
    others: Mapping[str, Sequence[Row]],
    findings: list[Finding],
) -> dict[str, list[Row]]:
    """Lines by table, with those of a library that are not there yet.

    Parameters
    ----------
    own, others : mapping of str to sequence of Row
        Lines of the workbook, and of the library.
    findings : list of Finding
        Appended to: an id that means one thing here and another there.
    """
    joined = {name: list(lines) for name, lines in own.items()}
    for name in _TABLES:
        key = _KEYS.get(name, "id")
        here, there = _group(own[name], key), _group(others[name], key)
        for one, lines in there.items():
            if one not in here:
                joined[name] += lines
            elif list(map(_bare, here[one])) != list(map(_bare, lines)):
                rule = say("nets.used_twice", place=lines[0][key].place)
                refuse(here[one][0][key], rule, say("office.once"), findings)
    return joined


def _group(lines: Sequence[Row], key: str) -> dict[str, list[Row]]:
    found: dict[str, list[Row]] = {}
    for line in lines:
        if line[key].word:
            found.setdefault(line[key].word, []).append(line)
    return found


def _bare(line: Row) -> dict[str, object]:
    """What a line says, wherever it stands."""
    return {
        key: (one.value, one.span) for key, one in line.items() if one.state == "given"
    }
