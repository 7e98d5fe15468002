"""Filling of a sheet with lines as they are typed."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from openpyxl.worksheet.worksheet import Worksheet


def fill(
    sheet: Worksheet, lines: Sequence[Sequence[object]], *, below: int = 0
) -> None:
    """Put lines into a sheet from column A, under a row; None leaves a cell empty."""
    for row, line in enumerate(lines, start=below + 1):
        for column, value in enumerate(line, start=1):
            if value is not None:
                sheet.cell(row, column, value)
