"""Records of the notional reliability of a row's governing check.

All numbers in engineer's units, as in ``records``.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from netdesign.study.case_records import CasePoint
from netdesign.words.message import Text


@dataclass(frozen=True, kw_only=True)
class VariableRecord:
    """One random variable of a limit state.

    Resistance and model factor are over their characteristic values.
    """

    name: str  # "snow_height", "density", ..., "model", "resistance"
    key: str  # of its unit: "height_vertical_m"; "" of a ratio
    distribution: str  # "gumbel", "lognormal", "normal"
    mean: float
    variation: float  # coefficient of variation [-]
    source: Text
    is_assumed: bool  # nobody typed it
    alpha_squared: float | None = None  # share in beta squared [-]
    at_design_point: float | None = None


@dataclass(frozen=True, kw_only=True)
class ReliabilityRecord:
    """Notional annual reliability of one check; no part of any verdict.

    Without a ``beta`` the ``reason`` says why.
    """

    check: str  # its id; "" where no check governs
    reason: Text | None
    variables: list[VariableRecord] = field(default_factory=list)
    beta: float | None = None  # by sampling
    standard_error: float | None = None  # of the sampling
    beta_by_form: float | None = None
    beta_at_full: float | None = None  # of the same row at utilisation 1
    action_factor: float | None = None  # implied: force at the design point over E_k
    resistance_factor: float | None = None  # implied: R_k over that at the design point
    profile_action_factor: float | None = None
    profile_resistance_factor: float | None = None
    design_point: CasePoint | None = None
    force_ratio: float | None = None  # at the design point over E_k, solved again
    force_ratio_by_model: float | None = None  # the same before it was solved
    samples: int = 0
    solves: int = 0
