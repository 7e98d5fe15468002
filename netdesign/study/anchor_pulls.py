"""Directions in which anchors are pulled over the whole envelope, and their axes.

Last: how many anchors of each type a row is built of, and how long.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from netdesign.checks import Check, OpenKind, Standard
from netdesign.checks.comparison import compare, leave_open
from netdesign.checks.schema import LEAST_DIP, ROPE_ANGLE
from netdesign.envelope.row_pulls import FootPulls
from netdesign.guideline.floor import HeadSpan
from netdesign.outcome import Verdict
from netdesign.resistance.ground import BENDING
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.anchors import (
    PullRange,
    find_pull_range,
    measure_pull,
    turn_by_splay,
    turn_sideways,
)
from netdesign.structure.layout import SupportPoints
from netdesign.structure.members import END_ANCHORS, EndMember, Member
from netdesign.structure.row_position import (
    Position,
    find_axis_at_dip,
    find_dip,
    measure_angle,
    measure_fall,
    turn_down,
)
from netdesign.structure.splay import Guys
from netdesign.study.case_records import PartRecord, PullRecord
from netdesign.study.load_along_row import place_row
from netdesign.study.row_to_check import RowToCheck
from netdesign.units import degree_from_radian
from netdesign.words.message import Message, say

ANCHORS = (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR)
GUY_ANCHORS = (Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR)
# Below the horizontal, of a bore without a given axis, so that mortar fills it: a
# supplier's manual asks for it (Geobrugg GBE-3000A).
USUAL_DIP = math.radians(15.0)
_ENDS = 2  # of a row
_CLOSE = 1e-9  # of two dips, which rounding keeps apart [deg]


def list_pulls(
    task: RowToCheck,
    feet: FootPulls,
    share: float,
    floor: HeadSpan | None,
    one_way: float = 0.0,
) -> list[PullRecord]:
    """Pull on every anchor over the converged cases and under the floor's load.

    ``feet`` is what these cases bring to the foot, ``share`` acts along the row. Behind
    those inside comes the foot beside the end, which holds ``one_way`` of the lower
    rope's pull along the row; last the anchors of the row's end: those of types of
    their own, then those that hold the row along it.
    """
    row = task.row
    solved = [result for result in task.solved.results if result.is_converged]
    inclined = dict.fromkeys(result.case.inclination for result in solved)
    places = [place_row(row, angle) for angle in inclined]
    directions = {
        anchor: [_measure_guy(place, anchor, row.guys) for place in places]
        for anchor in ANCHORS
    }
    directions[Member.FOOT_ANCHOR] = list(feet.turns)
    if floor is not None and feet.turns:
        directions[Member.FOOT_ANCHOR] += [floor.foot_least, floor.foot_largest]
    if row.layout.is_foot_shared:  # one anchor, pulled both ways
        both = [*directions[Member.FOOT_ANCHOR], *directions[Member.UPHILL_ANCHOR]]
        directions[Member.FOOT_ANCHOR] = directions[Member.UPHILL_ANCHOR] = both
    ranges = {anchor: find_pull_range(angles) for anchor, angles in directions.items()}
    of_supports = [
        build_pull(row, anchor, pulls, share, position)
        for position in list_positions(row)
        for anchor, pulls in ranges.items()
        if pulls is not None
    ]
    at_foot, turn = ranges[Member.FOOT_ANCHOR], one_way * feet.along
    if at_foot is not None and turn > 0.0:
        foot = (row, Member.FOOT_ANCHOR, at_foot, share + turn)
        of_supports.insert(len(ANCHORS), build_pull(*foot, position="second"))
    return [*of_supports, *(_list_end_pulls(row) if places else ())]


def _list_end_pulls(row: NetRow) -> Iterator[PullRecord]:
    """Pulls on the anchors that hold the row along itself: of lower rope and end guy.

    The lower rope pulls along the row. The bore of the end guy's anchor is assumed: it
    continues the guy, or dips more where that is too flat.
    """
    end, slope = row.row_end, row.slope_angle
    if end is None:
        return
    along = PullRange(least=0.0, largest=0.0)
    yield build_pull(row, EndMember.LATERAL_ANCHOR, along, 0.0, "edge")
    guy = end.guy.way
    x, y, z = way = turn_down(guy, slope, USUAL_DIP)
    rise = degree_from_radian(end.guy.angle)
    kind = row.find_anchor_type(EndMember.END_GUY_ANCHOR, "edge")
    yield PullRecord(
        anchor=EndMember.END_GUY_ANCHOR,
        position="edge",
        kind=kind.kind if kind else "",
        least_deg=rise,
        largest_deg=rise,
        axis_deg=degree_from_radian(math.asin(-y)),
        aside_deg=degree_from_radian(math.atan2(-x, -z)),
        is_axis_given=False,
        angle_deg=degree_from_radian(measure_angle(way, guy)),
        dip_deg=degree_from_radian(math.asin(measure_fall(way, slope))),
    )


def list_positions(row: NetRow) -> tuple[Position, ...]:
    """Supports whose anchors are of types of their own."""
    if row.end_anchors is None or not row.has_end:
        return ("intermediate",)
    return ("intermediate", "edge")


def find_pull(
    pulls: Sequence[PullRecord], anchor: str, position: Position
) -> PullRecord | None:
    """Pull on an anchor of a support; that inside the row where it has no other."""
    of_anchor = [pull for pull in pulls if pull.anchor == anchor]
    own = [pull for pull in of_anchor if pull.position == position]
    return next(iter(own or of_anchor), None)


def _measure_guy(points: SupportPoints, anchor: Member, guys: Guys) -> float:
    """Direction of a guy's line at its anchor, slack or not; in its own plane."""
    end = points.find_anchor(anchor)
    x, y = points.head[0] - end[0], points.head[1] - end[1]
    turned = 0.0 if may_share(guys) else guys.splay or 0.0
    return turn_by_splay(measure_pull(x, y, anchor), turned)


def may_share(guys: Guys) -> bool:
    """Two guys on one anchor: it may be pulled out of the section by the splay."""
    return guys.count > 1 and guys.are_shared is not False


def is_shared(row: NetRow, member: str) -> bool:
    """An anchor holds a guy of each of two neighbouring posts, or may do so."""
    return may_share(row.guys) and member in GUY_ANCHORS


def build_pull(
    row: NetRow,
    anchor: Member | EndMember,
    pulls: PullRange,
    share: float,
    position: Position = "intermediate",
) -> PullRecord:
    """Pull on an anchor from the range of its directions.

    Parameters
    ----------
    row : NetRow
        With axes and kinds of its anchors.
    anchor : Member or EndMember
        Which; without a given axis it goes along the mean pull, but dips enough.
    pulls : PullRange
        [rad].
    share : float
        Part of the foot's pull along the row [-].
    position : str
        Of the support.
    """
    typed_axis, kind = row.find_axis(anchor), row.find_anchor_type(anchor, position)
    flattest = find_axis_at_dip(USUAL_DIP, row.slope_angle, anchor)
    axis = max(pulls.mean, flattest) if typed_axis is None else typed_axis
    along_row = share if anchor in row.layout.anchors_at_foot else 0.0
    if is_shared(row, anchor):
        along_row = math.tan(row.guys.splay or 0.0)
    turned = turn_sideways(pulls.find_largest_angle(axis), along_row)
    return PullRecord(
        anchor=anchor,
        position=position,
        kind=kind.kind if kind else "",
        least_deg=degree_from_radian(pulls.least),
        largest_deg=degree_from_radian(pulls.largest),
        axis_deg=degree_from_radian(axis),
        is_axis_given=typed_axis is not None,
        angle_deg=degree_from_radian(turned),
        dip_deg=degree_from_radian(find_dip(axis, row.slope_angle, anchor)),
    )


def find_open_dip(
    resistance: Resistance, pull: PullRecord | None, standard: Standard
) -> Message | None:
    """Reason why grout may not fill a bore that is flatter than the profile's limit.

    From a borehole that is flat or rises mortar runs out; structure/THEORY.md, (S14b).
    """
    if resistance.mode != "pull_out" or pull is None:
        return None
    limit = standard.find(LEAST_DIP)
    if limit is None:
        return say("check.no_limit", limit=LEAST_DIP)
    if pull.dip_deg >= limit.value - _CLOSE:
        return None
    return say("bores.flat", dip=pull.dip_deg, least=limit.value)


def check_direction(
    pull: PullRecord, standard: Standard, open_cases: Message | None
) -> Check | None:
    """Check the angle of a rope anchor, or of an anchor whose kind is not given.

    None beyond the limit, and of a bar in a block: there a head has to take the force
    across the axis.
    """
    if pull.kind in BENDING:
        return None
    limit = standard.find(ROPE_ANGLE)
    if limit is None:
        reason = say("check.no_limit", limit=ROPE_ANGLE)
        kind = OpenKind.RESISTANCE_MISSING
        return leave_open("direction", kind, reason, member=pull.anchor)
    if pull.angle > limit.value_si:
        return None
    angle = round(pull.angle_deg, 9)  # less is rounding
    finding = say("direction.rope_within", angle=angle, most=limit.value)
    check = compare("direction", Verdict.PASS, finding, member=pull.anchor)
    return (
        check if open_cases is None else check.with_open(OpenKind.UNSOLVED, open_cases)
    )


def list_parts(row: NetRow) -> list[PartRecord]:
    """List the anchors of a net row; those in mid-panel count with the foot anchors."""
    counts: dict[tuple[str, str, float | None], int | None] = {}
    for member, kind, count in _list_anchors(row):
        key = (member, kind.type_id, kind.drilled_length)
        before = counts.get(key, 0)
        is_known = count is not None and before is not None
        counts[key] = (before or 0) + (count or 0) if is_known else None
    return [
        PartRecord(part=member, type_id=type_id, count=count, size=size)
        for (member, type_id, size), count in counts.items()
    ]


def _list_anchors(row: NetRow) -> Iterator[tuple[str, Resistance, int | None]]:
    """Anchors of the supports, between the posts, and of those that hold the row."""
    posts = row.post_count
    for position, supports in _count_supports(row):
        types = _index(row.resistances_at(position))
        for anchor in ANCHORS:
            if anchor not in types:
                continue
            yield anchor, types[anchor], _count(row, anchor, position, supports)
    if any(panel.has_mid_anchors for panel in row.panels):
        foot = _index(row.resistances)[Member.FOOT_ANCHOR]
        yield Member.FOOT_ANCHOR, foot, None if posts is None else posts - 1
    held = _index(row.row_end.resistances) if row.row_end else {}
    for member in END_ANCHORS:
        if member in held and held[member].type_id:
            yield member, held[member], _ENDS


def _count_supports(row: NetRow) -> Iterator[tuple[Position, int | None]]:
    """Supports by position; the first and last ones alone where they differ."""
    count = row.post_count
    if row.end_resistances is None:
        yield "intermediate", count
        return
    yield "intermediate", None if count is None else max(0, count - _ENDS)
    yield "edge", None if count is None else min(_ENDS, count)


def _count(
    row: NetRow, anchor: Member, position: Position, supports: int | None
) -> int | None:
    """Number of an anchor at some supports; a shared one is one of both its posts.

    The end post counts the shared anchors between itself and the next post.
    """
    if supports is None:
        return None
    if not is_shared(row, anchor):
        return supports * (1 if anchor == Member.FOOT_ANCHOR else row.guys.count)
    if row.guys.are_shared is None:
        return None
    if row.end_resistances is None:
        return supports + 1
    if position == "edge":
        return min(2 * supports, (row.post_count or 0) + 1)
    return max(0, supports - 1)


def _index(resistances: Iterable[Resistance]) -> dict[str, Resistance]:
    first: dict[str, Resistance] = {}
    for resistance in resistances:
        first.setdefault(resistance.member, resistance)
    return first
