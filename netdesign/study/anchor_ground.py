"""Anchors of a row in the ground, how near they come, and what ground they lift."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from netdesign.checks import Check, OpenKind
from netdesign.checks.comparison import compare, lack_factor, leave_open
from netdesign.checks.schema import ANCHOR_DISTANCE, SOIL_COHESION, SOIL_FRICTION
from netdesign.envelope.ranges import Ranges
from netdesign.outcome import Verdict
from netdesign.resistance.ground import (
    AnchorType,
    Soil,
    WedgeResistance,
    compute_cone_resistance,
    compute_slab_stability,
    compute_wedge_resistance,
)
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.anchors import turn_by_splay
from netdesign.structure.layout import SupportPoints
from netdesign.structure.members import END_ANCHORS, EndMember, Member
from netdesign.structure.row_position import (
    Bore,
    find_nearest,
    measure_in_row,
    measure_to_row_above,
)
from netdesign.study.anchor_pulls import ANCHORS, GUY_ANCHORS, find_pull
from netdesign.study.case_records import PullRecord
from netdesign.study.load_along_row import place_row
from netdesign.study.member_force import RowForces
from netdesign.study.row_to_check import Basis
from netdesign.units import degree_from_radian
from netdesign.words.catalogue import name_member
from netdesign.words.message import Message, say

_POSTS = 3  # beside each other: whatever comes near does so among them


def check_anchor_distance(
    forces: RowForces, open_cases: Message | None
) -> Check | None:
    """Check the least distance between the anchors of a row in the ground.

    A distance below the profile's limit is not proven, since a test of the group may
    show that it holds. The check is left out where no anchor is pulled.
    """
    row, pulls, ranges = forces.row, forces.pulls, forces.site.ranges
    limit = forces.standard.find(ANCHOR_DISTANCE)
    if not pulls:
        return None
    if limit is None:
        reason = say("check.no_limit", limit=ANCHOR_DISTANCE)
        return leave_open("anchors", OpenKind.RESISTANCE_MISSING, reason)
    ends = ranges["inclination"]
    places = [place_row(row, inclination) for inclination in (ends.low, ends.high)]
    nearest = (
        _find_nearest(each, ranges, place, pulls)
        for place in places
        for each in _list_sharings(row)
    )
    # of equal distances the first: a millionth is rounding
    least, members, is_above = min(nearest, key=lambda pair: round(pair[0], 6))
    is_apart = least >= limit.value
    key = "bores.apart" if is_apart else "bores.near"
    first, second = members if is_above else sorted(members)
    anchors = (name_member(first), name_member(second))
    if is_above:
        anchors = (anchors[0], say("bores.of_row_above", anchor=anchors[1]))
    named = tuple(dict.fromkeys(anchors))
    names = () if is_apart else _list_unsaid(forces)
    if names:
        key = "bores.near_unsaid"
    reason = say(key, least=least, limit=limit.value, anchors=named, names=names)
    if open_cases is None and is_apart:
        return compare("anchors", Verdict.PASS, reason, limit)
    near = compare("anchors", Verdict.NOT_PROVEN, None, limit)
    return near.with_open(OpenKind.UNSOLVED, open_cases or reason)


def _list_unsaid(forces: RowForces) -> tuple[Message, ...]:
    """Names of what nobody says of the bores, and what may bring them apart."""
    row = forces.row
    lengths = (
        name
        for pull in forces.pulls
        for name in row.list_missing_bore(pull.anchor, pull.position)
    )
    open_keys = (row.find_assumed(key) for key in ("guy_anchors", "upslope_length"))
    return (*dict.fromkeys(lengths), *(each.name for each in open_keys if each))


def _list_sharings(row: NetRow) -> list[NetRow]:
    """List the row with shared and with own guy anchors where neither is given."""
    ways = (True, False) if row.guys.are_shared is None else (row.guys.are_shared,)
    return [replace(row, guys=replace(row.guys, are_shared=way)) for way in ways]


def _find_nearest(
    row: NetRow, ranges: Ranges, points: SupportPoints, pulls: Sequence[PullRecord]
) -> tuple[float, tuple[str, str], bool]:
    """Least distance of two anchors [m], whose it is, and whether to the row above."""
    upslope = row.upslope_length
    if "upslope_length" in ranges.further:
        upslope = ranges["upslope_length"].low
    members, bores = zip(*_list_beside(row, points, pulls), strict=True)
    distances = [(False, measure_in_row(bores))]
    if row.has_row_above:
        distances.append((True, measure_to_row_above(bores, upslope)))
    nearest = []
    for is_above, apart in distances:
        first, second = find_nearest(apart)
        of_members = (members[first], members[second])
        nearest.append((float(apart[first, second]), of_members, is_above))
    return min(nearest, key=lambda pair: round(pair[0], 6))


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
    """List the anchors beyond the first post: outer guys and end guy.

    They lie before that post along the row. Where the lateral anchor stands is not
    known: its distance is a condition.
    """
    if row.guys.count > 1 and row.guys.are_shared:
        for anchor, bore in place_anchors(row, points, pulls):
            if anchor != Member.FOOT_ANCHOR:
                x, y, z = bore.start
                yield anchor, replace(bore, start=(x, y, -z))
    end, member = row.row_end, EndMember.END_GUY_ANCHOR
    pull = find_pull(pulls, member, "edge")
    if end is None or pull is None:
        return
    kind = end.find_anchor_type(member)
    start, length = end.guy.find_anchor(points), kind.drilled if kind else None
    yield member, Bore(start=start, direction=pull.way, length=length)


def check_cover(forces: RowForces) -> Check | None:
    """Check that the bores stay in the ground; None where all of them do.

    How much ground is enough around a bond is a condition, see `study/conditions.py`.
    The check is left out where the profile leaves the ground to others; an anchor
    without a type may lie as badly as any.
    """
    row, pulls = forces.row, forces.pulls
    if "anchor_ground" in forces.standard.not_checked:
        return None
    for bond in list_bonds(row, pulls):
        if bond.cover is not None and bond.leaves_ground:
            named = name_member(bond.anchor)
            told = say("bores.leaves_ground", anchor=named, height=-bond.cover)
            return compare("cover", Verdict.FAIL, told)
    untyped = next(filter(partial(_has_no_type, row), pulls), None)
    if untyped is None:
        return None
    lack = say("bores.no_type", anchor=name_member(untyped.anchor))
    return leave_open("cover", OpenKind.RESISTANCE_MISSING, lack)


@dataclass(frozen=True, slots=True, kw_only=True)
class BondInGround:
    """Bond of one anchor, and the ground above it.

    Attributes
    ----------
    anchor : Member or EndMember
        Which it is.
    cover : float or None
        Ground above the bond's middle, normal to the slope [m]; None where no length
        is given.
    length : float or None
        Of the bore, or of the bond alone [m]; None where neither is given.
    has_soil : bool
        The strength of the ground is given: its wedge is checked instead of a cover.
    """

    anchor: Member | EndMember
    cover: float | None
    length: float | None
    has_soil: bool

    @property
    def leaves_ground(self) -> bool:
        """The bore runs above the surface: nothing holds its bond."""
        return self.cover is not None and self.cover <= 0.0


def _has_no_type(row: NetRow, pull: PullRecord) -> bool:
    return row.find_anchor_type(pull.anchor, pull.position) is None


def list_bonds(row: NetRow, pulls: Sequence[PullRecord]) -> list[BondInGround]:
    """Bonds of those anchors of a row whose types are given."""
    bonds = []
    for pull in pulls:
        kind = row.find_anchor_type(pull.anchor, pull.position)
        if kind is None:
            continue
        length = kind.drilled or kind.bond
        cover = min(map(kind.find_cover, _list_axes(row, pull))) if length else None
        bond = BondInGround(
            anchor=pull.anchor,
            cover=cover,
            length=length,
            has_soil=kind.soil is not None,
        )
        bonds.append(bond)
    return bonds


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
        if any(panel.has_mid_anchors for panel in row.panels):
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


def find_ground_resistance(
    resistance: Resistance,
    anchor: AnchorType,
    soil: Soil,
    basis: Basis,
    pull: PullRecord | None,
) -> Resistance:
    """Resistance of the weakest wedge of ground in front of an anchor's bond.

    Theory: resistance/THEORY.md, (R18) to (R20) and (R30).
    """
    row, standard = basis.row, basis.standard
    on_cohesion, on_friction = map(standard.find, (SOIL_COHESION, SOIL_FRICTION))
    if on_cohesion is None or on_friction is None:
        key = SOIL_FRICTION if on_cohesion else SOIL_COHESION
        return replace(resistance, lack=lack_factor(key))
    if pull is None:
        return resistance
    depths = [x for axis in _list_axes(row, pull) for x in anchor.list_depths(axis)]
    if not depths:
        names = row.list_missing_bore(pull.anchor, pull.position)
        return replace(resistance, lack=say("check.unsaid", names=names))
    if not min(depths) > 0.0:
        return replace(resistance, lack=say("wedge.no_depth"))
    reduced = soil.reduce(on_cohesion.value, on_friction.value)
    numbers: dict[str, float | Message] = {
        "cohesion": soil.cohesion / 1e3,
        "friction": degree_from_radian(soil.friction),
        "weight": soil.weight / 1e3,
        "on_cohesion": on_cohesion.value,
        "on_friction": on_friction.value,
        "water": say("wedge.drained" if soil.is_drained else "wedge.seepage"),
    }
    stability = compute_slab_stability(reduced, max(depths), row.slope_angle)
    if stability < 1.0:
        numbers |= {"depth": max(depths), "stability": stability}
        return replace(resistance, lack=say("wedge.slab", **numbers))
    width = _find_ground_width(row, pull)
    wedges = {
        depth: _lift_ground(reduced, basis.row, pull, depth, width) for depth in depths
    }
    depth = min(wedges, key=lambda each: wedges[each].value)
    plane = degree_from_radian(wedges[depth].plane)
    numbers |= {"depth": depth, "width": width, "plane": plane}
    key = "wedge.lifts_cone" if pull.anchor in END_ANCHORS else "wedge.lifts"
    return replace(
        resistance, value=wedges[depth].value, derivation=say(key, **numbers)
    )


def _list_axes(row: NetRow, pull: PullRecord) -> tuple[float, ...]:
    """List the axes that an anchor may have [rad], shared by two guys or one for each.

    Where the workbook does not say whether two guys share it, both count.
    """
    may_be_own = row.guys.count > 1 and row.guys.are_shared is None
    if pull.is_axis_given or not may_be_own or pull.anchor not in GUY_ANCHORS:
        return (pull.axis,)
    return pull.axis, turn_by_splay(pull.axis, row.guys.splay or 0.0)


def _lift_ground(
    soil: Soil, row: NetRow, pull: PullRecord, depth: float, width: float
) -> WedgeResistance:
    """Compute the wedge that an anchor lifts, or the cone about a single anchor."""
    slope, guy = row.slope_angle, row.row_end.guy if row.row_end else None
    if pull.anchor not in END_ANCHORS:
        return compute_wedge_resistance(
            soil,
            depth=depth,
            width=width,
            slope=-slope if pull.anchor == Member.DOWNHILL_ANCHOR else slope,
            least_pull=pull.pulls.least,
            largest_pull=pull.pulls.largest,
        )
    x, y, z = (0.0, 0.0, -1.0)  # of the lower rope
    if pull.anchor == EndMember.END_GUY_ANCHOR and guy is not None:
        x, y, z = guy.way
    return compute_cone_resistance(soil, depth=depth, slope=slope, pull=(-x, -y, -z))


def _find_ground_width(row: NetRow, pull: PullRecord) -> float:
    """Width of ground that one anchor has along the row [m]."""
    if pull.anchor == Member.FOOT_ANCHOR:
        is_doubled = any(panel.has_mid_anchors for panel in row.panels)
    else:
        is_doubled = row.guys.count > 1 and not row.guys.are_shared
    return row.layout.post_spacing / (2.0 if is_doubled else 1.0)
