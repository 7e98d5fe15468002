"""Figures of a row's checks, to five digits: what a reader redoes them from.

Headings are symbols of the calculation, with ⁻ and ⁺ for the ends of a band; the page's
table of formulas says what they mean.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from netdesign.calculation.steps import evaluate
from netdesign.report.blocks.table import (
    Cell,
    Column,
    Table,
    lay_out,
    short_cell,
    symbol_columns,
    text_cell,
    text_column,
)
from netdesign.report.view.steps import write_numbers
from netdesign.report.words import (
    MISSING,
    Words,
    add_unit,
    append_unit,
    show_check,
    show_member,
    show_position,
    show_unit,
)
from netdesign.study.records import CheckRecord, RowStudy
from netdesign.words.names import name, name_mode

_WIDTHS = ("b", "f_R", "Δl", "b_e")
_ACTIONS = (
    *("E_s⁻", "E_s", "E_s⁺", "g", "A⁻", "A", "A⁺", "k_q"),
    *("E_c", "E_c⁺", "E_g0", "E_g", "t", "E_k"),
)
_BY_PANEL = (
    *("E_p0⁻", "E_p0", "T_r⁻", "T_r", "T_r⁺", "H", "γ", "Z⁻", "Z", "Z⁺"),
    *("E_p", "E_p⁺", "E_k"),
)
_DEMAND = ("γ_E", "E_d⁻", "E_d", "E_d⁺", "R_k")
_RESISTANCE = ("γ_R", "R_d", "μ⁻", "μ", "μ⁺")
_TESTS = ("R_m", "ξ_m", "R_min", "ξ_min", "R_k")
# Across the base of a post that slides: V_s to V_g in the columns of E_s to E_g.
_ACROSS = ("E_s", "E_c", "E_p0", "E_p", "E_g0", "E_g")

_Column = tuple[Column, Callable[[CheckRecord], Cell]]


def build_widths(row: RowStudy, words: Words) -> Table:
    """Loaded width of the supports at the row's end, with what it follows from."""
    at_end = [one for one in row.checks if "b_e" in one.known][:1]
    return lay_out(
        words("caption.widths"),
        (_support_column(words), *_list_columns(_WIDTHS, at_end, words)),
        at_end,
        empty=words("heading.no_end_support"),
    )


def build_actions(row: RowStudy, words: Words) -> Table:
    """Way from the solved force to the characteristic action, for each member."""
    checks = [one for one in _choose_acting(row) if _read(one, "E_s") is not None]
    return lay_out(
        words("caption.actions"),
        _list_acting(_ACTIONS, checks, words),
        checks,
        empty=words("heading.no_case_converged"),
    )


def build_panel_actions(row: RowStudy, words: Words) -> Table:
    """Way from the forces by the panel between posts to those on the support."""
    checks = [
        one
        for one in _choose_acting(row)
        if _read(one, "E_p0") is not None or "T_r" in one.known
    ]
    return lay_out(
        words("caption.panel_actions"),
        _list_acting(_BY_PANEL, checks, words),
        checks,
        empty=words("heading.no_panel"),
    )


def _list_acting(
    symbols: Sequence[str], checks: Sequence[CheckRecord], words: Words
) -> tuple[_Column, ...]:
    """Columns of forces: member and support, then the symbols."""
    return (
        _text_column(words, "member", lambda one: _name_acted(one, words)),
        _support_column(words),
        *_list_columns(symbols, checks, words),
    )


def build_check_figures(row: RowStudy, words: Words) -> Table:
    """Design values, factors and utilisation of each check of forces."""
    checks = [one for one in row.checks if one.is_of_force]
    numbers = {_name_given(one): str(k) for k, one in _number_resistances(row)}
    return lay_out(
        words("caption.check_figures"),
        (
            _text_column(words, "check", lambda one: show_check(words, one)),
            *_list_columns(_DEMAND, checks, words),
            _text_column(
                words, "no", lambda one: numbers.get(_name_given(one), MISSING)
            ),
            *_list_columns(_RESISTANCE, checks, words),
            _text_column(words, "verdict", lambda one: words(f"verdict.{one.verdict}")),
        ),
        checks,
        empty=words("heading.no_case_converged"),
    )


def build_resistances(row: RowStudy, words: Words) -> Table:
    """Characteristic resistances, each with the formula that gave it, or its cell."""
    numbers, checks = _split(_number_resistances(row))
    return lay_out(
        words("caption.resistances"),
        (
            _number_column(numbers, words),
            _text_column(words, "mode", lambda one: words.show(name_mode(one.mode))),
            _text_column(words, "type", lambda one: one.resistance_type),
            _text_column(
                words,
                "basis_of",
                lambda one: words.show(name("basis", one.resistance_basis)),
            ),
            _text_column(words, "cell", lambda one: one.resistance_cell),
            (
                text_column("R_k ="),
                lambda one: text_cell(_tell_resistance(one, words)),
            ),
            *_list_columns(("R_k",), checks, words),
        ),
        checks,
        empty=words("heading.no_resistance"),
    )


def build_tests(row: RowStudy, words: Words) -> Table:
    """Resistances from tests with their correlation factors."""
    tested = [pair for pair in _number_resistances(row) if "R_m" in pair[1].known]
    numbers, checks = _split(tested)
    return lay_out(
        words("caption.tests"),
        (
            _number_column(numbers, words),
            _text_column(words, "type", lambda one: one.resistance_type),
            *_list_columns(_TESTS, checks, words),
        ),
        checks,
        empty=words("heading.no_tests"),
    )


def _text_column(words: Words, key: str, read: Callable[[CheckRecord], str]) -> _Column:
    return text_column(words(f"heading.{key}")), lambda one: text_cell(read(one))


def _support_column(words: Words) -> _Column:
    return _text_column(
        words, "support", lambda one: show_position(words, one.position)
    )


def _list_columns(
    symbols: Iterable[str], checks: Sequence[CheckRecord], words: Words
) -> tuple[_Column, ...]:
    """Columns of the symbols that some check has, with or without an end of a band."""
    columns = []
    for symbol in symbols:
        steps = [one.known.get(_find_symbol(one, symbol)) for one in checks]
        units = [show_unit(step.unit) for step in steps if step]
        if units:
            columns.append(_symbol_column(symbol, units[0], words))
    return tuple(columns)


def _symbol_column(symbol: str, unit: str, words: Words) -> _Column:
    heading = symbol if unit == MISSING else add_unit(symbol, unit)
    (column,) = symbol_columns([("", heading)])
    return column, lambda one: short_cell(words, _read(one, symbol))


def _read(check: CheckRecord, heading: str) -> float | None:
    """Value of a symbol, or an end of its band; None where a check is without it."""
    symbol = _find_symbol(check, heading)
    is_ratio = symbol == "μ"  # is known without a bound, too
    if heading.endswith(("⁻", "⁺")):
        low, high = check.used_band if is_ratio else check.read_band(symbol)
        return low if heading.endswith("⁻") else high
    return check.used if is_ratio else check.read(symbol)


def _find_symbol(check: CheckRecord, heading: str) -> str:
    """Symbol in a check of what a heading names."""
    symbol = heading.rstrip("⁻⁺")
    if symbol == "E_c":  # is E_k where the section alone gives it
        return check.name_force("c")
    is_across = symbol in _ACROSS and "V_k" in check.known
    return f"V{symbol[1:]}" if is_across else symbol


def _choose_acting(row: RowStudy) -> list[CheckRecord]:
    """One check for each member and support; a base slides by a force of its own."""
    found: dict[tuple[str, str, bool], CheckRecord] = {}
    for check in row.checks:
        if check.is_of_force:
            key = check.position, check.member, check.mode == "sliding"
            found.setdefault(key, check)
    return list(found.values())


def _name_acted(check: CheckRecord, words: Words) -> str:
    """Member that a force acts on; a base that slides says so."""
    member = show_member(words, check.member)
    if check.mode != "sliding":
        return member
    mode = words.show(name_mode("sliding"))
    return words("check.title", member=member, mode=mode)


_Given = tuple[str, str, str, str, float | None]


def _name_given(check: CheckRecord) -> _Given:
    """Things by which one resistance differs from another."""
    told = check.resistance_derivation
    return (
        check.mode,
        check.resistance_type,
        check.resistance_cell,
        str(told) if told else "",
        check.read("R_k"),
    )


def _number_resistances(row: RowStudy) -> list[tuple[int, CheckRecord]]:
    """Resistances of a row, each once, by the first check that uses it."""
    found: dict[_Given, CheckRecord] = {}
    for check in row.checks:
        if check.read("R_k") is not None:
            found.setdefault(_name_given(check), check)
    return list(enumerate(found.values(), 1))


def _split(
    numbered: Sequence[tuple[int, CheckRecord]],
) -> tuple[dict[str, str], list[CheckRecord]]:
    """Numbers by the ids of checks, and these checks."""
    return {one.id: str(k) for k, one in numbered}, [one for _, one in numbered]


def _number_column(numbers: dict[str, str], words: Words) -> _Column:
    return _text_column(words, "no", lambda one: numbers[one.id])


def _tell_resistance(check: CheckRecord, words: Words) -> str:
    """Formula of a resistance with its numbers; of one that is given, that it is."""
    if check.resistance_derivation:
        return words.show(check.resistance_derivation)
    if not check.known["R_k"].formula:
        return words("show.as_given")
    found = evaluate(check.steps)["R_k"]
    return write_numbers(
        found, lambda one: append_unit(words.show_digits(one.value), one.unit), words
    )
