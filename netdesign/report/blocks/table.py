"""Parts of a table of the report: cells under headings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from netdesign.report.blocks.text import Content
from netdesign.report.words import MISSING, Words, name_heading, show_text

# Where a block is shown: everywhere, or in a page and not in a document.
Medium = Literal["all", "page"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Cell:
    """Text that a reader sees, and the number behind it if it is one.

    ``content`` stands for the text where it has several looks.
    """

    text: str = ""
    number: float | None = None
    content: Content = ()


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
    on: Medium = "all"
    symbols: Literal["", "headings", "cells"] = ""

    def shown(
        self, look: str, *, symbols: Literal["", "headings", "cells"] = ""
    ) -> Table:
        """The same table with a look."""
        return replace(self, look=look, symbols=symbols or self.symbols)


def text_column(heading: str) -> Column:
    """Column of texts."""
    return Column(heading=heading)


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


def text_cell(text: str) -> Cell:
    """Text on one line, never empty."""
    return Cell(text=show_text(text))


def rich_cell(content: Content) -> Cell:
    """Text in several looks."""
    return Cell(content=content)


def number_cell(words: Words, key: str, value: float | None) -> Cell:
    """Number of the quantity ``key``, with its decimals."""
    return Cell(text=words.show_number(key, value), number=value)


def fixed_cell(words: Words, value: float | None, decimals: int) -> Cell:
    """Number with so many decimals; "-" for none."""
    return Cell(text=words.show_fixed(value, decimals), number=value)


def share_cell(words: Words, value: float | None) -> Cell:
    """Pure number of any size, three significant digits."""
    return Cell(text=words.show_share(value), number=value)


def given_cell(words: Words, value: float | str) -> Cell:
    """Number that somebody chose or counted: no decimals are added."""
    if isinstance(value, str):
        return text_cell(value)
    return Cell(text=words.show_given(value), number=value)
