"""All checks of one net row as records: judged, with intervals and what turns them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial

from netdesign.envelope.extremes import Extreme, find_extreme
from netdesign.envelope.ranges import Ranges
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Verdict
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.structure.members import RopeForce, name_in_panel
from netdesign.study.case_records import ForceRecord
from netdesign.study.check_by_case import CheckByCase, Push
from netdesign.study.effects import find_effects
from netdesign.study.governing import find_shown
from netdesign.study.judgement import (
    MemberCheck,
    is_worst,
    judge_members,
    judge_with_fault,
    record_member,
    record_others,
)
from netdesign.study.margins import find_margins
from netdesign.study.member_force import (
    MemberForce,
    RowForces,
    find_force,
)
from netdesign.study.records import ChangeRecord, CheckRecord, HoldRecord, SpreadRecord
from netdesign.study.remedies import list_remedies
from netdesign.study.row_to_check import CaseSolver, RowToCheck
from netdesign.study.sideways import find_tilt
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message, say
from netdesign.words.names import name

# A program that fails beside the cases of a check is not trusted in them.
_FAULT_BESIDE = say("check.fault_beside")


@dataclass(frozen=True, slots=True, kw_only=True)
class RowChecks:
    """Every check of a row; by their ids how they were judged, and as functions.

    Functions of a solved case are those that follow from one.
    """

    records: list[CheckRecord]
    judged: Mapping[str, MemberCheck]
    by_case: Mapping[str, CheckByCase]


def check_row(task: RowToCheck, known: RowForces) -> RowChecks:
    """Every check of a row: the members of both supports, then the geometry.

    ``known`` is what its solved cases tell.
    """
    judged = judge_members(known)
    followed = list_checks_by_case(task, known, judged)
    changes: list[list[ChangeRecord]] = []
    for place, (one, by_case) in enumerate(zip(judged, followed, strict=True)):
        before = task.count_faults()
        changes.append(list_remedies(task, one, by_case) if one.force else [])
        if task.count_faults() > before:
            judged[place] = judge_with_fault(task, one, _FAULT_BESIDE)
        task.on_check()
    checks = [
        replace(record_member(known, one), changes=found)
        for one, found in zip(judged, changes, strict=True)
    ]
    pairs = zip(judged, followed, strict=True)
    return RowChecks(
        records=[*checks, *record_others(known, judged)],
        judged={one.id: one for one in judged},
        by_case={one.id: by_case for one, by_case in pairs if by_case is not None},
    )


def detail_shown(task: RowToCheck, found: RowChecks) -> RowChecks:
    """The check that is shown with the parts of its interval, and its margins."""
    shown = find_shown(found.records)
    judged = found.judged.get(shown.id) if shown else None
    if shown is None or judged is None or judged.force is None:
        return found
    by_case, margins = found.by_case.get(shown.id), list[HoldRecord]()
    if by_case is not None and task.solver is not None:
        margins = find_margins(by_case, task.solver, _list_known(shown.changes))
    detailed = replace(
        shown,
        spreads=list_spreads(task, judged),
        holds=margins,
    )
    records = [detailed if one is shown else one for one in found.records]
    return replace(found, records=records)


def distrust(check: CheckRecord) -> CheckRecord:
    """Check that passes by its forces, beside which the program failed: not proven."""
    if not check.is_of_force or check.verdict is not Verdict.PASS:
        return check
    reason = say("check.not_proven", gaps=(_FAULT_BESIDE,))
    told = check.reason
    if told.key == "load.reason":
        reason = say(told.key, **{**told.arguments, "reason": reason})
    return replace(check, verdict=Verdict.NOT_PROVEN, reason=reason)


# Changes that are limits of single values, too, and the names of these.
_SOLVED = {"change.snow_density": "density", "change.snow_thickness": "thickness"}


def list_checks_by_case(
    task: RowToCheck, known: RowForces, judged: Sequence[MemberCheck]
) -> list[CheckByCase | None]:
    """Checks as functions of a solved case; None of those that no solve may turn.

    Of several supports that one which uses a member most: where that holds, the
    others do. What the ropes load has to be known as a whole.
    """
    if task.solver is None or task.solved.gap or task.row.is_overtopped:
        return [None] * len(judged)
    return [
        _build_check(task, known, one)
        if _follows_cases(one) and is_worst(one, judged)
        else None
        for one in judged
    ]


def _list_known(changes: Sequence[ChangeRecord]) -> dict[str, float]:
    """Largest values up to which a check passes, by the quantity's name [SI]."""
    found = {}
    for change in changes:
        quantity = change.quantity
        key = quantity.key if isinstance(quantity, Message) else ""
        if key in _SOLVED and change.bound is not None:
            found[_SOLVED[key]] = change.bound
    return found


def _follows_cases(one: MemberCheck) -> bool:
    """The check follows from the member's force by numbers that stay as they are.

    A resistance that follows the snow does not, nor what is added to no force at all,
    nor an anchor of two guys: what these add may grow while its own force falls.
    """
    force = one.force
    if force is not None and force.on.load.across is not None:
        return False
    if force is None or one.given.dimensions or one.use is None or one.ratio <= 0.0:
        return False
    if one.is_of_end and (one.gap is not None or one.doubt is not None):
        return False
    return force.largest.high_kN > 0.0 or force.added_high == 0.0


def _build_check(task: RowToCheck, known: RowForces, one: MemberCheck) -> CheckByCase:
    """The check as a function of a solved case and of the row.

    Of section and panel that one which is larger is followed, the other beside it.
    """
    force, use = one.force, one.use
    if force is None or use is None:
        raise ValueError("a check without a force has no target")
    results = task.solved.results
    scales = {
        record.quantity: use * force.share * _widen(record, results) / 1e3
        for record in force.solved
    }
    followed = force.largest.quantity
    return CheckByCase(
        row=task.row,
        ranges=task.site.ranges,
        member=followed,
        scale=scales.pop(followed),
        beside=tuple(scales.items()),
        added=use * force.added_high,
        rise=use * force.rise,
        governing=task.extremes[followed].governing.case,
        results=results,
        widen=cache(partial(_find_load, known, one, force)),
        push=_find_push(task, one, force),
        use_floor=partial(_use_floor, task, one),
        bound_floor=partial(_bound_floor, task, one),
    )


def _use_floor(task: RowToCheck, one: MemberCheck, ranges: Ranges) -> float:
    """Utilisation of a member by the guideline's load alone [-]."""
    floor = task.find_floor(ranges)
    if floor is None or one.is_of_end:
        return 0.0
    least = floor.find(one.given.member)
    pull = floor.head.pull if floor.head else 0.0
    return math.inf if least is None else one.use_least(least.force, pull)


def _bound_floor(
    task: RowToCheck, one: MemberCheck, ranges: Ranges
) -> tuple[float, float]:
    """Ends of what `_use_floor` gives; no upper one where the bound is not known."""
    ends = None if one.is_of_end else task.bound_floor(ranges)
    if ends is None:
        return 0.0, math.inf
    member = one.given.member
    least, most = (one.use_least(end.of_members[member], end.pull) for end in ends)
    return least, most


def _find_push(task: RowToCheck, one: MemberCheck, force: MemberForce) -> Push | None:
    """Part of the panel's force that the end guy brings; None of any other member."""
    if force.on.push is None or not force.on.push.high:
        return None
    name, rope = name_in_panel(one.given.member), RopeForce.UPPER_ALONG
    results = task.solved.results
    panel = next(record for record in force.solved if record.quantity == name)
    inside = force.on_support * force.share * _widen(panel, results)
    pull = kilonewton_from_newton(find_extreme(rope, results).force.high)
    return Push(force=name, rope=rope, ratio=force.on.push.high / pull / inside)


def _find_load(
    known: RowForces,
    one: MemberCheck,
    now: MemberForce,
    ranges: Ranges,
) -> float:
    """Load of a support over ranges in which something was moved, over that now [-].

    Where a base would slide, times the tangent of its post's tilt, which is largest at
    an end of the inclinations.
    """
    effects = find_effects(known.row, known.standard, ranges)
    width = effects.find_support(one.width.position)
    moved = find_force(known, one.given, width) or now
    load, span = moved.compare_load(now), ranges["inclination"]
    if one.given.mode != "sliding":
        return load
    return load * find_tilt(known.row, (span.low, span.high))


def _widen(force: ForceRecord, results: Sequence[CaseResult]) -> float:
    """Upper end with what may hide, over the largest one of the solved cases [-]."""
    at_cases = kilonewton_from_newton(find_extreme(force.quantity, results).force.high)
    return force.high_kN / at_cases if at_cases else 1.0


def list_spreads(task: RowToCheck, one: MemberCheck) -> list[SpreadRecord]:
    """Parts of the interval of a utilisation, the creep law's for comparison.

    A floor cuts off what lies below it. What the ropes load has none, and is not
    compared: it is in proportion to the rope's force.
    """
    force, use = one.force, one.use
    if force is None or use is None or not one.result.find_value("μ"):
        return []

    def rate(solved: float) -> float:
        return use * force.find_high(solved / 1e3)

    extreme = task.extremes[force.largest.quantity]
    largest = 1e3 * force.largest.high_kN
    scale = rate(largest) / largest if largest else use * force.share / 1e3
    unknown = tuple(name("axis", axis) for axis in extreme.unknown)
    is_floor = force.governs == "guideline"
    spreads = _split(
        one,
        rate(extreme.force.high),
        say("spread.floor_governs") if is_floor else None,
        say("spread.unknown_along", axes=unknown) if unknown else None,
    )
    if one.is_of_end:
        return spreads
    if task.solver is not None and extreme.force.value > 0.0:
        spreads += _list_creep_laws(task.solver, task.row, extreme, scale)
    return spreads


def _split(
    one: MemberCheck, at_cases: float, *notes: Message | None
) -> list[SpreadRecord]:
    """Interval of a utilisation: numerical error, and what may hide between the cases.

    ``at_cases`` is its upper end at the solved cases.
    """
    used = one.result.find("μ")
    if used is None or used.value is None or used.low is None or used.high is None:
        return []
    numerical = max(used.value, at_cases)
    of_numbers, between = notes
    return [
        SpreadRecord(
            source=say("spread.numerical_error"),
            low=used.low,
            high=numerical,
            in_verdict=True,
            note=of_numbers,
        ),
        SpreadRecord(
            source=say("spread.between_cases"),
            low=used.value,
            high=used.value + used.high - numerical,
            in_verdict=True,
            note=between,
        ),
    ]


def _list_creep_laws(
    solver: CaseSolver, row: NetRow, extreme: Extreme, scale: float
) -> Iterable[SpreadRecord]:
    laws = {k: law for k, law in CREEP_LAWS.items() if k != solver.law.name}
    results = solver.solve_all(
        [(row, extreme.governing.case, law) for law in laws.values()]
    )
    for law, result in zip(laws, results, strict=True):
        force = result.member_forces.get(extreme.member)
        yield SpreadRecord(
            source=say("spread.creep_law", law=law),
            low=force.low * scale if force else None,
            high=force.high * scale if force else None,
            in_verdict=False,
            note=say("spread.in_governing_case") if force else result.reason,
        )
