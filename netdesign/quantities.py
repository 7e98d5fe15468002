"""One row per reported quantity: the only place for its unit and decimals."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantity:
    """How one quantity is named and written in every output.

    Attributes
    ----------
    key : str
        Name of the field in the JSON documents, unit included.
    symbol : str
        As in the theory pages.
    label : str
        A few words for a table heading.
    unit : str
        As printed; "" for a pure number.
    decimals : int or None
        Digits after the point. None: as given, for values that somebody chose
        (a density of 366.8 kg/m3 is not rounded away).
    scientific : bool
        Written with an exponent.
    """

    key: str
    symbol: str
    label: str
    unit: str
    decimals: int | None
    scientific: bool = False


def _row(
    key: str,
    symbol: str,
    label: str,
    unit: str,
    decimals: int | None,
) -> Quantity:
    return Quantity(key=key, symbol=symbol, label=label, unit=unit, decimals=decimals)


_ROWS = (
    # the ranges
    _row("density_kg_m3", "ρ", "Density", "kg/m³", None),
    _row("friction_deg", "φ", "Friction angle", "°", None),
    _row("inclination_deg", "θ", "Inclination", "°", None),
    _row("thickness_m", "d", "Snow thickness", "m", None),
    _row("slack", "", "Slack", "", None),
    _row("glide_factor", "N", "Glide factor", "", None),
    # geometry
    _row("slope_deg", "ψ", "Slope angle", "°", 1),
    _row("snow_thickness_m", "d", "Snow thickness", "m", 2),
    _row("sag_m", "f", "Sag", "m", 3),
    # net, per metre of width
    _row("foot_size_kN_per_m", "T₁", "Tension at the foot", "kN/m", 2),
    _row("head_size_kN_per_m", "T₂", "Tension at the head", "kN/m", 2),
    _row("tension_max_kN_per_m", "T", "Largest tension", "kN/m", 2),
    _row("force_x_kN_per_m", "Fx", "Force along the slope", "kN/m", 2),
    _row("force_y_kN_per_m", "Fy", "Force normal to the slope", "kN/m", 2),
    _row("error_kN_per_m", "", "Estimated error", "kN/m", 2),
    # members, per anchor, characteristic
    _row("foot_anchor_kN", "F", "Foot anchor", "kN", 1),
    _row("uphill_guy_kN", "F", "Uphill guy", "kN", 1),
    _row("downhill_guy_kN", "F", "Downhill guy", "kN", 1),
    _row("post_kN", "F", "Post", "kN", 1),
    _row("max_kN", "F", "Maximum", "kN", 1),
    # support and its place in the row
    _row("solved_kN", "E_s", "Solved force, inside a row", "kN", 1),
    _row("post_spacing_m", "b", "Post spacing", "m", 2),
    _row("loaded_width_m", "b_e", "Loaded width", "m", 2),
    _row("end_factor", "f_R", "End factor", "", 2),
    _row("end_length_m", "Δl", "Length of the end effect", "m", 2),
    _row("lateral_factor", "k_q", "Factor of the lateral load", "", 3),
    _row("force_x_kN", "F_x", "Along the slope", "kN", 1),
    _row("force_y_kN", "F_y", "Out of the ground", "kN", 1),
    _row("lateral_kN", "F_z", "Along the row, ±", "kN", 1),
    _row("size_kN", "F", "Size", "kN", 1),
    _row("direction_deg", "α", "Direction against the ground", "°", 1),
    # the guideline
    _row("height_vertical_m", "H", "Snow height, vertical", "m", 2),
    _row("creep_factor", "K", "Creep factor", "", 3),
    _row("glide_factor", "N", "Glide factor", "", 2),
    _row("rigid_kN_per_m", "S'_N", "On a rigid wall", "kN/m", 1),
    _row("load_kN_per_m", "R_x", "On the net, along the slope", "kN/m", 1),
    _row("load_difference_percent", "", "Coupled against it: load", "%", 0),
    _row("foot_difference_percent", "", "Coupled against it: foot anchor", "%", 0),
    # checks
    _row("action_kN", "E_k", "Characteristic action", "kN", 1),
    _row("action_factor", "γ_E", "Factor of the action", "", None),
    _row("demand_kN", "E_d", "Demand", "kN", 1),
    _row("resistance_characteristic_kN", "R_k", "Characteristic resistance", "kN", 1),
    _row("resistance_factor", "γ_R", "Factor of the resistance", "", None),
    _row("resistance_kN", "R_d", "Design resistance", "kN", 1),
    _row("utilisation", "μ", "Utilisation", "", 3),
    # comparison of two numbers
    _row("change_percent", "", "Change", "%", 1),
    # quality of a solution
    _row("error_percent", "", "Estimated error", "%", 2),
    Quantity(
        key="balance_residual",
        symbol="",
        label="Balance residual",
        unit="",
        decimals=1,
        scientific=True,
    ),
)

QUANTITIES: Mapping[str, Quantity] = MappingProxyType({row.key: row for row in _ROWS})
