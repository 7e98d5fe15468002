"""All checks of one net row as records: interval, effects, what would change them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.checks import CheckResult, check_member, withhold
from netdesign.envelope.extremes import Extreme
from netdesign.outcome import Verdict
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import Member, name_in_panel
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.calibration import find_doubt
from netdesign.study.changes import (
    build_end_target,
    find_row_holds,
    list_changes,
    list_end_changes,
    list_targets,
)
from netdesign.study.demand import tell_governing
from netdesign.study.dependent import Circumstances, find_short_post, settle_resistance
from netdesign.study.effects import RowEffects
from netdesign.study.holds import solve_ends
from netdesign.study.member_check import MemberCheck, RowCheck
from netdesign.study.member_loads import RowLoads, add_parts
from netdesign.study.pulls import check_directions, find_pull
from netdesign.study.record_cases import record_point
from netdesign.study.records import CheckRecord, HoldRecord
from netdesign.study.row_end import (
    find_lack,
    find_other_panel,
    find_unsaid,
    tell_unsaid,
)
from netdesign.study.settle import (
    find_gap,
    judge_forces,
    list_checked,
    place_check,
    record_geometry,
    record_result,
    settle_check,
)
from netdesign.study.sideways import check_sideways
from netdesign.study.spreads import list_end_spreads, list_spreads
from netdesign.study.target import Target
from netdesign.words.message import Message, say
from netdesign.words.names import name

# A program that fails beside the cases of a check is not trusted in them.
_FAULT_BESIDE = say("check.fault_beside")


def check_row(
    task: RowCheck, extremes: Mapping[str, Extreme], loads: RowLoads
) -> list[CheckRecord]:
    """Every check of a row: the members of both supports, then the geometry.

    ``extremes`` and ``loads`` are those of its solved cases.
    """
    judged = [
        _judge_member(task, given, width, extremes, loads)
        for width, given in list_checked(task.row, loads.effects)
    ]
    ends = [_judge_end(task, given, loads) for given in list_end_members(task.row)]
    end_targets = {one.id: one.target for one in ends if one.target}
    targets = list_targets(task, judged)
    if task.probe is not None:  # what is solved here serves changes and limits
        known = [one for one in (*targets, *end_targets.values()) if one is not None]
        solve_ends(known, task.probe)
    checks = []
    for one, target in zip(judged, targets, strict=True):
        checks.append(_record_member(task, one, loads.effects, target))
        task.on_check()
    before = task.probe.faults if task.probe else 0
    holds = find_row_holds(task, checks, targets, end_targets)
    checks = [replace(one, holds=holds.get(one.id, [])) for one in checks]
    is_faulty = task.probe is not None and task.probe.faults > before
    if is_faulty:
        told = zip(judged, checks, strict=True)
        checks = [_distrust(task, one, check) for one, check in told]
        ends = [_judge_end(task, one.given, loads, _FAULT_BESIDE) for one in ends]
    return [
        *checks,
        *(_record_end(task, one, loads, holds.get(one.id, [])) for one in ends),
        *_check_directions(task, loads, find_open(task.row, judged)),
        *record_geometry(task.site, task.row, task.standard),
    ]


def find_open(row: NetRow, judged: Sequence[MemberCheck]) -> Message | None:
    """Gap of the forces, else a doubt about any of them; None if all is well.

    What is not known of the row's end alone leaves no other check open.
    """
    if row.unsaid:
        return tell_unsaid(row)
    found = (find_lack(row, one.given) or row.panel_lack for one in judged)
    known = [one for one in found if one is not None]
    points = ((None if one.gap in known else one.gap) or one.doubt for one in judged)
    return next((one for one in points if one is not None), None)


@dataclass(frozen=True, slots=True, kw_only=True)
class EndCheck:
    """A member that holds the row along itself, judged; ``id`` is that of its check."""

    id: str
    given: Resistance
    result: CheckResult
    target: Target | None


def list_end_members(row: NetRow) -> tuple[Resistance, ...]:
    """Resistances of what holds the ropes' pull along the row, at its end."""
    return row.row_end.resistances if row.row_end else ()


def _judge_end(
    task: RowCheck, given: Resistance, loads: RowLoads, fault: Message | None = None
) -> EndCheck:
    """Check of such a member; a ``fault`` beside its cases leaves it open."""
    unsaid = find_unsaid(task.row, given, "edge", task.solved.results)
    end = None if unsaid else loads.end
    extreme = end.find_extreme(given.member) if end else None
    gap = unsaid or task.solved.gap or _find_unseen(extreme) or fault
    gap = gap or find_other_panel(task.row, given, "edge")
    doubt = _find_doubt(task, extreme) if extreme else None
    action = end.demand(given.member) if end else None
    result = check_member(action, given, task.standard, gap=gap, doubt=doubt)
    if unsaid:
        result = withhold(result, unsaid)
    is_known = end is not None and not (gap or doubt)
    return EndCheck(
        id=place_check(record_result(result, given), "edge").id,
        given=given,
        result=result,
        target=build_end_target(task, given, end, result) if end and is_known else None,
    )


def _record_end(
    task: RowCheck, one: EndCheck, loads: RowLoads, holds: list[HoldRecord]
) -> CheckRecord:
    end, given = loads.end, one.given
    before = task.probe.faults if task.probe else 0
    changes = list_end_changes(task, given, one.result, one.target)
    if task.probe and task.probe.faults > before:
        one = _judge_end(task, given, loads, _FAULT_BESIDE)
    settled = settle_check(task.site, task.row, one.result, "edge")
    check = place_check(record_result(settled, given), "edge")
    if end is None or find_unsaid(task.row, given, "edge", task.solved.results):
        return check
    extreme = end.find_extreme(given.member)
    return replace(
        check,
        case=record_point(extreme.governing.case),
        action=end.record(given.member, loads.effects.post_spacing),
        spreads=list_end_spreads(one.result, extreme),
        changes=changes,
        holds=holds,
    )


def _check_directions(
    task: RowCheck, loads: RowLoads, gap: Message | None
) -> list[CheckRecord]:
    """Checks of a row that compare no force: load along it, directions of pulls."""
    lateral = check_sideways(task.row, loads.sideways, gap)
    directions = check_directions(loads.pulls, task.standard, gap)
    return [
        record_result(settle_check(task.site, task.row, lateral)),
        *(
            place_check(
                record_result(settle_check(task.site, task.row, one, place)), place
            )
            for place, one in directions
        ),
    ]


def _judge_member(
    task: RowCheck,
    given: Resistance,
    width: LoadedWidth,
    extremes: Mapping[str, Extreme],
    loads: RowLoads,
) -> MemberCheck:
    unsaid = find_unsaid(task.row, given, width.position, task.solved.results)
    if unsaid:
        return _leave_open(task, given, width, unsaid)
    extreme, demand, doubt = extremes.get(given.member), None, None
    if extreme is not None:
        panel = extremes.get(name_in_panel(given.member))
        demand = loads.demand(given, extreme, width, panel)
        brings = [one for one in (extreme, panel) if one is not None]
        pressing = loads.press(extreme, width, panel)
        if panel is not None and demand.largest is not demand.solved:
            extreme = panel
        known = Circumstances(
            row=task.row,
            ranges=task.site.ranges,
            standard=task.standard,
            pull=find_pull(loads.pulls, given.member, width.position),
            pressing=pressing,
        )
        given = settle_resistance(given, known)
        if demand.load.added.high > 0.0:  # by the net's pull, as the post's force is
            brings.append(extremes[Member.POST])
        doubts = (_find_doubt(task, one) for one in brings)
        doubt = next((one for one in doubts if one), None)
    seen = (extreme, extremes.get(name_in_panel(given.member)))
    gap = find_gap(task.solved.gap, loads.floor) or _find_unseen(*seen)
    gap = gap or find_other_panel(task.row, given, width.position)
    action = demand.action if demand else None
    result = judge_forces(action, given, task.standard, gap=gap, doubt=doubt)
    short = find_short_post(given, task.row, task.site.ranges)
    if short and result.verdict is Verdict.PASS:  # a longer post fails all the more
        given = replace(given, value=None, lack=short)
        result = judge_forces(action, given, task.standard, gap=gap, doubt=doubt)
    return MemberCheck(
        given=given,
        width=width,
        extreme=extreme,
        demand=demand,
        gap=gap,
        doubt=doubt,
        result=result,
    )


def _leave_open(
    task: RowCheck, given: Resistance, width: LoadedWidth, unsaid: Message
) -> MemberCheck:
    """Check of a member whose force depends on what nobody gives."""
    result = judge_forces(None, given, task.standard, gap=unsaid, doubt=None)
    result = withhold(result, unsaid)  # whatever else is missing
    return MemberCheck(
        given=given,
        width=width,
        extreme=None,
        demand=None,
        gap=unsaid,
        doubt=None,
        result=result,
    )


def _find_unseen(*extremes: Extreme | None) -> Message | None:
    """Quantities between whose samples nothing is known of some largest force."""
    unknown = dict.fromkeys(axis for one in extremes if one for axis in one.unknown)
    if not unknown:
        return None
    axes = tuple(name("axis", axis) for axis in unknown)
    return say("check.unseen_between", axes=axes)


def _find_doubt(task: RowCheck, extreme: Extreme) -> Message | None:
    """Doubt that the creep law holds for the snow of a largest force."""
    density, largest = extreme.governing.case.density, extreme.widened.high
    return find_doubt(task.site, task.row, task.law, density=density, largest=largest)


def _record_member(
    task: RowCheck, one: MemberCheck, effects: RowEffects, target: Target | None
) -> CheckRecord:
    given, result = one.given, one.result
    if one.extreme is None or one.demand is None:
        settled = settle_check(task.site, task.row, result, one.width.position)
        return place_check(record_result(settled, given), one.width.position)
    before = task.probe.faults if task.probe else 0
    spreads = list_spreads(task, one, one.extreme)
    changes = list_changes(task, one, effects, target)
    settled = settle_check(task.site, task.row, result, one.width.position)
    plain = one.demand.record(effects, given.member)
    action = add_parts(plain, one.extreme.governing, given.member)
    check = replace(
        place_check(record_result(settled, given), one.width.position),
        case=record_point(one.extreme.governing.case),
        action=action,
        reason=tell_governing(settled.reason, action),
        spreads=spreads,
        changes=changes,
    )
    is_faulty = task.probe and task.probe.faults > before
    return _distrust(task, one, check) if is_faulty else check


def distrust(check: CheckRecord) -> CheckRecord:
    """Check that passes by its forces, beside which the program failed: not proven."""
    if check.action is None or check.verdict is not Verdict.PASS:
        return check
    reason = tell_governing(
        say("check.not_proven", gaps=(_FAULT_BESIDE,)), check.action
    )
    return replace(check, verdict=Verdict.NOT_PROVEN, reason=reason)


def _distrust(task: RowCheck, one: MemberCheck, check: CheckRecord) -> CheckRecord:
    """Check of a row beside whose cases the program failed."""
    if one.demand is None or one.gap or check.action is None:
        return check
    result = judge_forces(
        one.demand.action, one.given, task.standard, gap=_FAULT_BESIDE, doubt=one.doubt
    )
    settled = settle_check(task.site, task.row, result, one.width.position)
    reason = tell_governing(settled.reason, check.action)
    return replace(check, verdict=settled.verdict, reason=reason)
