"""Records of cases, forces, supports and the guideline's loads.

All numbers are in engineer's units, as in ``records``. Last: how they are made of a
row's envelope.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from netdesign.checks.check import CasePoint
from netdesign.edge.json_text import Items
from netdesign.envelope.extremes import Extreme
from netdesign.envelope.ranges import PARAMETERS, Case
from netdesign.envelope.rows import RowEnvelope
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Outcome
from netdesign.structure.anchors import PullRange
from netdesign.structure.members import REPORTED_MEMBERS, EndMember, Member
from netdesign.structure.row_position import Position
from netdesign.units import (
    kilonewton_from_newton,
    kilonewton_if_known,
    radian_from_degree,
)
from netdesign.words.message import Text


@dataclass(frozen=True, kw_only=True)
class ConfirmationRecord:
    """Result of the governing case on a finer mesh."""

    confirmed_kN: float | None
    difference_percent: float | None
    elements: int | None
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
    reason: Text | None = None  # why a force is None
    density_kg_m3: float
    glide_factor: float | None
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
class FloorForceRecord:
    """Largest force of the guideline's load in one member, inside the row."""

    load_case: str  # "load_case_1" or "load_case_2"
    inclination_deg: float  # of the net, where the force is largest
    member: str
    force_kN: float  # characteristic


@dataclass(frozen=True, kw_only=True)
class FloorRecord:
    """Forces that no demand of a row lies below, by the guideline's load cases."""

    profile: str  # whose load model
    forces: Items[FloorForceRecord]  # empty where the floor is not available
    reason: Text | None = None  # why it is not
    # Pull of the guideline's load on a rope over that of the solved cases, at least 1.
    lower_rope: float = 1.0
    ridge_rope: float = 1.0


@dataclass(frozen=True, kw_only=True)
class Drawing:
    """Section of the governing case, in the slope's axes [m]."""

    case: CasePoint
    slope_deg: float
    snow_thickness_m: float
    net_m: Items[tuple[float, float]]  # foot to head, under load
    head_m: tuple[float, float]
    post_base_m: tuple[float, float]
    uphill_anchor_m: tuple[float, float]
    downhill_anchor_m: tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class PullRecord:
    """Directions of the pulls on one anchor over all solved cases, and its axis.

    Counted from the slope surface, in the direction along the slope in which the anchor
    is pulled; 90 is straight out of the ground. Those that hold the row are pulled
    along it.
    """

    anchor: Member | EndMember
    position: Position  # "edge" of what the end has alone, "second" of the foot beside
    kind: str  # "bar", "micropile", "rope anchor", or "" where none is given
    least_deg: float
    largest_deg: float
    axis_deg: float
    aside_deg: float = 0.0  # of an end guy's anchor: from the row's line, downslope
    is_axis_given: bool  # else drilled along the middle of the pulls, or steeper
    angle_deg: float  # largest between pull and axis, with the part along the row
    dip_deg: float  # of the axis below the horizontal; negative where the hole rises

    @property
    def pulls(self) -> PullRange:
        """Directions in the section [rad]."""
        return PullRange(
            least=radian_from_degree(self.least_deg),
            largest=radian_from_degree(self.largest_deg),
        )

    @property
    def axis(self) -> float:
        """Inclination of the anchor, given or by the pulls [rad]."""
        return radian_from_degree(self.axis_deg)

    @property
    def way(self) -> tuple[float, float, float]:
        """Bore of an anchor that holds the row along itself, into the ground [-].

        Downslope, normal to the slope, along the row.
        """
        flat, aside = math.cos(self.axis), radian_from_degree(self.aside_deg)
        x, z = -flat * math.sin(aside), -flat * math.cos(aside)
        return x, -math.sin(self.axis), z

    @property
    def angle(self) -> float:
        """Largest angle between pull and axis [rad]."""
        return radian_from_degree(self.angle_deg)


@dataclass(frozen=True, kw_only=True)
class PartRecord:
    """Anchors of one type in one place of a net row.

    Attributes
    ----------
    part : str
        Member that the anchor holds.
    type_id : str
        Empty where none is named.
    count : int or None
        None where neither the row's length nor its posts are given.
    size : float or None
        Length of one [m]; None where it is not given.
    """

    part: str
    type_id: str
    count: int | None
    size: float | None


@dataclass(frozen=True, kw_only=True)
class HeldSidewaysRecord:
    """Numbers of a row that the load along it follows from: (S15) to (S18)."""

    share: float
    splay_deg: float
    pull_low_kN: float  # largest pull on a head, over the cases
    pull_kN: float
    pull_high_kN: float
    uphill_part: float  # c of the uphill guy
    downhill_part: float
    post_part: float  # w
    floor_pull_kN: float = 0.0  # largest pull on a head by the guideline's load


@dataclass(frozen=True, kw_only=True)
class EndGuyRecord:
    """Forces that the end guy brings to the support at a row's end: (S25), (S26).

    Parts are over V, the part across the row of its pull on the head; the largest over
    the net's inclinations.
    """

    post_part: float
    base_part: float  # across the base plate
    uphill_part: float  # in the plane of post and guys
    downhill_part: float
    # of the outer guy by a linear truss; None where there is no second guy on a side
    uphill_guy_kN: float | None = None
    downhill_guy_kN: float | None = None


def show_case(values: Mapping[str, float]) -> dict[str, float]:
    """Values of a case under their keys, each in the unit of its key."""
    shown = ((PARAMETERS[name], value) for name, value in values.items())
    return {parameter.key: parameter.show(value) for parameter, value in shown}


def record_point(case: Case) -> CasePoint:
    """Case of a site."""
    return CasePoint(**show_case(case.values))


def read_point(point: CasePoint) -> Case:
    """Case of a record, in SI units."""
    values = point.values
    return Case.of(
        {
            name: parameter.read(values[parameter.key])
            for name, parameter in PARAMETERS.items()
            if parameter.key in values
        }
    )


def record_case(result: CaseResult) -> CaseRecord:
    """Outcome and forces of a solved case."""
    forces = {
        f"{member}_kN": kilonewton_if_known(
            result.member_forces[member].value if result.is_converged else None
        )
        for member in REPORTED_MEMBERS
    }
    solution = result.solution
    return CaseRecord(
        case=record_point(result.case),
        outcome=result.outcome,
        reason=result.reason,
        error_percent=_largest_error_percent(result),
        balance_residual=solution.balance.relative_residual if solution else None,
        **forces,
    )


def _largest_error_percent(result: CaseResult) -> float | None:
    """Largest error of the two end pulls over their size, in per cent."""
    if result.solution is None:
        return None
    pulls = (result.solution.foot, result.solution.head)
    return 100.0 * max(pull.error / pull.size for pull in pulls)


def record_largest(extreme: Extreme, envelope: RowEnvelope) -> LargestForce:
    """Largest force, with what may hide between the cases."""
    force = extreme.widened
    return LargestForce(
        quantity=extreme.member,
        low_kN=kilonewton_from_newton(force.low),
        value_kN=kilonewton_from_newton(force.value),
        high_kN=kilonewton_from_newton(force.high),
        bound_kN=kilonewton_from_newton(extreme.upper_bound),
        case=record_point(extreme.governing.case),
        confirmed=_record_confirmation(envelope, extreme.member),
    )


def show_coincident(extreme: Extreme, members: Sequence[str]) -> dict[str, float]:
    """Forces of the other members in the governing case [kN]."""
    forces = extreme.governing.member_forces
    return {
        member: kilonewton_from_newton(forces[member].value)
        for member in members
        if member != extreme.member
    }


def _record_confirmation(
    envelope: RowEnvelope, member: str
) -> ConfirmationRecord | None:
    confirmation = next((c for c in envelope.confirmations if c.member == member), None)
    if confirmation is None:
        return None
    confirmed = confirmation.confirmed.solution
    difference, forces = confirmation.difference, confirmation.confirmed.member_forces
    return ConfirmationRecord(
        confirmed_kN=kilonewton_if_known(forces[member].value if forces else None),
        difference_percent=None if difference is None else 100.0 * difference,
        elements=confirmed.cost.elements if confirmed else None,
        reason=confirmation.confirmed.reason,
    )
