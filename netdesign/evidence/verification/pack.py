"""The whole verification pack."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from netdesign.evidence.table import show_lines, show_rows
from netdesign.evidence.verification.case import VerificationCase
from netdesign.evidence.verification.closed_forms import (
    list_cable,
    list_law,
    list_sliding_net,
    list_snow,
)
from netdesign.evidence.verification.compaction import list_compaction
from netdesign.evidence.verification.coupled import (
    list_depth_averaged,
    list_histories,
    list_invariants,
    list_layered,
    list_limits,
    list_numerics,
    list_orders,
    list_reference,
    list_walls,
)
from netdesign.evidence.verification.exported import list_another_code
from netdesign.evidence.verification.manufactured import list_manufactured
from netdesign.evidence.verification.panels import list_panels
from netdesign.evidence.verification.plan_view import list_plan_view
from netdesign.evidence.verification.winters import list_snow_heights, list_winters
from netdesign.report.words import Words
from netdesign.words.catalogue import load_texts

if TYPE_CHECKING:
    from rich.console import Console

# Lowest rung first: a rung is believed only when the one below stands.
GROUPS: tuple[Callable[[], list[VerificationCase]], ...] = (
    list_law,
    list_snow,
    list_compaction,
    list_manufactured,
    list_cable,
    list_sliding_net,
    list_invariants,
    list_limits,
    list_numerics,
    list_orders,
    list_reference,
    list_layered,
    list_walls,
    list_depth_averaged,
    list_histories,
    list_panels,
    list_plan_view,
    list_snow_heights,
    list_winters,
    list_another_code,
)


def run_pack(
    on_group: Callable[[int], None] | None = None,
) -> list[VerificationCase]:
    """All cases, in the order of the ladder; ``on_group`` gets the groups done."""
    cases: list[VerificationCase] = []
    for done, group in enumerate(GROUPS, start=1):
        cases.extend(group())
        if on_group:
            on_group(done)
    return cases


def write_pack(cases: Sequence[VerificationCase]) -> dict[str, Any]:
    """Plain values in the form ``netdesign.verification/1``."""
    texts = load_texts("en")
    return {
        "schema": "netdesign.verification/1",
        "cases": [
            {
                "id": case.id,
                "kind": case.kind,
                "reference": texts[f"reference.{case.reference}"],
                "expected": case.expected,
                "got": case.got,
                "error": case.error,
                "tolerance": case.tolerance,
                "order": case.order,
                "least_order": case.least_order,
                "pass": case.passes,
            }
            for case in cases
        ],
    }


def print_cases(
    cases: Sequence[VerificationCase], console: Console, words: Words
) -> None:
    """Print one line per case, then how many of each kind pass."""
    rows = [
        row
        | {
            "kind": name_kind(case.kind, words),
            "reference": words(f"reference.{case.reference}"),
        }
        for case, row in zip(cases, write_pack(cases)["cases"], strict=True)
    ]
    show_rows(rows, console, words, "verify_table")
    for kind in dict.fromkeys(case.kind for case in cases):
        passes = [case.passes for case in cases if case.kind == kind]
        line = words(
            "verify_table.of_kind",
            kind=name_kind(kind, words),
            passed=sum(passes),
            count=len(passes),
        )
        show_lines([line], console)


def name_kind(kind: str, words: Words) -> str:
    """Kind of a case: ``closed form``."""
    return words(f"case_kind.{kind.replace(' ', '_')}")
