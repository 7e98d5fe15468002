"""Figures of a row's checks, to five digits: what a reader redoes them from.

Headings are symbols; the page's table of formulas says what they mean.
"""

from __future__ import annotations

from netdesign.report.blocks.table import (
    Cell,
    Table,
    name_columns,
    short_cell,
    symbol_columns,
    text_cell,
    text_column,
)
from netdesign.report.words import (
    MISSING,
    Words,
    show_check,
    show_member,
    show_position,
)
from netdesign.structure.members import CARRYING_MEMBERS
from netdesign.study.records import ActionRecord, CheckRecord, RowStudy
from netdesign.words.names import name, name_mode

_WIDTHS = (
    ("post_spacing_m", "b [m]"),
    ("end_factor", "f_R"),
    ("end_length_m", "Δl [m]"),
    ("loaded_width_m", "b_e [m]"),
    ("other_width_m", "b_e' [m]"),
)
_ACTIONS = (
    ("solved_low_kN", "E_s⁻ [kN]"),
    ("solved_kN", "E_s [kN]"),
    ("solved_high_kN", "E_s⁺ [kN]"),
    ("share", "g"),
    ("added_low_kN", "A⁻ [kN]"),
    ("added_kN", "A [kN]"),
    ("added_high_kN", "A⁺ [kN]"),
    ("lateral_factor", "k_q"),
)
_CHECKS = (
    ("action_factor", "γ_E"),
    ("demand_low_kN", "E_d⁻ [kN]"),
    ("demand_kN", "E_d [kN]"),
    ("demand_high_kN", "E_d⁺ [kN]"),
    ("resistance_characteristic_kN", "R_k [kN]"),
    ("resistance_factor", "γ_R"),
    ("resistance_kN", "R_d [kN]"),
)
_TESTS = (
    ("count", "n"),
    ("mean", "R_m [kN]"),
    ("on_mean", "ξ_m"),
    ("least", "R_min [kN]"),
    ("on_least", "ξ_min"),
)
_FROM_TESTS = "check.from_tests"


def build_widths(row: RowStudy, words: Words) -> Table:
    """Loaded width of each support, with what it follows from."""
    found: dict[str, ActionRecord] = {}
    for check in row.checks:
        if check.action is not None:
            support = show_position(words, check.action.position)
            is_own = check.member not in CARRYING_MEMBERS  # by a rope, with its factor
            named = show_member(words, check.member) if is_own else support
            found.setdefault(named, check.action)
    return Table(
        caption=words("caption.widths"),
        columns=(text_column(words("heading.support")), *symbol_columns(_WIDTHS)),
        rows=tuple(
            (
                text_cell(named),
                *(short_cell(words, getattr(action, key)) for key, _ in _WIDTHS),
            )
            for named, action in found.items()
        ),
        empty=words("heading.no_case_converged"),
    )


def build_actions(row: RowStudy, words: Words) -> Table:
    """Way from the solved force to the characteristic action, for each member."""
    further = ("E_c [kN]", "E_c⁺ [kN]", "E_g0 [kN]", "E_g [kN]", "E_k [kN]")
    return Table(
        caption=words("caption.actions"),
        columns=(
            text_column(words("heading.member")),
            text_column(words("heading.support")),
            *symbol_columns(_ACTIONS),
            *name_columns(further, numbers=further),
        ),
        rows=tuple(
            _list_action(check, action, words) for check, action in _list_actions(row)
        ),
        empty=words("heading.no_case_converged"),
    )


_BY_PANEL = (
    ("panel_low_kN", "E_p⁻ [kN]"),
    ("panel_kN", "E_p [kN]"),
    ("along_low_kN", "Z⁻ [kN]"),
    ("along_kN", "Z [kN]"),
    ("along_high_kN", "Z⁺ [kN]"),
)


def build_panel_actions(row: RowStudy, words: Words) -> Table:
    """Way from the force by the panel between posts to that on the support."""
    further = ("E_q [kN]", "E_q⁺ [kN]")
    return Table(
        caption=words("caption.panel_actions"),
        columns=(
            text_column(words("heading.member")),
            text_column(words("heading.support")),
            *symbol_columns(_BY_PANEL),
            *name_columns(further, numbers=further),
        ),
        rows=tuple(
            (
                text_cell(_name_acted(check, words)),
                text_cell(show_position(words, action.position)),
                *(short_cell(words, getattr(action, key)) for key, _ in _BY_PANEL),
                short_cell(words, action.panel_force),
                short_cell(words, action.panel_support_kN),
            )
            for check, action in _list_actions(row)
            if action.panel_kN is not None
        ),
        empty=words("heading.no_panel"),
    )


def _list_actions(row: RowStudy) -> list[tuple[CheckRecord, ActionRecord]]:
    """One check for each member and support; a base slides by a force of its own."""
    found: dict[tuple[str, str, bool], tuple[CheckRecord, ActionRecord]] = {}
    for check in row.checks:
        if check.action is not None:
            key = (check.action.position, check.member, check.mode == "sliding")
            found.setdefault(key, (check, check.action))
    return list(found.values())


def _list_action(
    check: CheckRecord, action: ActionRecord, words: Words
) -> tuple[Cell, ...]:
    return (
        text_cell(_name_acted(check, words)),
        text_cell(show_position(words, action.position)),
        *(short_cell(words, getattr(action, key)) for key, _ in _ACTIONS),
        short_cell(words, action.section_force),
        short_cell(words, action.coupled_kN),
        short_cell(words, action.floor_kN),
        short_cell(words, action.guideline_kN),
        short_cell(words, check.action_kN),
    )


def _name_acted(check: CheckRecord, words: Words) -> str:
    """Member that a force acts on; a base that slides says so."""
    member = show_member(words, check.member)
    if check.mode != "sliding":
        return member
    mode = words.show(name_mode("sliding"))
    return words("check.title", member=member, mode=mode)


def build_check_figures(row: RowStudy, words: Words) -> Table:
    """Design values, factors and utilisation of each check of forces."""
    ratios = ("μ⁻", "μ", "μ⁺")
    numbers = {key: number for number, (key, *_) in enumerate(_list_given(row), 1)}
    return Table(
        caption=words("caption.check_figures"),
        columns=(
            text_column(words("heading.check")),
            *symbol_columns(_CHECKS[:5]),
            text_column(words("heading.no")),
            *symbol_columns(_CHECKS[5:]),
            *name_columns(ratios, numbers=ratios),
            text_column(words("heading.verdict")),
        ),
        rows=tuple(
            (
                text_cell(show_check(words, check)),
                *(short_cell(words, getattr(check, key)) for key, _ in _CHECKS[:5]),
                text_cell(f"{numbers.get(_name_given(check), MISSING)}"),
                *(short_cell(words, getattr(check, key)) for key, _ in _CHECKS[5:]),
                *(short_cell(words, one) for one in _list_ratios(check)),
                text_cell(words(f"verdict.{check.verdict}")),
            )
            for check in row.checks
            if check.action is not None
        ),
        empty=words("heading.no_case_converged"),
    )


def _list_ratios(check: CheckRecord) -> tuple[float | None, ...]:
    low, high = check.used_band
    return low, check.used, high


_Given = tuple[str, str, str, str, float | None]


def _name_given(check: CheckRecord) -> _Given:
    """Things by which one resistance differs from another."""
    told = check.resistance_derivation
    return (
        check.mode,
        check.resistance_type,
        check.resistance_cell,
        str(told) if told else "",
        check.resistance_characteristic_kN,
    )


def _list_given(row: RowStudy) -> list[tuple[_Given, CheckRecord]]:
    """Resistances of a row, each once, with the first check that uses it."""
    found: dict[_Given, CheckRecord] = {}
    for check in row.checks:
        if check.resistance_characteristic_kN is not None:
            found.setdefault(_name_given(check), check)
    return list(found.items())


def build_resistances(row: RowStudy, words: Words) -> Table:
    """Characteristic resistances, each with the formula that gave it, or its cell."""
    keys = ("no", "mode", "type", "basis_of", "cell")
    return Table(
        caption=words("caption.resistances"),
        columns=(
            *(text_column(words(f"heading.{key}")) for key in keys),
            text_column("R_k ="),
            *symbol_columns((("resistance_characteristic_kN", "R_k [kN]"),)),
        ),
        rows=tuple(
            (
                text_cell(str(number)),
                text_cell(words.show(name_mode(check.mode))),
                text_cell(check.resistance_type),
                text_cell(words.show(name("basis", check.resistance_basis))),
                text_cell(check.resistance_cell),
                text_cell(_tell_derivation(check, words)),
                short_cell(words, check.resistance_characteristic_kN),
            )
            for number, (_, check) in enumerate(_list_given(row), 1)
        ),
        empty=words("heading.no_resistance"),
    )


def _tell_derivation(check: CheckRecord, words: Words) -> str:
    told = check.resistance_derivation
    return words.show(told) if told else words("show.as_given")


def build_tests(row: RowStudy, words: Words) -> Table:
    """Pull-out tests with their correlation factors."""
    tested = [
        (number, check, check.resistance_derivation.arguments)
        for number, (_, check) in enumerate(_list_given(row), 1)
        if check.resistance_derivation
        and check.resistance_derivation.key == _FROM_TESTS
    ]
    return Table(
        caption=words("caption.tests"),
        columns=(
            text_column(words("heading.no")),
            text_column(words("heading.type")),
            *symbol_columns(_TESTS),
            *symbol_columns((("", "R_k [kN]"),)),
        ),
        rows=tuple(
            (
                text_cell(str(number)),
                text_cell(check.resistance_type),
                *(short_cell(words, _read_number(told.get(key))) for key, _ in _TESTS),
                short_cell(words, check.resistance_characteristic_kN),
            )
            for number, check, told in tested
        ),
        empty=words("heading.no_tests"),
    )


def _read_number(value: object) -> float | None:
    return float(value) if isinstance(value, int | float) else None
