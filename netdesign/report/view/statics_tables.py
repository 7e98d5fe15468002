"""Figures of the statics: pulls and points that forces follow from, to five digits.

Headings are symbols; the page's table of formulas says what they mean.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from netdesign.report.blocks.table import (
    Table,
    name_columns,
    short_cell,
    symbol_columns,
    text_cell,
    text_column,
)
from netdesign.report.words import MISSING, Words, show_member, show_position
from netdesign.study.records import RowStudy
from netdesign.study.support_records import PullRecord, StaticsRecord
from netdesign.words.names import name

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
    ("foot_anchor_kN", "|F_f| [kN]"),
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
_PULL_RANGE = (
    ("least_deg", "α_min [°]"),
    ("largest_deg", "α_max [°]"),
    ("axis_deg", "α_0 [°]"),
)


def build_statics(row: RowStudy, words: Words) -> Table:
    """Pulls, points and members' forces of the cases that govern."""
    return _list_states(
        "caption.statics",
        [one for one in row.statics if one.load is None],
        (*_PULLS, *_ERRORS, *_POINTS, *_FORCES, ("mid_foot_kN", "F_m [kN]")),
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
            *symbol_columns(fields),
        ),
        rows=tuple(
            (
                text_cell(
                    words.join(_name_brought(key, words) for key in state.brings)
                ),
                text_cell(_name_state(state, words)),
                *(short_cell(words, _read_state(state, key)) for key, _ in fields),
            )
            for state in states
        ),
        empty=words("heading.no_state"),
    )


def _name_brought(key: str, words: Words) -> str:
    is_span = key in ("head_pull", "least_tension", "foot_least", "foot_largest")
    return words(f"brings.{key}") if is_span else show_member(words, key)


def _name_state(state: StaticsRecord, words: Words) -> str:
    """Case by its numbers, to as many digits as the figures that follow from it."""
    if state.load is None:
        values = state.case.values.values() if state.case else ()
        return " / ".join(map(words.show_digits, values)) or MISSING
    return words.show(name("load_case", state.load.load_case))


def _read_state(state: StaticsRecord, key: str) -> float | None:
    owner = state if hasattr(state, key) else state.load
    value: float | None = getattr(owner, key)
    return value


def build_sideways(row: RowStudy, words: Words) -> Table:
    """Numbers that the load along the row follows from."""
    held = row.held_sideways
    cells = (
        [short_cell(words, getattr(held, key)) for key, _ in _SIDEWAYS] if held else []
    )
    return Table(
        caption=words("caption.held_sideways"),
        columns=symbol_columns(_SIDEWAYS),
        rows=(tuple(cells),) if cells else (),
        empty=words("heading.not_held_sideways"),
    )


def build_turns(row: RowStudy, words: Words) -> Table:
    """Directions of the pulls and their angles to the axes, to five digits."""
    further = ("δ [°]", "δ' [°]")
    return Table(
        caption=words("caption.turns"),
        columns=(
            text_column(words("heading.anchor")),
            text_column(words("heading.support")),
            *symbol_columns(_PULL_RANGE),
            *name_columns(further, numbers=further),
        ),
        rows=tuple(
            (
                text_cell(show_member(words, pull.anchor)),
                text_cell(show_position(words, pull.position)),
                *(short_cell(words, getattr(pull, key)) for key, _ in _PULL_RANGE),
                short_cell(words, _measure_turn(pull)),
                short_cell(words, pull.angle_deg),
            )
            for pull in row.pulls
        ),
        empty=words("heading.no_case_converged"),
    )


def _measure_turn(pull: PullRecord) -> float:
    """Largest angle between pull and axis in the section [deg]."""
    turns = (pull.least_deg - pull.axis_deg, pull.largest_deg - pull.axis_deg)
    return round(max(map(math.fabs, turns)), 9)  # the middle of equal ends is rounded
