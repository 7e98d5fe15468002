"""Run time against error: scenes by resolution, method and path, in one run.

A row is a solve on one mesh with the coarser one before it, which gives the error
estimate: the cheapest result of that mesh that the program would hand out. Both paths
are timed in turns, so that a busy machine slows both; meshes and start values of a
scene's shape are found before the first timing, as in an envelope of many cases.
"""

from __future__ import annotations

import os
import platform
import tracemalloc
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from importlib.metadata import version
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from netdesign import __version__
from netdesign.coupling.history.settings import TRANSIENT_LEVELS, TransientSettings
from netdesign.coupling.history.transient import solve_transient
from netdesign.coupling.scene import MESH_LEVELS, Scene, SolverSettings
from netdesign.coupling.solution import FailedSolution, Solution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.errors import SolveError
from netdesign.evidence.benchmark import reference_path
from netdesign.evidence.benchmark.summary import Method, Path, Row, summarise
from netdesign.evidence.benchmark.truth import (
    Truth,
    build_truth,
    refine_size,
    solve_truth,
    state_error,
)
from netdesign.evidence.runner import measure, run_in_turns
from netdesign.evidence.table import print_document, print_rows
from netdesign.report.words import Words
from netdesign.snow.mesh import MeshSize

if TYPE_CHECKING:
    from rich.console import Console

BENCH_SCHEMA = "netdesign.bench/1"
HISTORY_ACCURACY = 0.01  # of the steps

# Even meshes as one draws them without a thought for the net's ends.
PLAIN_LEVELS = tuple(
    MeshSize(net_spacing=h, corner=h, sectors=0, upslope_spacing=2 * h)
    for h in (1 / 4, 1 / 8, 1 / 16, 1 / 32)
)
# Accuracies asked for: of the truth, and of a pair of meshes (both are always solved).
# The iterations leave a 25th of them.
_TIGHT, _OFFERED = 1e-4, 5e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class Effort:
    """Amount of measurement: place of the finest level, repeats of each timing."""

    finest: int = 3
    repeats: int = 5


FULL = Effort()
QUICK = Effort(finest=2, repeats=3)


Solve = Callable[[], Solution | FailedSolution]


def measure_steady(name: str, scene: Scene, effort: Effort = FULL) -> list[Row]:
    """Rows of one scene: every pair of neighbouring levels, all paths.

    Raises
    ------
    SolveError
        If a mesh gives no converged solution.
    """
    settings = SolverSettings(accuracy=_OFFERED)
    tight = replace(settings, accuracy=_TIGHT)
    # cut in four once: to cut it twice would take minutes a scene
    truth = solve_truth(scene, MESH_LEVELS[effort.finest], tight, halvings=1)
    rows = []
    for pair in pairwise(MESH_LEVELS[: effort.finest + 1]):
        fast = replace(settings, levels=pair)
        plain = replace(fast, step=reference_path.advance)
        solves: dict[Path, Solve] = {
            "fast": partial(solve_steady, scene, fast),
            "reference": partial(solve_steady, scene, plain),
        }
        rows += _measure(name, "steady", solves, truth, effort.repeats)
    for pair in pairwise(PLAIN_LEVELS[: effort.finest]):
        plain = replace(settings, levels=pair, step=reference_path.advance)
        solve = partial(solve_steady, scene, plain)
        rows += _measure(name, "steady", {"plain": solve}, truth, effort.repeats)
    return rows


def measure_transient(name: str, scene: Scene, effort: Effort = FULL) -> list[Row]:
    """Rows of one scene's history up to its plateau; errors of its largest pulls.

    The truth is a history on twice the finest mesh with steps for a tenth of the
    accuracy; a finer one would take minutes.
    """
    settings = TransientSettings(accuracy=HISTORY_ACCURACY, stops_at_plateau=True)
    finest = TRANSIENT_LEVELS[-1]
    fine = replace(
        settings,
        accuracy=HISTORY_ACCURACY / 10.0,
        levels=(finest, refine_size(finest, 1)),
    )
    truth = build_truth(solve_transient(scene, fine))
    rows = []
    for pair in pairwise(TRANSIENT_LEVELS):
        solve = partial(solve_transient, scene, replace(settings, levels=pair))
        rows += _measure(name, "transient", {"fast": solve}, truth, effort.repeats)
    return rows


def _measure(
    name: str, method: Method, solves: Mapping[Path, Solve], truth: Truth, repeats: int
) -> list[Row]:
    """Solve each path once for its result and memory, then all in turns for time."""
    found = {path: _observe(solve) for path, solve in solves.items()}
    works = {path: partial(measure, solve) for path, solve in solves.items()}
    timed = run_in_turns(works, repeats)
    return [
        Row(
            scene=name,
            method=method,
            path=path,
            elements=solution.cost.elements,
            degrees_of_freedom=solution.cost.degrees_of_freedom,
            wall_s=min(time.wall_s for _, time in timed[path]),
            error=truth.compare(solution),
            stated_error=state_error(solution),
            linear_solves=solution.cost.linear_solves,
            rounds=solution.cost.rounds,
            peak_mb=peak_mb,
        )
        for path, (solution, peak_mb) in found.items()
    ]


def _observe(solve: Solve) -> tuple[Solution, float]:
    """Solution, and the memory that a second, warm solve takes [MB]."""
    solution = solve()
    if isinstance(solution, FailedSolution):
        raise SolveError(solution.outcome, solution.reason)
    tracemalloc.start()
    try:
        solve()
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    return solution, peak / 1e6


def write_bench(rows: Sequence[Row]) -> dict[str, Any]:
    """Plain values in the form ``netdesign.bench/1``."""
    return {
        "schema": BENCH_SCHEMA,
        "provenance": {
            "version": __version__,
            "python": platform.python_version(),
            "machine": platform.machine(),
            "cores": os.cpu_count(),
            **{name: version(name) for name in ("numpy", "scipy", "scikit-fem")},
        },
        "rows": [asdict(row) for row in rows],
        "summary": asdict(summarise(rows)),
    }


def print_bench(document: dict[str, Any], console: Console, words: Words) -> None:
    """Print a line for each row, then what they say together."""
    print_rows(document["rows"], console, words)
    print_document(document["summary"], console, words)
