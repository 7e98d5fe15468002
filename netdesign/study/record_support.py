"""Forces on the ground and on the post head of one case, for the report."""

from __future__ import annotations

from netdesign.envelope.run import CaseResult
from netdesign.site.model import NetRow
from netdesign.structure.members import Member
from netdesign.study.effects import RowEffects
from netdesign.study.records import AnchorRecord, HeadForce
from netdesign.units import degree_from_radian, kilonewton_from_newton


def record_anchors(result: CaseResult, effects: RowEffects) -> list[AnchorRecord]:
    """Force vectors on the ground with their direction; slack ones have none."""
    anchors = result.anchors
    if anchors is None:
        return []
    share = effects.lateral_share
    records = []
    for name, force in (
        (Member.FOOT_ANCHOR, anchors.foot_anchor),
        (Member.UPHILL_ANCHOR, anchors.uphill_anchor),
        (Member.DOWNHILL_ANCHOR, anchors.downhill_anchor),
        (Member.POST_BASE, anchors.post_base),
    ):
        lateral = 0.0 if force.member == Member.POST else share * force.size
        direction = force.direction
        records.append(
            AnchorRecord(
                anchor=name,
                member=force.member,
                force_x_kN=kilonewton_from_newton(force.x),
                force_y_kN=kilonewton_from_newton(force.y),
                lateral_kN=kilonewton_from_newton(lateral),
                size_kN=kilonewton_from_newton(force.size),
                direction_deg=None
                if direction is None
                else degree_from_radian(direction),
            )
        )
    return records


def record_head(row: NetRow, result: CaseResult) -> list[HeadForce]:
    """Forces on the post head, the net's pull first; together they are zero.

    The pull is that of the solve; the members' are the reverse of what each does to
    the ground, so that an error in the support would leave the polygon open.
    """
    if result.solution is None or result.anchors is None:
        return []
    pull, width = result.solution.head, row.layout.post_spacing
    anchors = result.anchors
    members = (anchors.post_base, anchors.uphill_anchor, anchors.downhill_anchor)
    forces = [
        ("net", pull.x * width, pull.y * width),
        *((force.member, -force.x, -force.y) for force in members if force.size > 0),
    ]
    return [
        HeadForce(
            member=member,
            x_kN=kilonewton_from_newton(x),
            y_kN=kilonewton_from_newton(y),
        )
        for member, x, y in forces
    ]
