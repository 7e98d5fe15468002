"""Two versions side by side on a terminal."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from netdesign.report.words import ENGLISH, Words, show_text

if TYPE_CHECKING:
    from rich.console import Console

_CLOCKS = ("cpu_s", "wall_s")
_LINE = "  {:10}  {:>24}  {:>24}  {:>12}"
_SHORT_S = 0.1  # below it times are told in milliseconds


def print_versions(
    document: Mapping[str, Any], console: Console, words: Words = ENGLISH
) -> None:
    """Print the table with the compiled core, then the one without."""
    made, rows = document["provenance"], document["rows"]
    lines = [words("against.head", **made)]
    for has_core in (True, False):
        lines += [
            "",
            words("against.with_core" if has_core else "against.without_core"),
        ]
        heads = (words("against.this"), made["other"], words("against.ratio"))
        lines.append(_LINE.format("", *heads))
        for row in rows:
            if row["core"] is has_core:
                lines += _list_lines(row, words)
    lines += [line for row in rows for line in _list_failures(row, words)]
    for line in lines:
        console.print(line, highlight=False, markup=False)


def _list_lines(row: Mapping[str, Any], words: Words) -> list[str]:
    """Lines of a figure: its name and what is asked, then one for each clock."""
    what = words(f"against_figure.{row['what']}")
    return [
        words("against.figure", what=what, asked=_show_asked(row, words)),
        *(
            _LINE.format(
                words(f"against_clock.{clock}"),
                *(_show_time(row[side][clock], words) for side in ("this", "other")),
                _show_ratio(row["times_faster"][clock], words),
            )
            for clock in _CLOCKS
        ),
    ]


def _show_time(found: Mapping[str, float] | None, words: Words) -> str:
    """``2.6 (2.5 to 2.9) ms``: the median, the least and the most."""
    if found is None:
        return words("against.none")
    is_short = found["median"] < _SHORT_S
    scale, unit = (1e3, "ms") if is_short else (1.0, "s")
    shown = {name: words.write(f"{scale * value:.3g}") for name, value in found.items()}
    return words("against.time", unit=unit, **shown)


def _show_ratio(ratio: float | None, words: Words) -> str:
    return "-" if ratio is None else words.write(f"{ratio:.2f}")


def _show_asked(row: Mapping[str, Any], words: Words) -> str:
    state = words("against.reached" if row["reached"] else "against.not_reached")
    clock = words(f"against_clock.{row['clock']}")
    if row["reach_s"] is None:
        return words("against.not_slower", clock=clock, state=state)
    is_short = row["reach_s"] < _SHORT_S
    scale, unit = (1e3, "ms") if is_short else (1.0, "s")
    time = words.write(f"{scale * row['reach_s']:g}")
    return words("against.at_most", clock=clock, time=time, unit=unit, state=state)


def _list_failures(row: Mapping[str, Any], words: Words) -> list[str]:
    """Lines of a figure's failures, in the words of the version that failed."""
    return [
        words(
            "against.failed",
            side=words("against.this") if side == "this" else words("against.other"),
            what=words(f"against_figure.{row['what']}"),
            reason=show_text(row[side]["failure"]),
        )
        for side in ("this", "other")
        if row[side]["failure"] is not None
    ]
