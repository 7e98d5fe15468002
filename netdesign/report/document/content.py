"""Parts of a document before they are XML: pieces of text, tables of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from netdesign.report.view.check_view import CheckView
from netdesign.report.view.table import Table
from netdesign.report.words import MISSING, VERDICTS, VerdictWords, Words

_SYMBOLS = tuple(signs.symbol for signs in VERDICTS.values())


@dataclass(frozen=True, slots=True)
class Piece:
    """Text in one look; a new line at each of its line ends."""

    text: str
    is_bold: bool = False
    is_small: bool = False
    has_symbols: bool = False  # E_d has a lowered d


Content = tuple[Piece, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Grid:
    """A table: headings, lines of cells. A line of one cell goes over all columns.

    Without headings the first column names the lines.
    """

    caption: str = ""
    headings: tuple[Content, ...] = ()
    numbers: tuple[bool, ...]  # columns that are set to the right
    lines: tuple[tuple[Content, ...], ...]


def plain(text: str) -> Content:
    """Text alone; that of a verdict is bold: its symbol comes first."""
    is_verdict = text in _SYMBOLS or text.startswith(tuple(f"{s} " for s in _SYMBOLS))
    return (Piece(text.replace(" ", "\u00a0", int(is_verdict)), is_bold=is_verdict),)


def symbols(text: str) -> Content:
    """Text with lowered subscripts."""
    return (Piece(text, has_symbols=True),)


def small(lines: Sequence[str]) -> Content:
    """Small lines, one below the other."""
    return (Piece("\n".join(line for line in lines if line), is_small=True),)


def badge(verdict: VerdictWords) -> Piece:
    """Symbol and word of a verdict."""
    return Piece(f"{verdict.symbol}\u00a0{verdict.word}", is_bold=True)


def show_utilisation(check: CheckView) -> Content:
    """Utilisation with its band."""
    band = f" {check.band}" if check.bar and check.band != MISSING else ""
    return (Piece(check.utilisation, is_bold=True), Piece(band))


def show_demand(check: CheckView | None, words: Words) -> Content:
    """One place of a check: verdict, utilisation, demand, what governs, its case."""
    if check is None:
        return plain(MISSING)
    told = [f"E_d {check.demand}"] if check.demand != MISSING else []
    told += [check.loads] if check.loads else []
    told += [check.case_short] if check.case_short != MISSING else []
    return (
        badge(check.verdict),
        Piece("\n"),
        *show_utilisation(check),
        Piece("\n" + words.join(told), is_small=True, has_symbols=True),
    )


def list_cells(table: Table, *, has_symbols: bool = False, hidden: str = "") -> Grid:
    """Grid of a table of the report, without the rows of which a cell is ``hidden``."""
    return Grid(
        caption=table.caption,
        headings=tuple(
            (Piece(column.heading, has_symbols=has_symbols),)
            for column in table.columns
        ),
        numbers=tuple(column.is_number for column in table.columns),
        lines=tuple(
            tuple(plain(cell.text) for cell in cells)
            for cells in table.rows
            if not hidden or all(cell.text != hidden for cell in cells)
        ),
    )


def turn(grid: Grid) -> Grid:
    """The same grid, its columns below each other: few lines of many cells."""
    first, *further = grid.headings
    return Grid(
        caption=grid.caption,
        headings=(first, *(cells[0] for cells in grid.lines)),
        numbers=(False, *(True for _ in grid.lines)),
        lines=tuple(
            (heading, *(cells[place] for cells in grid.lines))
            for place, heading in enumerate(further, 1)
        ),
    )


def list_pairs(caption: str, pairs: Sequence[tuple[str, Content]]) -> Grid:
    """Grid of names and what stands beside them."""
    lines = tuple(((Piece(name, is_bold=True),), content) for name, content in pairs)
    return Grid(caption=caption, numbers=(False, False), lines=lines)
