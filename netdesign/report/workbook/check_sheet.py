"""Sheet of checks with live formulas: change a cell and the verdict follows.

Each formula is stored with the value of the study, so that viewers which do not
calculate show the study's numbers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from netdesign.outcome import Verdict
from netdesign.quantities import QUANTITIES
from netdesign.report.blocks.table import Cell, Column
from netdesign.report.view.check_formulas import (
    ROUNDING,
    ChangedReasons,
    compute_rank,
    write_given_verdict,
    write_held,
    write_product,
    write_quotient,
    write_rank,
    write_ratio,
    write_reason,
    write_unchanged,
    write_verdict,
)
from netdesign.report.view.check_view import CheckView, find_case
from netdesign.report.view.tables import CASE_QUANTITIES
from netdesign.report.view.whole import ReportView
from netdesign.report.words import (
    MISSING,
    UNBOUNDED,
    Words,
    add_unit,
    name_heading,
    number_format,
    show_text,
)
from netdesign.report.workbook.pages import A4, find_height
from netdesign.report.workbook.profile_links import (
    UNCHANGED,
    Factors,
    ProfileCell,
    follows_factors,
    write_same,
)
from netdesign.report.workbook.writer import Book, count_lines, fit_headings
from netdesign.study.records import CheckRecord, Study

_PAGES = 2  # of paper side by side; on one its figures were too small to be read
HEAD_ROW = 3  # zero-based; the first check is one below
_NOTES = (
    ("caption.check_formulas", "caption.profile_links"),
    ("caption.check_verdicts",),
)
# Text in the place of a sentence of the study that no longer holds.
CHANGED = "caption.changed"
_WANTED = {True: "caption.above_zero", False: "caption.at_least_zero"}


@dataclass(frozen=True)
class _Field:
    """Column of the sheet: letter, key of its quantity, key of its heading, width.

    Without a key of a heading, a quantity of a case stands under its name, any other
    under its symbol; ``end`` tells the ends of its band apart. Columns with values of
    the stored study are hidden, and their headings say "study".
    """

    letter: str
    quantity: str
    heading: str
    width: float
    end: str = ""
    is_of_study: bool = False

    @cached_property
    def index(self) -> int:
        """Place of the column, from zero."""
        *tens, ones = (ord(sign) - ord("A") for sign in self.letter)
        return ones + 26 * sum(ten + 1 for ten in tens)

    @cached_property
    def is_number(self) -> bool:
        """True if its cells are numbers."""
        return bool(self.quantity) or self.heading == "heading.no"

    @cached_property
    def bare(self) -> Column:
        """The column without a heading."""
        return Column(heading="", quantity=self.quantity, is_number=self.is_number)

    def name(self, words: Words) -> Column:
        """The column under its heading."""
        heading = words(self.heading) if self.heading else self._name(words)
        if self.is_of_study:
            study = words("heading.study")
            heading = words("show.label", label=study, text=heading)
        return Column(heading=heading, quantity=self.quantity, is_number=self.is_number)

    def _name(self, words: Words) -> str:
        row = QUANTITIES[self.quantity]
        if self in _CASES:
            return name_heading(words, self.quantity)
        label = row.symbol
        if self.end:
            label = f"{label} {words(f'heading.{self.end}')}"
        return add_unit(label, row.unit)


def _field(letter: str, quantity: str, end: str = "") -> _Field:
    return _Field(letter, quantity, "", 7, end)


_LEAD = (
    _Field("A", "", "heading.no", 4),
    _Field("B", "", "heading.net_row", 9),
    _Field("C", "", "heading.check", 20),
    _Field("D", "", "heading.clause", 9),
)
_ACTIONS = (
    _field("E", "action_kN", "low"),
    _field("F", "action_kN"),
    _field("G", "action_kN", "high"),
)
_ACTION_FACTOR = _field("H", "action_factor")
_DEMANDS = (
    _field("I", "demand_kN", "low"),
    _field("J", "demand_kN"),
    _field("K", "demand_kN", "high"),
)
_RESISTANCE_K = _field("L", "resistance_characteristic_kN")
_RESISTANCE_FACTOR = _field("M", "resistance_factor")
_RESISTANCE = _field("N", "resistance_kN")
_RATIOS = (
    _field("O", "utilisation", "low"),
    _field("P", "utilisation"),
    _field("Q", "utilisation", "high"),
)
_SET = _Field("R", "", "heading.set_by_study", 10)
_VERDICT = _Field("S", "", "heading.verdict", 15)
_TAIL = (
    _Field("W", "", "heading.resistance_from", 18),
    _Field("X", "", "heading.reason", 50),
)
_LOADS = (
    _field("Y", "coupled_kN", "high"),
    _field("Z", "guideline_kN"),
    _Field("AA", "", "heading.governing_load", 16),
)
_CASES = tuple(
    _Field(letter, quantity, "", 8.5)
    for letter, quantity in zip("TUV", CASE_QUANTITIES, strict=True)
)
# Hidden: what the live cells are compared with, and what is sorted by.
_RANK = _Field("AB", "", "heading.rank", 8)
_UNCHANGED = _Field("AC", "", "heading.as_in_study", 8)
_STUDY_TEXTS = (
    _Field("AD", "", "heading.resistance_from", 8, is_of_study=True),
    _Field("AE", "", "heading.reason", 8, is_of_study=True),
)
_STUDY_VERDICT = _Field("AF", "", "heading.verdict", 8, is_of_study=True)
_STUDY_NUMBERS = (
    _Field("AG", "utilisation", "", 8, "low", is_of_study=True),
    _Field("AH", "utilisation", "", 8, "high", is_of_study=True),
    _Field("AI", "resistance_characteristic_kN", "", 8, is_of_study=True),
)
# Of a study with further ranges; after the hidden ones, whose letters stay.
_FURTHER = _Field("AJ", "", "heading.further_values", 24)
_SHOWN = (
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
    *_LOADS,
)
_HIDDEN = (_RANK, _UNCHANGED, *_STUDY_TEXTS, _STUDY_VERDICT, *_STUDY_NUMBERS)
_FOLDED = (_ACTIONS[0], _ACTIONS[2])  # E_d has the same ends; a click unfolds them
_FIELDS = (*_SHOWN, *_HIDDEN, _FURTHER)


def has_further(study: Study) -> bool:
    """True if more than the usual three quantities range."""
    checks = (check for row in study.rows for check in row.checks)
    return any(len(check.case.values) > 3 for check in checks if check.case)


def add_check_sheet(book: Book, study: Study, view: ReportView) -> None:
    """Sheet "Checks" and the defined names that the summary counts by."""
    sheet = book.add_sheet("checks", book.words("heading.checks"))
    sheet.fit_to_pages(_PAGES, 0)
    sheet.repeat_columns(_LEAD[0].index, _LEAD[2].index)
    book.link_back(sheet, (0, 3))
    first_page = _SHOWN[: _VERDICT.index + 1]  # what stands beside it is another one
    widths = [field.width for field in first_page]
    for line, notes in enumerate(_NOTES, 1):
        text = " ".join(book.words(note) for note in notes)
        book.write_wide(sheet, (line, 0), text, widths, italic=True)
    factors = Factors(book, study)
    columns = [field.name(book.words) for field in _FIELDS]
    widths = fit_headings(columns, [field.width for field in _FIELDS])
    book.write_head(sheet, HEAD_ROW, columns, widths)
    for field, width in zip(_FIELDS, widths, strict=True):
        is_idle = field is _FURTHER and not has_further(study)
        is_hidden = field in (*_HIDDEN, *_FOLDED) or is_idle
        options = {"hidden": is_hidden, "level": int(field in _FOLDED)}
        area = f"{field.letter}:{field.letter}"
        sheet.set_column(area, width, None, options)
    line = HEAD_ROW + 1
    for number, (row, shown) in enumerate(zip(study.rows, view.rows, strict=True), 1):
        for check, words in zip(row.checks, shown.checks, strict=True):
            _CheckLine(book, sheet, line, factors).write((number, row.id), check, words)
            line += 1
    if line == HEAD_ROW + 1:
        text = book.words("heading.no_check")
        sheet.write_string(line, 0, text, book.text())
    printed = [field.width for field in _SHOWN if field not in _FOLDED]
    named = _LEAD[2].index + 1
    book.paper(sheet).height = find_height(printed, A4, _PAGES, named)
    last = max(line, HEAD_ROW + 2)
    _finish(book, sheet, last)


def _finish(book: Book, sheet: Any, last: int) -> None:
    first = HEAD_ROW + 2
    named = {
        "check_net_row_number": _LEAD[0],
        "check_name": _LEAD[2],
        "check_utilisation": _RATIOS[1],
        "check_utilisation_high": _RATIOS[2],
        "check_verdict": _VERDICT,
        "check_reason": _TAIL[1],
        "check_rank": _RANK,
        "check_unchanged": _UNCHANGED,
        "check_load": _LOADS[2],
        **{f"check_case_{n}": field for n, field in enumerate(_CASES, 1)},
        "check_case_further": _FURTHER,
    }
    for name, field in named.items():
        area = f"${field.letter}${first}:${field.letter}${last}"
        book.workbook.define_name(name, f"={book.refer('checks', area)}")
    _validate(book, sheet, (first - 1, last - 1))
    for field, decorate in (
        (_VERDICT, book.colour_verdicts),
        (_RATIOS[1], book.add_ratio_bars),
    ):
        decorate(sheet, (first - 1, field.index, last - 1, field.index))
    sheet.autofilter(HEAD_ROW, 0, last - 1, len(_SHOWN) - 1)
    sheet.freeze_panes(HEAD_ROW + 1, 3)
    book.paper(sheet).repeat(HEAD_ROW)


def _validate(book: Book, sheet: Any, lines: tuple[int, int]) -> None:
    """Let a spreadsheet program refuse factors and resistances that cannot be."""
    first, last = lines
    given = (_ACTION_FACTOR, _RESISTANCE_K, _RESISTANCE_FACTOR)
    for field in (*given, *_ACTIONS):
        rule = {
            "validate": "decimal",
            "criteria": ">" if field in given else ">=",
            "value": 0,
            "ignore_blank": False,
            "error_message": book.words(_WANTED[field in given]),
        }
        sheet.data_validation(first, field.index, last, field.index, rule)


class _CheckLine:
    """One line of the sheet; ``line`` counts from zero."""

    def __init__(self, book: Book, sheet: Any, line: int, factors: Factors) -> None:
        self._book, self._sheet, self._line = book, sheet, line
        self._factors = factors

    def write(self, row: tuple[int, str], check: CheckRecord, view: CheckView) -> None:
        """Write texts and inputs as values, everything derived as formulas.

        ``row`` is number and id of the net row, ``view`` the check in words.
        """
        number, name = row
        self._put(_LEAD[0], Cell(text=str(number), number=float(number)))
        self._write_numbers(check)
        self._write_verdict(number, check)
        case = find_case(check)
        for field in _CASES:
            self._put_number(field, getattr(case, field.quantity) if case else None)
        self._put(_FURTHER, Cell(text=self._book.words.name_further(case)))
        self._write_loads(check, view)
        texts = (show_text(name), view.title, view.clause)
        for field, text in zip(_LEAD[1:], texts, strict=True):
            self._put(field, Cell(text=text))
        self._write_study(check, view)
        self._write_sentences(check, view)
        fields = (*_LEAD[1:], *_TAIL)
        shown = (*texts, view.resistance_from, view.reason)
        lines = count_lines(shown, [field.width for field in fields])
        self._book.set_height(self._sheet, self._line, lines)

    def _write_loads(self, check: CheckRecord, view: CheckView) -> None:
        """Coupled bound and guideline's force, characteristic, and the larger one."""
        action = check.action
        bound, least, governing = _LOADS
        self._put_number(bound, action.coupled_kN if action else None)
        self._put_number(least, action.guideline_kN if action else None)
        self._put(governing, Cell(text=show_load(check, view, self._book.words)))

    def _write_numbers(self, check: CheckRecord) -> None:
        actions, demands = _list_actions(check), _list_demands(check)
        factor, at = self._at(_ACTION_FACTOR), self._at
        self._put_factor(_ACTION_FACTOR, check.action_factor, self._factors.on_action())
        for source, target, action, demand in zip(
            _ACTIONS, _DEMANDS, actions, demands, strict=True
        ):
            self._put_number(source, action)
            self._put_number(target, demand, write_product(at(source), factor))
        parts = (at(_RESISTANCE_K), at(_RESISTANCE_FACTOR))
        self._put_number(_RESISTANCE_K, check.resistance_characteristic_kN)
        on_resistance = self._factors.on_resistance(check)
        self._put_factor(_RESISTANCE_FACTOR, check.resistance_factor, on_resistance)
        self._put_number(_RESISTANCE, check.resistance_kN, write_quotient(*parts))
        low, high = check.used_band
        for field, demand_field, ratio in zip(
            _RATIOS, _DEMANDS, (low, check.used, high), strict=True
        ):
            live = write_ratio(
                *(at(demand_field), at(_RESISTANCE)), is_unbounded=check.is_unbounded
            )
            self._put_number(field, ratio, live)

    def _write_verdict(self, number: int, check: CheckRecord) -> None:
        is_set = decide_by_ratio(*_recalculate_band(check)) is not check.verdict
        words = {verdict: self._book.word(verdict) for verdict in Verdict}
        shown, given = words[check.verdict], self._at(_SET)
        self._put(_SET, Cell(text=shown if is_set else MISSING))
        ends = [self._at(field) for field in _RATIOS]
        formula = (
            write_verdict(ends, given, self._at(_STUDY_VERDICT), words)
            if _is_of_forces(check)
            else write_given_verdict(given, words)
        )
        held = write_held(formula, self._list_conditions(check), words)
        form = self._book.text(bold=True, text_wrap=True)
        self._sheet.write_formula(*self._place(_VERDICT), held, form, shown)
        rank = write_rank(self._at(_LEAD[0]), self._at(_VERDICT), ends[1], words)
        value = compute_rank(number, check.verdict, check.used)
        self._sheet.write_formula(*self._place(_RANK), rank, None, value)

    def _list_conditions(self, check: CheckRecord) -> list[str]:
        """Conditions under which the cells that are no formulas hold."""
        conditions = [f"{UNCHANGED}=1"]
        if follows_factors(check):
            pairs = (
                (_ACTION_FACTOR, check.action_factor),
                (_RESISTANCE_FACTOR, check.resistance_factor),
            )
            conditions += [
                write_same(self._at(field), value) for field, value in pairs if value
            ]
        return conditions

    def _write_study(self, check: CheckRecord, view: CheckView) -> None:
        """Write the study's own values, and whether the live cells still show them."""
        at = self._at
        for field, text in zip(
            (*_STUDY_TEXTS, _STUDY_VERDICT),
            (view.resistance_from, view.reason, self._book.word(check.verdict)),
            strict=True,
        ):
            self._put(field, Cell(text=text))
        numbers = (*check.used_band, check.resistance_characteristic_kN)
        for field, number in zip(_STUDY_NUMBERS, numbers, strict=True):
            self._put_number(field, number)
        live = (_RATIOS[0], _RATIOS[2], _RESISTANCE_K)
        formula = write_unchanged(
            [(at(a), at(b)) for a, b in zip(live, _STUDY_NUMBERS, strict=True)],
            [(at(_VERDICT), at(_STUDY_VERDICT))],
            self._list_conditions(check),
        )
        self._sheet.write_formula(*self._place(_UNCHANGED), formula, None, 1)

    def _write_sentences(self, check: CheckRecord, view: CheckView) -> None:
        """Write sentences of the study, shown as long as they hold.

        Afterwards the reason is that of the live verdict.
        """
        form, words = self._book.text(text_wrap=True), self._book.words
        now = (
            f'"{words(CHANGED)}"',
            write_reason(
                [self._at(field) for field in _RATIOS],
                (self._at(_SET), self._at(_VERDICT)),
                self._list_conditions(check),
                {verdict: self._book.word(verdict) for verdict in Verdict},
                _list_reasons(words),
            ),
        )
        texts = (view.resistance_from, view.reason)
        for field, stored, live, text in zip(
            _TAIL, _STUDY_TEXTS, now, texts, strict=True
        ):
            formula = f"=IF({self._at(_UNCHANGED)}=1,{self._at(stored)},{live})"
            self._sheet.write_formula(*self._place(field), formula, form, text)

    def _at(self, field: _Field) -> str:
        return f"{field.letter}{self._line + 1}"

    def _place(self, field: _Field) -> tuple[int, int]:
        return self._line, field.index

    def _put(self, field: _Field, cell: Cell) -> None:
        self._book.write_cell(self._sheet, self._place(field), field.bare, cell)

    def _put_factor(
        self, field: _Field, value: float | None, link: ProfileCell | None
    ) -> None:
        """Write a factor as a link to the profile's value, where it is that one."""
        if value is None or link is None or link.value != value:
            self._put_number(field, value)
            return
        form = self._book.format(
            align="right", num_format=number_format(field.quantity)
        )
        place = self._place(field)
        self._sheet.write_formula(*place, f"={link.place}", form, value)

    def _put_number(
        self, field: _Field, value: float | None, formula: str = ""
    ) -> None:
        """Write a number; with ``formula`` it is live, and "-" without its parts."""
        shown = show_cached(value)
        if not formula:  # its text stands only where no number does
            text = shown if isinstance(shown, str) else MISSING
            self._put(field, Cell(text=text, number=value))
            return
        form = self._book.format(
            align="right", num_format=number_format(field.quantity)
        )
        live = f'=IFERROR({formula},"{MISSING}")'
        self._sheet.write_formula(*self._place(field), live, form, shown)


def show_cached(value: float | None) -> float | str:
    """Value of the study that a formula's cell shows: a number, or a sign for none."""
    if value is None:
        return MISSING
    return UNBOUNDED if value == math.inf else value


def _list_reasons(words: Words) -> ChangedReasons:
    return ChangedReasons(
        passes=words("caption.changed_passes"),
        fails=words("caption.changed_fails"),
        spans=words("caption.changed_spans"),
        lacks=words("caption.changed_lacks"),
        set=words("caption.changed_set"),
        profile=words("caption.changed_profile"),
        factor=words("caption.changed_factor"),
    )


def show_load(check: CheckRecord, view: CheckView, words: Words) -> str:
    """Load that governs; that of the guideline with its case."""
    if check.action is None or not view.load:
        return MISSING
    named = words(f"load_name.{check.action.governs}")
    return f"{named}, {view.case}" if find_case(check) is None else named


def decide_by_ratio(low: float | None, high: float | None) -> Verdict:
    """Verdict of the formula in the sheet: by the band of the utilisation alone."""
    if low is None or high is None:
        return Verdict.NOT_PROVEN
    if high <= 1.0 + ROUNDING:
        return Verdict.PASS
    return Verdict.FAIL if low > 1 else Verdict.NOT_PROVEN


def _is_of_forces(check: CheckRecord) -> bool:
    """The verdict follows from a ratio; that of a pass without one does not."""
    return check.verdict is not Verdict.PASS or check.utilisation is not None


def _recalculate_band(check: CheckRecord) -> tuple[float | None, float | None]:
    """Band as the sheet calculates it; may differ in the last bit, at exactly 1."""
    resistance = _divide_resistance(check)
    if resistance is None or check.action_factor is None:
        return None, None
    low, _, high = (
        None if action is None else action * check.action_factor / resistance
        for action in _list_actions(check)
    )
    return low, high


def _divide_resistance(check: CheckRecord) -> float | None:
    above, below = check.resistance_characteristic_kN, check.resistance_factor
    return above / below if above and below else None


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
