"""Rows of a benchmark -> work-precision plot as SVG."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from statistics import median
from typing import TYPE_CHECKING

from netdesign.evidence.benchmark.summary import Path, Row
from netdesign.report.drawing.figures import (
    ACCENT,
    GREY,
    INK,
    WIDTH_IN,
    use_style,
    write_svg,
)
from netdesign.report.words import ENGLISH, Words

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HEIGHT_IN = 3.6
_PATHS: tuple[Path, ...] = ("fast", "reference", "plain")
_COLOURS: dict[Path, str] = {"fast": ACCENT, "reference": INK, "plain": GREY}


def draw_work_precision(rows: Sequence[Row], words: Words = ENGLISH) -> str:
    """Run time against error: a dot a row, the median of each resolution joined."""
    from matplotlib.figure import Figure

    with use_style("work-precision"):
        figure = Figure(figsize=(WIDTH_IN, _HEIGHT_IN), layout="constrained")
        axes = figure.add_subplot()
        steady = [row for row in rows if row.method == "steady"]
        for path in _PATHS:
            of_path = [row for row in steady if row.path == path]
            _draw_path(axes, of_path, _COLOURS[path], words(f"bench_plot.{path}"))
        histories = [row for row in rows if row.method == "transient"]
        _draw_histories(axes, histories, words("bench_plot.transient"))
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel(words("bench_plot.error"))
        axes.set_ylabel(words("bench_plot.time"))
        axes.invert_xaxis()
        axes.grid(visible=True, which="major", color=GREY, alpha=0.25, linewidth=0.4)
        figure.legend(frameon=False, loc="outside upper left", ncols=2)
    return write_svg(figure, "work-precision", words("bench_plot.title"))


def _draw_path(axes: Axes, rows: Sequence[Row], colour: str, label: str) -> None:
    if not rows:
        return
    axes.plot(*_places(rows), ".", color=colour, alpha=0.35, markersize=4)
    by_mesh = _group_by_resolution(rows)
    errors = [100.0 * median(row.error for row in group) for group in by_mesh]
    times = [1e3 * median(row.wall_s for row in group) for group in by_mesh]
    axes.plot(errors, times, "-o", color=colour, markersize=4, label=label)


def _draw_histories(axes: Axes, rows: Sequence[Row], label: str) -> None:
    if rows:
        axes.plot(*_places(rows), "x", color=ACCENT, markersize=5, label=label)


def _places(rows: Sequence[Row]) -> tuple[list[float], list[float]]:
    return [100.0 * row.error for row in rows], [1e3 * row.wall_s for row in rows]


def _group_by_resolution(rows: Sequence[Row]) -> list[list[Row]]:
    """First rows of all scenes, second rows, ...: one group a mesh level."""
    seen: dict[str, int] = defaultdict(int)
    groups: dict[int, list[Row]] = defaultdict(list)
    for row in rows:
        groups[seen[row.scene]].append(row)
        seen[row.scene] += 1
    return [groups[place] for place in sorted(groups)]
