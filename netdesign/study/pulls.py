"""Directions in which anchors are pulled over the whole envelope, and their axes."""

from __future__ import annotations

import math
from collections.abc import Sequence

from netdesign.checks import Check, OpenKind, Standard
from netdesign.checks.check import judge
from netdesign.checks.comparison import compare, leave_open
from netdesign.checks.schema import ROPE_ANGLE
from netdesign.guideline.floor import HeadSpan
from netdesign.outcome import Verdict
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.anchors import (
    PullRange,
    find_dip,
    find_pull_range,
    measure_pull,
    turn_by_splay,
    turn_sideways,
)
from netdesign.structure.layout import SupportPoints
from netdesign.structure.members import Member
from netdesign.structure.row_position import Position
from netdesign.structure.splay import Guys
from netdesign.study.row_to_check import RowToCheck
from netdesign.study.sideways import list_states, place_row
from netdesign.study.support_records import PullRecord
from netdesign.units import degree_from_radian
from netdesign.words.message import Message, say

ANCHORS = (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR)


def list_pulls(
    task: RowToCheck, share: float, floor: HeadSpan | None
) -> list[PullRecord]:
    """Pull on every anchor over the converged cases and under the floor's load.

    ``share`` acts along the row. The anchors of the row's end come last, where they
    are of types of their own.
    """
    row, solved = task.row, [one for one in task.solved.results if one.is_converged]
    points = [place_row(row, one.case.inclination) for one in solved]
    states = [state for one in solved for state in list_states(row, one)]
    feet = [force for state in states for force in state.feet]
    directions = {
        anchor: [_measure_guy(place, anchor, row.guys) for place in points]
        for anchor in ANCHORS
    }
    directions[Member.FOOT_ANCHOR] = [
        measure_pull(x, y, Member.FOOT_ANCHOR) for x, y in feet
    ]
    if floor is not None and feet:
        directions[Member.FOOT_ANCHOR] += [floor.foot_least, floor.foot_largest]
    if row.layout.is_foot_shared:  # one anchor, pulled both ways
        both = [*directions[Member.FOOT_ANCHOR], *directions[Member.UPHILL_ANCHOR]]
        directions[Member.FOOT_ANCHOR] = directions[Member.UPHILL_ANCHOR] = both
    ranges = {anchor: find_pull_range(found) for anchor, found in directions.items()}
    return [
        build_pull(row, anchor, pulls, share, position)
        for position in list_positions(row)
        for anchor, pulls in ranges.items()
        if pulls is not None
    ]


def list_positions(row: NetRow) -> tuple[Position, ...]:
    """Supports whose anchors are of types of their own."""
    if row.end_anchors is None or not row.has_end:
        return ("intermediate",)
    return ("intermediate", "edge")


def find_pull(
    pulls: Sequence[PullRecord], anchor: str, position: Position
) -> PullRecord | None:
    """Pull on an anchor of a support; that inside the row where it has no other."""
    found = [one for one in pulls if one.anchor == anchor]
    own = [one for one in found if one.position == position]
    return next(iter(own or found), None)


def _measure_guy(points: SupportPoints, anchor: Member, guys: Guys) -> float:
    """Direction of a guy's line at its anchor, slack or not; in its own plane."""
    end = points.find_anchor(anchor)
    x, y = points.head[0] - end[0], points.head[1] - end[1]
    turned = 0.0 if may_share(guys) else guys.splay or 0.0
    return turn_by_splay(measure_pull(x, y, anchor), turned)


def may_share(guys: Guys) -> bool:
    """Two guys on one anchor: it may be pulled out of the section by the splay."""
    return guys.count > 1 and guys.are_shared is not False


def lack_sharing(guys: Guys) -> Message | None:
    """Lack of a word on whether an anchor holds two guys."""
    if guys.count == 1 or guys.are_shared is not None:
        return None
    return say("check.unsaid", names=(say("column.Nets.guy_anchors"),))


def build_pull(
    row: NetRow,
    anchor: Member,
    pulls: PullRange,
    share: float,
    position: Position = "intermediate",
) -> PullRecord:
    """Pull on an anchor from the range of its directions.

    Parameters
    ----------
    row : NetRow
        With axes and kinds of its anchors.
    anchor : Member
        Which.
    pulls : PullRange
        [rad].
    share : float
        Part of the foot's pull along the row [-].
    position : str
        Of the support.
    """
    given, kind = row.find_axis(anchor), row.find_anchor_type(anchor, position)
    axis = pulls.mean if given is None else given
    along_row = share if anchor in row.layout.anchors_at_foot else 0.0
    if may_share(row.guys) and anchor != Member.FOOT_ANCHOR:
        along_row = math.tan(row.guys.splay or 0.0)
    turned = turn_sideways(pulls.find_largest_angle(axis), along_row)
    return PullRecord(
        anchor=anchor,
        position=position,
        kind=kind.kind if kind else "",
        least_deg=degree_from_radian(pulls.least),
        largest_deg=degree_from_radian(pulls.largest),
        axis_deg=degree_from_radian(axis),
        is_axis_given=given is not None,
        is_axis_known=given is not None or row.drills_along_pull,
        angle_deg=degree_from_radian(turned),
        dip_deg=degree_from_radian(find_dip(axis, row.slope_angle, anchor)),
    )


def doubt_mortar(given: Resistance, pull: PullRecord | None) -> Message | None:
    """Doubt that mortar fills a borehole, of a bond computed as if it did.

    From a borehole that rises mortar runs out. A test shows what such a bond bears.
    """
    is_computed = given.mode == "pull_out" and given.basis == "computed"
    if not is_computed or pull is None:
        return None
    if not pull.is_axis_known:
        return say("bending.no_axis")
    return say("bores.rises", rise=-pull.dip_deg) if pull.dip_deg < 0.0 else None


def check_directions(
    pulls: Sequence[PullRecord], standard: Standard, gap: Message | None
) -> list[tuple[Position, Check]]:
    """Check the angles of rope anchors, and of anchors whose kind is not given.

    Each with the support that it belongs to.
    """
    return [
        (one.position, _check_direction(one, standard, gap))
        for one in pulls
        if one.kind not in ("bar", "micropile")  # what bends has a check of that
    ]


def _check_direction(
    pull: PullRecord, standard: Standard, gap: Message | None
) -> Check:
    limit = standard.find(ROPE_ANGLE)
    if limit is None:
        lack = say("check.no_limit", limit=ROPE_ANGLE)
        kind = OpenKind.RESISTANCE_MISSING
        return leave_open("direction", kind, lack, member=pull.anchor)
    gap = gap or (None if pull.is_axis_known else say("bending.no_axis"))
    most, angle = limit.value_si, pull.angle
    met = judge(angle, angle, least=0.0, most=most)
    key = "direction.rope_beyond" if met is Verdict.FAIL else "direction.rope_within"
    finding = say(key, angle=pull.angle_deg, most=limit.value)
    found = compare("direction", met, finding, member=pull.anchor)
    return found if gap is None else found.with_open(OpenKind.UNSOLVED, gap)
