"""Forces that one support of the net does to the ground."""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.guards import require_positive
from netdesign.outcome import Outcome
from netdesign.structure.head import FailedSupport, HeadForces, compute_head_forces
from netdesign.structure.layout import Point, SupportPoints
from netdesign.structure.members import Member
from netdesign.words.message import say


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundForce:
    """Force of the structure on the ground at one point, per anchor.

    Attributes
    ----------
    member : str
        What brings the force: the net, a guy or the post.
    x, y : float
        Parts along the slope (downslope positive) and normal to it (out of the
        ground positive) [N].
    """

    member: Member
    x: float
    y: float

    @property
    def size(self) -> float:
        """Size of the force [N]."""
        return math.hypot(self.x, self.y)

    @property
    def direction(self) -> float | None:
        """Angle of the force against the ground surface [rad]; None without force.

        Counted from the downslope direction, -pi to pi: 0 points downslope, pi/2
        straight out of the ground, pi upslope; negative presses into the ground.
        """
        if self.size == 0.0:
            return None
        return math.atan2(self.y, self.x)


@dataclass(frozen=True, slots=True, kw_only=True)
class AnchorForces:
    """Forces of one support on the ground, per anchor [N].

    Attributes
    ----------
    foot_anchor, uphill_anchor, downhill_anchor, post_base : GroundForce
        Force at each point; that of a slack guy is 0.
    head : HeadForces
        Forces in the members at the post head.
    is_foot_shared : bool
        The net's foot and the uphill guy end at the same point.
    """

    foot_anchor: GroundForce
    uphill_anchor: GroundForce
    downhill_anchor: GroundForce
    post_base: GroundForce
    head: HeadForces
    is_foot_shared: bool

    @property
    def on_ground(self) -> dict[Member, GroundForce]:
        """Force at each point on the ground."""
        return {
            Member.FOOT_ANCHOR: self.foot_anchor,
            Member.UPHILL_ANCHOR: self.uphill_anchor,
            Member.DOWNHILL_ANCHOR: self.downhill_anchor,
            Member.POST_BASE: self.post_base,
        }

    @property
    def head_pull(self) -> Point:
        """Pull of the net on the head: what its members bring to the ground [N]."""
        brought = (self.post_base, self.uphill_anchor, self.downhill_anchor)
        return sum(one.x for one in brought), sum(one.y for one in brought)

    @property
    def member_forces(self) -> dict[str, float]:
        """Characteristic force that each member must resist, by its name [N].

        One anchor for net and uphill guy takes the sum of both sizes, which is
        never less than their resultant. Theory: structure/THEORY.md, eq. (S7).
        """
        foot, uphill = self.foot_anchor.size, self.uphill_anchor.size
        if self.is_foot_shared:
            foot = uphill = foot + uphill
        return {
            Member.FOOT_ANCHOR: foot,
            Member.UPHILL_GUY: self.head.uphill_guy_tension,
            Member.UPHILL_ANCHOR: uphill,
            Member.DOWNHILL_GUY: self.head.downhill_guy_tension,
            Member.DOWNHILL_ANCHOR: self.downhill_anchor.size,
            Member.POST: self.head.post_compression,
            Member.POST_BASE: max(-self.post_base.y, 0.0),  # across the plate, (S8)
        }


def compute_anchor_forces(
    points: SupportPoints,
    *,
    foot_pull_per_m: Point,
    head_pull_per_m: Point,
    post_spacing: float,
) -> AnchorForces | FailedSupport:
    """Find the forces on the ground from the pulls of the net's two ends.

    Theory: structure/THEORY.md, eqs. (S5) and (S6).

    Parameters
    ----------
    points : SupportPoints
        Geometry of the support [m].
    foot_pull_per_m, head_pull_per_m : tuple of float, shape (2,)
        Force of the net on its foot anchor and on the post head, (x, y), X
        downslope, Y normal to the slope, per metre of net [N/m].
    post_spacing : float
        Width of net that one support carries [m].

    Returns
    -------
    AnchorForces or FailedSupport
        Forces on the ground, per anchor [N], or why the support cannot stand.

    Raises
    ------
    ModelError
        If the post spacing is not a finite number above 0.

    Verified by
    -----------
    verification/test_head_equilibrium.py
    """
    require_positive("post spacing", post_spacing, "m")
    foot = _scale(foot_pull_per_m, post_spacing)
    if not all(math.isfinite(part) for part in foot):
        return FailedSupport(
            outcome=Outcome.NONFINITE, reason=say("support.foot_no_number")
        )
    head = compute_head_forces(_scale(head_pull_per_m, post_spacing), points)
    if isinstance(head, FailedSupport):
        return head
    return AnchorForces(
        foot_anchor=GroundForce(member=Member.NET, x=foot[0], y=foot[1]),
        uphill_anchor=_force_from_head(
            Member.UPHILL_GUY,
            points.head,
            points.uphill_anchor,
            -head.uphill_guy_tension,
        ),
        downhill_anchor=_force_from_head(
            Member.DOWNHILL_GUY,
            points.head,
            points.downhill_anchor,
            -head.downhill_guy_tension,
        ),
        post_base=_force_from_head(
            Member.POST, points.head, points.post_base, head.post_compression
        ),
        head=head,
        is_foot_shared=points.uphill_anchor == points.net_foot,
    )


def _force_from_head(
    member: Member, head: Point, place: Point, thrust: float
) -> GroundForce:
    """Force of a member on ``place``; ``thrust`` [N] pushes it away from the head."""
    if thrust == 0.0:  # also where a slack guy has no length
        return GroundForce(member=member, x=0.0, y=0.0)
    x, y = place[0] - head[0], place[1] - head[1]
    length = math.hypot(x, y)
    return GroundForce(member=member, x=thrust * x / length, y=thrust * y / length)


def _scale(pull_per_m: Point, width: float) -> Point:
    return (pull_per_m[0] * width, pull_per_m[1] * width)
