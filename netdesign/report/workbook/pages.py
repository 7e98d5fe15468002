"""Pages of paper for a sheet: where one ends, so that a heading keeps its table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

# Papers lie on their side; a sheet is made smaller until it is as wide as its pages.
A4, A3 = 9, 8  # paper numbers of the format
_WIDTH_PT = {A4: 798.0, A3: 1147.0}  # between the margins
_HEIGHT_PT = {A4: 516.0, A3: 763.0}
_CHARACTER_PT = 5.56  # of a column, as LibreOffice prints it
_NARROW_PT = 5.25  # as Excel does, which then makes the sheet less small
_EDGE = 0.72  # that both add to the width of a column, in characters
_SMALLEST = 0.82  # of the size of the text, below which a sheet takes more paper
_ROW_PT = 15.0  # height of a line of which nothing is said
_STEPS = 40  # in which the height of a page is tried
NAMING = 2  # columns that name a line, repeated on a second page beside the first


@dataclass(frozen=True, slots=True)
class Line:
    """Line of a sheet: its height [pt], and whether the next one stays with it."""

    height: float
    is_kept: bool = False


def choose_paper(widths: Sequence[float]) -> tuple[int, int]:
    """Paper, and pages side by side, on which columns are read without a glass.

    Parameters
    ----------
    widths : sequence of float
        Of the columns, in characters of the default font [-].
    """
    for paper, pages in ((A4, 1), (A4, 2), (A3, 1)):
        if _find_scale(widths, paper, pages, _CHARACTER_PT) >= _SMALLEST:
            return paper, pages
    return A3, 2


def find_height(
    widths: Sequence[float], paper: int, pages: int, naming: int = NAMING
) -> float:
    """Height of a page between its margins, in points of the sheet before its scale.

    That of Excel, which is the smaller one.
    """
    scale = _find_scale(widths, paper, pages, _NARROW_PT, naming)
    return _HEIGHT_PT[paper] / scale


def _find_scale(
    widths: Sequence[float],
    paper: int,
    pages: int,
    character: float,
    naming: int = NAMING,
) -> float:
    wide, named = (sum(one) + _EDGE * len(one) for one in (widths, widths[:naming]))
    shown = character * (wide + (pages - 1) * named)
    return min(1.0, pages * _WIDTH_PT[paper] / shown)


def place_breaks(
    lines: Sequence[Line], height: float, repeated: float = 0.0
) -> list[int]:
    """Lines that begin a page after the first.

    The pages are as few as can be. Where the last one would hold less than a third, the
    others give some of theirs to it.

    Parameters
    ----------
    lines : sequence of Line
        Of the sheet, from its first.
    height : float
        Of a page [pt].
    repeated : float
        Height of the heading that every page after the first repeats [pt].
    """
    best = _fill(lines, height, repeated)
    for step in range(_STEPS - 1, _STEPS // 2, -1):
        last = sum(line.height for line in lines[best[-1] :]) if best else height
        lower = _fill(lines, height * step / _STEPS, repeated)
        if last >= height / 3.0 or len(lower) > len(best):
            break
        best = lower
    return best


def _fill(lines: Sequence[Line], height: float, repeated: float) -> list[int]:
    breaks: list[int] = []
    start, used = 0, 0.0
    for index, line in enumerate(lines):
        used += line.height
        if used <= height or index == start:
            continue
        begin = _step_back(lines, start, index)
        breaks.append(begin)
        start = begin
        used = repeated + sum(one.height for one in lines[begin : index + 1])
    return breaks


def _step_back(lines: Sequence[Line], start: int, index: int) -> int:
    """First of the lines that stay with line ``index``; itself if all of them do."""
    begin = index
    while begin > start and lines[begin - 1].is_kept:
        begin -= 1
    return begin if begin > start else index


class Paper:
    """Lines of a sheet as it is written, to find where its pages end."""

    def __init__(self, sheet: Any) -> None:
        self.sheet = sheet
        self._heights: dict[int, float] = {}
        self._kept: set[int] = set()
        self.height = 0.0  # of a page; 0 where nothing was chosen
        self._repeated: int | None = None

    def set_height(self, row: int, height: float) -> None:
        """Height of a line [pt]."""
        self._heights[row] = height

    def keep(self, first: int, last: int) -> None:
        """Keep lines ``first`` to ``last`` on one page."""
        self._kept.update(range(first, last))
        self._heights.setdefault(last, _ROW_PT)

    def repeat(self, row: int) -> None:
        """Repeat a heading on every page."""
        self.sheet.repeat_rows(row)
        self._repeated = row

    def end_pages(self) -> None:
        """Write where pages end."""
        lines = [
            Line(self._heights.get(row, _ROW_PT), row in self._kept)
            for row in range(max(self._heights, default=0) + 1)
        ]
        repeated = 0.0 if self._repeated is None else lines[self._repeated].height
        if self.height:
            breaks = place_breaks(lines, self.height, repeated)
            self.sheet.set_h_pagebreaks(breaks)
