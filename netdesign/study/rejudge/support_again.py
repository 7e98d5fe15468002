"""Support of a stored net row again: its forces from the pulls that the row states."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

from netdesign.checks.schema import LATERAL_SHARE
from netdesign.outcome import ModelError
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.layout import Point, SupportPoints
from netdesign.structure.members import (
    BROUGHT_BY,
    Member,
    NetPart,
    RopeForce,
    name_in_panel,
)
from netdesign.study.case_records import CasePoint, CaseRecord, FloorRecord
from netdesign.study.judge import find_worst
from netdesign.study.record_independent import (
    DIRECTION,
    DIRECTION_ERRORS,
    LIMITS,
    is_law_met,
    measure_open_head,
)
from netdesign.study.record_statics import show_forces
from netdesign.study.record_support import list_arrows, record_anchors, record_head
from netdesign.study.records import IndependentRecord, RowStudy, Study, find_input
from netdesign.study.rejudge.stored import (
    GUY_OF,
    Fields,
    find_drawn,
    find_largest,
    is_of_steady_states,
    measure_pull,
)
from netdesign.study.support_records import StaticsRecord
from netdesign.units import newton_from_kilonewton
from netdesign.words.message import Message


def _hold(
    points: SupportPoints, foot: Point, head: Point, width: float = 1.0
) -> AnchorForces:
    """Forces on the ground that hold the net's pulls [kN], (S1) to (S6)."""
    on_foot, on_head = (
        (newton_from_kilonewton(x), newton_from_kilonewton(y)) for x, y in (foot, head)
    )
    found = compute_anchor_forces(
        points, foot_pull_per_m=on_foot, head_pull_per_m=on_head, post_spacing=width
    )
    if not isinstance(found, AnchorForces):
        raise ModelError(found.reason)
    return found


def follow_drawn(row: RowStudy, study: Study) -> Fields:
    """Forces on ground and head of the drawn case, from the two pulls of the net.

    Sizes of a history are the largest ones, and need not be of one instant.
    """
    drawing, drawn = row.drawing, find_drawn(row)
    if drawing is None or drawn is None:
        return {}
    foot, pull = row.anchors[0], row.head[0]
    points = SupportPoints(
        net_foot=(0.0, 0.0),
        head=drawing.head_m,
        post_base=drawing.post_base_m,
        uphill_anchor=drawing.uphill_anchor_m,
        downhill_anchor=drawing.downhill_anchor_m,
    )
    on_head = (pull.x_kN, pull.y_kN)
    found = _hold(points, (foot.force_x_kN, foot.force_y_kN), on_head)
    values = study.profile.values
    share = next((v.value for v in values if v.id == LATERAL_SHARE), 0.0)
    arrows = list_arrows(points, found)
    again = drawn
    if is_of_steady_states(study):
        again = _follow_sizes(row, drawn, is_shared=points.uphill_anchor == (0.0, 0.0))
    return {
        "anchors": record_anchors(found, share),
        "head": record_head(found.head_pull, found),
        "drawing": replace(drawing, case=_find_governing(row), arrows=arrows),
        "cases": [again if one is drawn else one for one in row.cases],
    }


def _find_governing(row: RowStudy) -> CasePoint:
    """Case that has to be drawn: of the largest utilisation, or of the foot's force."""
    worst = find_worst(row.checks)
    case = worst.case if worst else None
    return case or find_largest(row, Member.FOOT_ANCHOR).case


def _follow_sizes(row: RowStudy, drawn: CaseRecord, *, is_shared: bool) -> CaseRecord:
    """Forces of the drawn case from those on the ground; one anchor may carry two."""
    if len(row.anchors) != len(BROUGHT_BY) or row.anchors[-1].force_y_kN > 0.0:
        return drawn  # a post that pulls: its guys count as if its foot gave way
    foot, uphill, downhill, post = (one.size_kN for one in row.anchors)
    return replace(
        drawn,
        foot_anchor_kN=foot + uphill if is_shared else foot,
        uphill_guy_kN=uphill,
        downhill_guy_kN=downhill,
        post_kN=post,
    )


def follow_laws(row: RowStudy, _: Study) -> Fields:
    """Independent checks of the drawn case, as far as the study has their numbers."""
    drawn = find_drawn(row)
    if drawn is None:
        return {}
    return {"independent": [_follow_law(one, row, drawn) for one in row.independent]}


def _follow_law(
    law: IndependentRecord, row: RowStudy, drawn: CaseRecord
) -> IndependentRecord:
    limit, value = LIMITS.get(law.name, law.limit), law.value
    if law.name == "end_direction":
        limit = max(DIRECTION, DIRECTION_ERRORS * (drawn.error_percent or 0.0) / 100.0)
    if law.name == "global_balance":
        value = drawn.balance_residual
    if law.name == "head_balance":
        value = measure_open_head(row.head)
    is_met = is_law_met(law.name, law.value, law.limit)
    return replace(law, value=value, limit=limit, is_met=is_met)


def follow_statics(row: RowStudy, study: Study) -> Fields:
    """Forces of the states from their pulls, and the load along the row from them.

    Of steady states only: the forces of a history need not be of one instant.
    """
    spacing = find_input(row, "post_spacing")  # as it was read [m]
    if spacing is None or not row.forces or not is_of_steady_states(study):
        return {}
    statics = [_follow_state(one, spacing) for one in row.statics]
    return {"statics": statics, **_follow_sideways(row, spacing)}


def _follow_state(state: StaticsRecord, spacing: float) -> StaticsRecord:
    """State with the forces that follow from its pulls: (S1) to (S8)."""
    points = SupportPoints(
        net_foot=(0.0, 0.0),
        head=(state.head_x_m, state.head_y_m),
        post_base=(state.base_x_m, 0.0),
        uphill_anchor=(state.uphill_x_m, 0.0),
        downhill_anchor=(state.downhill_x_m, 0.0),
    )
    foot = (state.foot_x_kN_per_m, state.foot_y_kN_per_m)
    found = _hold(points, foot, (state.head_x_kN_per_m, state.head_y_kN_per_m), spacing)
    return replace(state, **show_forces(found))


def _follow_sideways(row: RowStudy, spacing: float) -> Fields:
    """The pull and the tension by which the load along the row is shared."""
    held = row.held_sideways
    if held is None:
        return {}
    pull = max(
        spacing * math.hypot(one.head_x_kN_per_m, one.head_y_kN_per_m)
        for one in row.statics
        if "head_pull" in one.brings
    )
    least = max(held.solved_tension_kN - held.hidden_tension_kN, 0.0)
    if held.floor_tension_kN is not None:
        least = min(least, held.floor_tension_kN)
    # without its panels an assumed one is not told; nothing of such a row is proven
    is_assumed = bool(row.panel.assumed if row.panel else row.unsaid)
    is_none = is_assumed and (row.panel is not None or held.least_tension_kN == 0.0)
    if is_none or (held.floor_tension_kN is not None and _lacks_altitude(row)):
        least = 0.0
    return {"held_sideways": replace(held, pull_kN=pull, least_tension_kN=least)}


def _lacks_altitude(row: RowStudy) -> bool:
    """Note of the row that its altitude is not known."""
    told = (one for one in row.notes if isinstance(one, Message))
    return any(one.key == "row.altitude_assumed" for one in told)


def follow_brought(row: RowStudy, study: Study) -> Fields:
    """Each largest force from the state that is said to bring it."""
    if not row.forces or not is_of_steady_states(study):
        return {}
    solved = [one for one in row.statics if one.load is None]
    by_load = [one for one in row.statics if one.load is not None]
    stateless = (*RopeForce, NetPart.MESH)
    forces = [
        one
        if one.quantity in stateless
        else replace(one, value_kN=_find_brought(one.quantity, solved))
        for one in row.forces
    ]
    return {"forces": forces, "floor": row.floor and _bring(row.floor, by_load)}


def _bring(floor: FloorRecord, states: Sequence[StaticsRecord]) -> FloorRecord:
    forces = [
        replace(one, force_kN=_find_brought(one.member, states))
        if one.force_kN
        else one
        for one in floor.forces
    ]
    return replace(floor, forces=forces)


def _find_brought(member: str, states: Iterable[StaticsRecord]) -> float:
    """Force of the state that brings it [kN]; 0 without one, NaN of several."""
    found = [_read_state(one, member) for one in states if member in one.brings]
    return math.nan if len(found) > 1 else sum(found)


def _read_state(state: StaticsRecord, member: str) -> float:
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
    if member == NetPart.MESH:  # under the guideline's load it is largest at an end
        return measure_pull(state)
    found: float = getattr(state, f"{GUY_OF.get(member, member)}_kN", math.nan)
    return found
