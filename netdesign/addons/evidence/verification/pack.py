"""The whole verification pack."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from netdesign.addons.evidence.measurements import show_lines, show_rows
from netdesign.addons.evidence.verification.case import VerificationCase
from netdesign.addons.evidence.verification.closed_forms import (
    list_cable,
    list_compaction,
    list_law,
    list_sliding_net,
    list_snow,
)
from netdesign.addons.evidence.verification.coupled import (
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
from netdesign.addons.evidence.verification.exact_solutions import list_manufactured
from netdesign.addons.evidence.verification.panels import list_panels
from netdesign.addons.evidence.verification.winters import (
    list_another_code,
    list_snow_heights,
    list_winters,
)
from netdesign.report.words import ENGLISH
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
    list_snow_heights,
    list_winters,
    list_another_code,
)


_NUMBERS = ("expected", "got", "error", "tolerance", "order", "least_order")


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
                **{name: getattr(case, name) for name in _NUMBERS},
                "pass": case.passes,
            }
            for case in cases
        ],
    }


def print_cases(cases: Sequence[VerificationCase], console: Console) -> None:
    """Print one line per case, then how many of each kind pass."""
    show_rows(write_pack(cases)["cases"], console, "verify_table")
    for kind in dict.fromkeys(case.kind for case in cases):
        passes = [case.passes for case in cases if case.kind == kind]
        line = ENGLISH(
            "verify_table.of_kind", kind=kind, passed=sum(passes), count=len(passes)
        )
        show_lines([line], console)
