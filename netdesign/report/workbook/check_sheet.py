"""Sheet of checks: each a block whose numbers follow from the block's own cells.

A verdict is the study's text. A number typed here changes numbers of one block,
never a verdict: no cell can make an unearned pass.
"""

from __future__ import annotations

import math
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
from netdesign.study.records import Study
from netdesign.words.message import Message

FIRST_LINE = 4  # of the first check, zero-based; the headings are one above
_WIDTHS = {
    "net_row": 5,
    "check": 35,
    "verdict": 17,
    "symbol": 8,
    "name": 20,
    "formula": 16,
    "low": 6,
    "value": 6,
    "high": 6,
    "unit": 5,
    "source": 22,
}
_PLACES = {name: place for place, name in enumerate(_WIDTHS)}
_ENDS = {-1: "low", 0: "value", 1: "high"}
_FORCES = {"E_d": ("symbol", "name"), "R_d": ("formula", "formula")}  # columns
_REASON = ("check", "source")
_FORMATS = {"kN": "0.00", "m": "0.000", "-": "0.0000"}
_TYPED = "#2A4B6B"  # colour of numbers that a reader may type over

# Cell of each number by symbol and end; an end without a cell is as the value.
Cells = dict[tuple[str, int], str]


def add_check_sheet(book: Book, study: Study) -> None:
    """Sheet "Checks": a line of each check, and folded below it those of its steps."""
    words, widths = book.words, tuple(_WIDTHS.values())
    sheet = book.add_sheet("checks", words("heading.checks"), is_wide=False)
    sheet.outline_settings(symbols_below=False)
    book.link_back(sheet)
    book.write_wide(sheet, (2, 0), words("caption.calculations"), widths, italic=True)
    heads = [
        Column(heading=words(f"heading.{name}"), is_number=name in _ENDS.values())
        for name in _WIDTHS
    ]
    book.write_head(sheet, FIRST_LINE - 1, heads, widths)
    for place, width in enumerate(widths):
        sheet.set_column(place, place, width)
    line = FIRST_LINE
    for row in study.rows:
        shown: set[Message | None] = {None}
        for check in row.checks:
            reason = _tell_reason(check, words)
            is_hidden = check.verdict is Verdict.PASS or check.reason in shown
            shown.add(check.reason)
            cells = _write_steps(book, sheet, line + _ABOVE_STEPS, check)
            _write_check(book, sheet, line, row.id, check)
            _write_reason(book, sheet, line + 1, reason, is_hidden=is_hidden)
            _write_forces(book, sheet, line, check, cells)
            _write_used(book, sheet, line, check, cells)
            line += count_block(check)
    if line == FIRST_LINE:
        sheet.write_string(line, 0, words("heading.no_check"), book.text())
    last, verdict = max(line - 1, FIRST_LINE), _PLACES["verdict"]
    book.colour_verdicts(sheet, (FIRST_LINE, verdict, last, verdict))
    sheet.autofilter(FIRST_LINE - 1, 0, last, len(_WIDTHS) - 1)
    sheet.print_area(0, 0, max(line - 1, last), len(_WIDTHS) - 1)
    sheet.freeze_panes(FIRST_LINE, _PLACES["symbol"])
    sheet.repeat_rows(FIRST_LINE - 1)


_ABOVE_STEPS = 2  # lines of a check: its numbers, its reason


def count_block(check: Check) -> int:
    """Lines of a check: its numbers, its reason, its steps."""
    return _ABOVE_STEPS + len(check.steps)


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
        words.show(check.reason),
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


def _write_steps(book: Book, sheet: Any, first: int, check: Check) -> Cells:
    """Lines of the steps; what is worked out is a formula of the lines above it."""
    cells: Cells = {}
    for line, step in enumerate(check.steps, first):
        _write_texts(book, sheet, line, step)
        look = {} if step.formula else {"font_color": _TYPED}
        number_format = _FORMATS.get(step.unit, "General")
        form = book.format(align="right", num_format=number_format, **look)
        is_infinite = check.is_unbounded and step.symbol == "μ"
        none = UNBOUNDED if is_infinite else MISSING
        is_live = step.formula and not _is_refused(step, check)
        own = [end for end in _ENDS if _has_end(step, end, cells)]
        for end in own:
            place, number = (line, _PLACES[_ENDS[end]]), step.ends[end + 1]
            shown = none if number is None else number
            if is_live:
                formula = _write_formula(step, end, cells, none)
                sheet.write_formula(*place, formula, form, shown)
            else:
                sheet.write(*place, shown, form)
        letters = {end: chr(ord("A") + _PLACES[_ENDS[end]]) for end in own}
        cells |= {(step.symbol, end): f"{letters[end]}{line + 1}" for end in own}
    return cells


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
