"""Width of columns and height of lines that texts need: no program finds both."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from functools import lru_cache

from netdesign.report.blocks.table import Column, Table

# Widths are in digits of the default font.
BOLD = 1.1  # width of bold letters over that of others
_NARROWEST, _WIDEST = 6.0, 50.0  # columns
_CHARACTER, _CAPITAL = 0.82, 0.3  # width of one of ours; what a capital has beyond it
_WIDEST_LETTER = 1.13  # above that of a capital, whatever is rounded
_INDENT = 1.5  # of a text


def count_lines(
    texts: Sequence[str], widths: Sequence[float], look: float = 1.0
) -> int:
    """Lines that the longest of ``texts`` takes in its column, broken between words.

    ``look`` is the width of its letters over that of plain ones.
    """
    return max(
        [_wrap(text, width / look) for text, width in zip(texts, widths, strict=False)]
    )


def fit_headings(
    columns: Sequence[Column], widths: Sequence[float], turned: Sequence[int] = ()
) -> list[float]:
    """Widths of columns, wider where a word of a level heading has no room."""
    return [
        width if index in turned else max(width, measure_longest(column.heading))
        for index, (column, width) in enumerate(zip(columns, widths, strict=True))
    ]


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
    widths = [_NARROWEST] * max(len(table.columns) for table in tables)
    for place, table in enumerate(tables):
        for index, column in enumerate(table.columns):
            if place and index == len(table.columns) - 1:
                continue  # a last column may reach into empty cells beside it
            wide = [_measure(row[index].text) for row in table.rows]
            wide += [BOLD * _measure(word) for word in column.heading.split()]
            wanted = max(wide, default=0) + 2 * _INDENT
            widths[index] = min(max(widths[index], wanted), _WIDEST)
    return widths
