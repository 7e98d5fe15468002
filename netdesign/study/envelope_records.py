"""Records of the search for the largest forces of a row, and of what may hide.

All numbers in engineer's units, as in ``records``.
"""

from __future__ import annotations

from dataclasses import dataclass

from netdesign.words.text_field import Text


@dataclass(frozen=True, kw_only=True)
class AxisRecord:
    """One quantity that ranges; unit in its key."""

    key: str  # "density_kg_m3"
    low: float
    high: float


@dataclass(frozen=True, kw_only=True)
class DriverRecord:
    """Answer of one force to one quantity that ranges."""

    key: str
    at_low_kN: float  # the others as in the governing case
    at_high_kN: float
    least_kN: float
    most_kN: float
    first_order: float  # Sobol index
    total: float


@dataclass(frozen=True, kw_only=True)
class FlipRecord:
    """A value at which a check flips, the others as in the governing case."""

    check: str  # id of the check
    key: str
    value: float


@dataclass(frozen=True, kw_only=True)
class LineRecord:
    """Force along one quantity through the governing case."""

    key: str
    values: list[float]
    force_kN: list[float]
    bound_kN: list[float]


@dataclass(frozen=True, kw_only=True)
class MapRecord:
    """Force over density and friction at one inclination; rows are frictions."""

    inclination_deg: float
    density_kg_m3: list[float]
    friction_deg: list[float]
    force_kN: list[list[float]]


@dataclass(frozen=True, kw_only=True)
class ConfirmationRecord:
    """The governing case solved again by another fidelity."""

    method: str
    screened_kN: float
    confirmed_kN: float | None
    difference_percent: float | None
    elements: int | None
    screened_elements: int
    reason: Text | None  # why there is no confirmation


@dataclass(frozen=True, kw_only=True)
class BoundRecord:
    """Largest value of one force anywhere in the ranges.

    Per anchor; per metre of width where the envelope says so.
    """

    quantity: str
    max_kN: float
    upper_bound_kN: float  # with what may hide between the cases
    case: dict[str, float]
    coincident_kN: dict[str, float]
    unexplained: float | None  # error of the Sobol indices: share of the variance
    drivers: list[DriverRecord]
    flips: list[FlipRecord]
    lines: list[LineRecord]
    maps: list[MapRecord]
    confirmation: ConfirmationRecord | None


@dataclass(frozen=True, kw_only=True)
class AdditionRecord:
    """One line of the densification log."""

    round: int
    reason: str
    quantity: str
    case: dict[str, float]
    predicted_kN: float | None
    claimed_kN: float | None  # one standard error of the prediction
    found_kN: float | None


@dataclass(frozen=True, kw_only=True)
class EnvelopeRecord:
    """Search for the largest forces of a net row, and what may hide."""

    axes: list[AxisRecord]
    is_per_metre: bool
    is_closed: bool  # every gap is within the one asked for
    gap_asked_percent: float
    certainty: float  # standard errors in an upper bound
    resolved_share: float  # narrower features may hide, as a share of a range
    cases: int
    skipped: int  # known without a solve, since the snow stuck with less friction
    skips_tested: int
    failed: int
    bounds: list[BoundRecord]
    log: list[AdditionRecord]
