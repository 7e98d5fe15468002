"""Blocks of which every report is made: texts, tables, figures, and parts of them.

A block says what it is and where it stands; how that looks is the writer's. ``look``
names what a style sheet may set apart.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from netdesign.outcome import Verdict
from netdesign.report.words import MISSING, VerdictWords, Words, name_heading, show_text

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


def write_plain(text: Text) -> str:
    """Text without its looks: of a verdict its symbol, of a sketch nothing."""
    if isinstance(text, str):
        return text
    parts = [
        piece.text if isinstance(piece, Piece) else piece.verdict.symbol
        for piece in text
        if not isinstance(piece, Sketch)
    ]
    return " ".join(" ".join(parts).split(" ")).strip()


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


@dataclass(frozen=True, slots=True, kw_only=True)
class Cell:
    """Text that a reader sees, and the number behind it if it is one.

    ``content`` stands for the text where it has several looks. ``verdict`` sets the
    sign before a number in a workbook, ``note`` a comment at the cell there.
    """

    text: str = ""
    number: float | None = None
    content: Content = ()
    verdict: Verdict | None = None
    note: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """Heading of a column; ``quantity`` gives the decimals of its numbers."""

    heading: str
    quantity: str = ""
    is_number: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """Rows of cells under headings. Without rows, outputs print ``empty``.

    A row of one cell goes over all columns. ``symbols`` says whose subscripts are
    lowered: those of caption and headings, or those of all cells.
    """

    caption: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[Cell, ...], ...]
    empty: str = MISSING
    look: str = ""
    symbols: Literal["", "headings", "cells"] = ""

    def shown(
        self, look: str, *, symbols: Literal["", "headings", "cells"] = ""
    ) -> Table:
        """The same table with a look."""
        return replace(self, look=look, symbols=symbols or self.symbols)

    def describe_empty(self, words: Words) -> str:
        """Line that stands for the table without rows; one of figures is named."""
        if not self.symbols:
            return self.empty
        return words("show.label", label=self.caption, text=self.empty)


def number_column(key: str, heading: str) -> Column:
    """Column of the quantity ``key``."""
    return Column(heading=heading, quantity=key, is_number=True)


def quantity_column(words: Words, key: str) -> Column:
    """Column of the quantity ``key`` under its own name."""
    return number_column(key, name_heading(words, key))


def name_columns(
    headings: Sequence[str], *, numbers: Sequence[str]
) -> tuple[Column, ...]:
    """Columns by heading alone; those in ``numbers`` are set to the right."""
    return tuple(Column(heading=h, is_number=h in numbers) for h in headings)


def key_columns(
    words: Words, prefix: str, keys: Sequence[str], *, numbers: Sequence[str] = ()
) -> tuple[Column, ...]:
    """Columns by the keys of their headings; those in ``numbers`` to the right."""
    return tuple(
        Column(heading=words(f"{prefix}{key}"), is_number=key in numbers)
        for key in keys
    )


def text_cell(text: str) -> Cell:
    """Text on one line, never empty."""
    return Cell(text=show_text(text))


def number_cell(words: Words, key: str, value: float | None) -> Cell:
    """Number of the quantity ``key``, with its decimals."""
    return Cell(text=words.show_number(key, value), number=value)


def force_cell(words: Words, force: float | None) -> Cell:
    """Force in kN or kN/m, with three digits; "-" for none."""
    return number_cell(words, "max_kN", force)


def fixed_cell(words: Words, value: float | None, decimals: int) -> Cell:
    """Number with so many decimals; "-" for none."""
    return Cell(text=words.show_fixed(value, decimals), number=value)


def given_cell(words: Words, value: float | str) -> Cell:
    """Chosen or counted number: no decimals are added."""
    if isinstance(value, str):
        return text_cell(value)
    return Cell(text=words.show_given(value), number=value)


@dataclass(frozen=True, slots=True, kw_only=True)
class Heading:
    """Heading of a level from 1; level 2 stands in the contents of a document.

    A hidden one is for readers aloud, and in a page alone.
    """

    text: Text
    level: int
    look: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Paragraph:
    """Text."""

    text: Text
    look: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Items:
    """List of sentences."""

    items: tuple[Text, ...]
    look: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pair:
    """Name, and the text that stands beside it."""

    name: str
    text: Text
    look: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pairs:
    """Names with what stands beside them."""

    pairs: tuple[Pair, ...]
    look: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """Drawing of ours as SVG, with its caption below."""

    svg: str
    caption: Text = ""
    id: str = ""
    look: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Figures:
    """Drawings that stand beside each other where there is room."""

    figures: tuple[Figure, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """Blocks that belong together; a link leads to their ``id``."""

    blocks: tuple[Block, ...]
    id: str = ""
    look: str = ""
    kind: Literal["section", "article", "header", "div"] = "section"


Block = Heading | Paragraph | Items | Pairs | Table | Figure | Figures | Part


def section(
    anchor: str,
    heading: str,
    *blocks: Block,
    level: int = 2,
    look: str = "",
) -> Part:
    """Part of a page below a heading."""
    title = Heading(text=heading, level=level)
    return Part(id=anchor, look=look, blocks=(title, *blocks))


def masthead(kind: str, title: str, *more: Block) -> Part:
    """Kind and title of a page, and what stands with them."""
    first = (Paragraph(text=kind, look="kind"), Heading(text=title, level=1))
    return Part(kind="header", look="masthead", blocks=(*first, *more))


def notes(*sentences: Text, look: str = "notes") -> Part:
    """Sentences in a frame; ``notes open`` where they are a warning."""
    return Part(kind="div", look=look, blocks=(Items(items=sentences),))


def write_csv(
    headings: Sequence[str], rows: Iterable[Sequence[float | str | None]]
) -> bytes:
    """CSV of rows under headings; a missing number is an empty cell.

    >>> write_csv(["a_m", "b"], [[0.5, None], [1.0, "x"]])
    b'a_m,b\\n0.5,\\n1.0,x\\n'
    """
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(headings)
    writer.writerows(rows)
    return buffer.getvalue().encode()
