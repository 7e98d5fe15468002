"""All checks of one net row as records: judged, with intervals and what turns them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial

from netdesign.checks import Check, OpenKind
from netdesign.checks.check import Spread
from netdesign.envelope.extremes import find_extreme
from netdesign.envelope.ranges import Ranges
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Verdict
from netdesign.structure.members import RopeForce, name_in_panel
from netdesign.study.case_records import LargestForce
from netdesign.study.check_by_case import CheckByCase, Push
from netdesign.study.effects import find_effects
from netdesign.study.governing import find_shown
from netdesign.study.judgement import (
    MemberCheck,
    apply_declaration,
    check_others,
    is_worst,
    judge_members,
)
from netdesign.study.member_force import (
    MemberForce,
    RowForces,
    find_force,
)
from netdesign.study.remedies import list_remedies
from netdesign.study.row_to_check import RowToCheck
from netdesign.study.sideways import find_tilt
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message, say
from netdesign.words.names import name


@dataclass(frozen=True, slots=True, kw_only=True)
class RowChecks:
    """Every check of a row; by their ids how those of forces were judged."""

    checks: list[Check]
    judged: Mapping[str, MemberCheck]


def check_row(task: RowToCheck, known: RowForces) -> RowChecks:
    """Every check of a row: the members of both supports, then the geometry.

    ``known`` is what its solved cases tell.
    """
    judged = judge_members(known)
    checks = []
    for one in judged:
        changes = list_remedies(task, one) if one.force else []
        checks.append(replace(one.check, changes=changes))
        task.on_check()
    checks += check_others(known, judged)
    return RowChecks(
        checks=[apply_declaration(known, one) for one in checks],
        judged={one.check.id: one for one in judged},
    )


def detail_shown(task: RowToCheck, found: RowChecks) -> RowChecks:
    """The check that is shown with the parts of its interval."""
    shown = find_shown(found.checks)
    judged = found.judged.get(shown.id) if shown else None
    if shown is None or judged is None or judged.force is None:
        return found
    detailed = replace(shown, spreads=list_spreads(task, judged))
    checks = [detailed if one is shown else one for one in found.checks]
    return replace(found, checks=checks)


def distrust(check: Check) -> Check:
    """Check that passes by its forces, beside which the program failed: not proven."""
    if not check.is_of_force or check.verdict is not Verdict.PASS:
        return check
    return check.with_open(OpenKind.UNSOLVED, say("check.fault_beside"))


def find_check_by_case(
    task: RowToCheck, known: RowForces, one: MemberCheck, judged: Iterable[MemberCheck]
) -> CheckByCase | None:
    """The check as a function of a solved case; None of one that no solve may turn.

    What the ropes load has to be known as a whole.
    """
    if task.solver is None or task.solved.gap or task.row.is_overtopped:
        return None
    is_followed = _follows_cases(one) and is_worst(one, judged)
    return _build_check(task, known, one) if is_followed else None


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
    if one.is_of_end and one.check.has_open(OpenKind.UNSOLVED, OpenKind.OUTSIDE_LAW):
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
    )


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


def _widen(force: LargestForce, results: Sequence[CaseResult]) -> float:
    """Upper end with what may hide, over the largest one of the solved cases [-]."""
    at_cases = kilonewton_from_newton(find_extreme(force.quantity, results).force.high)
    return force.high_kN / at_cases if at_cases else 1.0


def list_spreads(task: RowToCheck, one: MemberCheck) -> list[Spread]:
    """Parts of the interval of a utilisation.

    A floor cuts off what lies below it. What the ropes load has none, and is not
    compared: it is in proportion to the rope's force.
    """
    force, use = one.force, one.use
    if force is None or use is None or not one.check.utilisation:
        return []

    def rate(solved: float) -> float:
        return use * force.find_high(solved / 1e3)

    extreme = task.extremes[force.largest.quantity]
    unknown = tuple(name("axis", axis) for axis in extreme.unknown)
    is_floor = one.check.governs == "guideline"
    return _split(
        one,
        rate(extreme.force.high),
        say("spread.floor_governs") if is_floor else None,
        say("spread.unknown_along", axes=unknown) if unknown else None,
    )


def _split(one: MemberCheck, at_cases: float, *notes: Message | None) -> list[Spread]:
    """Interval of a utilisation: numerical error, and what may hide between the cases.

    ``at_cases`` is its upper end at the solved cases.
    """
    value, (low, high) = one.check.utilisation, one.check.utilisation_band
    if value is None or low is None or high is None:
        return []
    numerical = max(value, at_cases)
    of_numbers, between = notes
    return [
        Spread(
            source=say("spread.numerical_error"),
            low=low,
            high=numerical,
            note=of_numbers,
        ),
        Spread(
            source=say("spread.between_cases"),
            low=value,
            high=value + high - numerical,
            note=between,
        ),
    ]
