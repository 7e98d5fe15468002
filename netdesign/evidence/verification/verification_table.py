"""Verification cases -> a table on a terminal."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from netdesign.evidence.verification.case import VerificationCase
from netdesign.report.words import ENGLISH, Words, show_own

if TYPE_CHECKING:
    from rich.console import Console


def print_cases(
    cases: Sequence[VerificationCase], console: Console, words: Words = ENGLISH
) -> None:
    """Print one line per case, then how many of each kind pass."""
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for heading in ("case", "kind"):
        table.add_column(words(f"verify_table.{heading}"), no_wrap=True)
    table.add_column(words("verify_table.reference"), overflow="fold")
    for heading in ("expected", "got", "error", "order"):
        named = words(f"verify_table.{heading}")
        table.add_column(named, justify="right", no_wrap=True)
    table.add_column("", no_wrap=True)
    for case in cases:
        order = "-" if case.order is None else f"{case.order:.2f}"
        passes, fails = (words(f"verify_table.{key}") for key in ("passes", "fails"))
        word = Text(passes, "green") if case.passes else Text(fails, "bold red")
        numbers = (
            f"{case.expected:.5g}",
            f"{case.got:.5g}",
            f"{case.error:.1e}",
            order,
        )
        told = (name_kind(case.kind, words), show_own(words, case.reference))
        table.add_row(case.id, *told, *map(words.write, numbers), word)
    console.print(table)
    for kind in dict.fromkeys(case.kind for case in cases):
        of_kind = [case for case in cases if case.kind == kind]
        passed = sum(case.passes for case in of_kind)
        line = words(
            "verify_table.of_kind",
            kind=name_kind(kind, words),
            passed=passed,
            count=len(of_kind),
        )
        console.print(line, highlight=False)


def name_kind(kind: str, words: Words) -> str:
    """Kind of a case: ``closed form``."""
    return words(f"case_kind.{kind.replace(' ', '_')}")
