"""One line of the sheet of checks: numbers of its calculation, verdict and reason."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from netdesign.outcome import Verdict
from netdesign.report.blocks import Cell
from netdesign.report.governing import find_case
from netdesign.report.sections.checks import (
    describe_loads,
    describe_resistance,
    name_case,
)
from netdesign.report.words import (
    MISSING,
    UNBOUNDED,
    Words,
    number_format,
    show_check,
    show_text,
)
from netdesign.report.workbook.calculation_sheet import UNCHANGED as GIVEN_UNCHANGED
from netdesign.report.workbook.calculation_sheet import Calculations
from netdesign.report.workbook.check_columns import (
    AS_CALCULATED,
    CASES,
    FURTHER,
    LEAD,
    LOADS,
    RANK,
    RATIOS,
    RESISTANCE_K,
    SET,
    STEPS,
    STUDY_NUMBERS,
    STUDY_TEXTS,
    STUDY_VERDICT,
    TAIL,
    UNCHANGED,
    VERDICT,
    Field,
)
from netdesign.report.workbook.formulas import (
    ROUNDING,
    ChangedReasons,
    compute_rank,
    write_given_verdict,
    write_held,
    write_link,
    write_rank,
    write_reason,
    write_unchanged,
    write_verdict,
)
from netdesign.report.workbook.writer import Book, count_lines
from netdesign.study.records import CheckRecord
from netdesign.words.message import Message

# Text in the place of a sentence of the study that no longer holds.
CHANGED = "caption.changed"
_WITHHELD = "check.overtopped"  # reason of a check whose numbers prove nothing


@dataclass(frozen=True, kw_only=True)
class CheckLine:
    """One line of the sheet.

    Attributes
    ----------
    book, sheet, line
        Where it is written; ``line`` counts from zero.
    check : CheckRecord
        What it shows.
    place : (int, int)
        Numbers of its net row and of itself there, from zero.
    calculations : Calculations
        Lines of its steps.
    followed : sequence of str
        Conditions: what it follows beside its steps is as in the study.
    """

    book: Book
    sheet: Any
    line: int
    check: CheckRecord
    place: tuple[int, int]
    calculations: Calculations
    followed: Sequence[str]

    @cached_property
    def verdicts(self) -> dict[Verdict, str]:
        """Words of the verdicts."""
        return {verdict: self.book.word(verdict) for verdict in Verdict}

    @cached_property
    def sentences(self) -> tuple[str, str]:
        """Source of the resistance, and the reason of the verdict."""
        words = self.book.words
        return describe_resistance(self.check, words), words.show(self.check.reason)

    @cached_property
    def conditions(self) -> list[tuple[str, str]]:
        """Conditions of a verdict by the numbers, and what is told without them."""
        profile, factor, lacks = (
            self.book.words(key)
            for key in (
                "caption.changed_profile",
                "caption.changed_factor",
                "caption.changed_lacks",
            )
        )
        return [
            *((f"{name}=1", profile) for name in GIVEN_UNCHANGED.values()),
            *((one, factor) for one in self.followed),
            (f"{self._at(AS_CALCULATED)}=1", lacks),
        ]

    def write(self, row: str) -> None:
        """Write texts as values, numbers as links, everything derived as formulas.

        ``row`` is the id of the net row.
        """
        number = self.place[0] + 1
        self._put(LEAD[0], Cell(text=str(number), number=float(number)))
        self._write_steps()
        self._write_verdict(number)
        case = find_case(self.check)
        for field in CASES:
            self._put_number(field, getattr(case, field.quantity) if case else None)
        self._put(FURTHER, Cell(text=self.book.words.name_further(case)))
        self._write_loads()
        texts = (
            show_text(row),
            show_check(self.book.words, self.check),
            show_text(self.check.clause),
        )
        for field, text in zip(LEAD[1:], texts, strict=True):
            self._put(field, Cell(text=text))
        self._write_study()
        self._write_sentences()
        fields = (*LEAD[1:], *TAIL)
        shown = (*texts, *self.sentences)
        lines = count_lines(shown, [field.width for field in fields])
        self.book.set_height(self.sheet, self.line, lines)

    def _write_steps(self) -> None:
        """Write links to the calculation, and whether all of them are still there."""
        known, none = self.check.known, Cell(text=MISSING)
        same = []
        for field in STEPS:
            step = known.get(field.step)
            source = self.calculations.refer(self.place, field.step, field.end)
            unbounded = field in RATIOS and self.check.is_unbounded
            if step is None or not source:
                self._put(field, Cell(text=UNBOUNDED) if unbounded else none)
                continue
            value = math.inf if unbounded else step.ends[field.end + 1]
            otherwise = UNBOUNDED if unbounded else MISSING
            link = write_link(source, ">=0", otherwise=otherwise)
            self._write_formula(field, link, show_cached(value))
            if not unbounded:
                cell = self._at(field)
                same.append(
                    f'IF(ISNUMBER({source}),{cell}={source},{cell}="{MISSING}")'
                )
        formula = f"=IFERROR(IF(AND({','.join(same or ['TRUE'])}),1,0),0)"
        self.sheet.write_formula(*self._place(AS_CALCULATED), formula, None, 1)

    def _write_loads(self) -> None:
        """Coupled bound and guideline's force, characteristic, and the larger one.

        A base that slides has none beside its demand: they act across it.
        """
        check = self.check
        bound, least, governing = LOADS
        for field, load in ((bound, "c"), (least, "g")):
            symbol = check.name_force(load)
            source = self.calculations.refer(self.place, symbol, field.end)
            is_across = "V_k" in check.known
            if is_across or not (source and check.is_of_force):
                self._put(field, Cell(text=MISSING))
                continue
            value = check.known[symbol].ends[field.end + 1]
            link = write_link(source, ">=0")
            self._write_formula(field, link, show_cached(value))
        self._put(governing, Cell(text=show_load(check, self.book.words)))

    def _write_verdict(self, number: int) -> None:
        check, given = self.check, self._at(SET)
        by_ratio = decide_by_ratio(*check.utilisation_band)
        shown = self.verdicts[check.verdict]
        is_set = by_ratio is not check.verdict
        self._put(SET, Cell(text=shown if is_set else MISSING))
        ends = [self._at(field) for field in RATIOS]
        is_withheld = _is_withheld(check.reason) or (
            by_ratio is Verdict.FAIL and is_set
        )
        formula = (
            write_verdict(
                *(ends, given, self._at(STUDY_VERDICT), self.verdicts),
                is_withheld=is_withheld,
            )
            if _is_of_forces(check)
            else write_given_verdict(given, self.verdicts)
        )
        held = write_held(formula, [one for one, _ in self.conditions], self.verdicts)
        form = self.book.text(bold=True, text_wrap=True)
        self.sheet.write_formula(*self._place(VERDICT), held, form, shown)
        rank = write_rank(
            *(self._at(LEAD[0]), self._at(VERDICT), ends[1], self.verdicts)
        )
        value = compute_rank(number, check.verdict, check.used)
        self.sheet.write_formula(*self._place(RANK), rank, None, value)

    def _write_study(self) -> None:
        """Write the study's own values, and whether the live cells still show them."""
        at, check = self._at, self.check
        for field, text in zip(
            (*STUDY_TEXTS, STUDY_VERDICT),
            (*self.sentences, self.verdicts[check.verdict]),
            strict=True,
        ):
            self._put(field, Cell(text=text))
        numbers = (*check.used_band, check.read("R_k"))
        for field, number in zip(STUDY_NUMBERS, numbers, strict=True):
            self._put_number(field, number)
        live = (RATIOS[0], RATIOS[2], RESISTANCE_K)
        formula = write_unchanged(
            [(at(a), at(b)) for a, b in zip(live, STUDY_NUMBERS, strict=True)],
            [(at(VERDICT), at(STUDY_VERDICT))],
            [one for one, _ in self.conditions],
        )
        self.sheet.write_formula(*self._place(UNCHANGED), formula, None, 1)

    def _write_sentences(self) -> None:
        """Write sentences of the study, shown as long as they hold.

        Afterwards the reason is that of the live verdict.
        """
        form, words = self.book.text(text_wrap=True), self.book.words
        now = (
            f'"{words(CHANGED)}"',
            write_reason(
                [self._at(field) for field in RATIOS],
                (self._at(SET), self._at(VERDICT)),
                self.conditions,
                self.verdicts,
                _list_reasons(words),
            ),
        )
        texts = self.sentences
        for field, stored, live, text in zip(
            TAIL, STUDY_TEXTS, now, texts, strict=True
        ):
            formula = f"=IF({self._at(UNCHANGED)}=1,{self._at(stored)},{live})"
            self.sheet.write_formula(*self._place(field), formula, form, text)

    def _at(self, field: Field) -> str:
        return f"{field.letter}{self.line + 1}"

    def _place(self, field: Field) -> tuple[int, int]:
        return self.line, field.index

    def _put(self, field: Field, cell: Cell) -> None:
        self.book.write_cell(self.sheet, self._place(field), field.bare, cell)

    def _put_number(self, field: Field, value: float | None) -> None:
        shown = show_cached(value)  # its text stands only where no number does
        text = shown if isinstance(shown, str) else MISSING
        self._put(field, Cell(text=text, number=value))

    def _write_formula(self, field: Field, formula: str, shown: float | str) -> None:
        form = self.book.format(align="right", num_format=number_format(field.quantity))
        self.sheet.write_formula(*self._place(field), formula, form, shown)


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
    )


def show_load(check: CheckRecord, words: Words) -> str:
    """Load that governs; that of the guideline with its case."""
    if not describe_loads(check, words):
        return MISSING
    named = words(f"load_name.{check.governs}")
    return named if find_case(check) else f"{named}, {name_case(check, words)}"


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


def _is_withheld(reason: object) -> bool:
    """Somewhere in a reason it is said that the numbers prove nothing."""
    if isinstance(reason, tuple):
        return any(_is_withheld(one) for one in reason)
    if not isinstance(reason, Message):
        return False
    return reason.key == _WITHHELD or _is_withheld(tuple(reason.arguments.values()))
