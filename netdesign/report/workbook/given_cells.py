"""Cells of the sheets of inputs and of the profile that steps of a check are read from.

A value that a step reads is live. All others went into the study's forces and
resistances: where one is changed, no check is proven until the site is checked again.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from netdesign.calculation.quantity import Kind
from netdesign.calculation.steps import SAME, Step
from netdesign.checks import StandardValue
from netdesign.checks.schema import LATERAL_SHARE
from netdesign.report.blocks.table import Cell, Table
from netdesign.report.workbook.formulas import write_same
from netdesign.report.workbook.writer import Book
from netdesign.study.records import CheckRecord, RowStudy, Study

# Names of cells that hold 1 where no value differs that the forces rest on.
UNCHANGED = {"inputs": "inputs_unchanged", "profile": "profile_unchanged"}
_FIRST_LINE = 5  # of a sheet's first table, counted from one
_BETWEEN_TABLES = 3  # lines
_VALUE = {"inputs": "D", "profile": "C"}  # columns
_WATCH = 8  # column of what is watched, hidden; beyond the tables
IN_FORCES = ("b",)  # read by steps, but the solved forces rest on it as well
_BY_RULE = ("f_R", "Δl")  # worked out by a rule of the profile, no value of it
# Values that a resistance or a check without a force follows, by the derivation.
_FOLLOWED = {"bending.": ("k", "β"), "post_bending.": ("γ_E", "γ_R"), "": ()}
_WITHOUT_FORCE = ("k", "β")


Parts = Sequence[tuple[str, Table]]  # tables by the place that they are of


@dataclass(frozen=True, slots=True)
class GivenCell:
    """Cell of a given value: its sheet, its line from one, and what it shows."""

    sheet: str
    line: int
    shown: Cell

    @property
    def column_and_line(self) -> str:
        """Place on its own sheet."""
        return f"${_VALUE[self.sheet]}${self.line}"


class GivenCells:
    """Cells of a study's given values, and which of them its checks read."""

    def __init__(
        self,
        book: Book,
        study: Study,
        above: Table | None,
        parts: Parts,
        profile: Table,
    ) -> None:
        """Cells of the tables on the sheets of inputs and of the profile.

        ``above`` stands before the inputs; ``parts`` are those of the ranges, then
        those of each net row.
        """
        self._book = book
        self._rows = study.rows
        of_profile = [
            GivenCell("profile", line, cells[2])
            for line, cells in enumerate(profile.rows, _FIRST_LINE)
        ]
        self._profile = list(zip(study.profile.values, of_profile, strict=True))
        tables = [table for _, table in parts]
        inputs = _list_inputs(above, tables)
        self._cells = [*of_profile, *inputs]
        ends = [len(tables[0].rows)]
        for table in tables[1:]:
            ends.append(ends[-1] + len(table.rows))
        self._inputs = [
            list(zip(row.inputs, inputs[first:last], strict=True))
            for row, first, last in zip(study.rows, ends, ends[1:], strict=False)
        ]
        # directions of pulls follow the load along the row wherever a profile has one
        share = [("k", x) for value, x in self._profile if value.id == LATERAL_SHARE]
        self._by_symbol = [
            {**dict(share), **self._find_all(number, _list_leaves(row))}
            for number, row in enumerate(study.rows)
        ]

    def find(self, row: int, step: Step) -> GivenCell | None:
        """Cell that a step of a net row, by its place, is read from."""
        if step.value is None or step.symbol in _BY_RULE:
            return None
        if step.kind is Kind.GIVEN:
            found = [
                cell
                for echo, cell in self._inputs[row]
                if echo.cell == step.source and echo.unit == step.unit
            ]
        elif step.kind is Kind.PROFILE:
            found = [cell for one, cell in self._profile if _is_of(one, step)]
        else:
            return None
        same = [one for one in found if _is_near(one.shown.number, step.value)]
        return same[0] if len(same) == 1 else None

    def refer(self, cell: GivenCell) -> str:
        """Reference to a cell from another sheet."""
        return self._book.refer(cell.sheet, cell.column_and_line)

    def list_followed(self, row: int, check: CheckRecord) -> Iterator[str]:
        """Conditions: values are the study's that a check follows beside its steps."""
        told = check.resistance_derivation
        wanted: Sequence[str] = _WITHOUT_FORCE
        if check.steps:
            key = told.key if told else ""
            wanted = next(v for k, v in _FOLLOWED.items() if key.startswith(k))
        cells = {**self._by_symbol[row], **self._find_all(row, check.steps)}
        for symbol in wanted:
            cell = cells.get(symbol)
            if cell is not None and cell.shown.number is not None:
                yield write_same(self.refer(cell), cell.shown.number)

    def _find_all(self, row: int, steps: Iterable[Step]) -> dict[str, GivenCell]:
        """Cells that steps of a net row are read from, by their symbols."""
        found = ((one.symbol, self.find(row, one)) for one in steps if not one.formula)
        return {symbol: cell for symbol, cell in found if cell is not None}

    def watch(self) -> None:
        """Name the cells that tell whether the values are those of the study."""
        live = {
            (cell.sheet, cell.line)
            for number, row in enumerate(self._rows)
            for step in _list_leaves(row)
            if (cell := self.find(number, step)) and step.symbol not in IN_FORCES
        }
        for sheet in UNCHANGED:
            cells = [one for one in self._cells if one.sheet == sheet]
            self._watch(sheet, [x for x in cells if (sheet, x.line) not in live])

    def _watch(self, sheet: str, cells: Sequence[GivenCell]) -> None:
        """Fill a hidden column with 1 beside each value that is the study's."""
        book = self._book
        written = book.workbook.get_worksheet_by_name(book.name(sheet))
        for one in cells:
            number = one.shown.number
            known = one.shown.text if number is None else number
            condition = write_same(one.column_and_line, known)
            formula = f"=IFERROR(IF({condition},1,0),0)"
            written.write_formula(one.line - 1, _WATCH, formula, None, 1)
        column, head = chr(ord("A") + _WATCH), _FIRST_LINE - 1
        written.set_column(_WATCH, _WATCH, None, None, {"hidden": True})
        last = max((one.line for one in cells), default=_FIRST_LINE)
        least = f"=MIN(1,{column}{_FIRST_LINE}:{column}{last})"
        written.write_formula(head - 1, _WATCH, least, None, 1)
        place = book.refer(sheet, f"${column}${head}")
        book.workbook.define_name(UNCHANGED[sheet], f"={place}")


def _list_inputs(above: Table | None, tables: Sequence[Table]) -> list[GivenCell]:
    """Cells of the sheet of inputs: of the ranges, then of each net row."""
    first = _FIRST_LINE
    if above and above.rows:
        first += _BETWEEN_TABLES + len(above.rows)
    shown = [cells[2] for table in tables for cells in table.rows]
    return [GivenCell("inputs", line, cell) for line, cell in enumerate(shown, first)]


def _list_leaves(row: RowStudy) -> set[Step]:
    steps = (step for check in row.checks for step in check.steps)
    return {step for step in steps if not step.formula}


def _is_of(value: StandardValue, step: Step) -> bool:
    """The step is that value, or stands in that table, of the profile."""
    is_named = value.id == step.source or value.id.startswith(f"{step.source}[")
    return is_named and value.unit == step.unit


def _is_near(number: float | None, value: float) -> bool:
    return number is not None and math.isclose(number, value, rel_tol=SAME)
