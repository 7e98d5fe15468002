"""Records of second opinions on a row's forces: closed form, other models of the snow.

All numbers in engineer's units, as in ``records``. They decide nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

from netdesign.study.case_records import CasePoint
from netdesign.words.text_field import Text


@dataclass(frozen=True, kw_only=True)
class SlabCase:
    """Closed form of creep and glide pressure on this row; (H6) to (H10)."""

    name: str  # "glide_factor", "slip_length", "no_slip", "free": what gave the ground
    slip_length_m: float | None  # D* of linear creep; None without drag
    influence_length_m: float | None  # None without drag
    dynamic_kN_per_m: float  # creep and glide held back
    at_rest_kN_per_m: float
    wedge_kN_per_m: float  # snow between slope normal and net, along the slope
    load_kN_per_m: float  # sum of the three
    foot_anchor_kN: float | None
    uphill_guy_kN: float | None
    post_kN: float | None
    load_difference_percent: float | None  # of the coupled solve against this
    foot_difference_percent: float | None
    reason: Text | None = None  # why a force is None


@dataclass(frozen=True, kw_only=True)
class SlabRecord:
    """Creep and glide pressure in closed form, beside one solved case of a row."""

    case: CasePoint  # of the coupled solve
    poisson: float  # viscous ratio, of the mean density
    solved_load_kN_per_m: float  # along the slope on the net
    solved_foot_anchor_kN: float
    cases: list[SlabCase]


@dataclass(frozen=True, kw_only=True)
class VariantRecord:
    """One other model of the snow on one case."""

    kind: str  # "creep_law", "exponent", "ground_contact", "slip_law"
    creep_law: str
    exponent: float
    slip_length_m: float | None  # of sliding ground: rematched where N was typed
    stated: str  # "yes", "no": exponent stated for such snow; "": as the set has it
    is_calibrated: bool  # the set is given for this snow
    foot_anchor_kN: float | None
    uphill_guy_kN: float | None
    post_kN: float | None
    ratio: float | None  # force of the governing member over that of the study's model
    reason: Text | None = None  # why there is none, or why nothing was solved


@dataclass(frozen=True, kw_only=True)
class ModelFormRecord:
    """Spread of a governing force over other models of the same snow."""

    case: CasePoint
    member: str  # key of the governing force
    force_kN: float  # of the study's model
    low_ratio: float  # least and largest over all variants with a force, and 1
    high_ratio: float
    utilisation: float | None  # of the governing check
    utilisation_low: float | None  # of the same, in proportion
    utilisation_high: float | None
    numerical_low: float | None  # interval of the same check
    numerical_high: float | None
    solves: int  # that this took
    variants: list[VariantRecord]
