"""One list of everything that a verdict on a net row still lacks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import chain

from netdesign.resistance.connection import Link
from netdesign.site.columns.all_tables import ANCHORS, ENDS, NETS, POSTS, ROPES
from netdesign.site.columns.fields import SheetPlan
from netdesign.site.model import CONNECTED, LIFTED_MODE, NAMED_BY, NetRow, Resistance
from netdesign.structure.members import Member
from netdesign.words.message import Message, say

_SHEET_BY_MODE = {"rope": ROPES, "compression": POSTS, "bearing": POSTS}


def list_missing(
    row: NetRow, links: Mapping[str, tuple[Link, ...]]
) -> tuple[Message, ...]:
    """Names of columns and sheets that a verdict on a net row lacks, each once.

    Parameters
    ----------
    row : NetRow
        As read.
    links : mapping of str to tuple of Link
        Chains of sheet Links, by type.
    """
    found = chain(
        row.unsaid,
        _list_of_row(row),
        _list_of_types(row),
        _list_chains(row, links),
        _list_of_end(row),
    )
    return tuple(dict.fromkeys(found))


def _list_of_row(row: NetRow) -> Iterator[Message]:
    if row.panel is not None:
        yield from row.panel.assumed
    if not row.drills_along_pull and any(
        row.find_axis(anchor) is None for anchor, _ in row.anchors
    ):
        yield _name(NETS, "anchor_axes")
    for anchor, _ in row.anchors:
        yield from row.list_unsaid_cover(anchor, "intermediate")
    may_be_two = row.guys.count > 1 or _name(NETS, "guy_count") in row.unsaid
    if may_be_two and row.guys.are_shared is None:
        yield _name(NETS, "guy_anchors")


def _list_of_types(row: NetRow) -> Iterator[Message]:
    """Types that no column names, and what those that are named do not say."""
    for one in (*row.resistances, *row.net_parts):
        if one.mode == "mesh":
            yield from () if one.basis else (_name(NETS, "mesh_strength"),)
        elif not one.type_id:
            is_own = one.member not in NAMED_BY
            yield _name(NETS, one.member if is_own else NAMED_BY[Member(one.member)])
        elif (one.member, one.mode) == LIFTED_MODE:
            pass  # asked for once some case lifts a post
        elif one.value is None and not (one.tests or one.dimensions):
            yield from _list_lacking(row, one)
        yield from (*row.list_unsaid_grounds(one), *row.list_unsaid_wear(one))


def _list_chains(
    row: NetRow, links: Mapping[str, tuple[Link, ...]]
) -> Iterator[Message]:
    """Types of ropes and anchors whose links nobody gives."""
    at_end = (*(row.end_resistances or ()), *_list_along(row))
    for one in (*row.resistances, *row.net_parts, *at_end):
        is_rope = one.mode in ("rope", "tendon") and one.member in CONNECTED
        if is_rope and one.type_id and one.type_id not in links:
            yield say("links.of_type", type=one.type_id)


def _list_lacking(row: NetRow, one: Resistance) -> Iterator[Message]:
    names = one.lack.arguments.get("names", ()) if one.lack else ()
    if one.mode == "bending":
        anchor = row.find_anchor_type(Member(one.member))
        if anchor is None or not anchor.kind:
            yield _name(ANCHORS, "kind")
        yield _name(ANCHORS, "lever_arm")
    elif one.mode == "sliding":
        yield _name(POSTS, "base_friction")
    elif isinstance(names, tuple) and names:
        yield from (one for one in names if isinstance(one, Message))
    elif one.lack is not None and one.lack.key == "type.sleeve_unsaid":
        yield _name(ANCHORS, "sleeve")
    else:
        yield _name(_SHEET_BY_MODE.get(one.mode, ANCHORS), one.mode)


def _list_of_end(row: NetRow) -> Iterator[Message]:
    at_end = (*(row.end_resistances or ()), *_list_along(row))
    if any(one.source == ENDS.name for one in at_end):
        yield say("check.unsaid_ends")
    elif row.row_end is not None:
        yield from row.row_end.list_unsaid_places()


def _list_along(row: NetRow) -> tuple[Resistance, ...]:
    return row.row_end.resistances if row.row_end else ()


def _name(plan: SheetPlan, key: str) -> Message:
    return next(one.name for one in plan.fields if one.key == key)
