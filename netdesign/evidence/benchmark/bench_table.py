"""Benchmarks -> tables on a terminal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from netdesign.evidence.benchmark.rows import Row
from netdesign.evidence.benchmark.summary import summarise
from netdesign.report.words import ENGLISH, Words

if TYPE_CHECKING:
    from rich.console import Console

_TEXTS = ("scene", "method", "path")
_NUMBERS = ("elements", "time", "error", "stated", "solves", "memory")


def print_rows(rows: Sequence[Row], console: Console, words: Words = ENGLISH) -> None:
    """Print one line per row, then what they say together."""
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0))
    for heading in _TEXTS:
        table.add_column(words(f"bench_table.{heading}"), no_wrap=True)
    for heading in _NUMBERS:
        named = words(f"bench_table.{heading}")
        table.add_column(named, justify="right", no_wrap=True)
    for row in rows:
        numbers = (
            f"{row.elements}",
            f"{1e3 * row.wall_s:.1f}",
            f"{100 * row.error:.3f}",
            f"{100 * row.stated_error:.3f}",
            f"{row.linear_solves}",
            f"{row.peak_mb:.1f}",
        )
        kinds = (words(f"bench_table.{kind}") for kind in (row.method, row.path))
        table.add_row(row.scene, *kinds, *map(words.write, numbers))
    console.print(table)
    _print_lines(_describe(rows, words), console)


def print_stress(
    document: Mapping[str, Any], console: Console, words: Words = ENGLISH
) -> None:
    """Print what became of the random scenes; failures last."""
    lines = [
        words(
            "bench.stress",
            failed=len(document["failures"]),
            **_pick(document, "scenes", "seed", "converged"),
        ),
        words(
            "bench.stress_balance",
            balance=words.write(_show(document["worst_balance"], ".1e")),
            solves=document["most_linear_solves"],
        ),
        words(
            "bench.stress_time",
            slowest=document["slowest_s"],
            **_show_times(document, words),
        ),
        words(
            "bench.stress_accuracy",
            accuracy=document["accuracy"],
            missed=document["accuracy_missed"],
        ),
        *(
            words(f"bench.refused_{one['when'].split()[0]}", **_pick(one, *_REFUSED))
            for one in document["refused"]
        ),
        *(
            words("bench.failed", **_pick(one, "scene", "reason"))
            for one in document["failures"]
        ),
    ]
    _print_lines(lines, console)


def print_errors(
    document: Mapping[str, Any], console: Console, words: Words = ENGLISH
) -> None:
    """Print the shares of honest and of accurate results; exceptions last."""
    inside, below = (
        words.write(_show(document[f"share_{what}"], ".1%"))
        for what in ("inside_stated_error", "below_accuracy")
    )
    lines = [
        words("bench.compared", **_pick(document, "compared", "scenes")),
        words(
            "bench.shares", inside=inside, below=below, accuracy=document["accuracy"]
        ),
        words("bench.times", **_show_times(document, words)),
        *(
            words("bench.outside", **_pick(one, "scene", "true_error", "stated_error"))
            for one in document["outside"]
        ),
        *(
            words("bench.not_compared", **_pick(one, "scene", "reason"))
            for one in document["not_compared"]
        ),
    ]
    _print_lines(lines, console)


def print_lines(
    document: Mapping[str, Any], console: Console, words: Words = ENGLISH
) -> None:
    """Print jumps and true errors along lines; what is beyond its bound last."""
    shown = {
        name: words.write(_show(document[name], form))
        for name, form in (
            ("largest_jump", ".2f"),
            ("largest_true_over_stated", ".2f"),
            ("share_outside", ".1%"),
        )
    }
    lines = [
        words("bench.lines", **_pick(document, "lines", "points", "solved", "refused")),
        words(
            "bench.jumps",
            largest=shown["largest_jump"],
            **_pick(document, "jumps", "bends"),
        ),
        words(
            "bench.line_truths",
            largest=shown["largest_true_over_stated"],
            outside=shown["share_outside"],
            **_pick(document, "compared", "without_truth"),
        ),
        *(
            words(
                "bench.jump",
                **_pick(line, "number", "parameter"),
                **_pick(jump, "place", "end", "relative", "over_stated"),
            )
            for line in document["of_lines"]
            for jump in line["jumps"]
        ),
        *(
            words("bench.line_not_compared", number=line["number"], reason=reason)
            for line in document["of_lines"]
            for reason in line["missing"]
        ),
    ]
    _print_lines(lines, console)


_REFUSED = ("count", "reason")


def _pick(found: Mapping[str, Any], *names: str) -> dict[str, Any]:
    return {name: found[name] for name in names}


def _show_times(document: Mapping[str, Any], words: Words) -> dict[str, str]:
    return {
        name: words.write(_show(document[f"{name}_s"], ".3f"))
        for name in ("median", "p95")
    }


def _print_lines(lines: Sequence[str], console: Console) -> None:
    for line in lines:
        console.print(line, highlight=False, markup=False)


def _describe(rows: Sequence[Row], words: Words) -> list[str]:
    found = summarise(rows)
    lines = []
    if found.times_faster is not None:
        lines.append(
            words(
                "bench.faster_same_mesh",
                times=found.times_faster,
                least=found.least_times_faster or 0.0,
                most=found.most_times_faster or 0.0,
            )
        )
    if found.times_faster_at_error is not None:
        lines.append(words("bench.faster_even", times=found.times_faster_at_error))
    if found.cost_order is not None:
        lines.append(
            words(
                "bench.orders",
                cost=found.cost_order,
                worst=found.worst_cost_order or 0.0,
                error=found.error_order or 0.0,
            )
        )
    return lines


def _show(value: float | None, form: str) -> str:
    return "-" if value is None else format(value, form)
