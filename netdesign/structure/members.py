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
CARRYING_MEMBERS = tuple(one for one in Member if one is not Member.NET)


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
# Points of a support on the ground, in their order, and what brings the force there.
BROUGHT_BY: Mapping[str, Member] = MappingProxyType(
    {
        Member.FOOT_ANCHOR: Member.NET,
        Member.UPHILL_ANCHOR: Member.UPHILL_GUY,
        Member.DOWNHILL_ANCHOR: Member.DOWNHILL_GUY,
        Member.POST_BASE: Member.POST,
    }
)
