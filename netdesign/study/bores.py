"""Anchors of a row in the ground, and how near they come to each other."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain, product

from netdesign.checks import Check, OpenKind
from netdesign.checks.comparison import compare, leave_open
from netdesign.checks.schema import ANCHOR_DISTANCE
from netdesign.envelope.ranges import Ranges
from netdesign.outcome import Verdict
from netdesign.site.model import NetRow
from netdesign.structure.layout import SupportPoints
from netdesign.structure.members import EndMember, Member
from netdesign.structure.row_position import (
    Bore,
    find_distance_to_row_above,
    find_least_distance,
    measure_distance,
)
from netdesign.structure.splay import EndGuy
from netdesign.study.member_force import RowForces
from netdesign.study.pulls import ANCHORS, find_pull, lack_sharing
from netdesign.study.sideways import place_row
from netdesign.study.support_records import PullRecord
from netdesign.words.message import Message, say
from netdesign.words.names import name_member

_POSTS = 3  # beside each other: whatever comes near does so among them


def check_anchor_distance(known: RowForces, gap: Message | None) -> Check | None:
    """Check how near the anchors of a row come to each other in the ground.

    Nearer than the profile says is not proven: a test of the group may show it. None
    without any pull.
    """
    row, pulls, ranges = known.row, known.pulls, known.site.ranges
    limit = known.standard.find(ANCHOR_DISTANCE)
    if not pulls:
        return None
    if limit is None:
        lack = say("check.no_limit", limit=ANCHOR_DISTANCE)
        return leave_open("anchors", OpenKind.RESISTANCE_MISSING, lack)
    gap = gap or _find_lack(row, pulls)
    ends = ranges["inclination"]
    places = [place_row(row, one) for one in (ends.low, ends.high)]
    pairs = (_list_nearest(row, ranges, place, pulls) for place in places)
    # of equal distances the first: a millionth is rounding
    least, anchors = min(chain(*pairs), key=lambda one: round(one[0], 6))
    is_apart = least >= limit.value
    key = "bores.apart" if is_apart else "bores.near"
    reason = say(key, least=least, limit=limit.value, anchors=anchors)
    if gap is None and is_apart:
        return compare("anchors", Verdict.PASS, reason, limit)
    found = compare("anchors", Verdict.NOT_PROVEN, None, limit)
    return found.with_open(OpenKind.UNSOLVED, gap or reason)


def _list_nearest(
    row: NetRow, ranges: Ranges, points: SupportPoints, pulls: Sequence[PullRecord]
) -> Iterator[tuple[float, tuple[Message, Message]]]:
    """Least distances of two kinds of anchors [m], in the row and to a row above."""
    upslope = row.upslope_length
    if "upslope_length" in ranges.further:
        upslope = ranges["upslope_length"].low
    of_row: dict[str, list[Bore]] = {}
    for anchor, bore in _list_beside(row, points, pulls):
        of_row.setdefault(anchor, []).append(bore)
    for (one, bores), (other, others) in product(of_row.items(), repeat=2):
        named = (name_member(one), name_member(other))
        if one == other:
            yield find_least_distance(bores), named
        elif one < other:
            distances = (measure_distance(*pair) for pair in product(bores, others))
            yield min(distances), named
        if row.has_row_above:
            there = say("bores.of_row_above", anchor=named[1])
            yield find_distance_to_row_above(bores, others, upslope), (named[0], there)


def _list_beside(
    row: NetRow, points: SupportPoints, pulls: Sequence[PullRecord]
) -> Iterator[tuple[str, Bore]]:
    """Anchors of some posts beside each other, from the row's end on."""
    for anchor, bore in place_anchors(row, points, pulls):
        x, y, z = bore.start
        for post in range(_POSTS):
            place = (x, y, z + post * row.layout.post_spacing)
            yield anchor, replace(bore, start=place)
    yield from place_end_anchors(row, points, pulls)


def place_end_anchors(
    row: NetRow, points: SupportPoints, pulls: Sequence[PullRecord]
) -> Iterator[tuple[str, Bore]]:
    """Anchors beyond the first post: of its outer guys, lateral, of the end guy.

    Along the row they lie before that post. Those whose places nobody gives are none.
    """
    if row.guys.count > 1 and row.guys.are_shared:
        for anchor, bore in place_anchors(row, points, pulls):
            if anchor != Member.FOOT_ANCHOR:
                x, y, z = bore.start
                yield anchor, replace(bore, start=(x, y, -z))
    end = row.row_end
    if end is None or end.lateral_distance is None or end.lateral_axis is None:
        return
    drilled = {one.member: one.drilled_length for one in end.resistances}
    guy, axis = end.guy or EndGuy(angle=0.0), end.lateral_axis
    sideways = (0.0, -math.sin(axis), -math.cos(axis))
    for member, start, way in (
        (EndMember.LATERAL_ANCHOR, (0.0, 0.0, -end.lateral_distance), sideways),
        (EndMember.END_GUY_ANCHOR, guy.find_anchor(points), guy.find_way(points)),
    ):
        yield member, Bore(start=start, direction=way, length=drilled.get(member))


def check_cover(known: RowForces, gap: Message | None) -> Check | None:
    """Check the ground around the bonds against what the geotechnical engineer asks.

    None where the profile leaves it to others, or without any pull.
    """
    row, pulls = known.row, known.pulls
    if "anchor_ground" in known.standard.not_checked or not pulls:
        return None
    unsaid = dict.fromkeys(
        name
        for one in pulls
        for name in row.list_unsaid_cover(one.anchor, one.position)
    )
    if unsaid:
        gap = say("check.unsaid", names=tuple(unsaid))
    elif any(not one.is_axis_known for one in pulls):
        gap = gap or say("bending.no_axis")
    short = None if unsaid else next(_list_short(row, pulls), None)
    if short is not None:
        return compare("cover", Verdict.FAIL, short)
    if gap is not None:
        return leave_open("cover", OpenKind.UNSOLVED, gap)
    return compare("cover", Verdict.PASS, say("bores.covered"))


def _list_short(row: NetRow, pulls: Sequence[PullRecord]) -> Iterator[Message]:
    """Anchors whose bond lies too near to the surface, or to an edge."""
    for pull in pulls:
        kind = row.find_anchor_type(pull.anchor, pull.position)
        if kind is None:
            continue
        told = {"anchor": name_member(pull.anchor)}
        cover, least = kind.find_cover(pull.axis), kind.least_cover or 0.0
        if cover < least:
            yield say("bores.too_shallow", **told, cover=cover, least=least)
        edge, least = row.edge_distance or 0.0, kind.least_edge or 0.0
        if edge < least:
            yield say("bores.too_near_edge", **told, edge=edge, least=least)


def _find_lack(row: NetRow, pulls: Sequence[PullRecord]) -> Message | None:
    if any(not one.is_axis_known for one in pulls):
        return say("bending.no_axis")
    names = row.row_end.list_unsaid_places() if row.row_end else ()
    of_end = say("check.unsaid", names=names) if names else None
    return lack_sharing(row.guys) or of_end


def place_anchors(
    row: NetRow, points: SupportPoints, pulls: Sequence[PullRecord]
) -> Iterator[tuple[Member, Bore]]:
    """Anchors of a post, of the panel behind it, and which each of them is.

    The axes are those of the slope at the net's foot of that post.
    """
    for anchor in ANCHORS:
        pull = find_pull(pulls, anchor, "intermediate")
        is_foot = row.layout.is_foot_shared and anchor == Member.UPHILL_ANCHOR
        if is_foot or pull is None:
            continue
        place = points.find_anchor(anchor)[0]
        heading = -1.0 if anchor == Member.DOWNHILL_ANCHOR else 1.0
        flat = math.cos(pull.axis)
        kind = row.find_anchor_type(anchor)
        for aside, turned in _spread(row, points, anchor):
            direction = (
                -heading * flat * math.cos(turned),
                -math.sin(pull.axis),
                flat * math.sin(turned),
            )
            length = kind.drilled if kind else None
            yield (
                anchor,
                Bore(start=(place, 0.0, aside), direction=direction, length=length),
            )


def _spread(
    row: NetRow, points: SupportPoints, anchor: Member
) -> Iterator[tuple[float, float]]:
    """Places beside a post, and turns out of the section, of one anchor's kind.

    Lengths along the row [m], angles from the section in the slope's plane [rad].
    """
    half = 0.5 * row.layout.post_spacing
    if anchor == Member.FOOT_ANCHOR:
        yield 0.0, 0.0
        if any(one.has_mid_anchors for one in row.panels):
            yield half, 0.0
        return
    splay = row.guys.splay or 0.0
    if row.guys.count == 1 or not splay:
        yield 0.0, 0.0
    elif row.guys.are_shared:
        yield half, 0.0
    else:
        reach = points.head[0] - points.find_anchor(anchor)[0]
        aside = math.hypot(reach, points.head[1]) * math.tan(splay)
        turned = math.atan2(aside, abs(reach))
        yield aside, turned
        yield -aside, -turned
