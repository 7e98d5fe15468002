"""Ground in which an anchor type was tested or computed: it holds in no other one."""

from __future__ import annotations

from netdesign.site.model import Resistance, Site
from netdesign.structure.members import EndMember, Member

_ANCHORS = (
    *(Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR),
    *(EndMember.LATERAL_ANCHOR, EndMember.END_GUY_ANCHOR),
)


def find_ground(site: Site, type_id: str) -> str:
    """Ground of an anchor type of the workbook; "" where nobody gives it."""
    found = (one.ground for one in site.catalogue if one.type_id == type_id)
    return next((ground for ground in found if ground), "")


def holds_in_ground(member: str, now: str, other: Resistance) -> bool | None:
    """Validity of a type in the ground of the type that it would replace.

    Parameters
    ----------
    member : str
        What the type is for; only anchors stand in a ground.
    now : str
        Ground of the type that is there; "" for an unknown one.
    other : Resistance
        Of the type that would replace it.

    Returns
    -------
    bool or None
        None where either ground is unknown: somebody has to be asked.
    """
    if member not in _ANCHORS:
        return True
    return now == other.ground if now and other.ground else None
