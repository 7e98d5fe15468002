"""Sheet of calculations: each check step by step, in live formulas.

Checks of one member share a design force: it is worked out once, and the other checks
refer to it.

A value that is read from a cell of the inputs or of the profile is a link to it; any
other stands as a number where it occurs first, and later checks refer to that line. So
one cell changes all checks that use it. All other cells of inputs and profile went into
the study's forces and resistances: where one is changed, no check is proven until the
site is checked again.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any

from netdesign.calculation.formula import (
    PRINTED,
    SPREADSHEET,
    list_operands,
    translate,
)
from netdesign.calculation.quantity import Kind
from netdesign.calculation.steps import SAME, Step
from netdesign.checks.schema import LATERAL_SHARE
from netdesign.report.blocks import Cell, Column, Table
from netdesign.report.words import MISSING, Words, show_check, show_text, show_unit
from netdesign.report.workbook.formulas import (
    write_guarded,
    write_link,
    write_same,
)
from netdesign.report.workbook.writer import Book, count_lines
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
        values = list(zip(study.profile.values, of_profile, strict=True))
        # a value by its id, and all that stand in a table by the table's
        self._profile: dict[tuple[str, str], list[GivenCell]] = {}
        for value, cell in values:
            for source in {value.id, value.id.partition("[")[0]}:
                self._profile.setdefault((source, value.unit), []).append(cell)
        tables = [table for _, table in parts]
        inputs = _list_inputs(above, tables)
        self._cells = [*of_profile, *inputs]
        of_rows = iter(inputs[len(tables[0].rows) :])
        self._inputs: list[dict[tuple[str, str], list[GivenCell]]] = []
        for row in study.rows:
            places: dict[tuple[str, str], list[GivenCell]] = {}
            own = islice(of_rows, len(row.inputs))
            for echo, cell in zip(row.inputs, own, strict=True):
                places.setdefault((echo.cell, echo.unit), []).append(cell)
            self._inputs.append(places)
        # directions of pulls follow the load along the row wherever a profile has one
        share = [("k", x) for value, x in values if value.id == LATERAL_SHARE]
        self._by_symbol = [
            {**dict(share), **self._find_all(number, _list_leaves(row))}
            for number, row in enumerate(study.rows)
        ]

    def find(self, row: int, step: Step) -> GivenCell | None:
        """Cell that a step of a net row, by its place, is read from."""
        if step.value is None or step.symbol in _BY_RULE:
            return None
        cells = {Kind.GIVEN: self._inputs[row], Kind.PROFILE: self._profile}
        found = cells.get(step.kind, {}).get((step.source, step.unit), [])
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


def _is_near(number: float | None, value: float) -> bool:
    return number is not None and math.isclose(number, value, rel_tol=SAME)


_HEAD_ROW = 3  # zero-based; the first block begins one below
_WIDTHS = (7, 30, 26, 9, 9, 9, 6, 20)
_DEMAND = "E_d"  # last of the steps that checks of one member share
_NAME, _FORMULA, _UNIT, _SOURCE = 1, 2, 6, 7  # columns; the symbol stands first
_ENDS = {-1: 3, 0: 4, 1: 5}  # columns of low end, value and high end
_FORMATS = {"kN": "0.00", "m": "0.000", "-": "0.0000"}
_TYPED = "#2A4B6B"  # colour of numbers that somebody may type over
_WANTED = {">0": "caption.above_zero", ">=0": "caption.at_least_zero"}
_QUARTER = "<90"  # angles are below a right one


@dataclass(frozen=True, slots=True)
class Line:
    """Line of a step.

    Attributes
    ----------
    number : int
        From one.
    step : Step
        What it shows.
    link : str
        Cell that its value is read from, on another sheet; "" where there is none.
    first : int
        Line where the same value stands as a number; itself unless another has it.
    ends : set of int
        Those that have a cell; the value stands for the others.
    """

    number: int
    step: Step
    link: str
    first: int
    ends: frozenset[int]

    def at(self, end: int) -> str:
        """Cell of one of its ends."""
        return f"{chr(ord('A') + _ENDS[end])}{self.number}"

    def find(self, end: int) -> str:
        """Cell whose number counts for an end."""
        return self.at(end if end in self.ends else 0)

    @property
    def bounds(self) -> tuple[str, ...]:
        """Bounds of its numbers: a force, or what is zero already, may be zero."""
        is_read = self.step.kind in (Kind.GIVEN, Kind.PROFILE)
        is_above = is_read and self.step.value != 0.0
        least = ">0" if is_above else ">=0"
        return (least, _QUARTER) if self.step.unit == "deg" else (least,)


class Calculations:
    """Lines of the calculations of all checks, by net row and check."""

    def __init__(self, book: Book, study: Study, cells: GivenCells) -> None:
        self._book = book
        self._cells = cells
        self._typed: dict[tuple[int, Step], int] = {}
        # lines of each check by symbol, by the places of net row and check
        self.blocks: dict[tuple[int, int], dict[str, Line]] = {}
        self._actions: dict[tuple[int, tuple[Step, ...]], dict[str, Line]] = {}
        self.titles: dict[tuple[int, int], int] = {}  # lines of them
        line = _HEAD_ROW + 2
        for place, check in _list_checks(study):
            self.titles[place] = line
            self.blocks[place] = self._place_steps(place[0], line + 1, check)
            line += sum(one.number > line for one in self.blocks[place].values()) + 2

    def _place_steps(self, row: int, first: int, check: CheckRecord) -> dict[str, Line]:
        """Lines of a check by symbol; those to its design force may be another's."""
        names = [step.symbol for step in check.steps]
        last = names.index(_DEMAND) if _DEMAND in names else 0
        action = (row, tuple(check.steps[:last]))
        block = dict(self._actions.get(action, {}))
        for number, step in enumerate(check.steps[last if block else 0 :], first):
            earlier = block.get(step.symbol)
            line = self._place(row, number, step, _list_ends(step, block))
            block[step.symbol] = replace(line, first=earlier.first) if earlier else line
        if all(self._is_known(block[name]) for name in names[:last]):
            shared = {name: block[name] for name in names[: last + 1] if last}
            self._actions.setdefault(action, shared)
        return block

    def _is_known(self, line: Line) -> bool:
        """It is the same wherever it stands: made by a formula, or with a source."""
        step = line.step
        return bool(
            step.formula or line.link or (step.value is not None and step.source)
        )

    def _place(self, row: int, number: int, step: Step, ends: frozenset[int]) -> Line:
        cell = None if step.formula else self._cells.find(row, step)
        if step.formula or cell is not None:
            link = self._cells.refer(cell) if cell else ""
            return Line(number, step, link, number, ends)
        if step.value is None or not step.source:  # nobody says that it is the same
            return Line(number, step, "", number, ends)
        whose = -1 if step.kind is Kind.GIVEN else row  # a cell serves all net rows
        first = self._typed.setdefault((whose, step), number)
        return Line(number, step, "", first, ends)

    def refer(self, place: tuple[int, int], symbol: str, end: int = 0) -> str:
        """Reference to a step of a check from another sheet; "" where it has none."""
        line = self.blocks.get(place, {}).get(symbol)
        if line is None:
            return ""
        cell = line.find(end)
        return self._book.refer("steps", f"${cell[0]}${cell[1:]}")

    def list_followed(self, place: tuple[int, int]) -> Iterator[str]:
        """Conditions: what stands here and the solved forces rest on is the study's."""
        for symbol in IN_FORCES:
            line = self.blocks.get(place, {}).get(symbol)
            if line is not None and not line.link and line.step.value is not None:
                yield write_same(self.refer(place, symbol), line.step.value)

    def write_end(self, block: Mapping[str, Line], line: Line, end: int) -> str:
        """Formula of one end of a line; "" of a number that stands there itself."""
        if line.first != line.number:
            column = chr(ord("A") + _ENDS[end])
            return write_link(f"{column}{line.first}", line.bounds)
        if line.step.formula:
            return _write_step(block, line, end)
        return write_link(line.link, line.bounds) if line.link else ""


def _list_ends(step: Step, block: Mapping[str, Line]) -> frozenset[int]:
    """Ends of a step that may differ from its value: its own, or of what makes it."""
    if not step.formula:
        given = {-1: step.low, 0: step.value, 1: step.high}
        return frozenset(
            end for end, own in given.items() if end == 0 or own is not None
        )
    return frozenset(
        end
        for end in _ENDS
        if end == 0
        or any(
            of_end and of_end in block[symbol].ends
            for symbol, of_end in list_operands(step.formula, end)
        )
    )


def _list_checks(study: Study) -> Iterator[tuple[tuple[int, int], CheckRecord]]:
    for number, row in enumerate(study.rows):
        for place, check in enumerate(row.checks):
            if check.steps:
                yield (number, place), check


def _write_step(block: Mapping[str, Line], line: Line, end: int) -> str:
    """Formula of a step of the lines before it, and which of their cells count."""
    read: dict[str, Sequence[str]] = {}

    def find(symbol: str, of_end: int) -> str:
        one = block[symbol]
        cell = one.find(of_end)
        read[cell] = one.bounds
        return cell

    formula = translate(line.step.formula, SPREADSHEET, find, end)
    return write_guarded(formula, read)


def add_calculation_sheet(book: Book, study: Study, calculations: Calculations) -> None:
    """Sheet "Steps": a block of lines for each check of a force."""
    words = book.words
    sheet = book.add_sheet("steps", words("heading.steps_of_checks"))
    sheet.set_portrait()
    book.link_back(sheet)
    book.write_wide(sheet, (2, 0), words("caption.calculations"), _WIDTHS, italic=True)
    book.write_head(sheet, _HEAD_ROW, _list_columns(words), _WIDTHS)
    for index, width in enumerate(_WIDTHS):
        sheet.set_column(index, index, width)
    for (row, check), block in calculations.blocks.items():
        shown = study.rows[row]
        named = show_check(words, shown.checks[check])
        title = words("show.label", label=show_text(shown.id), text=named)
        top = calculations.titles[row, check] - 1
        book.write_wide(sheet, (top, 0), title, _WIDTHS, bold=True)
        for line in block.values():
            if line.number > top:
                _write_line(book, sheet, calculations, block, line)
    if not calculations.titles:
        text = words("heading.no_check")
        sheet.write_string(_HEAD_ROW + 1, 0, text, book.text())
    sheet.repeat_rows(_HEAD_ROW)
    sheet.freeze_panes(_HEAD_ROW + 1, 1)


def _list_columns(words: Words) -> tuple[Column, ...]:
    keys = ("symbol", "name", "formula", "low", "value", "high", "unit", "source")
    return tuple(
        Column(heading=words(f"heading.{key}"), is_number=index in _ENDS.values())
        for index, key in enumerate(keys)
    )


def _write_line(
    book: Book,
    sheet: Any,
    calculations: Calculations,
    block: Mapping[str, Line],
    line: Line,
) -> None:
    step, row, words = line.step, line.number - 1, book.words
    is_worked = line.first == line.number  # else the formula stands at another check
    printed = translate(step.formula, PRINTED) if step.formula and is_worked else ""
    texts = {
        0: step.symbol,
        _NAME: words(f"symbol.{step.symbol}"),
        _FORMULA: words.write_formula(printed),
        _UNIT: "" if step.unit == "-" else show_unit(step.unit),
        _SOURCE: _name_source(line, words),
    }
    for column, text in texts.items():
        if text:
            sheet.write_string(row, column, text, book.text(text_wrap=True))
    lines = count_lines(list(texts.values()), [_WIDTHS[one] for one in texts])
    book.set_height(sheet, row, lines)
    for end, value in zip(_ENDS, step.ends, strict=True):
        if end not in line.ends:
            continue
        formula = calculations.write_end(block, line, end)
        _write_number(book, sheet, line, end, value, formula)


def _write_number(
    book: Book, sheet: Any, line: Line, end: int, value: float | None, formula: str
) -> None:
    place = (line.number - 1, _ENDS[end])
    look = {"align": "right", "num_format": _FORMATS.get(line.step.unit, "General")}
    if formula:
        shown = MISSING if value is None else value
        sheet.write_formula(*place, formula, book.format(**look), shown)
        return
    form = book.format(**look, font_color=_TYPED)
    if value is None:
        sheet.write_string(*place, MISSING, form)
    else:
        sheet.write_number(*place, value, form)
    least = line.bounds[0]
    rule = {
        "validate": "decimal",
        "criteria": least.rstrip("0"),
        "value": 0,
        "ignore_blank": False,
        "error_message": book.words(_WANTED[least]),
    }
    sheet.data_validation(*place, *place, rule)


def _name_source(line: Line, words: Words) -> str:
    """Cell, id of the profile's value, clause; of a force the load that brings it."""
    step = line.step
    if step.formula and line.first != line.number:
        return replace(line, number=line.first).at(0)
    if step.kind is not Kind.SOLVED:
        return step.source
    is_floor = step.source.startswith("floor")
    return words("load_name.guideline" if is_floor else "load_name.coupled")
