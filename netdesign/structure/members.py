"""Members of a support that carry force, by the keys that every document uses."""

from __future__ import annotations

from enum import StrEnum


class Member(StrEnum):
    """Part of a support that can fail: an anchor, a guy, the post, its base."""

    FOOT_ANCHOR = "foot_anchor"
    UPHILL_GUY = "uphill_guy"
    UPHILL_ANCHOR = "uphill_anchor"
    DOWNHILL_GUY = "downhill_guy"
    DOWNHILL_ANCHOR = "downhill_anchor"
    POST = "post"
    POST_BASE = "post_base"


# Those whose force is reported; each guy stands for its anchor too.
REPORTED_MEMBERS = (
    Member.FOOT_ANCHOR,
    Member.UPHILL_GUY,
    Member.DOWNHILL_GUY,
    Member.POST,
)
