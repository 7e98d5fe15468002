"""Anchors that a net row is built of: how many of each type, how long."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import END_ANCHORS, Member
from netdesign.structure.row_position import Position
from netdesign.study.anchor_pulls import ANCHORS
from netdesign.study.member_force import is_shared

_ENDS = 2  # of a row


@dataclass(frozen=True, kw_only=True)
class PartRecord:
    """Anchors of one type in one place of a net row.

    Attributes
    ----------
    part : str
        Member that the anchor holds.
    type_id : str
        Empty where none is named.
    count : int or None
        None where neither the row's length nor its posts are given.
    size : float or None
        Length of one [m]; None where it is not given.
    """

    part: str
    type_id: str
    count: int | None
    size: float | None


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
