"""Common parts of the workbook's sheets: formats, tables, widths, print set-up."""

from __future__ import annotations

import math
import re
import textwrap
from collections.abc import Sequence
from functools import lru_cache
from types import MappingProxyType
from typing import Any

from netdesign.outcome import Verdict
from netdesign.quantities import QUANTITIES
from netdesign.report.blocks import Cell, Column, Table, write_plain
from netdesign.report.words import Words, show_verdict

# Widths are in digits of the default font.
BOLD = 1.1  # width of bold letters over that of others
_NARROWEST, _WIDEST, _ALONE = 6.0, 75.0, 130.0  # columns; one without others
_NAMES, _TEXTS = 24.0, 90.0  # columns of a sheet without tables
_CHARACTER, _CAPITAL = 0.82, 0.3  # width of one of ours; what a capital has beyond it
_WIDEST_LETTER = 1.13  # above that of a capital, whatever is rounded
_INDENT = 1.5  # of a text
BETWEEN_TABLES = 3  # lines from one table of a sheet to the next


def read_cell(cell: Cell) -> str:
    """Text of a cell, or that of its content."""
    return cell.text or write_plain(cell.content)


def count_lines(
    texts: Sequence[str], widths: Sequence[float], look: float = 1.0
) -> int:
    """Lines that the longest of ``texts`` takes in its column, broken between words.

    ``look`` is the width of its letters over that of plain ones.
    """
    return max(
        [_wrap(text, width / look) for text, width in zip(texts, widths, strict=False)]
    )


def measure_longest(heading: str) -> float:
    """Width that the longest word of a heading needs."""
    return max(BOLD * _measure(word) + _INDENT for word in ("", *heading.split()))


def _wrap(text: str, width: float) -> int:
    """Lines of a text in a column; a part of it is the distance from the one before."""
    if _WIDEST_LETTER * len(text) + _INDENT <= width:
        return 1
    wide = _measure(text)
    if wide + _INDENT <= width:
        return 1
    letters = (width - _INDENT) * len(text) / wide
    return _fold(text, max(int(letters), 1))


@lru_cache(maxsize=1024)
def _fold(text: str, letters: int) -> int:
    """Lines of so many letters; kept, for most long texts stand at many checks."""
    return len(textwrap.wrap(text, letters))


def _measure(text: str) -> float:
    """Width of a text in digits of the default font; capitals are wider than others."""
    if text.isascii() and text == text.lower():
        return _CHARACTER * len(text)
    return _CHARACTER * len(text) + _CAPITAL * sum(map(str.isupper, text))


def find_widths(tables: Sequence[Table]) -> list[float]:
    """Width of each column: its longest cell and the longest word of its head.

    The last columns of all tables but the first do not count.
    """
    if not tables:
        return [_NAMES, _TEXTS]
    widths = [_NARROWEST] * max(len(table.columns) for table in tables)
    if len(widths) == 1:
        return [_ALONE]
    for place, table in enumerate(tables):
        for index, column in enumerate(table.columns):
            if place and index == len(table.columns) - 1:
                continue  # a last column may reach into empty cells beside it
            wide = [_measure(read_cell(row[index])) for row in table.rows]
            wide += [BOLD * _measure(word) for word in column.heading.split()]
            wanted = max(wide, default=0) + 2 * _INDENT
            widths[index] = min(max(widths[index], wanted), _WIDEST)
    return widths


# A sheet is made smaller until it is as wide as its pages.
A4, A3 = 9, 8  # paper numbers of the format
_UPRIGHT_PT = 538.0  # between the margins of A4
_WIDTH_PT = {A4: 784.0, A3: 1133.0}  # of papers that lie on their side
_CHARACTER_PT = 5.56  # of a column, as LibreOffice prints it
_EDGE = 0.72  # that both add to the width of a column, in characters
_SMALLEST = 0.62  # of the size of the text, below which a sheet takes more paper
NAMING = 2  # columns that name a line, repeated on a second page beside the first


def choose_paper(widths: Sequence[float]) -> tuple[int, int, bool]:
    """Paper on which columns are read without a glass.

    Parameters
    ----------
    widths : sequence of float
        Of the columns, in characters of the default font [-].

    Returns
    -------
    paper : int
        Number of the format.
    pages : int
        Pages side by side.
    is_wide : bool
        The paper lies on its side.
    """
    if _find_scale(widths, _UPRIGHT_PT, 1) >= _SMALLEST:
        return A4, 1, False
    for paper, pages in ((A4, 1), (A3, 1), (A4, 2)):
        if _find_scale(widths, _WIDTH_PT[paper], pages) >= _SMALLEST:
            return paper, pages, True
    return A3, 2, True


def _find_scale(widths: Sequence[float], paper_pt: float, pages: int) -> float:
    wide, named = (
        sum(columns) + _EDGE * len(columns) for columns in (widths, widths[:NAMING])
    )
    shown = _CHARACTER_PT * (wide + (pages - 1) * named)
    return min(1.0, pages * paper_pt / shown)


_FONT = {"font_name": "Arial", "font_size": 9, "valign": "vcenter"}
_HEAD = {"bold": True, "bottom": 1, "text_wrap": True, "valign": "bottom"}
_COLOURS = {
    "pass": ("#DDEBDD", "#1E4620"),
    "fail": ("#F3D3CA", "#8C2A14"),
    "not-proven": ("#F7EBC8", "#5F4B00"),
    "declared": ("#DCE7F2", "#20415F"),
}
# Widths are in digits of the default font. Every program must have it, or one as wide:
# LibreOffice prints a sheet a third smaller that names one which it lacks.
DEFAULT_FONT = MappingProxyType({"font_name": "Arial", "font_size": 10})
_LINE_PT, _ROOM_PT = 11.3, 0.9  # height of a line of text, and room around a row
# With the mark of any language: a sign, and a unit behind.
_DECIMAL = re.compile(r"([-+\u2212]?)\d+(?:[.,](\d+))?( m²?)?")
_LINK = "#2A4B6B"
_LONGEST_NAME = 31  # of a sheet
_LONGEST_TEXT = 32000  # a cell holds 32767 characters
_LONGEST_LINK = 2000  # of its text too; older XlsxWriters leave longer links out


def _show_literally(text: str) -> str:
    """Text for a footer, where ``&`` begins a code and ``&G`` a picture."""
    return re.sub(r"&([G\[])", r"& \1", text).replace("&", "&&")


class Book:
    """A workbook being written; keeps one format for each set of properties."""

    def __init__(self, workbook: Any, footer: str, words: Words) -> None:
        self.workbook = workbook
        self.words = words
        self.verdicts = {verdict: show_verdict(verdict, words) for verdict in Verdict}
        self._footer = _show_literally(footer[:120])
        self._formats: dict[tuple[tuple[str, Any], ...], Any] = {}

    def format(self, **properties: Any) -> Any:
        """Format with the font of the workbook and these properties."""
        key = tuple(sorted(properties.items()))
        if key not in self._formats:
            self._formats[key] = self.workbook.add_format({**_FONT, **properties})
        return self._formats[key]

    def text(self, **properties: Any) -> Any:
        """Format of a text; it keeps a distance from a number before it."""
        return self.format(align="left", indent=1, **properties)

    def set_height(self, sheet: Any, row: int, lines: int, **fold: Any) -> None:
        """Height for wrapped text: not every program finds it on its own.

        ``fold`` says what folds the row or is folded below it.
        """
        sheet.set_row(row, _LINE_PT * lines + _ROOM_PT, None, fold)

    def add_sheet(
        self, name: str, title: str, *, paper: int = A4, is_wide: bool = True
    ) -> Any:
        """Sheet with a title in its first cell, ready to print on one page width."""
        sheet = self.workbook.add_worksheet(self.name(name))
        sheet.hide_gridlines(2)
        sheet.set_landscape() if is_wide else sheet.set_portrait()
        sheet.set_paper(paper)
        sheet.fit_to_pages(1, 0)
        sheet.set_margins(left=0.4, right=0.4, top=0.4, bottom=0.55)
        sheet.set_footer(f"&L&9 {self._footer}&C&9 &A&R&9 &P / &N")
        sheet.write_string(0, 0, title, self.text(bold=True, font_size=13))
        sheet.set_row(0, 22)
        return sheet

    def name(self, sheet: str) -> str:
        """Name of a sheet, by its key, in the language of the workbook."""
        return self.words(f"heading.{sheet}")[:_LONGEST_NAME]

    def refer(self, sheet: str, area: str) -> str:
        """Reference to an area of another sheet."""
        return f"'{self.name(sheet)}'!{area}"

    def link(self, sheet: Any, place: tuple[int, int], target: str, text: str) -> None:
        """Text that leads to a place of this workbook."""
        form = self.text(font_color=_LINK, underline=1)
        sheet.write_url(*place, f"internal:{target}", form, text[:_LONGEST_LINK])

    def link_back(self, sheet: Any) -> None:
        """Lead back to the first sheet."""
        text = f"← {self.name('decision')}"
        self.link(sheet, (1, 0), self.refer("decision", "A1"), text)

    def word(self, verdict: Verdict) -> str:
        """Word of a verdict in the language of the workbook."""
        return self.verdicts[verdict].word

    def write_head(
        self,
        sheet: Any,
        row: int,
        columns: Sequence[Column],
        widths: Sequence[float],
    ) -> None:
        """Headings of a table, in columns of these widths."""
        for index, column in enumerate(columns):
            form = self.format(**_HEAD, **_align(column))
            sheet.write_string(row, index, column.heading, form)
        headings = [column.heading for column in columns]
        self.set_height(sheet, row, max(2, count_lines(headings, widths, BOLD)))

    def write_cell(
        self,
        sheet: Any,
        place: tuple[int, int],
        column: Column,
        cell: Cell,
    ) -> None:
        """Write a number as a number with its format, all else as text."""
        if cell.note:
            sheet.write_comment(*place, cell.note[:_LONGEST_TEXT], {"x_scale": 3})
        if cell.number is None or not math.isfinite(cell.number):
            form = self.format(**_align(column), text_wrap=True)
            sheet.write_string(*place, read_cell(cell)[:_LONGEST_TEXT], form)
            return
        look = _find_look(column.quantity, cell.text)
        if cell.verdict is not None:
            shown = self.verdicts[cell.verdict]
            look["num_format"] = f'"{shown.symbol}"\\ {look["num_format"]}'
            look["font_color"] = _COLOURS[shown.style][1]
        form = self.format(**_align(column), **look)
        sheet.write_number(*place, cell.number, form)

    def write_table(
        self, sheet: Any, table: Table, top: int, widths: Sequence[float]
    ) -> int:
        """Caption, headings and rows, or what stands for none; the next free row.

        ``widths`` are those of the sheet. A text that would reach beyond its columns is
        wrapped: one that runs out of the sheet makes all of it small in print.
        """
        self.write_wide(sheet, (top, 0), table.caption, widths, italic=True)
        if not table.rows:
            self.write_wide(sheet, (top + 1, 0), table.empty, widths)
            return top + 3
        self.write_head(sheet, top + 1, table.columns, widths)
        last = len(table.columns) - 1
        own = [*widths[:last], sum(widths[last:])]
        for row, cells in enumerate(table.rows, top + 2):
            for index, (column, cell) in enumerate(
                zip(table.columns, cells, strict=True)
            ):
                if index == last and cell.number is None:
                    self.write_wide(sheet, (row, last), read_cell(cell), widths)
                else:
                    self.write_cell(sheet, (row, index), column, cell)
            self.set_height(sheet, row, count_lines([*map(read_cell, cells)], own))
        return top + 3 + len(table.rows)

    def write_wide(
        self,
        sheet: Any,
        place: tuple[int, int],
        text: str,
        widths: Sequence[float],
        **look: Any,
    ) -> None:
        """Text from a cell to the last column, on as many lines as it needs."""
        row, column = place
        form = self.text(text_wrap=True, **look)
        room = widths[column:]
        is_long = count_lines([text], room[:1]) > 1
        if is_long and len(room) > 1:
            sheet.merge_range(row, column, row, column + len(room) - 1, "", form)
        sheet.write_string(row, column, text[:_LONGEST_TEXT], form)
        if column == 0:
            self.set_height(sheet, row, count_lines([text], [sum(room)]))

    def add_table_sheet(
        self,
        name: str,
        title: str,
        tables: Sequence[Table],
        *,
        has_more: bool = False,
    ) -> Any:
        """Sheet of tables one below the other; a single one can be filtered.

        Where there are several, or other blocks follow, no heading is repeated on each
        page of paper: it would stand above columns of another table.
        """
        widths = find_widths(tables)
        paper, pages, is_wide = choose_paper(widths)
        sheet = self.add_sheet(name, title, paper=paper, is_wide=is_wide)
        if pages > 1:
            sheet.fit_to_pages(pages, 0)
            sheet.repeat_columns(0, NAMING - 1)
        self.link_back(sheet)
        top = 2
        for table in tables:
            top = self.write_table(sheet, table, top, widths)
        for index, width in enumerate(widths):
            sheet.set_column(index, index, width)
        first = tables[0] if len(tables) == 1 and not has_more else None
        if first is not None:
            sheet.repeat_rows(3)
        if first is not None and first.rows:
            sheet.autofilter(3, 0, 3 + len(first.rows), len(first.columns) - 1)
        sheet.freeze_panes(4, 1)
        return sheet

    def colour_verdicts(self, sheet: Any, area: tuple[int, int, int, int]) -> None:
        """Colours for the words of the verdicts in ``area``."""
        for words in self.verdicts.values():
            back, front = _COLOURS[words.style]
            form = self.workbook.add_format({"bg_color": back, "font_color": front})
            rule = {
                "type": "cell",
                "criteria": "==",
                "value": f'"{words.word}"',
                "format": form,
            }
            sheet.conditional_format(*area, rule)


def _find_look(quantity: str, text: str) -> dict[str, Any]:
    """Format of a number: that of its quantity, or with digits and unit of its text."""
    if quantity:
        return {"num_format": QUANTITIES[quantity].number_format}
    parts = _DECIMAL.fullmatch(text)
    if parts is None:
        return {}
    digits = f"0.{'0' * len(parts[2] or '')}".rstrip(".")
    shown = f'{digits}"{parts[3]}"' if parts[3] else digits
    return {"num_format": f"+{shown};-{shown};{shown}" if parts[1] == "+" else shown}


def _align(column: Column) -> dict[str, Any]:
    """Numbers to the right; texts keep a distance from a number before them."""
    return {"align": "right"} if column.is_number else {"align": "left", "indent": 1}
