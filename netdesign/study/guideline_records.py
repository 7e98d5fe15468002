"""Records of the guideline's load on a row: comparison, floor, load.

All numbers in engineer's units, as in ``records``.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from netdesign.study.case_records import CasePoint
from netdesign.words.text_field import Text


@dataclass(frozen=True, kw_only=True)
class GuidelineCase:
    """One load case of the guideline on this row; characteristic, inside a row."""

    name: str  # "same_snow", "load_case_1", "load_case_2"
    density_kg_m3: float
    height_vertical_m: float
    creep_factor: float | None
    glide_factor: float | None
    rigid_kN_per_m: float | None  # S'_N on a rigid wall
    load_kN_per_m: float | None  # along the slope on the net, with the prism
    foot_anchor_kN: float | None
    uphill_guy_kN: float | None
    post_kN: float | None
    load_difference_percent: float | None  # of the coupled solve against this
    foot_difference_percent: float | None
    reason: Text | None = None


@dataclass(frozen=True, kw_only=True)
class GuidelineRecord:
    """Independent check of a row by the guideline's load model."""

    profile: str  # whose numbers
    sha256: str
    case: CasePoint  # of the coupled solve
    solved_load_kN_per_m: float  # along the slope on the net
    solved_foot_anchor_kN: float
    cases: list[GuidelineCase]
    sentence: Text  # why the two differ


@dataclass(frozen=True, kw_only=True)
class FloorForceRecord:
    """Largest force of the guideline's load in one member, inside the row."""

    member: str
    force_kN: float  # characteristic
    load_case: str  # "load_case_1" or "load_case_2"
    inclination_deg: float  # of the net, where the force is largest
    snow_thickness_m: float  # of the snow that is held, there as well
    slack: float
    stiffness_kN_per_m: float
    density_kg_m3: float
    height_vertical_m: float
    creep_factor: float
    glide_factor: float
    load_along_kN_per_m: float  # on the net, downslope, with the prism
    load_across_kN_per_m: float  # out of the ground
    chord_tension_kN_per_m: float


@dataclass(frozen=True, kw_only=True)
class FloorRecord:
    """Forces that no demand of a row lies below, by the guideline's load cases."""

    profile: str  # whose load model
    sha256: str
    forces: list[FloorForceRecord]  # empty where the floor is not available
    altitude_factor: float  # on the density of load case 1
    assumed: list[Text] = field(default_factory=list)  # of the row, for its load
    reason: Text | None = None  # why it is not


@dataclass(frozen=True, kw_only=True)
class GuidelineLoadRecord:
    """The guideline's load on a net, for each metre of width: (G1) to (G9)."""

    load_case: str  # "load_case_1" or "load_case_2"
    inclination_deg: float
    snow_thickness_m: float
    density_kg_m3: float
    height_vertical_m: float
    creep_factor: float
    glide_factor: float
    rigid_kN_per_m: float
    parallel_kN_per_m: float
    normal_kN_per_m: float
    prism_kN_per_m: float
    load_along_kN_per_m: float
    load_across_kN_per_m: float
    loaded_share: float  # of the chord, from the foot
    stiffness_kN_per_m: float
    slack: float
    chord_tension_kN_per_m: float
