"""All checks of one net row, with what turns them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.checks import Check, OpenKind
from netdesign.outcome import Verdict
from netdesign.study.best_ends import settle
from netdesign.study.judgement import (
    MemberCheck,
    apply_declaration,
    check_others,
)
from netdesign.study.member_force import RowForces
from netdesign.study.remedies import list_remedies
from netdesign.study.row_to_check import RowToCheck
from netdesign.study.structure import check_limits, settle_structure
from netdesign.study.worst_checks import judge_members
from netdesign.words.message import say


@dataclass(frozen=True, slots=True, kw_only=True)
class RowChecks:
    """Every check of a row; by their ids how those of forces were judged."""

    checks: list[Check]
    judged: Mapping[str, MemberCheck]


def check_row(task: RowToCheck, variants: Sequence[RowForces]) -> RowChecks:
    """Every check of a row: the members of both supports, then the geometry.

    ``variants`` is what its solved cases tell, at each corner of what is assumed of its
    statics.
    """
    judged = settle(task, variants, judge_members(variants))
    checks = []
    for one in judged:
        changes = list_remedies(one.known, one) if one.force else []
        checks.append(replace(one.check, changes=changes))
        task.on_check()
    known = variants[0]
    checks += [*check_others(variants, judged), *check_limits(known)]
    checks = [apply_declaration(task, one) for one in checks]
    return RowChecks(
        checks=settle_structure(known, checks),
        judged={one.check.id: one for one in judged},
    )


def distrust(check: Check) -> Check:
    """Check that passes by its forces, beside which the program failed: not proven."""
    if not check.is_of_force or check.verdict is not Verdict.PASS:
        return check
    return check.with_open(OpenKind.UNSOLVED, say("check.fault_beside"))
