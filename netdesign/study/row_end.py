"""End of a row of panels: what its ropes pull along the row, and what holds that.

Theory: panel/THEORY.md, (P7) and (P8).
"""

from __future__ import annotations

from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import EndMember, Member
from netdesign.structure.row_position import LoadedWidth, Position
from netdesign.study.member_force import PUSHED
from netdesign.words.message import Message, say


def compute_end_factor(width: LoadedWidth, spacing: float) -> float:
    """Pull of a rope under the end effect over that without, at most, (P8) [-]."""
    share = width.end_length / spacing
    return 1.0 + width.end_factor * (share if share <= 0.5 else 1.0)


def name_unsaid(row: NetRow) -> Message:
    """The columns that a row leaves empty, and that every force depends on."""
    return say("check.unsaid", names=row.unsaid)


def find_lack(row: NetRow, given: Resistance) -> Message | None:
    """Lack of the workbook that leaves an end member, or the end post, open."""
    if row.row_end is None or given.member not in (*EndMember, *PUSHED):
        return None
    if row.panel is None:
        return row.panel_lack
    if row.row_end.guy_angle is not None or given.member == EndMember.LATERAL_ANCHOR:
        return None
    return say("row_end.no_angle")


def find_other_panel(
    row: NetRow, given: Resistance, position: Position
) -> Message | None:
    """Doubt that the ropes between the posts are those that were computed.

    It concerns what they load more than the section does.
    """
    pulled = [Member.UPHILL_GUY, Member.UPHILL_ANCHOR]
    if row.layout.is_foot_shared:
        pulled.append(Member.FOOT_ANCHOR)
    at_end = (*EndMember, *PUSHED) if position == "edge" and row.row_end else ()
    return row.panel_lack if given.member in (*pulled, *at_end) else None
