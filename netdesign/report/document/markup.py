"""Text and tables as WordprocessingML (ISO/IEC 29500-1)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from html import escape
from typing import Any

from netdesign.edge.input_files import make_printable
from netdesign.report.blocks import (
    SMALL,
    STRONG,
    Badge,
    Piece,
    Text,
    list_pieces,
)

_W = "http://schemas.openxmlformats.org/wordprocessingml/2006/main"
NAMESPACE = f'xmlns:w="{_W}"'
KEEP = "<w:keepNext/>"  # a paragraph on one page with the next
POINT = 20  # twentieths of a point, in which widths are counted
SMALLEST_PT = 7.5  # of cells and small text
_MARGIN_PT = 3.0  # left and right of the text of a cell
_TIGHT_MARGIN_PT = 1.5  # the same where columns are narrower than their words
_SIGN = 0.51  # width of a sign in sizes of the font
_BOLD_SIGN = 1.06  # of a heading against another
_LINE = 0.95  # of a whole line: not all of its signs are wide
_LONGEST = 80  # signs of a cell that count for the width of its column
_LONGEST_WORD = 22
_CAPITAL = 0.35  # more than the width of another sign
_PART = "xxxxx"  # of a word of a heading that may stand alone
# Looks that are bold in a document.
_BESIDE = "beside"
_SMALL_PIECES = (SMALL, _BESIDE)
_BOLD = ("strong", "name", "ratio", "figure", "hidden")
_SAYS, _SAYS_PT = "says", 11.5  # of a heading, what stands behind its name
_SUBSCRIPT = re.compile(r"_(\w+)")


def parse(markup: str) -> Any:
    """Element of one paragraph or table."""
    from docx.oxml import parse_xml

    return parse_xml(f"<w:body {NAMESPACE}>{markup}</w:body>")[0]


Runs = tuple[Piece, ...]  # what stands in a paragraph or a cell


@dataclass(frozen=True, slots=True, kw_only=True)
class Grid:
    """Cells under headings. A line of one cell goes over all columns.

    Without headings the first column names the lines.
    """

    headings: tuple[Runs, ...] = ()
    numbers: tuple[bool, ...]  # columns that are set to the right
    lines: tuple[tuple[Runs, ...], ...]


def list_runs(text: Text, *, has_symbols: bool = False) -> Runs:
    """Pieces of a block's text, small ones on lines of their own; no sketches."""
    runs: list[Piece] = []
    for piece in list_pieces(text, has_symbols=has_symbols):
        if isinstance(piece, Badge):
            shown = piece.verdict
            word = "" if piece.look == "sign" else shown.word
            runs.append(Piece(f"{shown.symbol}\u00a0{word}", STRONG))
        elif isinstance(piece, Piece):
            is_small = piece.look == SMALL
            begins = is_small and runs and not runs[-1].text.endswith("\n")
            text = f"\n{piece.text}" if begins else piece.text
            if piece.look == _BESIDE and runs:  # a number's second one
                text = re.sub("^ ", "\u00a0", text)
            runs.append(replace(piece, text=text))
    return tuple(runs)


def write_runs(
    runs: Runs, *, is_bold: bool = False, is_small: bool | None = None
) -> str:
    """Pieces as WordprocessingML; all of them are small, or none, if that is said."""
    written = ""
    for piece in runs:
        look = "<w:b/>" if is_bold or piece.look in _BOLD else ""
        if piece.look == _SAYS:
            look += f'<w:b w:val="0"/><w:sz w:val="{round(2 * _SAYS_PT)}"/>'
        if is_small or (is_small is None and piece.look in _SMALL_PIECES):
            look += f'<w:sz w:val="{round(2 * SMALLEST_PT)}"/>'
        lowered = look + '<w:vertAlign w:val="subscript"/>'
        parts = _SUBSCRIPT.split(piece.text) if piece.has_symbols else [piece.text]
        written += "".join(
            _write_run(part, lowered if place % 2 else look)
            for place, part in enumerate(parts)
            if part
        )
    return written


def _write_run(text: str, look: str) -> str:
    lines = make_printable(text).split("\n")
    inside = "<w:br/>".join(
        f'<w:t xml:space="preserve">{escape(line)}</w:t>' if line else ""
        for line in lines
    )
    return f"<w:r><w:rPr>{look}</w:rPr>{inside}</w:r>"


def write_paragraph(runs: str, style: str, look: str = "") -> str:
    """Paragraph of a style, by its id."""
    named = f'<w:pStyle w:val="{escape(style)}"/>'
    return f"<w:p><w:pPr>{named}{look}</w:pPr>{runs}</w:p>"


def write_table(
    grid: Grid, styles: tuple[str, str], width_pt: float, *, keeps: bool = False
) -> str:
    """Table over the whole width; its headings are repeated on each page.

    Parameters
    ----------
    grid : Grid
        Its margins are smaller where its columns do not fit on the paper.
    styles : tuple of str
        Ids of the style of tables and of that of the paragraphs in a cell.
    width_pt : float
        Between the margins of the page [pt].
    keeps : bool
        On one page, with what follows.
    """
    least, wanted = _measure_columns(grid)
    margin_pt = _MARGIN_PT
    if sum(least) > width_pt:
        margin_pt = _TIGHT_MARGIN_PT
        least, wanted = _measure_tight(grid)
        if sum(least) > width_pt:
            grid = _loosen(grid)
            least, wanted = _measure_tight(grid)
    widths = [round(POINT * w) for w in share_width(least, wanted, width_pt)]
    head = [_write_line(grid.headings, grid, widths, styles[1], True, True)]
    lines = [
        _write_line(line, grid, widths, styles[1], False, keeps) for line in grid.lines
    ]
    columns = "".join(f'<w:gridCol w:w="{width}"/>' for width in widths)
    margin = f'w:w="{round(POINT * margin_pt)}" w:type="dxa"'
    look = int(bool(grid.headings))
    return (
        f'<w:tbl><w:tblPr><w:tblStyle w:val="{escape(styles[0])}"/>'
        f'<w:tblW w:w="{sum(widths)}" w:type="dxa"/><w:tblLayout w:type="fixed"/>'
        f"<w:tblCellMar><w:left {margin}/><w:right {margin}/></w:tblCellMar>"
        f'<w:tblLook w:firstRow="{look}" w:lastRow="0" w:firstColumn="0" '
        f'w:lastColumn="0" w:noHBand="1" w:noVBand="1"/></w:tblPr>'
        f"<w:tblGrid>{columns}</w:tblGrid>"
        f"{''.join(head if grid.headings else [])}{''.join(lines)}</w:tbl>"
    )


def _write_line(
    cells: Sequence[Runs],
    grid: Grid,
    widths: Sequence[int],
    style: str,
    is_head: bool,
    keeps: bool,
) -> str:
    spans = len(cells) == 1 < len(widths)
    taken = [sum(widths)] if spans else widths
    spanned = f'<w:gridSpan w:val="{len(widths)}"/>' if spans else ""
    inside = ""
    for cell, width, is_number in zip(cells, taken, grid.numbers, strict=False):
        runs = write_runs(cell, is_bold=is_head)
        look = KEEP if keeps else ""
        look += '<w:jc w:val="right"/>' if is_number and not spans else ""
        inside += (
            f'<w:tc><w:tcPr><w:tcW w:w="{width}" w:type="dxa"/>{spanned}</w:tcPr>'
            f"{write_paragraph(runs, style, look)}</w:tc>"
        )
    repeated = "<w:tblHeader/>" if is_head else ""
    return f"<w:tr><w:trPr><w:cantSplit/>{repeated}</w:trPr>{inside}</w:tr>"


def _measure_columns(
    grid: Grid, margin_pt: float = _MARGIN_PT
) -> tuple[list[float], list[float]]:
    """Widths of the longest word and of the longest line of each column [pt].

    Headings may be broken between their words.
    """
    count = len(grid.numbers)
    lines = [line for line in (grid.headings, *grid.lines) if len(line) == count]
    columns = list(zip(*lines, strict=True))
    texts = [[_join(cell) for cell in column] for column in columns]
    first = bool(grid.headings)
    least = [
        max(
            _BOLD_SIGN * _measure(_list_words(column[:first]), margin_pt),
            _find_weight(cells) * _measure(_list_words(column[first:]), margin_pt),
        )
        for column, cells in zip(texts, columns, strict=True)
    ]
    wanted = [
        _LINE * _measure(_list_lines(column[first:]), margin_pt) for column in texts
    ]
    return least, [max(pair) for pair in zip(least, wanted, strict=True)]


def _measure_tight(grid: Grid) -> tuple[list[float], list[float]]:
    """The same where words of headings have to break, before any number does."""
    wanted, _ = _measure_columns(grid, _TIGHT_MARGIN_PT)
    headings = tuple((Piece(_PART),) for _ in grid.headings)
    least, _ = _measure_columns(replace(grid, headings=headings), _TIGHT_MARGIN_PT)
    return least, wanted


def _loosen(grid: Grid) -> Grid:
    """The same grid; the symbol of a verdict may stand above its number."""

    def loosen(content: Runs) -> Runs:
        return tuple(
            replace(piece, text=piece.text.replace("\u00a0", " ")) for piece in content
        )

    lines = tuple(tuple(loosen(cell) for cell in line) for line in grid.lines)
    return replace(grid, lines=lines)


def _find_weight(cells: Iterable[Runs]) -> float:
    """Width of the signs of a column over that of plain ones."""
    is_bold = any(piece.look == STRONG for cell in cells for piece in cell)
    return _BOLD_SIGN if is_bold else 1.0


def _join(content: Runs) -> str:
    return "".join(piece.text for piece in content)


def _list_words(texts: Iterable[str]) -> list[float]:
    """Lengths of the words, very long ones cut: they break anywhere."""
    lengths = (_count(w) for text in texts for w in re.split(r"[ \n\-]", text))
    return [min(length, _LONGEST_WORD) for length in lengths]


def _list_lines(texts: Iterable[str]) -> list[int]:
    return [min(len(line), _LONGEST) for text in texts for line in text.split("\n")]


def _count(word: str) -> float:
    """Length in signs of middle width: capitals are wider."""
    return len(word) + _CAPITAL * sum(sign.isupper() for sign in word)


def _measure(lengths: Sequence[float], margin_pt: float) -> float:
    """Width that the longest text takes in a cell [pt]."""
    return max(lengths, default=1) * _SIGN * SMALLEST_PT + 2.0 * margin_pt + 1.0


def share_width(
    least: Sequence[float], wanted: Sequence[float], width: float
) -> list[float]:
    """Widths of columns that add up to ``width``: least ones first, then by wish.

    Examples
    --------
    >>> share_width([10.0, 10.0], [10.0, 30.0], 30.0)
    [10.0, 20.0]
    >>> share_width([20.0, 40.0], [20.0, 40.0], 30.0)
    [10.0, 20.0]
    """
    if sum(least) >= width:
        return [width * column / sum(least) for column in least]
    if sum(wanted) <= width:
        return [width * column / sum(wanted) for column in wanted]
    share = (width - sum(least)) / (sum(wanted) - sum(least))
    return [low + share * (high - low) for low, high in zip(least, wanted, strict=True)]
