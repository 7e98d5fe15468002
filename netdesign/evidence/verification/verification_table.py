"""Verification cases -> a table on a terminal."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from netdesign.evidence.table import print_lines, print_rows
from netdesign.evidence.verification.case import VerificationCase
from netdesign.evidence.verification.pack import write_pack
from netdesign.report.words import Words

if TYPE_CHECKING:
    from rich.console import Console


def print_cases(
    cases: Sequence[VerificationCase], console: Console, words: Words
) -> None:
    """Print one line per case, then how many of each kind pass."""
    rows = [
        row | {"kind": name_kind(row["kind"], words)}
        for row in write_pack(cases)["cases"]
    ]
    print_rows(rows, console, words, "verify_table")
    for kind in dict.fromkeys(case.kind for case in cases):
        passes = [case.passes for case in cases if case.kind == kind]
        line = words(
            "verify_table.of_kind",
            kind=name_kind(kind, words),
            passed=sum(passes),
            count=len(passes),
        )
        print_lines([line], console)


def name_kind(kind: str, words: Words) -> str:
    """Kind of a case: ``closed form``."""
    return words(f"case_kind.{kind.replace(' ', '_')}")
