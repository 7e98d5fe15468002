"""Records of cases, forces and the guideline's loads."""

from __future__ import annotations

from dataclasses import dataclass, field

from netdesign.checks.check import CasePoint
from netdesign.edge.json_text import Items
from netdesign.outcome import Outcome
from netdesign.words.message import Text


@dataclass(frozen=True, kw_only=True)
class ConfirmationRecord:
    """The governing case solved again by another fidelity."""

    screened_kN: float
    confirmed_kN: float | None
    difference_percent: float | None
    elements: int | None
    screened_elements: int
    reason: Text | None  # why there is no confirmation


@dataclass(frozen=True, kw_only=True)
class LargestForce:
    """Largest value of one force anywhere in the ranges of a row, characteristic.

    Per anchor; per metre of width of a scene without a support. The only place where
    such a force leaves SI units.
    """

    quantity: str  # "foot_anchor", "panel_post", "panel_upper_along", ...
    low_kN: float  # numerical band; its upper end has what may hide between the cases
    value_kN: float
    high_kN: float
    bound_kN: float  # value with what may hide
    case: CasePoint
    confirmed: ConfirmationRecord | None = None


@dataclass(frozen=True, kw_only=True)
class CaseRecord:
    """One solved case of a net row: per-anchor forces, characteristic."""

    case: CasePoint
    outcome: Outcome
    reason: Text | None  # None when converged
    foot_anchor_kN: float | None
    uphill_guy_kN: float | None
    downhill_guy_kN: float | None
    post_kN: float | None
    error_percent: float | None  # estimated, of the worst of the four
    balance_residual: float | None  # relative to the weight


@dataclass(frozen=True, kw_only=True)
class GuidelineCase:
    """One load case of the guideline on this row; characteristic, inside a row.

    Named "same_snow", "load_case_1" or "load_case_2"; its load has the prism.
    """

    name: str
    load_kN_per_m: float | None  # along the slope on the net
    foot_anchor_kN: float | None
    uphill_guy_kN: float | None
    post_kN: float | None
    reason: Text | None = None  # why a force is None
    density_kg_m3: float
    height_vertical_m: float
    creep_factor: float | None
    glide_factor: float | None
    rigid_kN_per_m: float | None  # S'_N on a rigid wall
    loaded_share: float = 1.0  # of the net's height, from the foot


@dataclass(frozen=True, kw_only=True)
class GuidelineRecord:
    """Independent check of a row by the guideline's load model."""

    case: CasePoint  # of the coupled solve
    solved_load_kN_per_m: float  # along the slope on the net
    solved_foot_anchor_kN: float
    cases: Items[GuidelineCase]
    sentence: Text  # why the two differ
    # Height above the slope [m] and pressure of the snow [kPa] of the coupled solve.
    along_net: Items[tuple[float, float]] = field(default_factory=list)


@dataclass(frozen=True, kw_only=True)
class LoadOnNet:
    """The guideline's load on a net, for each metre of width."""

    load_case: str  # "load_case_1" or "load_case_2"
    normal_share: float = 0.35  # a of (G4): of the normal part
    inclination_deg: float  # of the net, where a force is largest
    snow_thickness_m: float  # of the snow that is held, there as well
    density_kg_m3: float
    height_vertical_m: float
    creep_factor: float
    glide_factor: float
    load_along_kN_per_m: float  # on the net, downslope, with the prism
    load_across_kN_per_m: float  # out of the ground
    stiffness_kN_per_m: float
    slack: float
    chord_tension_kN_per_m: float


@dataclass(frozen=True, kw_only=True)
class FloorForceRecord(LoadOnNet):
    """Largest force of the guideline's load in one member, inside the row."""

    member: str
    force_kN: float  # characteristic


@dataclass(frozen=True, kw_only=True)
class FloorRecord:
    """Forces that no demand of a row lies below, by the guideline's load cases."""

    profile: str  # whose load model
    forces: Items[FloorForceRecord]  # empty where the floor is not available
    altitude_factor: float  # on the density of load case 1
    assumed: Items[Text] = field(default_factory=list)  # of the row, for its load
    reason: Text | None = None  # why it is not
    # Pull of the guideline's load on a rope over that of the solved cases, at least 1.
    lower_rope: float = 1.0
    ridge_rope: float = 1.0
