"""Text of a block: pieces, each in one look, verdicts, and small drawings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from netdesign.report.words import VerdictWords

# Looks that every writer knows; a page's style sheet may have more. A small piece
# stands on a line of its own, a hidden one is for readers aloud, and on paper.
STRONG, CODE, SMALL, HIDDEN = "strong", "code", "small", "hidden"


@dataclass(frozen=True, slots=True)
class Piece:
    """Text in one look; each of its line ends begins a new line."""

    text: str
    look: str = ""
    has_symbols: bool = False  # E_d has a lowered d
    link: str = ""  # id of a part of the page


@dataclass(frozen=True, slots=True)
class Badge:
    """Symbol and word of a verdict; of a sign the word is hidden."""

    verdict: VerdictWords
    look: Literal["badge", "word", "sign"] = "badge"


@dataclass(frozen=True, slots=True)
class Sketch:
    """Drawing in a line of text, for a page alone; SVG of ours."""

    svg: str


Content = tuple[Piece | Badge | Sketch, ...]
Text = str | Content


def list_pieces(text: Text, *, has_symbols: bool = False) -> Content:
    """Pieces of a text; plain text is one piece."""
    if isinstance(text, str):
        return (Piece(text, has_symbols=has_symbols),) if text else ()
    return text


def symbols(text: str) -> Content:
    """Text with lowered subscripts."""
    return (Piece(text, has_symbols=True),)


def strong(text: str) -> Content:
    """Text that stands out."""
    return (Piece(text, STRONG),)


def link(anchor: str, text: str) -> Content:
    """Text that leads to a part of the page."""
    return (Piece(text, link=anchor),)


def small(lines: Sequence[str]) -> Content:
    """Small lines, one below the other."""
    return tuple(Piece(line, SMALL) for line in lines if line)


def keep_units(case: str) -> str:
    """``400 kg/m³, φ 15°`` that breaks at its commas only."""
    return case.replace(" ", "\u00a0").replace(",\u00a0", ", ")
