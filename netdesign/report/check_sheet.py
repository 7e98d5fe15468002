"""Sheet of checks with live formulas: change a cell and the verdict follows.

Each formula is stored with the value of the study, so that viewers which do not
calculate show the study's numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from netdesign.outcome import Verdict
from netdesign.quantities import QUANTITIES
from netdesign.report.check_view import (
    CheckView,
    find_utilisation_band,
)
from netdesign.report.table import Cell, Column
from netdesign.report.tables import CASE_COLUMNS
from netdesign.report.translation import translate_view
from netdesign.report.view import ReportView
from netdesign.report.words import (
    MISSING,
    number_format,
    show_number,
    show_text,
)
from netdesign.report.workbook import A3, Book, count_lines
from netdesign.study import CheckRecord, Study

HEAD_ROW = 3  # zero-based; the first check is one below
_NOTES = (
    "Demand E_d = γ_E · E_k, design resistance R_d = R_k / γ_R, utilisation "
    "μ = E_d / R_d; kN per anchor; low and high are the ends of the numerical band.",
    "PASS: μ high is at most 1. FAIL: μ low exceeds 1. Otherwise NOT PROVEN. "
    '"Set by the study": the verdict has another reason than the ratio, see Reason.',
)


@dataclass(frozen=True, slots=True)
class _Field:
    """Column of the sheet: letter, key of its quantity, heading, width."""

    letter: str
    quantity: str
    heading: str
    width: float

    @property
    def column(self) -> Column:
        return Column(
            heading=self.heading,
            quantity=self.quantity,
            is_number=bool(self.quantity) or self.heading == "No.",
        )


def _field(letter: str, quantity: str, end: str = "") -> _Field:
    row = QUANTITIES[quantity]
    unit = f" [{row.unit}]" if row.unit else ""
    return _Field(letter, quantity, f"{row.symbol}{end}{unit}", 8.3)


_LEAD = (
    _Field("A", "", "No.", 4),
    _Field("B", "", "Net row", 15),
    _Field("C", "", "Check", 20),
    _Field("D", "", "Clause", 9),
)
_ACTIONS = (
    _field("E", "action_kN", " low"),
    _field("F", "action_kN"),
    _field("G", "action_kN", " high"),
)
_ACTION_FACTOR = _field("H", "action_factor")
_DEMANDS = (
    _field("I", "demand_kN", " low"),
    _field("J", "demand_kN"),
    _field("K", "demand_kN", " high"),
)
_RESISTANCE_K = _field("L", "resistance_characteristic_kN")
_RESISTANCE_FACTOR = _field("M", "resistance_factor")
_RESISTANCE = _field("N", "resistance_kN")
_RATIOS = (
    _field("O", "utilisation", " low"),
    _field("P", "utilisation"),
    _field("Q", "utilisation", " high"),
)
_SET = _Field("R", "", "Set by the study", 10)
_VERDICT = _Field("S", "", "Verdict", 13)
_TAIL = (
    _Field("W", "", "Resistance from", 18),
    _Field("X", "", "Reason", 36),
)
_CASES = tuple(
    _Field(letter, column.quantity, column.heading, 8.5)
    for letter, column in zip("TUV", CASE_COLUMNS, strict=True)
)
_FIELDS = (
    *_LEAD,
    *_ACTIONS,
    _ACTION_FACTOR,
    *_DEMANDS,
    _RESISTANCE_K,
    _RESISTANCE_FACTOR,
    _RESISTANCE,
    *_RATIOS,
    _SET,
    _VERDICT,
    *_CASES,
    *_TAIL,
)


def add_check_sheet(book: Book, study: Study, view: ReportView) -> None:
    """Sheet "Checks" and the defined names that the summary counts by."""
    sheet = book.add_sheet("Checks", "Checks", paper=A3)
    book.link_back(sheet, (0, 3))
    for line, note in enumerate(_NOTES, 1):
        sheet.write_string(line, 0, book.words(note), book.text(italic=True))
    columns = [translate_view(field.column, book.words) for field in _FIELDS]
    book.write_head(sheet, HEAD_ROW, columns, [field.width for field in _FIELDS])
    for field in _FIELDS:
        sheet.set_column(f"{field.letter}:{field.letter}", field.width)
    line = HEAD_ROW + 1
    for number, (row, shown) in enumerate(zip(study.rows, view.rows, strict=True), 1):
        for check, words in zip(row.checks, shown.checks, strict=True):
            _CheckLine(book, sheet, line).write((number, row.id), check, words)
            line += 1
    if line == HEAD_ROW + 1:
        text = book.words("none: no check was made")
        sheet.write_string(line, 0, text, book.text())
    last = max(line, HEAD_ROW + 2)
    _finish(book, sheet, last)


def _finish(book: Book, sheet: Any, last: int) -> None:
    first = HEAD_ROW + 2
    for name, field in (
        ("check_net_row_number", _LEAD[0]),
        ("check_utilisation", _RATIOS[1]),
        ("check_utilisation_high", _RATIOS[2]),
        ("check_verdict", _VERDICT),
    ):
        area = f"${field.letter}${first}:${field.letter}${last}"
        book.workbook.define_name(name, f"={book.refer('Checks', area)}")
    column = ord(_VERDICT.letter) - ord("A")
    book.colour_verdicts(sheet, (first - 1, column, last - 1, column))
    column = ord(_RATIOS[1].letter) - ord("A")
    book.add_ratio_bars(sheet, (first - 1, column, last - 1, column))
    sheet.autofilter(HEAD_ROW, 0, last - 1, len(_FIELDS) - 1)
    sheet.freeze_panes(HEAD_ROW + 1, 3)
    sheet.repeat_rows(HEAD_ROW)


class _CheckLine:
    """One line of the sheet; ``line`` counts from zero."""

    def __init__(self, book: Book, sheet: Any, line: int) -> None:
        self._book, self._sheet, self._line = book, sheet, line

    def write(self, row: tuple[int, str], check: CheckRecord, view: CheckView) -> None:
        """Write texts and inputs as values, everything derived as formulas.

        ``row`` is number and id of the net row, ``view`` the check in words.
        """
        number, name = row
        self._put(_LEAD[0], Cell(text=str(number), number=float(number)))
        self._write_numbers(check)
        self._write_verdict(check)
        case = check.case
        for field in _CASES:
            self._put_number(field, getattr(case, field.quantity) if case else None)
        fields = (*_LEAD[1:], *_TAIL)
        texts = (
            show_text(name),
            view.title,
            view.clause,
            view.resistance_from,
            view.reason,
        )
        for field, text in zip(fields, texts, strict=True):
            self._put(field, Cell(text=text))
        lines = count_lines(texts, [field.width for field in fields])
        self._book.set_height(self._sheet, self._line, lines)

    def _write_numbers(self, check: CheckRecord) -> None:
        actions, demands = _list_actions(check), _list_demands(check)
        factor = self._at(_ACTION_FACTOR)
        self._put_number(_ACTION_FACTOR, check.action_factor)
        for source, target, action, demand in zip(
            _ACTIONS, _DEMANDS, actions, demands, strict=True
        ):
            self._put_number(source, action)
            product = f"{self._at(source)}*{factor}" if action is not None else ""
            self._put_number(target, demand, product)
        self._put_number(_RESISTANCE_K, check.resistance_characteristic_kN)
        self._put_number(_RESISTANCE_FACTOR, check.resistance_factor)
        given, factor = self._at(_RESISTANCE_K), self._at(_RESISTANCE_FACTOR)
        quotient = f'IF({given}>0,{given}/{factor},"{MISSING}")'
        is_live = _divide_resistance(check) is not None or check.resistance_kN is None
        self._put_number(_RESISTANCE, check.resistance_kN, quotient if is_live else "")
        low, high = find_utilisation_band(check)
        for field, demand_field, ratio in zip(
            _RATIOS, _DEMANDS, (low, check.utilisation, high), strict=True
        ):
            quotient = f"{self._at(demand_field)}/{self._at(_RESISTANCE)}"
            # a slack member needs no resistance, unless the study holds it back
            is_slack = f'AND({self._at(_DEMANDS[2])}=0,{self._at(_SET)}="{MISSING}")'
            is_live = check.demand_kN is not None or ratio is None
            formula = f"IF({is_slack},0,{quotient})" if is_live else ""
            self._put_number(field, ratio, formula)

    def _write_verdict(self, check: CheckRecord) -> None:
        is_set = decide_by_ratio(*_recalculate_band(check)) is not check.verdict
        word = self._book.word(check.verdict)
        passes, fails, open_ = map(
            self._book.word, (Verdict.PASS, Verdict.FAIL, Verdict.NOT_PROVEN)
        )
        self._put(_SET, Cell(text=word if is_set else MISSING))
        low, high, given = (self._at(f) for f in (_RATIOS[0], _RATIOS[2], _SET))
        formula = (
            f'=IF({given}<>"{MISSING}",{given},IF(ISNUMBER({high}),'
            f'IF({high}<=1,"{passes}",IF({low}>1,"{fails}","{open_}")),"{open_}"))'
        )
        form = self._book.text(bold=True)
        self._sheet.write_formula(self._at(_VERDICT), formula, form, word)

    def _at(self, field: _Field) -> str:
        return f"{field.letter}{self._line + 1}"

    def _put(self, field: _Field, cell: Cell) -> None:
        place = (self._line, ord(field.letter) - ord("A"))
        self._book.write_cell(self._sheet, place, field.column, cell)

    def _put_number(
        self, field: _Field, value: float | None, formula: str = ""
    ) -> None:
        """Write a number; with ``formula``, live and giving "-" without its parts."""
        if not formula:
            self._put(
                field, Cell(text=show_number(field.quantity, value), number=value)
            )
            return
        form = self._book.format(
            align="right", num_format=number_format(field.quantity)
        )
        live = f'=IFERROR({formula},"{MISSING}")'
        cached = MISSING if value is None else value
        self._sheet.write_formula(self._at(field), live, form, cached)


def decide_by_ratio(low: float | None, high: float | None) -> Verdict:
    """Verdict of the formula in the sheet: by the band of the utilisation alone."""
    if low is None or high is None:
        return Verdict.NOT_PROVEN
    if high <= 1:
        return Verdict.PASS
    return Verdict.FAIL if low > 1 else Verdict.NOT_PROVEN


def _recalculate_band(check: CheckRecord) -> tuple[float | None, float | None]:
    """Band as the sheet calculates it; may differ in the last bit, at exactly 1."""
    resistance = _divide_resistance(check) or check.resistance_kN
    if check.demand_high_kN == 0.0 or check.utilisation == 0.0:
        return 0.0, 0.0
    ends = []
    for action, demand in zip(
        _list_actions(check)[::2], _list_demands(check)[::2], strict=True
    ):
        if action is not None and check.action_factor is not None:
            demand = action * check.action_factor
        ends.append(demand / resistance if demand is not None and resistance else None)
    return ends[0], ends[1]


def _divide_resistance(check: CheckRecord) -> float | None:
    above, below = check.resistance_characteristic_kN, check.resistance_factor
    return above / below if above is not None and below else None


def _list_demands(check: CheckRecord) -> tuple[float | None, ...]:
    return check.demand_low_kN, check.demand_kN, check.demand_high_kN


def _list_actions(check: CheckRecord) -> tuple[float | None, ...]:
    """Characteristic actions whose products with the factor are the demands."""
    factor = check.action_factor
    if not factor or check.action_kN is None:
        return None, check.action_kN, None
    low, high = check.demand_low_kN, check.demand_high_kN
    return (
        None if low is None else low / factor,
        check.action_kN,
        None if high is None else high / factor,
    )
