"""Records of solved cases and of the largest forces over them.

All numbers in engineer's units, as in ``records``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from netdesign.edge.json_text import list_fields
from netdesign.outcome import Outcome
from netdesign.words.text_field import Text


@dataclass(frozen=True, kw_only=True)
class CasePoint:
    """One point of the ranges; what does not range beside the first three is None.

    The document leaves that out.
    """

    LEAVES_OUT_NONE: ClassVar[bool] = True

    density_kg_m3: float
    friction_deg: float
    inclination_deg: float
    thickness_m: float | None = None
    height_vertical_m: float | None = None
    upslope_length_m: float | None = None
    slack: float | None = None
    stiffness_kN_per_m: float | None = None
    slip_length_m: float | None = None
    glide_factor: float | None = None

    @property
    def values(self) -> dict[str, float]:
        """Values by their keys."""
        return list_fields(self)


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
    is_calibrated: bool = True  # the creep law is given for this density


@dataclass(frozen=True, kw_only=True)
class ExtremeRecord:
    """Largest value of one member force over all cases, characteristic."""

    quantity: str  # "foot_anchor", "uphill_guy", "downhill_guy", "post"
    max_kN: float
    low_kN: float  # band: numerical error
    high_kN: float
    case: CasePoint
    coincident_kN: dict[str, float]  # the other members in that case
    upper_bound_kN: float | None = None  # None for a grid, which has no bound
