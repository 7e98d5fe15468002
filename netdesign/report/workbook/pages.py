"""Paper for a sheet on which its columns can be read."""

from __future__ import annotations

from collections.abc import Sequence

# Papers lie on their side; a sheet is made smaller until it is as wide as its pages.
A4, A3 = 9, 8  # paper numbers of the format
_WIDTH_PT = {A4: 798.0, A3: 1147.0}  # between the margins
_CHARACTER_PT = 5.56  # of a column, as LibreOffice prints it
_EDGE = 0.72  # that both add to the width of a column, in characters
_SMALLEST = 0.82  # of the size of the text, below which a sheet takes more paper
NAMING = 2  # columns that name a line, repeated on a second page beside the first


def choose_paper(widths: Sequence[float]) -> tuple[int, int]:
    """Paper, and pages side by side, on which columns are read without a glass.

    Parameters
    ----------
    widths : sequence of float
        Of the columns, in characters of the default font [-].
    """
    for paper, pages in ((A4, 1), (A4, 2), (A3, 1)):
        if _find_scale(widths, paper, pages) >= _SMALLEST:
            return paper, pages
    return A3, 2


def _find_scale(widths: Sequence[float], paper: int, pages: int) -> float:
    wide, named = (sum(one) + _EDGE * len(one) for one in (widths, widths[:NAMING]))
    shown = _CHARACTER_PT * (wide + (pages - 1) * named)
    return min(1.0, pages * _WIDTH_PT[paper] / shown)
