"""Faults of a site workbook with their places: collected, never thrown singly."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

from netdesign.edge.input_files import make_printable
from netdesign.outcome import SiteDataError
from netdesign.words.message import Message, say

Severity = Literal["error", "question", "note"]

_LONGEST_QUOTE = 60
_ALIKE = (
    "number.ambiguous",
    "type.governs",
    "list_map.unanswered",
)  # rules that repeat the text of their cell
_MOST = 12  # alike, named after the first


class Refusal(NamedTuple):
    """Reason against a value, without its place.

    Attributes
    ----------
    rule : Message
        What is wrong; reads after the text in question: ``is not a number``.
    accepted : Message or str
        What is accepted or what to do; may be empty.
    """

    rule: Message
    accepted: Message | str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """One fault (or remark) with its place in the workbook.

    Attributes
    ----------
    file, sheet, cell : str
        Place; ``sheet`` and ``cell`` are empty where the fault has none.
    field : Message or str
        Heading of the quantity, with its unit; may be empty.
    text : str
        Exactly what the cell holds; empty for an empty cell.
    rule, accepted : Message
        As in `Refusal`.
    severity : str
        ``error`` refuses the workbook, ``question`` leaves net rows not proven,
        ``note`` only ends up in the report.
    """

    file: str
    sheet: str = ""
    cell: str = ""
    field: Message | str = ""
    text: str = ""
    rule: Message
    accepted: Message | str = ""
    severity: Severity = "error"

    @property
    def message(self) -> Message:
        """``site.xlsx › Nets › C14: "0,45O" is not a number (...); accepted: ...``."""
        place = " › ".join(part for part in (self.file, self.sheet, self.cell) if part)
        accepted = say("finding.accepted", accepted=self.accepted)
        return say(
            "finding.line",
            place=make_printable(place.replace("\n", " ")),
            subject=self._subject(),
            rule=self.rule,
            field=say("finding.field", field=self.field) if self.field else "",
            accepted=accepted if self.accepted else "",
        )

    @property
    def is_asked(self) -> bool:
        """Whether the workbook may be a list, which needs a file of answers."""
        return self.rule.key == "table.lacks_sheet"

    def __str__(self) -> str:
        """The message in English."""
        return str(self.message)

    def _subject(self) -> Message | str:
        if self.text:
            return quote(self.text)
        if self.cell:
            return say("finding.the_cell")
        return say("finding.the_sheet" if self.sheet else "finding.the_file")


def fold_findings(
    findings: Sequence[Finding], site_file: str = ""
) -> tuple[Message, ...]:
    """Lines about findings, faults first; alike findings share a line.

    Faults are alike by rule and column, remarks by rule and sheet.
    """
    alike: dict[tuple[object, ...], list[Finding]] = {}
    for finding in sorted(findings, key=lambda finding: finding.severity != "error"):
        column = finding.cell.rstrip("0123456789")
        is_fault = finding.severity == "error"
        place = (column, str(finding.field)) if is_fault else ()
        rule = finding.rule.key if finding.rule.key in _ALIKE else str(finding.rule)
        key = (finding.severity, finding.file, finding.sheet, rule, place)
        group = alike.setdefault(key, [])
        if finding not in group:  # a cell that two columns are read from
            group.append(finding)
    asked = [finding for finding in findings if finding.is_asked]
    offers = [
        say("finding.ask_map", file=site_file or finding.file) for finding in asked[:1]
    ]
    lines = [_describe_alike(group) for group in alike.values()]
    count = sum(group[0].severity == "error" for group in alike.values())
    faults, notes = lines[:count], lines[count:]
    between = [say("finding.beside")] if faults and notes else []
    return (*faults, *offers, *between, *notes)


def _describe_alike(findings: list[Finding]) -> Message:
    first, *others = findings
    if not others:
        return first.message
    shown = [
        " ".join(
            filter(None, (finding.cell, quote(finding.text) if finding.text else ""))
        )
        or finding.sheet
        for finding in others
    ]
    return say("finding.likewise", line=first.message, others=shorten(shown, _MOST))


def shorten(texts: Sequence[str], most: int) -> tuple[Message | str, ...]:
    """First ``most`` of some texts, and the number of the others."""
    more = len(texts) - most
    return (*texts[:most], *([say("finding.more", count=more)] if more > 0 else []))


def refuse_file(
    file: str, rule: Message, accepted: Message, sheet: str = ""
) -> SiteDataError:
    """Error for a file, or a sheet of it, that cannot be read as a whole."""
    finding = Finding(file=file, sheet=sheet, rule=rule, accepted=accepted)
    return SiteDataError([finding])


def note_file(file: str, rule: Message, sheet: str = "") -> Finding:
    """Remark on a file, or a sheet of it, that is read all the same."""
    return Finding(file=file, sheet=sheet, rule=rule, severity="note")


def quote(text: str) -> str:
    """Quote a cell's text on one line, shortened when it is long."""
    start = text[: 10 * _LONGEST_QUOTE]  # words of a whole file would fill the memory
    line = " ".join(make_printable(start).split())
    if len(line) > _LONGEST_QUOTE or len(start) < len(text):
        line = line[: _LONGEST_QUOTE - 3] + "..."
    return f'"{line}"'


def add_nearest(
    accepted: Message,
    word: str,
    places: Mapping[str, str],
) -> Message:
    """Add near matches of a word to what is accepted, each with its cell, if any.

    >>> accepted = say("accepted.id_of_sheet", sheet="Ropes")
    >>> str(add_nearest(accepted, "G81", {"G18": "Ropes!A2"}))
    'an id of sheet Ropes (nearest: "G18" in Ropes!A2)'
    """
    near = difflib.get_close_matches(word, list(places), n=3)
    if not near:
        return accepted
    shown = tuple(
        say("finding.near_at", word=quote(match), place=places[match])
        if places[match]
        else quote(match)
        for match in near
    )
    return say("finding.nearest", accepted=accepted, near=shown)
