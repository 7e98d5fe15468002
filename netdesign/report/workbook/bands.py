"""Intervals of a table as two columns of numbers: a workbook calculates with them."""

from __future__ import annotations

from dataclasses import replace

from netdesign.report.blocks.table import Cell, Column, Table
from netdesign.report.words import MISSING, Words

_ENDS = ("heading.low", "heading.high")


def split_bands(table: Table, words: Words) -> Table:
    """Table with a column for each end of an interval; others stay as they are."""
    places = {
        index
        for cells in table.rows
        for index, cell in enumerate(cells)
        if cell.ends is not None
    }
    if not places:
        return table
    columns: list[Column] = []
    for index, column in enumerate(table.columns):
        columns += _split_column(column, words) if index in places else [column]
    return replace(
        table,
        columns=tuple(columns),
        rows=tuple(_split_row(cells, places) for cells in table.rows),
    )


def _split_column(column: Column, words: Words) -> list[Column]:
    label, bracket, unit = column.heading.rpartition(" [")
    label, unit = (label, bracket + unit) if bracket else (unit, "")
    return [
        replace(column, heading=f"{label} {words(end)}{unit}", is_number=True)
        for end in _ENDS
    ]


def _split_row(cells: tuple[Cell, ...], places: set[int]) -> tuple[Cell, ...]:
    found: list[Cell] = []
    for index, cell in enumerate(cells):
        if index in places:
            found += [_show_end(end) for end in cell.ends or (None, None)]
        else:
            found.append(cell)
    return tuple(found)


def _show_end(number: float | None) -> Cell:
    """End of an interval: the number as it is, to six digits on its own width."""
    return Cell(text=MISSING if number is None else f"{number:.6g}", number=number)
