"""Two versions timed in turns, and the table of both."""

from __future__ import annotations

import os
import platform
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Literal

from netdesign.core.library import name_core
from netdesign.evidence.benchmark.versions import measures
from netdesign.evidence.benchmark.versions.measures import (
    Bench,
    Measure,
    RunFailure,
    Size,
)
from netdesign.evidence.benchmark.versions.other import read_version
from netdesign.evidence.runner import Time, describe_times, run_in_turns

SCHEMA = "netdesign.bench-against/1"
_AS_SLOW = 0.9  # ratios repeat to a tenth: what is less is slower

Clocked = Literal["cpu_s", "wall_s"]
Side = Literal["this", "other"]
_SIDES: tuple[Side, Side] = ("this", "other")


@dataclass(frozen=True, slots=True)
class Figure:
    """A line of the table: what is asked of it, and by which clock [s].

    The clock is the processor's where one process works: what else runs on the machine
    does not change it. Where several work, it is the one on the wall.
    """

    key: str
    clock: Clocked
    reach_s: float


@dataclass(frozen=True, slots=True)
class Timing:
    """A measure, the figures that one run of it gives, and whether it is long."""

    measure: Measure
    figures: tuple[Figure, ...]
    is_long: bool = False


TIMINGS = (
    Timing(
        measures.time_scenes,
        (Figure("median", "cpu_s", 2.5e-3), Figure("p95", "cpu_s", 8e-3)),
    ),
    Timing(measures.time_row, (Figure("row", "cpu_s", 0.2),)),
    Timing(measures.time_grid, (Figure("grid", "wall_s", 1.0),)),
    Timing(
        measures.time_site,
        (Figure("site", "wall_s", 4.0), Figure("again", "wall_s", 0.7)),
        is_long=True,
    ),
    Timing(measures.time_solve, (Figure("solve", "cpu_s", 0.4),)),
    Timing(measures.time_example, (Figure("example", "wall_s", 3.0),), is_long=True),
)


@dataclass(frozen=True, slots=True)
class Runs:
    """Times of one version, a list for each run; or why it has none."""

    times: tuple[tuple[Time, ...], ...]
    failure: str | None


def count_runs(size: Size) -> int:
    """Runs of both versions, with the compiled core and without."""
    repeats = (size.long if one.is_long else size.short for one in TIMINGS)
    return 2 * len(_SIDES) * sum(repeats)


def compare_versions(
    other: Path,
    size: Size | None = None,
    on_done: Callable[[object], None] | None = None,
) -> dict[str, Any]:
    """Times of this version beside those of another one, as one document.

    Every run is a process of its own with a store of its own. Versions take turns, and
    in every second repeat the other one begins.

    Parameters
    ----------
    other : Path
        Python that runs the other version.
    size : Size, optional
        All of it unless told otherwise; the document holds it.
    on_done : callable, optional
        Called after each run.
    """
    size = size or Size()
    pythons: dict[Side, Path] = {"this": Path(sys.executable), "other": other}
    rows = []
    with TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        bench = Bench(Path(folder), size, has_core=True)
        bench.write_inputs()
        for has_core in (True, False):
            bench = replace(bench, has_core=has_core)
            for timing in TIMINGS:
                runs = _run_in_turns(timing, bench, pythons, on_done)
                rows += _describe(timing.figures, runs, has_core=has_core)
    return {
        "schema": SCHEMA,
        "size": asdict(size),
        "pass": all(row["reached"] for row in rows),
        "provenance": {
            "this": read_version(pythons["this"]),
            "other": read_version(other),
            "core": name_core(),
            "python": platform.python_version(),
            "machine": platform.machine(),
            "processors": os.cpu_count(),
        },
        "rows": rows,
    }


def _run_in_turns(
    timing: Timing,
    bench: Bench,
    pythons: dict[Side, Path],
    on_done: Callable[[object], None] | None,
) -> dict[Side, Runs]:
    """Runs of both; a version that failed once is not run again."""
    failures: dict[Side, str] = {}

    def run(side: Side) -> tuple[Time, ...]:
        if side in failures:
            return ()
        try:
            return tuple(timing.measure(bench, pythons[side]))
        except RunFailure as failure:
            failures[side] = str(failure)
            return ()

    repeats = bench.size.long if timing.is_long else bench.size.short
    works = {side: partial(run, side) for side in _SIDES}
    times = run_in_turns(works, repeats, on_done)
    return {side: Runs(tuple(times[side]), failures.get(side)) for side in _SIDES}


def _describe(
    figures: Sequence[Figure], runs: dict[Side, Runs], *, has_core: bool
) -> list[dict[str, Any]]:
    return [
        _describe_figure(figure, place, runs, has_core=has_core)
        for place, figure in enumerate(figures)
    ]


def _describe_figure(
    figure: Figure, place: int, runs: dict[Side, Runs], *, has_core: bool
) -> dict[str, Any]:
    """Row of the document; without the core it is asked only not to be slower."""
    found = {side: _sum_up(runs[side], place) for side in _SIDES}
    ratios: dict[str, float | None] = dict.fromkeys(("cpu_s", "wall_s"))
    for clock in ratios:
        with suppress(TypeError, ZeroDivisionError):  # one of them has no time
            ratios[clock] = (
                found["other"][clock]["median"] / found["this"][clock]["median"]
            )
    clock, ratio = figure.clock, ratios[figure.clock]
    if has_core:
        mine = found["this"][clock]
        reached = mine is not None and mine["median"] <= figure.reach_s
    else:
        reached = ratio is not None and ratio >= _AS_SLOW
    return {
        "what": figure.key,
        "core": has_core,
        "clock": clock,
        "reach_s": figure.reach_s if has_core else None,
        "reached": reached,
        "this": found["this"],
        "other": found["other"],
        "times_faster": ratios,
    }


def _sum_up(runs: Runs, place: int) -> dict[str, Any]:
    """Median, least and most of each clock [s]; None where the version failed."""
    described: dict[str, Any] = {"failure": runs.failure}
    for clock in ("cpu_s", "wall_s"):
        described[clock] = None
        if runs.failure is None:
            times = [getattr(run[place], clock) for run in runs.times]
            described[clock] = describe_times(times)
    return described
