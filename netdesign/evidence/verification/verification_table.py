"""Verification cases -> a table on a terminal."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from netdesign.evidence.verification.case import VerificationCase

if TYPE_CHECKING:
    from rich.console import Console


def print_cases(cases: Sequence[VerificationCase], console: Console) -> None:
    """Print one line per case, then how many of each kind pass."""
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for heading in ("Case", "Kind"):
        table.add_column(heading, no_wrap=True)
    table.add_column("Reference", overflow="fold")
    for heading in ("Expected", "Got", "Error", "Order"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("", no_wrap=True)
    for case in cases:
        order = "-" if case.order is None else f"{case.order:.2f}"
        word = Text("pass", "green") if case.passes else Text("FAIL", "bold red")
        numbers = (
            f"{case.expected:.5g}",
            f"{case.got:.5g}",
            f"{case.error:.1e}",
            order,
        )
        table.add_row(case.id, case.kind, case.reference, *numbers, word)
    console.print(table)
    for kind in dict.fromkeys(case.kind for case in cases):
        of_kind = [case for case in cases if case.kind == kind]
        passed = sum(case.passes for case in of_kind)
        console.print(f"{kind}: {passed} of {len(of_kind)} pass", highlight=False)
