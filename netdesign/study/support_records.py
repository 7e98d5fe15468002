"""Records of the supports of a row: section, pulls, load along the row, panel.

All numbers in engineer's units, as in ``records``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from netdesign.checks.check import CasePoint
from netdesign.edge.json_text import Items
from netdesign.structure.anchors import PullRange
from netdesign.structure.members import EndMember, Member
from netdesign.structure.row_position import Position
from netdesign.units import radian_from_degree
from netdesign.words.message import Message


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
class HeldSidewaysRecord:
    """Numbers of a row that the load along it follows from: (S15) to (S18)."""

    share: float
    splay_deg: float
    pull_low_kN: float  # largest pull on a head, over the cases
    pull_kN: float
    pull_high_kN: float
    least_tension_kN: float  # over the cases and the guideline's load
    uphill_part: float  # c of the uphill guy
    downhill_part: float
    post_part: float  # w
    floor_pull_kN: float = 0.0  # largest pull on a head by the guideline's load
    floor_tension_kN: float = 0.0  # its least tension of the guys


@dataclass(frozen=True, kw_only=True)
class EndGuyRecord:
    """What the end guy does to the support at a row's end: (S25), (S26).

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


@dataclass(frozen=True, kw_only=True)
class PanelRecord:
    """Panel between two posts of a row, inside it.

    Where columns are ``assumed``, since they are empty, forces are the largest of all
    panels that were tried, and the anchors in mid-panel are those of the first.
    """

    has_mid_anchors: bool
    assumed: Items[Message] = field(default_factory=list)
