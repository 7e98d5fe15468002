"""All checks of one net row as records: judged, with intervals and what turns them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from netdesign.envelope.extremes import Extreme
from netdesign.outcome import Verdict
from netdesign.study.build_check_by_case import (
    find_row_margins,
    list_checks_by_case,
)
from netdesign.study.check_by_case import CheckByCase
from netdesign.study.judgement import (
    Known,
    MemberCheck,
    judge_members,
    judge_with_fault,
    record_member,
    record_others,
)
from netdesign.study.margins import solve_ends
from netdesign.study.records import ChangeRecord, CheckRecord, SpreadRecord
from netdesign.study.remedies import list_remedies
from netdesign.study.row_to_check import RowToCheck
from netdesign.study.spreads import list_spreads
from netdesign.words.message import say

# A program that fails beside the cases of a check is not trusted in them.
_FAULT_BESIDE = say("check.fault_beside")


def check_row(
    task: RowToCheck, extremes: Mapping[str, Extreme], known: Known
) -> list[CheckRecord]:
    """Every check of a row: the members of both supports, then the geometry.

    ``extremes`` are those of its solved cases, ``known`` what these tell.
    """
    judged = judge_members(task.basis, known)
    followed = list_checks_by_case(task, judged, extremes)
    if task.solver is not None:  # what is solved here serves changes and limits
        solve_ends([one for one in followed if one is not None], task.solver)
    beside = []
    for place, (one, by_case) in enumerate(zip(judged, followed, strict=True)):
        before = task.count_faults()
        beside.append(_solve_beside(task, one, by_case, extremes))
        if task.count_faults() > before:
            judged[place] = judge_with_fault(task.basis, one, _FAULT_BESIDE)
        task.on_check()
    before = task.count_faults()
    all_changes = [changes for _, changes in beside]
    holds = find_row_margins(task, judged, all_changes, followed)
    if task.count_faults() > before:
        judged = [judge_with_fault(task.basis, one, _FAULT_BESIDE) for one in judged]
    checks = [
        replace(
            record_member(task.basis, known, one),
            spreads=spreads,
            changes=changes,
            holds=holds.get(one.id, []),
        )
        for one, (spreads, changes) in zip(judged, beside, strict=True)
    ]
    return [*checks, *record_others(task.basis, known, judged)]


def _solve_beside(
    task: RowToCheck,
    one: MemberCheck,
    by_case: CheckByCase | None,
    extremes: Mapping[str, Extreme],
) -> tuple[list[SpreadRecord], list[ChangeRecord]]:
    """Intervals of a check and changes that turn it, as far as solves tell them."""
    if one.force is None:
        return [], []
    extreme = extremes[one.force.largest.quantity]
    return list_spreads(task, one, extreme), list_remedies(task, one, by_case)


def distrust(check: CheckRecord) -> CheckRecord:
    """Check that passes by its forces, beside which the program failed: not proven."""
    if not check.is_of_force or check.verdict is not Verdict.PASS:
        return check
    reason = say("check.not_proven", gaps=(_FAULT_BESIDE,))
    told = check.reason
    if told.key == "load.reason":
        reason = say(told.key, **{**told.arguments, "reason": reason})
    return replace(check, verdict=Verdict.NOT_PROVEN, reason=reason)
