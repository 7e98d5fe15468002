"""What is wrong in a site workbook, and where: collected, never thrown one by one."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

from netdesign.edge.given_files import make_printable
from netdesign.errors import SiteDataError

Severity = Literal["error", "note"]

_LONGEST_QUOTE = 60


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why something was not taken, before its place is known.

    Attributes
    ----------
    rule : str
        What is wrong; reads after the text in question: ``is not a number``.
    accepted : str
        What is accepted or what to do; may be empty.
    """

    rule: str
    accepted: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """One fault (or remark) with its place in the workbook.

    Attributes
    ----------
    file, sheet, cell : str
        Place; ``sheet`` and ``cell`` are empty where the fault has none.
    field : str
        Heading of the quantity, with its unit; may be empty.
    text : str
        Exactly what the cell holds; empty for an empty cell.
    rule, accepted : str
        As in `Refusal`.
    severity : str
        ``error`` refuses the workbook, ``note`` only ends up in the report.
    """

    file: str
    sheet: str = ""
    cell: str = ""
    field: str = ""
    text: str = ""
    rule: str
    accepted: str = ""
    severity: Severity = "error"

    def __str__(self) -> str:
        """``site.xlsx › Nets › C14: "0,45O" is not a number (...); accepted: ...``."""
        place = " › ".join(part for part in (self.file, self.sheet, self.cell) if part)
        quantity = f" ({self.field})" if self.field else ""
        accepted = f"; accepted: {self.accepted}" if self.accepted else ""
        sentence = f"{place}: {self._subject()} {self.rule}{quantity}{accepted}"
        return make_printable(sentence.replace("\n", " "))

    def _subject(self) -> str:
        if self.text:
            return quote(self.text)
        if self.cell:
            return "the cell"
        return "the sheet" if self.sheet else "the file"


def refuse_file(file: str, rule: str, accepted: str, sheet: str = "") -> SiteDataError:
    """Error for a file, or one sheet of it, that cannot be read as a whole."""
    finding = Finding(file=file, sheet=sheet, rule=rule, accepted=accepted)
    return SiteDataError([finding])


def note_file(file: str, rule: str, sheet: str = "") -> Finding:
    """Remark on a file, or one sheet of it, that is read all the same."""
    return Finding(file=file, sheet=sheet, rule=rule, severity="note")


def quote(text: str) -> str:
    """Quote a cell's text on one line, shortened when it is long."""
    start = text[: 10 * _LONGEST_QUOTE]  # words of a whole file would fill the memory
    line = " ".join(make_printable(start).split())
    if len(line) > _LONGEST_QUOTE or len(start) < len(text):
        line = line[: _LONGEST_QUOTE - 3] + "..."
    return f'"{line}"'


def add_nearest(
    accepted: str,
    word: str,
    known: Iterable[str],
    places: Mapping[str, str] | None = None,
) -> str:
    """Add near matches of a word to what is accepted, with their cells if given.

    >>> add_nearest("an id of sheet Ropes", "G81", ["G18"], {"G18": "Ropes!A2"})
    'an id of sheet Ropes (nearest: "G18" in Ropes!A2)'
    """
    near = difflib.get_close_matches(word, list(known), n=3)
    if not near:
        return accepted
    shown = [
        f"{quote(match)} in {places[match]}" if places else quote(match)
        for match in near
    ]
    return f"{accepted} (nearest: {', '.join(shown)})"
