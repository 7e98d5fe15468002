"""Members of a support that carry force, by the keys that every document uses."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType


class Member(StrEnum):
    """The net, and each part of a support that can fail: anchors, guys, post.

    The base is pressed by its post; the foot is what holds a post that pulls.
    """

    NET = "net"
    FOOT_ANCHOR = "foot_anchor"
    UPHILL_GUY = "uphill_guy"
    UPHILL_ANCHOR = "uphill_anchor"
    DOWNHILL_GUY = "downhill_guy"
    DOWNHILL_ANCHOR = "downhill_anchor"
    POST = "post"
    POST_BASE = "post_base"
    POST_FOOT = "post_foot"


# Those that carry a force to be resisted: all but the net.
CARRYING_MEMBERS = tuple(member for member in Member if member is not Member.NET)

GUYS = (Member.UPHILL_GUY, Member.DOWNHILL_GUY)


class EndMember(StrEnum):
    """A member that holds the ropes' pull along the row, at its end."""

    LATERAL_ANCHOR = "lateral_anchor"
    END_GUY = "end_guy"
    END_GUY_ANCHOR = "end_guy_anchor"


class NetPart(StrEnum):
    """A part of the net itself, along a row: its mesh and its two border ropes."""

    MESH = "mesh"  # a strip one metre wide
    RIDGE_ROPE = "ridge_rope"
    LOWER_ROPE = "lower_rope"


class RopeForce(StrEnum):
    """A force of a border rope: along the row, or its tension at a support."""

    LOWER_ALONG = "panel_lower_along"
    UPPER_ALONG = "panel_upper_along"
    LOWER_TENSION = "panel_lower_tension"
    UPPER_TENSION = "panel_upper_tension"


# Pull of a rope that an end member holds, or that the rope itself bears.
ROPE_OF: Mapping[str, RopeForce] = MappingProxyType(
    {
        EndMember.LATERAL_ANCHOR: RopeForce.LOWER_ALONG,
        EndMember.END_GUY: RopeForce.UPPER_ALONG,
        EndMember.END_GUY_ANCHOR: RopeForce.UPPER_ALONG,
        NetPart.LOWER_ROPE: RopeForce.LOWER_TENSION,
        NetPart.RIDGE_ROPE: RopeForce.UPPER_TENSION,
    }
)


def name_in_panel(member: str) -> str:
    """Key of a member's force by the panel, beside that by the section."""
    return f"panel_{member}"


# Those whose force is reported; each guy stands for its anchor too.
REPORTED_MEMBERS = (
    Member.FOOT_ANCHOR,
    Member.UPHILL_GUY,
    Member.DOWNHILL_GUY,
    Member.POST,
)
# Those of one solved support, whose post may pull.
SOLVED_MEMBERS = (*REPORTED_MEMBERS, Member.POST_FOOT)
# What a member can fail by; the keys under which resistances are given.
MEMBER_MODES: tuple[tuple[Member, str], ...] = (
    (Member.FOOT_ANCHOR, "tendon"),
    (Member.FOOT_ANCHOR, "pull_out"),
    (Member.UPHILL_GUY, "rope"),
    (Member.UPHILL_ANCHOR, "tendon"),
    (Member.UPHILL_ANCHOR, "pull_out"),
    (Member.DOWNHILL_GUY, "rope"),
    (Member.DOWNHILL_ANCHOR, "tendon"),
    (Member.DOWNHILL_ANCHOR, "pull_out"),
    (Member.POST, "compression"),
    (Member.POST_BASE, "bearing"),
)
# Columns that name the type of a member without a type of its own.
NAMED_BY: Mapping[str, Member] = {
    Member.POST_BASE: Member.POST,
    Member.POST_FOOT: Member.POST,
}
# Members whose resistance follows the demand; anchors that bend come in addition.
DEPENDENT_MODES: tuple[tuple[Member, str], ...] = (
    (Member.POST, "compression_bending"),
    (Member.POST_BASE, "sliding"),
)
# Checked only where some case lifts a post.
LIFTED_MODE = (Member.POST_FOOT, "tension")
# Of the ends of a row of panels.
END_MODES: tuple[tuple[EndMember, str], ...] = (
    (EndMember.LATERAL_ANCHOR, "tendon"),
    (EndMember.LATERAL_ANCHOR, "pull_out"),
    (EndMember.END_GUY, "rope"),
    (EndMember.END_GUY_ANCHOR, "tendon"),
    (EndMember.END_GUY_ANCHOR, "pull_out"),
)
END_ANCHORS = (EndMember.LATERAL_ANCHOR, EndMember.END_GUY_ANCHOR)
# Members whose chain of links is checked, and the anchor that pulls at its end.
CONNECTED: Mapping[str, Member | EndMember | None] = {
    Member.FOOT_ANCHOR: Member.FOOT_ANCHOR,
    Member.UPHILL_GUY: Member.UPHILL_ANCHOR,
    Member.UPHILL_ANCHOR: Member.UPHILL_ANCHOR,
    Member.DOWNHILL_GUY: Member.DOWNHILL_ANCHOR,
    Member.DOWNHILL_ANCHOR: Member.DOWNHILL_ANCHOR,
    EndMember.LATERAL_ANCHOR: EndMember.LATERAL_ANCHOR,
    EndMember.END_GUY: EndMember.END_GUY_ANCHOR,
    EndMember.END_GUY_ANCHOR: EndMember.END_GUY_ANCHOR,
    NetPart.RIDGE_ROPE: None,
    NetPart.LOWER_ROPE: None,
}
# Of the net itself; those of its ropes where it has some.
NET_MODES: tuple[tuple[NetPart, str], ...] = (
    (NetPart.MESH, "mesh"),
    (NetPart.RIDGE_ROPE, "rope"),
    (NetPart.LOWER_ROPE, "rope"),
)
