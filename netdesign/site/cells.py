"""What a workbook holds: cells that know where they are, sheets, the file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from netdesign.site.diagnostics import Finding, Refusal, Severity


@dataclass(frozen=True, slots=True, kw_only=True)
class Cell:
    """One cell: where it is and what it holds.

    ``value`` is what the file stores: text, number, truth value, date, or None;
    of a formula it is the stored result, None where the file has none.
    """

    file: str
    sheet: str
    row: int
    column: int
    value: object = None
    formula: str = ""
    is_error: bool = False
    is_percent: bool = False  # the cell's format shows hundredfold

    @property
    def address(self) -> str:
        """Address in its sheet: ``C14``."""
        return f"{name_column(self.column)}{self.row}"

    @property
    def place(self) -> str:
        """Address in its workbook: ``Nets!C14``."""
        return f"{self.sheet}!{self.address}"

    @property
    def text(self) -> str:
        """What was typed: the formula, or the value as text."""
        if self.formula:
            return self.formula
        return "" if self.value is None else str(self.value)

    @property
    def is_blank(self) -> bool:
        """Whether nothing but spaces was typed."""
        return not self.text.strip()

    def finding(
        self, refusal: Refusal, field: str = "", *, severity: Severity = "error"
    ) -> Finding:
        """Say what is wrong with this cell."""
        return Finding(
            file=self.file,
            sheet=self.sheet,
            cell=self.address,
            field=field,
            text=self.text,
            rule=refusal.rule,
            accepted=refusal.accepted,
            severity=severity,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class MergedRange:
    """Merged cells: their range as text, their first cell, their last row."""

    text: str  # "B3:C4"
    row: int
    column: int
    last_row: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Sheet:
    """One sheet; ``rows`` holds the filled cells by row, then column, from 1."""

    file: str
    name: str
    rows: Mapping[int, Mapping[int, Cell]]
    merged: tuple[MergedRange, ...] = ()
    hidden_rows: frozenset[int] = frozenset()
    is_hidden: bool = False

    def cell(self, row: int, column: int) -> Cell:
        """Cell at a place, blank where nothing is filled in."""
        blank = Cell(file=self.file, sheet=self.name, row=row, column=column)
        return self.rows.get(row, {}).get(column, blank)

    def row(self, number: int) -> tuple[Cell, ...]:
        """Cells of one row that hold more than spaces, from left to right."""
        cells = self.rows.get(number, {}).values()
        return tuple(cell for cell in cells if not cell.is_blank)

    def finding(self, refusal: Refusal, *, severity: Severity = "error") -> Finding:
        """Say what is wrong with the whole sheet."""
        return Finding(
            file=self.file,
            sheet=self.name,
            rule=refusal.rule,
            accepted=refusal.accepted,
            severity=severity,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Workbook:
    """The wanted sheets of one file, the names of the others, the file's hash."""

    file: str
    sha256: str
    sheets: tuple[Sheet, ...]
    unread: tuple[str, ...]


def name_column(column: int) -> str:
    """Letters of a column counted from 1.

    >>> name_column(28)
    'AB'
    """
    letters = ""
    while column:
        column, digit = divmod(column - 1, 26)
        letters = chr(ord("A") + digit) + letters
    return letters
