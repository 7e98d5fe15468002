"""Sheet of checks: each a block whose numbers follow from cells of its net row.

A step stands in the first check that rests on it, and is read there by all others. A
verdict is the study's text: no number typed here can make an unearned pass.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from netdesign.calculation.quantity import Kind
from netdesign.calculation.steps import (
    PRINTED,
    SPREADSHEET,
    Step,
    list_operands,
    translate,
)
from netdesign.checks.check import Check
from netdesign.outcome import Verdict
from netdesign.quantities import QUANTITIES
from netdesign.report.blocks import Column
from netdesign.report.sections.checks import (
    describe_eased,
    describe_resistance,
    name_case,
)
from netdesign.report.words import (
    MISSING,
    UNBOUNDED,
    Words,
    show_check,
    show_text,
    show_unit,
)
from netdesign.report.workbook.writer import Book, count_lines
from netdesign.study.records import RowStudy, Study
from netdesign.words.message import Message

FIRST_LINE = 4  # of the first check, zero-based; the headings are one above
_WIDTHS = {
    "net_row": 7,
    "check": 44,
    "verdict": 22,
    "symbol": 9,
    "name": 13,
    "formula": 14,
    "low": 6,
    "value": 6,
    "high": 6,
    "unit": 7,
    "source": 30,
}
_PLACES = {name: place for place, name in enumerate(_WIDTHS)}
_ENDS = {-1: "low", 0: "value", 1: "high"}
_HEADINGS = {"net_row": "anchors.row"}  # which is short
_FORCES = {"E_d": ("symbol", "name"), "R_d": ("formula", "formula")}  # columns
_REASON = ("check", "source")
_FORMATS = {"kN": "0.00", "m": "0.000", "-": "0.0000"}
_TYPED = "#2A4B6B"  # colour of numbers that a reader may type over

# Cell of each number by symbol and end; an end without a cell is as the value.
Cells = dict[tuple[str, int], str]
# Cells of the steps of a net row, each by all that decides what stands in them.
_Written = dict[tuple[object, ...], Cells]
_Shown = tuple[str, float | str]  # formula, "" of a number that is given, and result


def add_check_sheet(book: Book, study: Study) -> list[int]:
    """Sheet "Checks": a line of each check, and folded below it those of its steps.

    Returns the first line of each net row, zero-based.
    """
    words, widths = book.words, tuple(_WIDTHS.values())
    sheet = book.add_sheet("checks", words("heading.checks"), is_wide=False)
    sheet.outline_settings(symbols_below=False)
    book.link_back(sheet)
    book.write_wide(sheet, (2, 0), words("caption.calculations"), widths, italic=True)
    heads = [
        Column(heading=words(_HEADINGS.get(name, f"heading.{name}")), is_number=is_end)
        for name, is_end in ((x, x in _ENDS.values()) for x in _WIDTHS)
    ]
    book.write_head(sheet, FIRST_LINE - 1, heads, widths)
    for place, width in enumerate(widths):
        sheet.set_column(place, place, width)
    line, first_lines = FIRST_LINE, []
    for row in study.rows:
        first_lines.append(line)
        line = _write_row(book, sheet, line, row)
    if line == FIRST_LINE:
        sheet.write_string(line, 0, words("heading.no_check"), book.text())
    last, verdict = max(line - 1, FIRST_LINE), _PLACES["verdict"]
    book.colour_verdicts(sheet, (FIRST_LINE, verdict, last, verdict))
    sheet.autofilter(FIRST_LINE - 1, 0, last, len(_WIDTHS) - 1)
    sheet.print_area(0, 0, max(line - 1, last), len(_WIDTHS) - 1)
    sheet.freeze_panes(FIRST_LINE, _PLACES["symbol"])
    sheet.repeat_rows(FIRST_LINE - 1)
    return first_lines


_ABOVE_STEPS = 2  # lines of a check: its numbers, its reason


def _write_row(book: Book, sheet: Any, line: int, row: RowStudy) -> int:
    """Checks of a net row from a line on; the next free line."""
    shown: set[Message | None] = {None}
    written: _Written = {}
    for check in row.checks:
        reason = _tell_reason(check, book.words)
        is_hidden = check.verdict is Verdict.PASS or check.reason in shown
        shown.add(check.reason)
        first = line + _ABOVE_STEPS
        cells, after = _write_steps(book, sheet, first, check, written)
        _write_check(book, sheet, line, row.id, check)
        _write_reason(book, sheet, line + 1, reason, is_hidden=is_hidden)
        _write_forces(book, sheet, line, check, cells)
        _write_used(book, sheet, line, check, cells)
        line = after
    return line


def _write_check(book: Book, sheet: Any, line: int, row: str, check: Check) -> None:
    """Net row, check, verdict and resistance, on one line; a long text is smaller."""
    words = book.words
    texts = {
        "net_row": show_text(row),
        "check": show_check(words, check),
        "verdict": book.word(check.verdict),
        "source": describe_resistance(check, words).removeprefix(MISSING),
    }
    for name, text in texts.items():
        look = book.text(shrink=True, top=1, bold=name != "source")
        sheet.write_string(line, _PLACES[name], text, look)
    sheet.write_blank(line, _PLACES["unit"], None, book.text(top=1))
    book.set_height(sheet, line, 1)


def _tell_reason(check: Check, words: Words) -> str:
    """Clause, case and reason of a check; the worst come first."""
    texts = (
        words.show(check.reason).rstrip("."),
        describe_eased(check, words),
        check.clause,
        name_case(check, words),
    )
    return words.join(text for text in texts if text not in ("", MISSING))


def _write_reason(
    book: Book, sheet: Any, line: int, reason: str, *, is_hidden: bool
) -> None:
    """Reason of a check; folded away where it passes, and where a row has it again."""
    first, last = (_PLACES[name] for name in _REASON)
    form = book.text(text_wrap=True)
    sheet.merge_range(line, first, line, last, "", form)
    sheet.write_string(line, first, reason, form)
    lines = count_lines([reason], [sum(list(_WIDTHS.values())[first : last + 1])])
    fold = {"level": 1, "hidden": True} if is_hidden else {}
    book.set_height(sheet, line, lines, collapsed=not is_hidden, **fold)


def _write_forces(
    book: Book, sheet: Any, line: int, check: Check, cells: Cells
) -> None:
    """E_d and R_d of a check [kN], as its steps work them out."""
    numbers = {step.symbol: step.value for step in check.steps}
    for symbol, (start, end) in _FORCES.items():
        first, last = _PLACES[start], _PLACES[end]
        number, form = numbers.get(symbol), book.text(top=1)
        if number is not None:
            shown = QUANTITIES["demand_kN"].number_format.split(";")
            parts = [
                f'{x[: x.find("0")]}"{symbol} "{x[x.find("0") :]}" kN"' for x in shown
            ]
            form = book.text(top=1, num_format=";".join(parts))
        if last > first:
            sheet.merge_range(line, first, line, last, "", form)
        if number is None:
            sheet.write_blank(line, first, None, form)
        else:
            sheet.write_formula(line, first, f"={cells[symbol, 0]}", form, number)


def _write_used(book: Book, sheet: Any, line: int, check: Check, cells: Cells) -> None:
    """Utilisation of a check, which its steps work out."""
    form = book.format(
        align="right",
        num_format=QUANTITIES["utilisation"].number_format,
        bold=True,
        top=1,
    )
    low, high = check.used_band
    for (end, name), used in zip(_ENDS.items(), (low, check.used, high), strict=True):
        shown = MISSING if used is None else UNBOUNDED if used == math.inf else used
        place = (line, _PLACES[name])
        if ("μ", 0) in cells:
            cell = _find(cells, "μ", end)
            is_eased = end < 0 and check.eased_low is not None
            eased = f"IF(ISNUMBER({cell}),MIN({cell},{check.eased_low!r}),{cell})"
            formula = f"={eased if is_eased else cell}"
            sheet.write_formula(*place, formula, form, shown)
        else:
            sheet.write(*place, shown, form)


def _write_steps(
    book: Book, sheet: Any, line: int, check: Check, written: _Written
) -> tuple[Cells, int]:
    """Lines of the steps that no check above has; cells of all, the next free line."""
    cells: Cells = {}
    for step in check.steps:
        read = list_operands(step.formula, 0) if step.formula else ()
        none = UNBOUNDED if check.is_unbounded and step.symbol == "μ" else MISSING
        key = (step, none, *(cells[place] for place in read))
        if key not in written:
            _write_texts(book, sheet, line, step)
            is_live = bool(step.formula) and not _is_refused(step, check)
            ends = _list_ends(step, cells, none, is_live=is_live)
            written[key] = _write_ends(book, sheet, line, step, ends)
            line += 1
        cells |= written[key]
    return cells, line


def _write_ends(
    book: Book, sheet: Any, line: int, step: Step, shown: Mapping[int, _Shown]
) -> Cells:
    """Numbers of a step, those that are worked out as formulas; their cells."""
    look = {} if step.formula else {"font_color": _TYPED}
    number_format = _FORMATS.get(step.unit, "General")
    form = book.format(align="right", num_format=number_format, **look)
    cells: Cells = {}
    for end, (formula, value) in shown.items():
        place = _PLACES[_ENDS[end]]
        if formula:
            sheet.write_formula(line, place, formula, form, value)
        else:
            sheet.write(line, place, value, form)
        cells[step.symbol, end] = f"{chr(ord('A') + place)}{line + 1}"
    return cells


def _list_ends(
    step: Step, cells: Cells, none: str, *, is_live: bool
) -> dict[int, _Shown]:
    """Formula and number of each end of a step; ``none`` where there is no number."""
    return {
        end: (
            _write_formula(step, end, cells, none) if is_live else "",
            none if number is None else number,
        )
        for end, number in zip(_ENDS, step.ends, strict=True)
        if _has_end(step, end, cells)
    }


def _find(cells: Cells, symbol: str, end: int) -> str:
    """Cell whose number counts for an end of a step."""
    return cells.get((symbol, end), cells[symbol, 0])


def _has_end(step: Step, end: int, cells: Cells) -> bool:
    """An end of a step may differ from its value: by itself, or by what makes it."""
    if end == 0:
        return True
    if not step.formula:
        return (step.low if end < 0 else step.high) is not None
    operands = list_operands(step.formula, end)
    return any(of_end and (symbol, of_end) in cells for symbol, of_end in operands)


def _is_refused(step: Step, check: Check) -> bool:
    """Its formula has no result, although all that it is made of is known."""
    if step.value is not None:
        return False
    operands = list_operands(step.formula, 0)
    return all(check.read(symbol) is not None for symbol, _ in operands)


def _write_formula(step: Step, end: int, cells: Cells, none: str) -> str:
    """Formula of an end of a step; ``none`` where a cell of it holds no number.

    That sign comes from a function of Excel 2013, marked as such: XlsxWriter looks for
    newer ones in any formula without the mark, which takes a quarter of all outputs.
    """
    read = list_operands(step.formula, end)
    formula = translate(
        step.formula, SPREADSHEET, lambda symbol, of: _find(cells, symbol, of), end
    )
    used = dict.fromkeys(_find(cells, *place) for place in read)
    counted = f"COUNT({','.join(used)})={len(used)}"
    sign = f"_xlfn.UNICHAR({ord(none)})"
    return f"=IFERROR(IF({counted},{formula},{sign}),{sign})"


def _write_texts(book: Book, sheet: Any, line: int, step: Step) -> None:
    """Texts of a step: symbol, name, formula, unit and origin."""
    words, form = book.words, book.text(text_wrap=True)
    source = _name_source(step, words)
    texts, lines = _list_texts(words, step.symbol, step.formula, step.unit, source)
    for place, text in texts:
        sheet.write_string(line, place, text, form)
    book.set_height(sheet, line, lines, level=1, hidden=True)


@lru_cache(maxsize=4096)  # a study has a few hundred, each many times
def _list_texts(
    words: Words, symbol: str, formula: str, unit: str, source: str
) -> tuple[list[tuple[int, str]], int]:
    """Texts of a step by their columns, and the lines that they take."""
    printed = translate(formula, PRINTED) if formula else ""
    texts = {
        "symbol": symbol,
        "name": words(f"symbol.{symbol}"),
        "formula": words.write_formula(printed),
        "unit": "" if unit == "-" else show_unit(unit),
        "source": source,
    }
    lines = count_lines(list(texts.values()), [_WIDTHS[name] for name in texts])
    return [(_PLACES[name], text) for name, text in texts.items() if text], lines


def _name_source(step: Step, words: Words) -> str:
    """Cell, id of the profile's value, clause; of a force the load that brings it."""
    if step.kind is not Kind.SOLVED:
        return step.source
    is_floor = step.source.startswith("floor")
    return words("load_name.guideline" if is_floor else "load_name.coupled")
