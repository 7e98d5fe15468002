"""Parts that a net row is built of: how many of each type, how long."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from netdesign.envelope.ranges import Interval
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.layout import SupportPoints
from netdesign.structure.members import Member, NetPart
from netdesign.structure.row_position import Position
from netdesign.study.load_along_row import place_row
from netdesign.study.member_force import is_shared

NET = "net"  # its size is an area
_BESIDE_GUYS = (
    *(Member.UPHILL_GUY, Member.UPHILL_ANCHOR),
    *(Member.DOWNHILL_GUY, Member.DOWNHILL_ANCHOR),
)
_PER_SUPPORT = (Member.FOOT_ANCHOR, *_BESIDE_GUYS, Member.POST)
_ENDS = 2  # of a row


@dataclass(frozen=True, kw_only=True)
class PartRecord:
    """Parts of one type in one place of a net row.

    Attributes
    ----------
    part : str
        A member, "mid_anchor", "ridge_rope", "lower_rope" or "net".
    type_id : str
        Empty where none is named, and of the net.
    count : int or None
        None where neither the row's length nor its posts are given.
    size : float or None
        Length of one [m], of the net its area [m2]; None where it is not given.
    """

    part: str
    type_id: str
    count: int | None
    size: float | None


def list_parts(row: NetRow, inclination: Interval) -> list[PartRecord]:
    """List the parts of a net row to be ordered.

    Parameters
    ----------
    row : NetRow
        Its length or number of posts gives the numbers.
    inclination : Interval
        Of the net, from the slope normal [rad]: the longest guys and the largest net.
    """
    heads = [
        place_row(row, inclined) for inclined in (inclination.low, inclination.high)
    ]
    counts: dict[tuple[str, str, float | None], int | None] = {}
    for position, supports in _count_supports(row):
        for counted in _list_of_support(row, heads, position, supports):
            key = (counted.part, counted.type_id, counted.size)
            before = counts.get(key, 0)
            is_known = counted.count is not None and before is not None
            counts[key] = (before or 0) + (counted.count or 0) if is_known else None
    of_supports = (
        PartRecord(part=part, type_id=kind, count=count, size=size)
        for (part, kind, size), count in counts.items()
    )
    return [*of_supports, *_list_along(row, inclination), *_list_ends(row)]


def _count_supports(row: NetRow) -> Iterator[tuple[Position, int | None]]:
    """Supports by position; the first and last ones alone where they differ."""
    count = row.post_count
    if row.end_resistances is None:
        yield "intermediate", count
        return
    yield "intermediate", None if count is None else max(0, count - _ENDS)
    yield "edge", None if count is None else min(_ENDS, count)


def _list_of_support(
    row: NetRow, heads: list[SupportPoints], position: Position, supports: int | None
) -> Iterator[PartRecord]:
    types = _index(row.resistances_at(position))
    for member in _PER_SUPPORT:
        if member not in types:
            continue
        yield PartRecord(
            part=member,
            type_id=types[member].type_id,
            count=_count(row, member, position, supports),
            size=_measure(row, member, heads) or types[member].drilled_length,
        )


def _count(
    row: NetRow, member: str, position: Position, supports: int | None
) -> int | None:
    """Number of a member at some supports; a shared anchor is one of both its posts.

    The end post counts the shared anchors between itself and the next post.
    """
    if supports is None:
        return None
    if not is_shared(row, member):
        return supports * (row.guys.count if member in _BESIDE_GUYS else 1)
    if row.guys.are_shared is None:
        return None
    if row.end_resistances is None:
        return supports + 1
    if position == "edge":
        return min(2 * supports, (row.post_count or 0) + 1)
    return max(0, supports - 1)


def _measure(row: NetRow, member: str, heads: list[SupportPoints]) -> float | None:
    """Measure the longest guy or post between its points [m]; None for anchors."""
    if member == Member.POST:
        return max(head.post_length for head in heads)
    if member not in (Member.UPHILL_GUY, Member.DOWNHILL_GUY):
        return None
    flat = max(math.dist(head.head, head.find_anchor(member)) for head in heads)
    return flat / math.cos(row.guys.splay or 0.0)


def _list_along(row: NetRow, inclination: Interval) -> Iterator[PartRecord]:
    """Net, border ropes, and foot anchors between the posts."""
    length, count = row.length, row.post_count
    built = row.net_height / math.cos(inclination.high)
    yield PartRecord(
        part=NET,
        type_id="",
        count=None if length is None else 1,
        size=None if length is None else length * built,
    )
    if not row.panels:
        return
    for part in (NetPart.RIDGE_ROPE, NetPart.LOWER_ROPE):
        yield PartRecord(
            part=part,
            type_id=row.find_net_part(part).type_id,
            count=None if length is None else 1,
            size=length,
        )
    if all(panel.has_mid_anchors for panel in row.panels):
        foot = _index(row.resistances)[Member.FOOT_ANCHOR]
        yield PartRecord(
            part="mid_anchor",
            type_id=foot.type_id,
            count=None if count is None else count - 1,
            size=foot.drilled_length,
        )


def _list_ends(row: NetRow) -> Iterator[PartRecord]:
    """Members that hold the row along itself; a row that goes on has none."""
    if row.row_end is None:
        return
    for member, resistance in _index(row.row_end.resistances).items():
        if resistance.type_id:
            size = resistance.drilled_length
            yield PartRecord(
                part=member, type_id=resistance.type_id, count=_ENDS, size=size
            )


def _index(resistances: Iterable[Resistance]) -> dict[str, Resistance]:
    first: dict[str, Resistance] = {}
    for resistance in resistances:
        first.setdefault(resistance.member, resistance)
    return first
