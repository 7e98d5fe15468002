"""Inputs of a net row by their column."""

from __future__ import annotations

from netdesign.study.records import RowStudy
from netdesign.words.message import Message


def find_input(row: RowStudy, column: str) -> float | None:
    """Number of a column of sheet Nets, as understood; None where it is empty."""
    for echo in row.inputs:
        label = echo.label
        if isinstance(label, Message) and label.key == f"column.Nets.{column}":
            return echo.value if isinstance(echo.value, float | int) else None
    return None
