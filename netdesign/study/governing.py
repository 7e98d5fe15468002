"""Check that decides a net row, and the one of which most is worked out and shown."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.checks.check import Check
from netdesign.outcome import Outcome, Verdict
from netdesign.structure.members import BROUGHT_BY, REPORTED_MEMBERS
from netdesign.study.case_records import CaseRecord
from netdesign.study.records import RowStudy
from netdesign.study.remedies import CLOSE


def find_governing(checks: Sequence[Check]) -> Check | None:
    """Check that decides the verdict: the worst verdict, then the largest ratio."""
    return min(checks, key=lambda check: check.rank, default=None)


def _ratio(check: Check) -> float:
    return -1.0 if check.used is None else check.used


def find_highest(checks: Sequence[Check]) -> Check | None:
    """Check with the largest utilisation, of those that have one."""
    known = [check for check in checks if check.used is not None]
    return max(known, key=_ratio, default=None)


def find_worst(checks: Sequence[Check]) -> Check | None:
    """Check of the largest utilisation by a solved case; None without any."""
    rated = [check for check in checks if check.used is not None and check.case]
    return max(rated, key=lambda check: check.used or 0.0, default=None)


def find_shown(checks: Sequence[Check]) -> Check | None:
    """Check of which most is shown: the governing one, or the most used one."""
    governing = find_governing(checks)
    if governing and governing.used is not None:
        return governing
    return find_highest(checks)


def find_shown_member(checks: Sequence[Check]) -> str:
    """Member whose envelope is shown; "" without any."""
    shown = find_shown(checks)
    if shown is None or shown.member in REPORTED_MEMBERS:
        return shown.member if shown else ""
    return BROUGHT_BY.get(shown.member, "")


def is_far_from_limit(check: Check) -> bool:
    """True of a check that passes, and is told no change that would turn it."""
    _, used = check.utilisation_band
    return check.verdict is Verdict.PASS and (used is None or used < CLOSE)


def list_failed(row: RowStudy) -> list[CaseRecord]:
    """Cases that gave no numbers."""
    return [case for case in row.cases if case.outcome is not Outcome.CONVERGED]
