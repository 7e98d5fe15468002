"""Statics of the governing states: members' forces from the net's pulls."""

from __future__ import annotations

import math
from collections.abc import Iterator

from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.layout import SupportPoints
from netdesign.structure.members import Member, RopeForce, name_in_panel
from netdesign.study.records import RowStudy
from netdesign.study.rejudge.compare import Pair, report_unequal
from netdesign.study.support_records import StaticsRecord
from netdesign.words.message import Message, say
from netdesign.words.names import name_member


def rejudge_statics(row: RowStudy) -> Iterator[Message]:
    """Sentences on states whose forces do not follow, or are not those of the checks.

    Of steady states only: the forces of a history need not be of one instant.
    """
    spacing = _read_spacing(row)
    if spacing is None or not row.forces:
        return
    place = say("audit.row", row=row.id)
    for number, state in enumerate(row.statics):
        where = say("audit.statics", place=place, number=number)
        yield from report_unequal(where, _follow(state, spacing))
    yield from _rejudge_largest(place, row)
    yield from _rejudge_sideways(place, row, spacing)


def _read_spacing(row: RowStudy) -> float | None:
    """Post spacing that was read [m]."""
    label = say("column.Nets.post_spacing")
    found = [echo.value for echo in row.inputs if echo.label == label]
    return next((one for one in found if isinstance(one, float)), None)


def _follow(state: StaticsRecord, spacing: float) -> list[Pair]:
    """Stored forces beside those that follow from the pulls: (S1) to (S8)."""
    points = SupportPoints(
        net_foot=(0.0, 0.0),
        head=(state.head_x_m, state.head_y_m),
        post_base=(state.base_x_m, 0.0),
        uphill_anchor=(state.uphill_x_m, 0.0),
        downhill_anchor=(state.downhill_x_m, 0.0),
    )
    found = compute_anchor_forces(
        points,
        foot_pull_per_m=(state.foot_x_kN_per_m, state.foot_y_kN_per_m),
        head_pull_per_m=(state.head_x_kN_per_m, state.head_y_kN_per_m),
        post_spacing=spacing,
    )
    if not isinstance(found, AnchorForces):
        return [("post_kN", state.post_kN, None)]
    head = found.head
    return [
        ("foot_anchor_kN", state.foot_anchor_kN, found.foot_anchor.size),
        ("uphill_guy_kN", state.uphill_guy_kN, head.uphill_guy_tension),
        ("downhill_guy_kN", state.downhill_guy_kN, head.downhill_guy_tension),
        ("post_kN", state.post_kN, head.post_compression),
        ("post_base_kN", state.post_base_kN, max(-found.post_base.y, 0.0)),
    ]


def read_state(state: StaticsRecord, member: str) -> float:
    """Force of a state in one member [kN]; one anchor of net and guy has both.

    NaN where the state is by the section and the force by the panel, or the other way.
    """
    by_panel = name_in_panel("")
    is_of_panel = member.startswith(by_panel)
    if is_of_panel is not state.is_by_panel:
        return math.nan
    member = member.removeprefix(by_panel)
    is_shared = state.uphill_x_m == 0.0
    if is_of_panel and member == Member.FOOT_ANCHOR:
        guy = state.uphill_guy_kN if is_shared else 0.0
        return max(state.foot_anchor_kN + guy, state.mid_foot_kN)
    if is_shared and member in (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR):
        return state.foot_anchor_kN + state.uphill_guy_kN
    forces = {
        Member.FOOT_ANCHOR: state.foot_anchor_kN,
        Member.UPHILL_GUY: state.uphill_guy_kN,
        Member.UPHILL_ANCHOR: state.uphill_guy_kN,
        Member.DOWNHILL_GUY: state.downhill_guy_kN,
        Member.DOWNHILL_ANCHOR: state.downhill_guy_kN,
        Member.POST: state.post_kN,
        Member.POST_BASE: state.post_base_kN,
    }
    return forces[Member(member)]


def _rejudge_largest(place: Message, row: RowStudy) -> Iterator[Message]:
    """Each largest force stands in the state that is said to bring it."""
    ropes = tuple(RopeForce)
    solved = {one.quantity: one.value_kN for one in row.forces}
    solved = {name: force for name, force in solved.items() if name not in ropes}
    least = {
        one.member: one.force_kN for one in (row.floor.forces if row.floor else ())
    }
    for key, wanted, states in (
        ("value_kN", solved, [one for one in row.statics if one.load is None]),
        ("force_kN", least, [one for one in row.statics if one.load is not None]),
    ):
        for member, force in wanted.items():
            if not force:
                continue
            found = [read_state(one, member) for one in states if member in one.brings]
            where = say("audit.part", place=place, part=name_member(member))
            yield from report_unequal(
                where, [(key, force, found[0] if len(found) == 1 else None)]
            )


def _lacks_altitude(row: RowStudy) -> bool:
    """Note of the row that its altitude is not known."""
    told = (one for one in row.notes if isinstance(one, Message))
    return any(one.key == "row.altitude_assumed" for one in told)


def _rejudge_sideways(
    place: Message, row: RowStudy, spacing: float
) -> Iterator[Message]:
    """The pull and the tension by which the load along the row is shared."""
    held = row.held_sideways
    if held is None:
        return
    pulls = [
        spacing * math.hypot(one.head_x_kN_per_m, one.head_y_kN_per_m)
        for one in row.statics
        if "head_pull" in one.brings
    ]
    least = max(held.solved_tension_kN - held.hidden_tension_kN, 0.0)
    if held.floor_tension_kN is not None:
        least = min(least, held.floor_tension_kN)
    is_assumed = row.panel is not None and bool(row.panel.assumed)
    if is_assumed or (held.floor_tension_kN is not None and _lacks_altitude(row)):
        least = 0.0
    yield from report_unequal(
        place,
        [
            ("held_sideways.pull_kN", held.pull_kN, max(pulls, default=None)),
            ("held_sideways.least_tension_kN", held.least_tension_kN, least),
        ],
    )
