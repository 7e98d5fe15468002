"""The check that decides among several, and what outputs show first of a row."""

from __future__ import annotations

from netdesign.outcome import Outcome, Verdict
from netdesign.study.case_records import CasePoint, CaseRecord
from netdesign.study.records import CheckRecord, RowStudy
from netdesign.study.remedies import CLOSE


def find_case(check: CheckRecord) -> CasePoint | None:
    """Case of the ranges that brings the demand; None where the guideline does."""
    return None if check.governs == "guideline" else check.case


def is_far_from_limit(check: CheckRecord) -> bool:
    """True of a check that passes, and is told no change that would turn it."""
    _, used = check.utilisation_band
    return check.verdict is Verdict.PASS and (used is None or used < CLOSE)


def list_failed(row: RowStudy) -> list[CaseRecord]:
    """Cases that gave no numbers."""
    return [case for case in row.cases if case.outcome is not Outcome.CONVERGED]
