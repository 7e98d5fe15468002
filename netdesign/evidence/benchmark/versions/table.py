"""Two versions side by side: the rows of their table on a terminal."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from netdesign.evidence.table import print_lines, print_rows
from netdesign.report.words import Words

if TYPE_CHECKING:
    from rich.console import Console

_SHORT_S = 0.1  # below it times are told in milliseconds


def print_versions(document: Mapping[str, Any], console: Console, words: Words) -> None:
    """Print each figure by each clock, with the compiled core and without."""
    print_lines([words("against.head", **document["provenance"])], console)
    rows = [
        _describe(row, clock, words)
        for row in document["rows"]
        for clock in ("cpu_s", "wall_s")
    ]
    print_rows(rows, console, words, "against_table")


def _describe(row: Mapping[str, Any], clock: str, words: Words) -> dict[str, Any]:
    """Row by one clock; what is asked stands beside the clock that it is asked of."""
    is_asked = clock == row["clock"]
    return {
        "what": words(f"against_figure.{row['what']}"),
        "core": row["core"],
        "clock": words(f"against_clock.{clock}"),
        **{side: _show_side(row[side], clock, words) for side in ("this", "other")},
        "ratio": row["times_faster"][clock],
        "reach_s": row["reach_s"] if is_asked else None,
        "reached": row["reached"] if is_asked else None,
    }


def _show_side(found: Mapping[str, Any], clock: str, words: Words) -> str:
    """``2.6 (2.5 to 2.9) ms``: the median, the least and the most; or the failure."""
    if found["failure"] is not None:
        return words("against.failed", reason=found["failure"])
    times = found[clock]
    scale, unit = (1e3, "ms") if times["median"] < _SHORT_S else (1.0, "s")
    shown = {name: words.write(f"{scale * time:.3g}") for name, time in times.items()}
    return words("against.time", unit=unit, **shown)
