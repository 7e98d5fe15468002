"""One row per reported quantity: the only place for its unit and decimals."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
class Form:
    """Name and form of one quantity in every output.

    Attributes
    ----------
    key : str
        Name of the field in the JSON documents, unit included.
    symbol : str
        As in the theory pages.
    unit : str
        As printed; "" for a pure number.
    decimals : int or None
        Digits after the point. None: as given, for values that somebody chose
        (a density of 366.8 kg/m3 is not rounded away).
    most : int
        Digits after the point at most where ``decimals`` is None: a search goes to
        values that nobody would type.
    scientific : bool
        Written with an exponent.
    """

    key: str
    symbol: str
    unit: str
    decimals: int | None
    most: int = 4
    scientific: bool = False

    @property
    def label(self) -> Message:
        """A few words for a table heading."""
        return say(f"label.{self.key}")


def _row(
    key: str,
    symbol: str,
    unit: str,
    decimals: int | None,
    most: int = 4,
) -> Form:
    return Form(key=key, symbol=symbol, unit=unit, decimals=decimals, most=most)


_ROWS = (
    # the ranges
    _row("density_kg_m3", "ρ", "kg/m³", None, most=1),
    _row("friction_deg", "φ", "°", None, most=1),
    _row("inclination_deg", "θ", "°", None, most=1),
    _row("thickness_m", "d", "m", None, most=2),
    _row("upslope_length_m", "L", "m", None, most=2),
    _row("slack", "s", "", None),
    _row("stiffness_kN_per_m", "ES", "kN/m", None, most=0),
    _row("slip_length_m", "D*", "m", None, most=2),
    _row("glide_factor", "N", "", None),
    # geometry
    _row("slope_deg", "ψ", "°", 1),
    _row("snow_thickness_m", "d", "m", 2),
    _row("sag_m", "f", "m", 3),
    # net, per metre of width
    _row("foot_size_kN_per_m", "T₁", "kN/m", 2),
    _row("head_size_kN_per_m", "T₂", "kN/m", 2),
    _row("tension_max_kN_per_m", "T", "kN/m", 2),
    _row("force_x_kN_per_m", "Fx", "kN/m", 2),
    _row("force_y_kN_per_m", "Fy", "kN/m", 2),
    _row("error_kN_per_m", "", "kN/m", 2),
    # members, per anchor, characteristic
    _row("foot_anchor_kN", "F", "kN", 1),
    _row("uphill_guy_kN", "F", "kN", 1),
    _row("downhill_guy_kN", "F", "kN", 1),
    _row("post_kN", "F", "kN", 1),
    _row("max_kN", "F", "kN", 1),
    # support and its place in the row
    _row("solved_kN", "E_s", "kN", 1),
    _row("post_spacing_m", "b", "m", 2),
    _row("loaded_width_m", "b_e", "m", 2),
    _row("end_factor", "f_R", "", 2),
    _row("end_length_m", "Δl", "m", 2),
    _row("lateral_factor", "k_q", "", 3),
    _row("coupled_kN", "E_c", "kN", 1),
    _row("panel_kN", "E_p0", "kN", 1),
    _row("panel_support_kN", "E_p", "kN", 1),
    _row("along_kN", "H", "kN", 1),
    _row("tension_kN", "T", "kN", 1),
    _row("breaking_kN", "F_min", "kN", 1),
    _row("floor_kN", "E_g0", "kN", 1),
    _row("guideline_kN", "E_g", "kN", 1),
    _row("force_x_kN", "F_x", "kN", 1),
    _row("force_y_kN", "F_y", "kN", 1),
    _row("lateral_kN", "F_z", "kN", 1),
    _row("size_kN", "F", "kN", 1),
    _row("direction_deg", "α", "°", 1),
    _row("least_deg", "α_min", "°", 1),
    _row("largest_deg", "α_max", "°", 1),
    _row("axis_deg", "α_0", "°", 1),
    _row("angle_deg", "δ", "°", 1),
    _row("share", "g", "", 4),
    _row("added_kN", "A", "kN", 2),
    _row("part", "c", "", 3),
    _row("pull_kN", "P", "kN", 1),
    _row("splay_deg", "β", "°", 1),
    _row("least_tension_kN", "T_min", "kN", 1),
    # the guideline
    _row("height_vertical_m", "H", "m", 2),
    _row("creep_factor", "K", "", 3),
    _row("glide_factor", "N", "", 3),
    _row("rigid_kN_per_m", "S'_N", "kN/m", 1),
    _row("load_kN_per_m", "R_x", "kN/m", 1),
    _row("force_kN", "E_g0", "kN", 1),
    _row("load_along_kN_per_m", "R_x", "kN/m", 2),
    _row("load_across_kN_per_m", "R_y", "kN/m", 2),
    _row("chord_tension_kN_per_m", "T", "kN/m", 2),
    _row("load_difference_percent", "", "%", 0),
    _row("foot_difference_percent", "", "%", 0),
    # second opinions
    _row("matched_slip_m", "D*", "m", 2),
    _row("influence_length_m", "l", "m", 2),
    _row("dynamic_kN_per_m", "", "kN/m", 1),
    _row("at_rest_kN_per_m", "", "kN/m", 1),
    _row("wedge_kN_per_m", "G_x", "kN/m", 1),
    _row("exponent", "n", "", None),
    # checks
    _row("action_kN", "E_k", "kN", 1),
    _row("action_factor", "γ_E", "", None),
    _row("demand_kN", "E_d", "kN", 1),
    _row("resistance_characteristic_kN", "R_k", "kN", 1),
    _row("resistance_factor", "γ_R", "", None),
    _row("resistance_kN", "R_d", "kN", 1),
    _row("utilisation", "μ", "", 3),
    # comparison of two numbers
    _row("change_percent", "", "%", 1),
    # quality of a solution
    _row("error_percent", "", "%", 2),
    Form(
        key="balance_residual",
        symbol="",
        unit="",
        decimals=1,
        scientific=True,
    ),
)

QUANTITIES: Mapping[str, Form] = MappingProxyType({row.key: row for row in _ROWS})

# Digits after the point of symbols of a calculation: by their unit, but for some.
_DIGITS_OF_UNIT = {"kN": 1, "m": 2, "deg": 1, "-": 4}
_DIGITS: Mapping[str, int | None] = {
    **dict.fromkeys(("γ_E", "γ_R", "ξ_m", "ξ_min", "μ_b"), None),  # as given
    **{"ξ_5": 3, "f_R": 2, "A": 2, "c": 3, "w": 3, "k_q": 3},
}


def find_form(symbol: str, unit: str) -> Form:
    """Form of a symbol of a calculation, in the unit that the calculation has."""
    if symbol == "μ":
        return QUANTITIES["utilisation"]
    digits = _DIGITS.get(symbol, _DIGITS_OF_UNIT.get(unit, 4))
    return Form(key="", symbol=symbol, unit=unit, decimals=digits)
