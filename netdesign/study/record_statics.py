"""Statics of the cases that bring the largest forces, so that they can be redone."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import Any, TypeVar

from netdesign.coupling.solution import EndPull
from netdesign.envelope.panel_forces import PANEL_QUANTITIES, PanelForces
from netdesign.envelope.run import CaseResult
from netdesign.guideline.comparison import hold_net, place_head
from netdesign.guideline.floor import SPANS, Floor, FloorForce
from netdesign.site.model import NetRow
from netdesign.structure.anchors import AnchorForces
from netdesign.structure.axis import measure_pull
from netdesign.structure.layout import place_support
from netdesign.structure.members import Member, NetPart, RopeForce
from netdesign.study.case_records import GuidelineLoadRecord
from netdesign.study.record_envelope import record_point
from netdesign.study.record_guideline import list_load
from netdesign.study.row_to_check import RowToCheck
from netdesign.study.sideways import SupportState, list_states
from netdesign.study.support_records import StaticsRecord
from netdesign.units import kilonewton_from_newton

_State = TypeVar("_State")  # state of a row


def record_statics(task: RowToCheck, floor: Floor | None) -> list[StaticsRecord]:
    """States of a row that bring its largest forces: solved cases, then the floor's.

    A member that is slack in every state is left out.
    """
    return [*_record_cases(task), *_record_floor(floor)]


def _record_cases(task: RowToCheck) -> Iterable[StaticsRecord]:
    row = task.row
    found = [
        (key, state)
        for key, one in task.extremes.items()
        if one.force.value > 0.0 and key not in (*RopeForce, NetPart.MESH)
        for state in _find_state(row, key, one.governing)
    ]
    every = (state for one in task.solved.results for state in list_states(row, one))
    if states := sorted(every, key=lambda one: one.panel is not None):
        found += [
            (key, max(states, key=lambda one: _measure(one)[key])) for key in SPANS
        ]
    for state, keys in _group(found, lambda one: (one.result, one.panel)):
        if state.foot is not None:
            yield _record_state(keys, state, None)


def _find_state(row: NetRow, member: str, result: CaseResult) -> Iterator[SupportState]:
    """The case at rest or followed in time, whichever brings the member's force."""
    both, panel = result.compared, None
    if member in PANEL_QUANTITIES and isinstance(result.panel, PanelForces):
        panel = result.panel.find_worst(member)
    elif both is not None:
        result = both.history if both.exceeds(member) else both.steady
    return (one for one in list_states(row, result) if one.panel is panel)


def _measure(state: SupportState) -> dict[str, float]:
    """Sizes of a state of which the largest counts, by the keys `SPANS`."""
    foot = state.anchors.foot_anchor
    turn = measure_pull(foot.x, foot.y, Member.FOOT_ANCHOR)
    sizes = (state.pull, -state.tension, -turn, turn)
    return dict(zip(SPANS, sizes, strict=True))


def _group(
    found: Iterable[tuple[str, _State]], identify: Callable[[_State], Hashable]
) -> Iterable[tuple[_State, list[str]]]:
    """States in the order of what they bring, each with all of it."""
    groups: dict[Hashable, tuple[_State, list[str]]] = {}
    for key, state in found:
        _, keys = groups.setdefault(identify(state), (state, []))
        keys.append(key)
    return groups.values()


def _record_floor(floor: Floor | None) -> Iterable[StaticsRecord]:
    found = [
        (one.member, one)
        for one in ((*floor.forces, *floor.spans) if floor else ())
        if one.member in SPANS or one.force != 0.0
    ]
    for state, keys in _group(found, lambda one: (one.at, one.case)):
        yield _record_floor_state(state, keys)


def _record_floor_state(state: FloorForce, keys: list[str]) -> StaticsRecord:
    net = state.at.net
    foot, head = state.pull.foot, state.pull.head
    anchors = hold_net(net, state.pull)
    if not isinstance(anchors, AnchorForces):  # the floor has held it before
        raise TypeError("a state of the floor has no equilibrium")
    pulls = SupportState(
        points=place_support(net.layout, place_head(net)),
        anchors=anchors,
        foot=EndPull(x=foot[0], y=foot[1], error=0.0),
        head=EndPull(x=head[0], y=head[1], error=0.0),
    )
    return _record_state(keys, pulls, _record_load(state))


def _record_load(state: FloorForce) -> GuidelineLoadRecord:
    net, case, load = state.at.net, state.case, state.load
    filled = case.height_vertical * math.cos(net.slope_angle) / net.net_height
    return GuidelineLoadRecord(
        rigid_kN_per_m=kilonewton_from_newton(load.rigid),
        parallel_kN_per_m=kilonewton_from_newton(load.parallel),
        normal_kN_per_m=kilonewton_from_newton(load.normal),
        prism_kN_per_m=kilonewton_from_newton(load.prism),
        loaded_share=min(1.0, filled),
        **list_load(state),
    )


def _record_state(
    keys: list[str], state: SupportState, load: GuidelineLoadRecord | None
) -> StaticsRecord:
    foot, head, points, anchors = state.foot, state.head, state.points, state.anchors
    if foot is None or head is None:
        raise TypeError("a state without pulls has no statics")
    return StaticsRecord(
        brings=keys,
        case=record_point(state.result.case) if state.result else None,
        load=load,
        foot_x_kN_per_m=kilonewton_from_newton(foot.x),
        foot_y_kN_per_m=kilonewton_from_newton(foot.y),
        foot_error_kN_per_m=kilonewton_from_newton(foot.error),
        head_x_kN_per_m=kilonewton_from_newton(head.x),
        head_y_kN_per_m=kilonewton_from_newton(head.y),
        head_error_kN_per_m=kilonewton_from_newton(head.error),
        head_x_m=points.head[0],
        head_y_m=points.head[1],
        base_x_m=points.post_base[0],
        uphill_x_m=points.uphill_anchor[0],
        downhill_x_m=points.downhill_anchor[0],
        **show_forces(anchors),
        is_by_panel=state.panel is not None,
        mid_foot_kN=kilonewton_from_newton(math.hypot(*state.mid_foot)),
    )


def show_forces(anchors: AnchorForces) -> dict[str, Any]:
    """Forces in the members of a state, by the keys of a ``StaticsRecord``."""
    uphill, downhill = anchors.head.guy_demands
    forces = {
        Member.FOOT_ANCHOR: anchors.foot_anchor.size,
        Member.UPHILL_GUY: uphill,
        Member.DOWNHILL_GUY: downhill,
        Member.POST: anchors.head.post_compression,
        Member.POST_BASE: max(-anchors.post_base.y, 0.0),
        Member.POST_FOOT: anchors.head.post_tension,
    }
    return {f"{key}_kN": kilonewton_from_newton(one) for key, one in forces.items()}
