"""Geometry of one support: net foot, post, guys, anchors in the slope's plane."""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.numerics.arrays import Number
from netdesign.outcome import require_positive, require_within
from netdesign.structure.members import Member

# Defaults of this program, chosen for a sensible geometry; from no standard.
DEFAULT_POST_TILT = math.radians(15.0)
DEFAULT_UPHILL_RATIO = 1.0  # uphill anchor above the net foot / net height
DEFAULT_DOWNHILL_RATIO = 1.0  # downhill anchor below the post base / net height

Point = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class SupportLayout:
    """Choices of the engineer about one support.

    Attributes
    ----------
    post_spacing : float
        Distance of the posts along the row, the tributary width [m].
    post_tilt : float
        Angle of the post from the slope normal, head downslope positive [rad].
    uphill_anchor_distance : float
        Uphill anchor upslope of the net's foot, along the slope [m].
    downhill_anchor_distance : float
        Downhill anchor downslope of the post's base, along the slope [m].
    post_base_distance : float or None
        Post's base downslope of the net's foot, along the slope [m]; with it the
        tilt follows from the head, whatever the net's inclination.
    """

    post_spacing: float
    post_tilt: float = DEFAULT_POST_TILT
    uphill_anchor_distance: float
    downhill_anchor_distance: float
    post_base_distance: float | None = None

    @property
    def is_foot_shared(self) -> bool:
        """The uphill guy ends at the net's foot: one anchor carries both."""
        return self.uphill_anchor_distance == 0.0

    @property
    def lean(self) -> float:
        """Tangent of the post's angle from the slope normal [-]."""
        return math.tan(self.post_tilt)

    @property
    def anchors_at_foot(self) -> tuple[Member, ...]:
        """Anchors of the net's foot, on which the load along the row acts as well."""
        if self.is_foot_shared:
            return Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR
        return (Member.FOOT_ANCHOR,)

    def __post_init__(self) -> None:
        """Refuse impossible geometry."""
        require_positive("post spacing", self.post_spacing, "m")
        require_within("post tilt", self.post_tilt, math.radians(-30), math.radians(45))
        require_within(
            "uphill anchor distance", self.uphill_anchor_distance, 0.0, 100.0, "m"
        )
        require_within(
            "downhill anchor distance", self.downhill_anchor_distance, 0.0, 100.0, "m"
        )
        if self.post_base_distance is not None:
            require_within(
                "post base distance", self.post_base_distance, -50.0, 50.0, "m"
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class SupportPoints:
    """Points of one support in the slope's axes.

    Attributes
    ----------
    net_foot, head, post_base, uphill_anchor, downhill_anchor : tuple of float
        (x, y), X downslope, Y normal [m].
    """

    net_foot: Point
    head: Point
    post_base: Point
    uphill_anchor: Point
    downhill_anchor: Point

    @property
    def is_foot_shared(self) -> bool:
        """The uphill guy ends at the net's foot: one anchor carries both."""
        return self.uphill_anchor == self.net_foot

    @property
    def post_length(self) -> float:
        """From base to head [m]."""
        return math.dist(self.post_base, self.head)

    def find_anchor(self, member: str) -> Point:
        """Point on the ground of an anchor, or of the anchor of a guy [m]."""
        if member == Member.FOOT_ANCHOR:
            return self.net_foot
        is_uphill = member in (Member.UPHILL_GUY, Member.UPHILL_ANCHOR)
        return self.uphill_anchor if is_uphill else self.downhill_anchor


def place_support(layout: SupportLayout, head: Point) -> SupportPoints:
    """Points of a support, its net's foot at the origin.

    Parameters
    ----------
    layout : SupportLayout
        What the engineer chose.
    head : tuple of float, shape (2,)
        Where the net hangs, (x, y) from its foot [m].
    """
    x_base = locate_base(layout, *head)
    return SupportPoints(
        net_foot=(0.0, 0.0),
        head=head,
        post_base=(x_base, 0.0),
        uphill_anchor=(-layout.uphill_anchor_distance, 0.0),
        downhill_anchor=(x_base + layout.downhill_anchor_distance, 0.0),
    )


def locate_base(layout: SupportLayout, x_head: Number, y_head: Number) -> Number:
    """Post base downslope of the net's foot [m], below a head or below many.

    Parameters
    ----------
    layout : SupportLayout
        What the engineer chose.
    x_head, y_head : float or ndarray
        Where the net hangs, from its foot [m].
    """
    if layout.post_base_distance is not None:
        return 0.0 * x_head + layout.post_base_distance
    return x_head - y_head * layout.lean
