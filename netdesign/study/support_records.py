"""Records of forces on a support, of its panel, and of their drawing.

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
class Arrow:
    """A force drawn at a point of the section; per anchor."""

    member: str
    x_m: float
    y_m: float
    force_x_kN: float  # what the structure does to the ground
    force_y_kN: float


@dataclass(frozen=True, kw_only=True)
class Drawing:
    """Section of the governing case, in the slope's axes [m]."""

    case: CasePoint
    slope_deg: float
    snow_thickness_m: float
    net_m: Items[tuple[float, float]]  # foot to head, under load
    sticks: Items[bool]  # per net point: the snow sticks there
    mesh_edges_m: Items[tuple[float, float, float, float]]
    head_m: tuple[float, float]
    post_base_m: tuple[float, float]
    uphill_anchor_m: tuple[float, float]
    downhill_anchor_m: tuple[float, float]
    arrows: Items[Arrow]
    # Of the snow, per net point; None at the ends, where it is singular, and above the
    # snow. Empty in studies of earlier versions.
    pressure_kPa: Items[float | None] = field(default_factory=list)


@dataclass(frozen=True, kw_only=True)
class AnchorRecord:
    """Force of the structure on the ground at one point, in the drawn case."""

    anchor: str  # "foot_anchor", "uphill_anchor", "downhill_anchor", "post_base"
    member: str  # what brings it: "net", "uphill_guy", "downhill_guy", "post"
    force_x_kN: float  # downslope
    force_y_kN: float  # out of the ground
    lateral_kN: float  # along the row, either way; share of the profile
    size_kN: float  # in the section
    direction_deg: float | None  # 0 downslope, 90 out of the ground; None if slack


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
class HeadForce:
    """One force on the post head; those of a head sum up to zero."""

    member: str
    x_kN: float
    y_kN: float


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
class RopeRecord:
    """A border rope: what it is, and its largest forces, upper ends to a tenth."""

    rope: str  # "lower" or "upper"
    type: str  # id of sheet Ropes
    stiffness_kN: float  # EA
    sag: float  # as built, over the post spacing
    along_kN: float | None  # along the row; None where no case has a panel
    tension_kN: float | None
    breaking_kN: float | None  # less what its ends lose; None where none is given
    cell: str  # of the breaking force, else of the id


@dataclass(frozen=True, kw_only=True)
class PanelDrawing:
    """Panel of the drawn case: half of it, from a post to mid-panel.

    Axes of the section: X downslope from the net's foot, Y out of the ground.
    """

    case: CasePoint
    places_m: Items[float]  # along the row, from beside the post to mid-panel
    post_head_m: tuple[float, float]
    lower_m: Items[tuple[float, float]]
    upper_m: Items[tuple[float, float]]
    mid_net_m: Items[tuple[float, float]]  # foot to head, in mid-panel
    rope_places_m: Items[float]  # those of the tensions, from the post on
    lower_tensions_kN: Items[float]
    upper_tensions_kN: Items[float]
    foot_kN: tuple[float, float]  # on the foot anchor beside a post, of a bay
    mid_foot_kN: tuple[float, float]
    head_kN: tuple[float, float]  # on a post head
    lower_along_kN: float
    upper_along_kN: float


@dataclass(frozen=True, kw_only=True)
class PanelRecord:
    """Panel between two posts of a row, inside it."""

    cut: str  # "uniform", "upper" or "fitted"
    has_mid_anchors: bool
    ropes: Items[RopeRecord]
    failed: int = 0  # solved cases without forces by the panel
    end_guy_deg: float | None = None  # angle to the row; None where none is given
    drawing: PanelDrawing | None = None  # None where the drawn case has no panel
    # columns that are empty: several panels were tried, forces are the largest of all,
    # and cut and anchors in mid-panel those of the first
    assumed: Items[Message] = field(default_factory=list)
