"""Anchors, structure and siting side by side: in a sentence, and in short."""

from __future__ import annotations

from collections.abc import Iterator

from netdesign.checks.check import Check
from netdesign.outcome import Verdict
from netdesign.report.sections.basis import label_rows
from netdesign.report.words import (
    Words,
    append_unit,
    show_check,
    show_text,
)
from netdesign.study.records import RowStudy, Study
from netdesign.study.scopes import BY_APPROVAL, Scope, ScopeRecord

_BETWEEN = " · "


def describe_study_scopes(study: Study, words: Words) -> str:
    """``anchors FAIL 1.48 (6 assumed), A4 · structure by approval X · siting PASS``.

    Each scope stands with the row that decides it, where there are several.
    """
    rows = {row.id: row for row in study.rows}
    texts = []
    for scope, record in study.scopes.items():
        row = rows.get(record.row or "")
        text = _describe(scope, record, _find_check(row, record), words)
        is_open = record.verdict is not Verdict.PASS and len(rows) > 1 and row
        texts.append(f"{text}, {show_text(row.id)}" if row and is_open else text)
    return _BETWEEN.join(texts)


def _find_check(row: RowStudy | None, record: ScopeRecord) -> Check | None:
    """Check that decides a scope."""
    checks = row.checks if row else []
    return next((check for check in checks if check.id == record.governing), None)


def _describe(
    scope: Scope, record: ScopeRecord, check: Check | None, words: Words
) -> str:
    name = words(f"of_scope.{scope}")
    if document := _find_approval(record, check):
        return words("scopes.by_approval", scope=name, document=show_text(document))
    verdict = words(f"verdict.{record.verdict}")
    used = show_extent(record, check, words)
    parts = [name, verdict, *([used] if used else [])]
    if record.assumed:
        parts.append(words("scopes.assumed", count=record.assumed))
    return " ".join(parts)


def _find_approval(record: ScopeRecord, check: Check | None) -> str:
    """Document of the type approval that proves a scope; "" without one."""
    is_by_approval = record.governing == BY_APPROVAL
    is_proven = check is not None and check.declared and is_by_approval
    return check.declared.document if is_proven and check and check.declared else ""


def show_extent(record: ScopeRecord, check: Check | None, words: Words) -> str:
    """Utilisation of the check that decides, else its force; "" of one without."""
    if check is not None and check.used is not None:
        return words.show_number("utilisation", check.used)
    demand = check.read_band("E_d")[1] if check else None
    is_met = record.verdict in (Verdict.PASS, Verdict.DECLARED)
    if demand is None or is_met:
        return ""
    return append_unit(words.show_number("demand_kN", demand), "kN")


def list_exceeding(study: Study, words: Words) -> Iterator[str]:
    """Checks whose coupled force exceeds the resistance, though it does not decide."""
    rows: dict[str, list[str]] = {}
    for row in study.rows:
        beyond = [check for check in row.checks if check.exceeds_by_model]
        if not beyond:
            continue
        worst = max(beyond, key=lambda check: check.utilisation_by_model or 0.0)
        text = words(
            "scopes.exceeds",
            check=show_check(words, worst),
            times=words.show_number("utilisation", worst.utilisation_by_model),
            count=len(beyond),
        )
        rows.setdefault(text, []).append(row.id)
    yield from label_rows(rows, study, words)
