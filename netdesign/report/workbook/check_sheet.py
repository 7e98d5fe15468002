"""Sheet of checks: its numbers are those of the calculations, its verdicts follow them.

Each formula is stored with the value of the study, so that viewers which do not
calculate show the study's numbers. A sentence of the study stands as long as the live
numbers are the study's.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from netdesign.outcome import Verdict
from netdesign.quantities import QUANTITIES
from netdesign.report.blocks import Cell, Column
from netdesign.report.sections.checks import (
    describe_loads,
    describe_resistance,
    name_case,
)
from netdesign.report.words import (
    MISSING,
    UNBOUNDED,
    Words,
    add_unit,
    show_check,
    show_text,
)
from netdesign.report.workbook.calculation_sheet import UNCHANGED as GIVEN_UNCHANGED
from netdesign.report.workbook.calculation_sheet import Calculations, GivenCells
from netdesign.report.workbook.formulas import (
    decide_by_ratio,
    quote,
    write_same,
    write_verdict,
)
from netdesign.report.workbook.writer import Book, count_lines, fit_headings
from netdesign.study.governing import find_case
from netdesign.study.records import CheckRecord, Study
from netdesign.words.message import Message

_PAGES = 2  # of paper side by side; on one its figures were too small to be read
HEAD_ROW = 3  # zero-based; the first check is one below
CHANGED = "caption.changed"  # in the place of a sentence that no longer holds
_CHECK_AGAIN = "caption.changed_factor"  # where the forces may be other ones
_WITHHELD = "check.overtopped"  # reason of a check whose numbers prove nothing
_ENDS = {-1: "heading.low", 1: "heading.high"}


@dataclass(frozen=True, slots=True)
class Field:
    """Column: key of its heading, width; of a number its quantity, step and end.

    Without a heading it stands under the symbol of its quantity. One ``of_study`` is
    hidden: no text of a site stands in a formula.
    """

    heading: str
    width: float
    quantity: str = ""
    step: str = ""
    end: int = 0
    of_study: bool = False

    def name(self, words: Words) -> Column:
        """The column under its heading."""
        is_number = bool(self.quantity) or self.heading == "heading.no"
        heading = words(self.heading) if self.heading else self._name(words)
        if self.of_study:
            study = words("heading.study")
            heading = words("show.label", label=study, text=heading)
        return Column(heading=heading, quantity=self.quantity, is_number=is_number)

    def _name(self, words: Words) -> str:
        quantity = QUANTITIES[self.quantity]
        end = f" {words(_ENDS[self.end])}" if self.end else ""
        return add_unit(f"{quantity.symbol}{end}", quantity.unit)


FIELDS = {
    "no": Field("heading.no", 4),
    "row": Field("heading.net_row", 9),
    "check": Field("heading.check", 30),
    "clause": Field("heading.clause", 9),
    "E_k low": Field("", 7, "action_kN", "E_k", -1),
    "E_k": Field("", 7, "action_kN", "E_k"),
    "E_k high": Field("", 7, "action_kN", "E_k", 1),
    "γ_E": Field("", 7, "action_factor", "γ_E"),
    "E_d low": Field("", 7, "demand_kN", "E_d", -1),
    "E_d": Field("", 7, "demand_kN", "E_d"),
    "E_d high": Field("", 7, "demand_kN", "E_d", 1),
    "R_k": Field("", 7, "resistance_characteristic_kN", "R_k"),
    "γ_R": Field("", 7, "resistance_factor", "γ_R"),
    "R_d": Field("", 7, "resistance_kN", "R_d"),
    "μ low": Field("", 7, "utilisation", "μ", -1),
    "μ": Field("", 7, "utilisation", "μ"),
    "μ high": Field("", 7, "utilisation", "μ", 1),
    "set": Field("heading.set_by_study", 10),
    "verdict": Field("heading.verdict", 15),
    "case": Field("heading.case", 28),
    "load": Field("heading.governing_load", 16),
    "source": Field("heading.resistance_from", 26),
    "reason": Field("heading.reason", 58),
    "holds": Field("heading.as_calculated", 8),  # hidden: nothing stands in the way
    "unchanged": Field("heading.as_in_study", 8),  # hidden: it is as in the study
    "stored source": Field("heading.resistance_from", 8, of_study=True),
    "stored reason": Field("heading.reason", 8, of_study=True),
}
_ALPHABET = 26
_LETTERS = {
    name: "A" * (place // _ALPHABET) + chr(ord("A") + place % _ALPHABET)
    for place, name in enumerate(FIELDS)
}
_PLACES = {name: place for place, name in enumerate(FIELDS)}
_STEPS = tuple(name for name, field in FIELDS.items() if field.step)
_RATIOS = ("μ low", "μ", "μ high")
_HIDDEN = ("holds", "unchanged", "stored source", "stored reason")
_FOLDED = ("E_k low", "E_k high")  # E_d has the same ends; a click unfolds them
# Columns that the first sheet counts by, under the names that it knows them by.
_NAMED = {
    "check_net_row_number": "no",
    "check_utilisation": "μ",
    "check_utilisation_high": "μ high",
    "check_verdict": "verdict",
    "check_unchanged": "unchanged",
}


def add_check_sheet(
    book: Book,
    study: Study,
    cells: GivenCells,
    calculations: Calculations,
) -> None:
    """Sheet "Checks" and the defined names that the summary counts by."""
    sheet = book.add_sheet("checks", book.words("heading.checks"))
    columns = {name: field.name(book.words) for name, field in FIELDS.items()}
    _write_head(book, sheet, list(columns.values()))
    line = HEAD_ROW + 1
    for number, row in enumerate(study.rows):
        for place, check in enumerate(row.checks):
            followed = [
                *cells.list_followed(number, check),
                *calculations.list_followed((number, place)),
            ]
            writer = _LineWriter(book, sheet, line, check, calculations, columns)
            writer.write(row.id, (number, place), followed)
            line += 1
    if line == HEAD_ROW + 1:
        text = book.words("heading.no_check")
        sheet.write_string(line, 0, text, book.text())
    _finish(book, sheet, max(line, HEAD_ROW + 2))


def _write_head(book: Book, sheet: Any, columns: Sequence[Column]) -> None:
    """Notes and headings; width of the columns."""
    sheet.fit_to_pages(_PAGES, 0)
    sheet.repeat_columns(_PLACES["no"], _PLACES["check"])
    book.link_back(sheet, (0, 3))
    fields = list(FIELDS.values())
    # what stands beside the verdict is on another page
    widths = [field.width for field in fields[: _PLACES["verdict"] + 1]]
    live = book.words("caption.live_values", sheet=book.name("steps"))
    formulas = " ".join((book.words("caption.check_formulas"), live))
    for line, text in enumerate((formulas, book.words("caption.check_verdicts")), 1):
        book.write_wide(sheet, (line, 0), text, widths, italic=True)
    widths = fit_headings(columns, [field.width for field in fields])
    book.write_head(sheet, HEAD_ROW, columns, widths)
    for (name, place), width in zip(_PLACES.items(), widths, strict=True):
        is_hidden = name in (*_HIDDEN, *_FOLDED)
        options = {"hidden": is_hidden, "level": int(name in _FOLDED)}
        sheet.set_column(place, place, width, None, options)


def _finish(book: Book, sheet: Any, last: int) -> None:
    first = HEAD_ROW + 2
    for name, field in _NAMED.items():
        letter = _LETTERS[field]
        area = book.refer("checks", f"${letter}${first}:${letter}${last}")
        book.workbook.define_name(name, f"={area}")
    for field, decorate in (
        ("verdict", book.colour_verdicts),
        ("μ", book.add_ratio_bars),
    ):
        decorate(sheet, (first - 1, _PLACES[field], last - 1, _PLACES[field]))
    sheet.autofilter(HEAD_ROW, 0, last - 1, _PLACES["reason"])
    sheet.freeze_panes(HEAD_ROW + 1, 3)
    sheet.repeat_rows(HEAD_ROW)


@dataclass(frozen=True, slots=True)
class _LineWriter:
    """Writes the line of a check; ``line`` counts from zero."""

    book: Book
    sheet: Any
    line: int
    check: CheckRecord
    calculations: Calculations
    columns: Mapping[str, Column]

    def write(self, row: str, place: tuple[int, int], followed: Sequence[str]) -> None:
        """Texts as values, numbers as links, what is derived as formulas.

        ``row`` is the id of the net row, ``place`` the numbers of it and of the check;
        ``followed`` are conditions that what it follows beside its steps is the
        study's.
        """
        check, words = self.check, self.book.words
        self._write_links(place)
        watched = (f"{name}=1" for name in GIVEN_UNCHANGED.values())
        conditions = ",".join([*watched, *followed])
        self._write_formula("holds", f"IF(AND({conditions}),1,0)", "0", 1)
        self._write_verdict(place)
        number = place[0] + 1
        self._put("no", Cell(text=str(number), number=float(number)))
        case = find_case(check)
        texts = {
            "row": show_text(row),
            "check": show_check(words, check),
            "clause": show_text(check.clause),
            "case": words.name_case(case),
            "load": show_load(check, words),
            "source": describe_resistance(check, words),
            "reason": words.show(check.reason),
        }
        again = f"IF({self._at('holds')}=1,{quote(words(CHANGED))},"
        again += f"{quote(words(_CHECK_AGAIN))})"
        for name, text in texts.items():
            if name not in ("source", "reason"):
                self._put(name, Cell(text=text))
                continue
            self._put(f"stored {name}", Cell(text=text))
            stored = self._at(f"stored {name}")
            formula = f"IF({self._at('unchanged')}=1,{stored},{again})"
            form = self.book.text(text_wrap=True)
            self.sheet.write_formula(*self._place(name), f"={formula}", form, text)
        widths = [FIELDS[name].width for name in texts]
        lines = count_lines(list(texts.values()), widths)
        self.book.set_height(self.sheet, self.line, lines)

    def _refer(self, place: tuple[int, int], name: str) -> str:
        """Cell of the calculation that a column shows; "" where it has none."""
        field = FIELDS[name]
        return self.calculations.refer(place, field.step, field.end)

    def _find(self, place: tuple[int, int], name: str) -> str:
        """Cell that the verdict follows: of the calculation, or here without one."""
        is_here = name in _RATIOS and self.check.is_unbounded
        return (not is_here and self._refer(place, name)) or self._at(name)

    def _write_links(self, place: tuple[int, int]) -> None:
        """Links to the calculation: they show it, and nothing is decided by them."""
        check = self.check
        for name in _STEPS:
            field = FIELDS[name]
            step = check.known.get(field.step)
            source = self._refer(place, name)
            is_unbounded = name in _RATIOS and check.is_unbounded
            if step is None or not source:
                self._put(name, Cell(text=UNBOUNDED if is_unbounded else MISSING))
                continue
            value = math.inf if is_unbounded else step.ends[field.end + 1]
            link = f"={source}"
            if is_unbounded:
                link = f'=IF(ISNUMBER({source}),{source},"{UNBOUNDED}")'
            form = self.book.format(
                align="right", num_format=QUANTITIES[field.quantity].number_format
            )
            self.sheet.write_formula(*self._place(name), link, form, show_cached(value))

    def _write_verdict(self, place: tuple[int, int]) -> None:
        """Verdict of the live numbers, and whether all is as in the study."""
        check, words = self.check, self.book.words
        shown = self.book.word(check.verdict)
        is_set = decide_by_ratio(*check.utilisation_band) is not check.verdict
        self._put("set", Cell(text=shown if is_set else MISSING))
        # a pass without a ratio has no number to follow
        is_set_for_good = check.verdict is Verdict.PASS and check.utilisation is None
        formula = write_verdict(
            [self._find(place, name) for name in _RATIOS],
            check.verdict if is_set else None,
            self.book.verdicts,
            follows=not (_is_withheld(check.reason) or is_set_for_good),
        )
        none = quote(words(f"verdict.{Verdict.NOT_PROVEN}"))
        held = f"IF({self._at('holds')}=1,{formula},{none})"
        form = self.book.text(bold=True, text_wrap=True)
        self._write_formula("verdict", held, none, shown, form)
        numbers = {
            "μ low": check.used_band[0],
            "μ high": check.used_band[1],
            "R_k": check.read("R_k"),
        }
        same = [
            write_same(self._find(place, name), show_cached(x))
            for name, x in numbers.items()
        ]
        same += [f"{self._at('holds')}=1", f"{self._at('verdict')}={quote(shown)}"]
        self._write_formula("unchanged", f"IF(AND({','.join(same)}),1,0)", "0", 1)

    def _write_formula(
        self,
        name: str,
        formula: str,
        otherwise: str,
        shown: float | str,
        form: Any = None,
    ) -> None:
        """Formula with what stands for an error in it."""
        whole = f"=IFERROR({formula},{otherwise})"
        self.sheet.write_formula(*self._place(name), whole, form, shown)

    def _at(self, name: str) -> str:
        return f"{_LETTERS[name]}{self.line + 1}"

    def _place(self, name: str) -> tuple[int, int]:
        return self.line, _PLACES[name]

    def _put(self, name: str, cell: Cell) -> None:
        self.book.write_cell(self.sheet, self._place(name), self.columns[name], cell)


def show_cached(value: float | None) -> float | str:
    """Value of the study that a formula's cell shows: a number, or a sign for none."""
    if value is None:
        return MISSING
    return UNBOUNDED if value == math.inf else value


def show_load(check: CheckRecord, words: Words) -> str:
    """Load that governs; that of the guideline with its case."""
    if not describe_loads(check, words):
        return MISSING
    named = words(f"load_name.{check.governs}")
    return named if find_case(check) else f"{named}, {name_case(check, words)}"


def _is_withheld(reason: object) -> bool:
    """Somewhere in a reason it is said that the numbers prove nothing."""
    if isinstance(reason, tuple):
        return any(_is_withheld(one) for one in reason)
    if not isinstance(reason, Message):
        return False
    return reason.key == _WITHHELD or _is_withheld(tuple(reason.arguments.values()))
