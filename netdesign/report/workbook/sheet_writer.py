"""Blocks of a report written into a sheet, one below the other."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from netdesign.report.blocks import (
    HIDDEN,
    Block,
    Heading,
    Items,
    Pairs,
    Paragraph,
    Part,
    Table,
    write_plain,
)
from netdesign.report.workbook.writer import (
    BETWEEN_TABLES,
    Book,
    count_lines,
    find_widths,
)

_LABEL = 24.0  # least width of the names of pairs, in digits


@dataclass(slots=True, kw_only=True)
class SheetWriter:
    """Writes blocks below a line; a drawing has no place in a sheet.

    Attributes
    ----------
    widths : sequence of float
        Widths of the columns, in digits of the default font.
    line : int
        Next free line, zero-based.
    """

    book: Book
    sheet: Any
    widths: Sequence[float]
    line: int

    def write(self, blocks: Iterable[Block]) -> None:
        """All blocks, those of parts as well."""
        for block in blocks:
            if isinstance(block, Part):
                self.write(block.blocks)
            elif isinstance(block, Heading) and block.look != HIDDEN:
                self.line += 1
                self._write_line(write_plain(block.text), bold=True)
            elif isinstance(block, Paragraph):
                self._write_line(write_plain(block.text))
            elif isinstance(block, Items):
                for item in block.items:
                    self._write_line(f"– {write_plain(item)}")
            elif isinstance(block, Pairs):
                self._write_pairs(
                    [(pair.name, write_plain(pair.text)) for pair in block.pairs]
                )
            elif isinstance(block, Table):
                self._write_table(block)

    def _write_line(self, text: str, **look: Any) -> None:
        self.book.write_wide(self.sheet, (self.line, 0), text, self.widths, **look)
        self.line += 1

    def _write_table(self, table: Table) -> None:
        """A table of names and values stands in the columns of another table."""
        if len(table.columns) == 2:
            shown = [[x.text or write_plain(x.content) for x in y] for y in table.rows]
            self._write_pairs([(name, value) for name, value in shown])
            return
        self.line = self.book.write_table(self.sheet, table, self.line, self.widths)

    def _write_pairs(self, pairs: Sequence[tuple[str, str]]) -> None:
        """Names in the first columns, and beside each its text, over all others."""
        first, wide = 0, 0.0
        while wide < _LABEL and first < len(self.widths) - 1:
            wide += self.widths[first]
            first += 1
        rest = sum(self.widths[first:])
        form = self.book.text(text_wrap=True, valign="top")
        spans = ((0, first - 1), (first, len(self.widths) - 1))
        for pair in pairs:
            for text, (start, end) in zip(pair, spans, strict=True):
                if end > start:
                    self.sheet.merge_range(self.line, start, self.line, end, "", form)
                self.sheet.write_string(self.line, start, text, form)
            count = max(
                sum(count_lines([one], [room]) for one in text.split("\n"))
                for text, room in zip(pair, (wide, rest), strict=True)
            )
            self.book.set_height(self.sheet, self.line, count)
            self.line += 1


def add_page_sheet(
    book: Book, name: str, tables: Sequence[Table], *blocks: Block
) -> Any:
    """Sheet of tables that are read by number, and other blocks of a page below them.

    Parameters
    ----------
    book : Book
        That gets the sheet.
    name : str
        Key of the sheet, whose heading is its title.
    tables : sequence of Table
        They set the widths of the columns.
    blocks : Block
        What follows, as on the page.
    """
    title = book.words(f"heading.{name}")
    sheet = book.add_table_sheet(name, title, tables, has_more=bool(blocks))
    line = 2 + sum(BETWEEN_TABLES + len(table.rows) for table in tables)
    widths = find_widths(tables)
    SheetWriter(book=book, sheet=sheet, widths=widths, line=line).write(blocks)
    return sheet
