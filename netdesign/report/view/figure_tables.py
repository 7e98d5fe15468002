"""All figures of a row's checks, to five or six digits: what a reader redoes them from.

Headings are symbols; the page's table of formulas says what they mean.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from netdesign.report.view.table import (
    Cell,
    Column,
    Table,
    given_cell,
    name_columns,
    text_cell,
    text_column,
)
from netdesign.report.words import (
    MISSING,
    Words,
    name_case_short,
    show_check,
    show_digits,
    show_member,
    show_text,
)
from netdesign.structure.members import CARRYING_MEMBERS
from netdesign.study.records import ActionRecord, CheckRecord, RowStudy
from netdesign.study.support_records import PullRecord, StaticsRecord
from netdesign.words.catalogue import load_texts
from netdesign.words.names import name, name_mode

_PULLS = (
    ("foot_x_kN_per_m", "f_x [kN/m]"),
    ("foot_y_kN_per_m", "f_y [kN/m]"),
    ("head_x_kN_per_m", "h_x [kN/m]"),
    ("head_y_kN_per_m", "h_y [kN/m]"),
)
_ERRORS = (
    ("foot_error_kN_per_m", "± f [kN/m]"),
    ("head_error_kN_per_m", "± h [kN/m]"),
)
_POINTS = (
    ("head_x_m", "x_H [m]"),
    ("head_y_m", "y_H [m]"),
    ("base_x_m", "x_B [m]"),
    ("uphill_x_m", "x_U [m]"),
    ("downhill_x_m", "x_D [m]"),
)
_FORCES = (
    ("foot_anchor_kN", "|F_foot| [kN]"),
    ("uphill_guy_kN", "T_u [kN]"),
    ("downhill_guy_kN", "T_d [kN]"),
    ("post_kN", "C [kN]"),
    ("post_base_kN", "V [kN]"),
)
_LOAD = (
    ("inclination_deg", "θ [°]"),
    ("height_vertical_m", "H [m]"),
    ("density_kg_m3", "ρ [kg/m³]"),
    ("creep_factor", "K"),
    ("glide_factor", "N"),
    ("rigid_kN_per_m", "S'_N [kN/m]"),
    ("parallel_kN_per_m", "f_s S'_N [kN/m]"),
    ("normal_kN_per_m", "S'_Q [kN/m]"),
    ("prism_kN_per_m", "G' [kN/m]"),
    ("load_along_kN_per_m", "R_x [kN/m]"),
    ("load_across_kN_per_m", "R_y [kN/m]"),
    ("loaded_share", "λ"),
    ("slack", "s"),
    ("stiffness_kN_per_m", "ES [kN/m]"),
    ("chord_tension_kN_per_m", "T [kN/m]"),
)
_SIDEWAYS = (
    ("share", "k"),
    ("splay_deg", "β [°]"),
    ("pull_low_kN", "P⁻ [kN]"),
    ("pull_kN", "P [kN]"),
    ("pull_high_kN", "P⁺ [kN]"),
    ("solved_tension_kN", "T_s [kN]"),
    ("hidden_tension_kN", "ΔT [kN]"),
    ("floor_tension_kN", "T_g [kN]"),
    ("least_tension_kN", "T_min [kN]"),
    ("uphill_part", "c_u"),
    ("uphill_at_deg", "θ(c_u) [°]"),
    ("downhill_part", "c_d"),
    ("downhill_at_deg", "θ(c_d) [°]"),
    ("post_part", "w"),
    ("post_at_deg", "θ(w) [°]"),
)
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
_PULL_RANGE = (
    ("least_deg", "α_min [°]"),
    ("largest_deg", "α_max [°]"),
    ("axis_deg", "α_0 [°]"),
)
_TESTS = (
    ("count", "n"),
    ("mean", "R_mean [kN]"),
    ("on_mean", "ξ_mean"),
    ("least", "R_min [kN]"),
    ("on_least", "ξ_min"),
)
_FROM_TESTS = "check.from_tests"


def build_statics(row: RowStudy, words: Words) -> Table:
    """Pulls, points and members' forces of the cases that govern."""
    return _list_states(
        "caption.statics",
        [one for one in row.statics if one.load is None],
        (*_PULLS, *_ERRORS, *_POINTS, *_FORCES, ("mid_foot_kN", "F_mid [kN]")),
        words,
    )


def build_floor_statics(row: RowStudy, words: Words) -> Table:
    """The same of the guideline's load, with what that follows from."""
    return _list_states(
        "caption.floor_statics",
        [one for one in row.statics if one.load is not None],
        (*_LOAD, *_PULLS, *_POINTS, *_FORCES),
        words,
    )


def _list_states(
    caption: str,
    states: Sequence[StaticsRecord],
    fields: Sequence[tuple[str, str]],
    words: Words,
) -> Table:
    return Table(
        caption=words(caption),
        columns=(
            text_column(words("heading.brings")),
            text_column(words("heading.case")),
            *_name_numbers(fields),
        ),
        rows=tuple(
            (
                text_cell(
                    words.join(_name_brought(key, words) for key in state.brings)
                ),
                text_cell(_name_state(state, words)),
                *(_number(_read_state(state, key)) for key, _ in fields),
            )
            for state in states
        ),
        empty=words("heading.no_state"),
    )


def _name_brought(key: str, words: Words) -> str:
    is_span = key in ("head_pull", "least_tension", "foot_least", "foot_largest")
    return words(f"brings.{key}") if is_span else show_member(words, key)


def _name_state(state: StaticsRecord, words: Words) -> str:
    if state.load is None:
        return name_case_short(state.case)
    return words.show(name("load_case", state.load.load_case))


def _read_state(state: StaticsRecord, key: str) -> float | None:
    owner = state if hasattr(state, key) else state.load
    value: float | None = getattr(owner, key)
    return value


def build_sideways(row: RowStudy, words: Words) -> Table:
    """Numbers that the load along the row follows from."""
    held = row.held_sideways
    cells = [_number(getattr(held, key)) for key, _ in _SIDEWAYS] if held else []
    return Table(
        caption=words("caption.held_sideways"),
        columns=_name_numbers(_SIDEWAYS),
        rows=(tuple(cells),) if cells else (),
        empty=words("heading.not_held_sideways"),
    )


def _name_position(position: str, words: Words) -> str:
    key = f"position.{position}"
    return words(key) if key in load_texts(words.language) else show_text(position)


def build_widths(row: RowStudy, words: Words) -> Table:
    """Loaded width of each support, with what it follows from."""
    found: dict[str, ActionRecord] = {}
    for check in row.checks:
        if check.action is not None:
            support = _name_position(check.action.position, words)
            is_own = check.member not in CARRYING_MEMBERS  # by a rope, with its factor
            named = show_member(words, check.member) if is_own else support
            found.setdefault(named, check.action)
    return Table(
        caption=words("caption.widths"),
        columns=(text_column(words("heading.support")), *_name_numbers(_WIDTHS)),
        rows=tuple(
            (
                text_cell(named),
                *(_number(getattr(action, key)) for key, _ in _WIDTHS),
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
            *_name_numbers(_ACTIONS),
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
            *_name_numbers(_BY_PANEL),
            *name_columns(further, numbers=further),
        ),
        rows=tuple(
            (
                text_cell(_name_acted(check, words)),
                text_cell(_name_position(action.position, words)),
                *(_short(getattr(action, key)) for key, _ in _BY_PANEL),
                _short(compute_by_panel(action)),
                _short(action.panel_support_kN),
            )
            for check, action in _list_actions(row)
            if action.panel_kN is not None
        ),
        empty=words("heading.no_panel"),
    )


def compute_by_panel(action: ActionRecord) -> float | None:
    """Force on the support by the panel between posts [kN]; None without one."""
    if action.panel_kN is None:
        return None
    on_row = action.loaded_width_m / action.post_spacing_m * action.lateral_factor
    return (action.share * action.panel_kN + action.added_kN) * on_row + action.along_kN


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
        text_cell(_name_position(action.position, words)),
        *(_short(getattr(action, key)) for key, _ in _ACTIONS),
        _short(compute_coupled(action)),
        _short(action.coupled_kN),
        _short(action.floor_kN),
        _short(action.guideline_kN),
        _short(check.action_kN),
    )


def _name_acted(check: CheckRecord, words: Words) -> str:
    """Member that a force acts on; a base that slides says so."""
    member = show_member(words, check.member)
    if check.mode != "sliding":
        return member
    mode = words.show(name_mode("sliding"))
    return words("check.title", member=member, mode=mode)


def compute_coupled(action: ActionRecord) -> float:
    """Coupled force on the support, (V1) of checks/THEORY.md [kN]."""
    on_row = action.loaded_width_m / action.post_spacing_m * action.lateral_factor
    return (action.share * action.solved_kN + action.added_kN) * on_row


def build_check_figures(row: RowStudy, words: Words) -> Table:
    """Design values, factors and utilisation of each check of forces."""
    ratios = ("μ⁻", "μ", "μ⁺")
    numbers = {key: number for number, (key, *_) in enumerate(_list_given(row), 1)}
    return Table(
        caption=words("caption.check_figures"),
        columns=(
            text_column(words("heading.check")),
            *_name_numbers(_CHECKS[:5]),
            text_column(words("heading.no")),
            *_name_numbers(_CHECKS[5:]),
            *name_columns(ratios, numbers=ratios),
            text_column(words("heading.verdict")),
        ),
        rows=tuple(
            (
                text_cell(show_check(words, check)),
                *(_short(getattr(check, key)) for key, _ in _CHECKS[:5]),
                text_cell(f"{numbers.get(_name_given(check), MISSING)}"),
                *(_short(getattr(check, key)) for key, _ in _CHECKS[5:]),
                *(_short(one) for one in _list_ratios(check)),
                text_cell(words(f"verdict.{check.verdict}")),
            )
            for check in row.checks
            if check.action is not None
        ),
        empty=words("heading.no_case_converged"),
    )


def _list_ratios(check: CheckRecord) -> tuple[float | None, ...]:
    low, high = check.utilisation_band
    return low, check.utilisation, high


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
            *_name_numbers((("resistance_characteristic_kN", "R_k [kN]"),)),
        ),
        rows=tuple(
            (
                text_cell(str(number)),
                text_cell(words.show(name_mode(check.mode))),
                text_cell(check.resistance_type),
                text_cell(words.show(name("basis", check.resistance_basis))),
                text_cell(check.resistance_cell),
                text_cell(_tell_derivation(check, words)),
                _number(check.resistance_characteristic_kN),
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
            *_name_numbers(_TESTS),
            *_name_numbers((("", "R_k [kN]"),)),
        ),
        rows=tuple(
            (
                text_cell(str(number)),
                text_cell(check.resistance_type),
                *(_number(_read_number(told.get(key))) for key, _ in _TESTS),
                _number(check.resistance_characteristic_kN),
            )
            for number, check, told in tested
        ),
        empty=words("heading.no_tests"),
    )


def _read_number(value: object) -> float | None:
    return float(value) if isinstance(value, int | float) else None


def build_turns(row: RowStudy, words: Words) -> Table:
    """Directions of the pulls and their angles to the axes, to six digits."""
    further = ("δ [°]", "δ' [°]")
    return Table(
        caption=words("caption.turns"),
        columns=(
            text_column(words("heading.anchor")),
            text_column(words("heading.support")),
            *_name_numbers(_PULL_RANGE),
            *name_columns(further, numbers=further),
        ),
        rows=tuple(
            (
                text_cell(show_member(words, pull.anchor)),
                text_cell(_name_position(pull.position, words)),
                *(_number(getattr(pull, key)) for key, _ in _PULL_RANGE),
                _number(_measure_turn(pull)),
                _number(pull.angle_deg),
            )
            for pull in row.pulls
        ),
        empty=words("heading.no_case_converged"),
    )


def _measure_turn(pull: PullRecord) -> float:
    """Largest angle between pull and axis in the section [deg]."""
    turns = (pull.least_deg - pull.axis_deg, pull.largest_deg - pull.axis_deg)
    return round(max(map(math.fabs, turns)), 9)  # the middle of equal ends is rounded


def _name_numbers(fields: Iterable[tuple[str, str]]) -> tuple[Column, ...]:
    headings = [heading for _, heading in fields]
    return name_columns(headings, numbers=headings)


def _number(value: float | None) -> Cell:
    """Number to six digits; "-" for none."""
    return text_cell(MISSING) if value is None else given_cell(value)


def _short(value: float | None) -> Cell:
    """Number to five digits, in tables of many columns."""
    return Cell(text=show_digits(value), number=value)


# Names of the formulas, each with its symbols; what it gives is in the words.
FORMULAS = (
    ("pulls", "F_foot = b · (f_x; f_y), P = b · (h_x; h_y)"),
    ("head", "C = (P × g) / (p × g), T = (P × p) / (p × g); a × c = a_x c_y − a_y c_x"),
    ("base", "V = −C p_y"),
    ("shared", "E_s = |F_foot| + T_u"),
    (
        "guys",
        "g = 1 / (2 cos β), A = c k P / sin β; c_u = max(1/2; κ), "
        "c_d = max(1/2; 1 − κ), κ = |d × p| / (|u × p| + |d × p|)",
    ),
    (
        "post",
        "A = w · max(k P / tan β − T_min; 0), w = κ u·p + (1 − κ) d·p, "
        "T_min = min(max(T_s − ΔT; 0); T_g)",
    ),
    ("sliding", "g = max |x_H − x_B| / y_H, A = g · A(V)"),
    ("lateral", "k_q = √(1 + k²)"),
    (
        "width",
        "b_e = b / 2 + f_R Δl, f_R = min((e_0 + e_1 N) a / 2; c_0 + c_1 N), "
        "Δl = min(l a / 2; s_l D_K)",
    ),
    ("coupled", "E_c = (g E_s + A) k_q b_e / b"),
    ("guideline", "E_g = (g E_g0 + A) k_q b_e / b"),
    ("panel", "E_q = (g E_p + A) k_q b_e / b + Z"),
    ("action", "E_k = max(E_c; E_q; E_g)"),
    ("design", "E_d = γ_E E_k, R_d = R_k / γ_R, μ = E_d / R_d"),
    ("pressure", "S'_N = ρ g H² K N / 2, K = (k_0 + k_1 ρ + k_2 ρ² + k_3 ρ³) sin 2ψ"),
    (
        "load_cases",
        "ρ_1 = ρ_0 (1 + r max(min(Z; Z_1) − Z_0; 0)), H_1 = d / cos ψ; H_2 = h_2 H_1",
    ),
    (
        "resultant",
        "S'_Q = f_s S'_N a_Q / (N tan ψ), G' = ρ g min(D_K; H cos ψ)² tan θ / 2, "
        "R = (f_s S'_N + G' sin ψ; −S'_Q − G' cos ψ)",
    ),
    (
        "chord",
        "λ = min(1; H cos ψ / D_K), Q = R_x cos θ − R_y sin θ, v_1 = 1 − λ/2, "
        "v_2 = λ/2; (Q² / (2 T²)) (λ (v_1² − v_1 v_2 + v_2²) / 3 + (1 − λ) v_2²) "
        "= s + (1 + s) T / ES",
    ),
    ("net", "f = v_1 R + T e, h = v_2 R − T e, e = (sin θ; cos θ)"),
    (
        "direction",
        "α_s = atan2(F_y; ±F_x), α = asin(cos β sin α_s), "
        "δ = max(|α_min − α_0|; |α_max − α_0|), cos δ' = cos δ / √(1 + k²)",
    ),
    (
        "bar",
        "N_Rk = π (D² − d²) f / 4, M_Rk = π (D⁴ − d⁴) f / (32 D), "
        "V_Rk = A_v f / √3, A_v = 3 A / 4 | 2 A / π",
    ),
    (
        "bending",
        "R_k = 1 / a, a = cos δ / N_Rk + e sin δ / M_Rk; c = 2 sin δ / V_Rk > a ⇒ "
        "R_k = (2 c − a) / c²",
    ),
    (
        "buckling",
        "Φ = (1 + α (λ − 0.2) + λ²) / 2, χ = min(1; 1 / (Φ + √(Φ² − λ²))), "
        "R_k = χ A f_y",
    ),
    ("height", "D_K ≥ max(1; r_h) d"),
    ("spacing", "L ≤ f_L D_K / cos ψ, f_L = 2 tan ψ / (tan ψ − tan φ)"),
)


_HOLDING = (
    *("statics", "floor_statics", "held_sideways", "actions", "panel_actions"),
    *("check_figures", "turns"),
)


def build_holding(words: Words) -> Table:
    """Contents of the tables of a row, once for all rows."""
    return Table(
        caption=words("caption.figure_tables"),
        columns=tuple(
            text_column(words(f"heading.{key}")) for key in ("table", "table_holds")
        ),
        rows=tuple(
            (text_cell(words(f"caption.{key}")), text_cell(words(f"holding.{key}")))
            for key in _HOLDING
        ),
    )


def build_formulas(words: Words) -> Table:
    """Formulas of all figures, once for all rows."""
    keys = ("gives", "formula")
    return Table(
        caption=words("caption.formulas"),
        columns=tuple(text_column(words(f"heading.{key}")) for key in keys),
        rows=tuple(
            (text_cell(words(f"formula.{key}")), text_cell(show_text(formula)))
            for key, formula in FORMULAS
        ),
    )
