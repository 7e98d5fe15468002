"""Inputs of a net row by their column."""

from __future__ import annotations

from netdesign.study.records import RowStudy
from netdesign.words.message import Message


def find_input(row: RowStudy, column: str) -> float | None:
    """Number of a column of sheet Nets, as understood; None where it is empty."""
    value = _find(row, column)
    return None if isinstance(value, str) else value


def find_word(row: RowStudy, column: str) -> str:
    """Word of a column of sheet Nets, by its key; "" where it is empty."""
    value = _find(row, column)
    return value if isinstance(value, str) else ""


def _find(row: RowStudy, column: str) -> float | str | None:
    for echo in row.inputs:
        label = echo.label
        if isinstance(label, Message) and label.key == f"column.Nets.{column}":
            return echo.value
    return None
