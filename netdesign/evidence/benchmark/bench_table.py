"""Benchmarks -> tables on a terminal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from netdesign.evidence.benchmark.rows import Row
from netdesign.evidence.benchmark.summary import summarise

if TYPE_CHECKING:
    from rich.console import Console

_HEADINGS = ("Elements", "Time ms", "Error %", "Stated %", "Solves", "MB")


def print_rows(rows: Sequence[Row], console: Console) -> None:
    """Print one line per row, then what they say together."""
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0))
    for heading in ("Scene", "Method", "Path"):
        table.add_column(heading, no_wrap=True)
    for heading in _HEADINGS:
        table.add_column(heading, justify="right", no_wrap=True)
    for row in rows:
        table.add_row(
            row.scene,
            row.method,
            row.path,
            f"{row.elements}",
            f"{1e3 * row.wall_s:.1f}",
            f"{100 * row.error:.3f}",
            f"{100 * row.stated_error:.3f}",
            f"{row.linear_solves}",
            f"{row.peak_mb:.1f}",
        )
    console.print(table)
    for line in _describe(rows):
        console.print(line, highlight=False)


def print_stress(document: Mapping[str, Any], console: Console) -> None:
    """Print what became of the random scenes; failures last."""
    lines = [
        f"{document['scenes']} scenes of seed {document['seed']}: "
        f"{document['converged']} converged, {len(document['failures'])} failed",
        f"worst balance {_show(document['worst_balance'], '.1e')} of the weight, most "
        f"linear solves {document['most_linear_solves']}",
        f"time: median {_show(document['median_s'], '.3f')} s, 95 % below "
        f"{_show(document['p95_s'], '.3f')} s, slowest {document['slowest_s']:.2f} s",
        f"accuracy of {document['accuracy']:g} not reached, and said so: "
        f"{document['accuracy_missed']}",
        *(
            f"refused {one['when']}, {one['count']}: {one['reason']}"
            for one in document["refused"]
        ),
        *(f"FAILED {one['scene']}: {one['reason']}" for one in document["failures"]),
    ]
    for line in lines:
        console.print(line, highlight=False, markup=False)


def print_errors(document: Mapping[str, Any], console: Console) -> None:
    """Print the shares of honest and of accurate results; exceptions last."""
    share = [
        document[f"share_{what}"] for what in ("inside_stated_error", "below_accuracy")
    ]
    lines = [
        f"{document['compared']} of {document['scenes']} scenes compared with a mesh "
        "four times finer",
        f"true error inside the stated one: {_show(share[0], '.1%')}; below the "
        f"accuracy of {document['accuracy']:g}: {_show(share[1], '.1%')}",
        f"time: median {_show(document['median_s'], '.3f')} s, 95 % below "
        f"{_show(document['p95_s'], '.3f')} s",
        *(
            f"outside: scene {one['scene']}, true {one['true_error']:.2%}, stated "
            f"{one['stated_error']:.2%}"
            for one in document["outside"]
        ),
        *(
            f"not compared: scene {one['scene']}, {one['reason']}"
            for one in document["not_compared"]
        ),
    ]
    for line in lines:
        console.print(line, highlight=False, markup=False)


def print_lines(document: Mapping[str, Any], console: Console) -> None:
    """Print jumps and true errors along lines; what is beyond its bound last."""
    lines = [
        f"{document['lines']} lines of {document['points']} scenes: "
        f"{document['solved']} solved, {document['refused']} refused",
        f"jumps beyond the stated errors: {document['jumps']}; the largest is "
        f"{_show(document['largest_jump'], '.2f')} of them; bends that are none: "
        f"{document['bends']}",
        f"{document['compared']} compared with a finer mesh, the true error is at most "
        f"{_show(document['largest_true_over_stated'], '.2f')} of the stated one; "
        f"{document['without_truth']} without a result there; together "
        f"{_show(document['share_outside'], '.1%')} count as outside",
        *(
            f"JUMP line {line['number']}, {line['parameter']}, point {jump['place']}: "
            f"{jump['end']} by {jump['relative']:.2%}, {jump['over_stated']:.2f} of "
            "the stated errors"
            for line in document["of_lines"]
            for jump in line["jumps"]
        ),
        *(
            f"not compared: line {line['number']}, {reason}"
            for line in document["of_lines"]
            for reason in line["missing"]
        ),
    ]
    for line in lines:
        console.print(line, highlight=False, markup=False)


def _describe(rows: Sequence[Row]) -> list[str]:
    found = summarise(rows)
    lines = []
    if found.times_faster is not None:
        lines.append(
            f"fast path: {found.times_faster:.1f} times faster than plain scikit-fem "
            f"on the same mesh (median; {found.least_times_faster:.1f} to "
            f"{found.most_times_faster:.1f})"
        )
    if found.times_faster_at_error is not None:
        lines.append(
            f"{found.times_faster_at_error:.0f} times faster than plain scikit-fem on "
            "even meshes at equal error (median)"
        )
    if found.cost_order is not None:
        lines.append(
            f"time grows as unknowns^{found.cost_order:.2f} (median; at most "
            f"{found.worst_cost_order:.2f}), the error falls as "
            f"h^{found.error_order:.1f}"
        )
    return lines


def _show(value: float | None, form: str) -> str:
    return "-" if value is None else format(value, form)
