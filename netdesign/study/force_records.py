"""Records of the forces that checks rest on; all numbers in engineer's units."""

from __future__ import annotations

from dataclasses import dataclass, field

from netdesign.study.case_records import CasePoint


@dataclass(frozen=True, kw_only=True)
class ForceRecord:
    """Largest force of one kind over the cases of a row, as its checks take it.

    The upper end has what may hide between the cases.
    """

    quantity: str  # "foot_anchor", "panel_post", "panel_upper_along", ...
    low_kN: float
    value_kN: float
    high_kN: float
    case: CasePoint
    unknown: list[str] = field(default_factory=list)  # axes nothing is known along
