"""Run time against error: scenes by resolution and method, in one run.

A row is a solve on one mesh with the coarser one before it, which gives the error
estimate: the cheapest result of that mesh that the program would hand out. Its truth is
the same scene on a finer mesh. Meshes and start values of a scene's shape are found
before the first timing, as in an envelope of many cases.
"""

from __future__ import annotations

import math
import os
import platform
import tracemalloc
from collections import defaultdict
from collections.abc import Callable, Collection, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from importlib.metadata import version
from itertools import pairwise
from statistics import median
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from netdesign import __version__
from netdesign.addons.charts import draw_decades
from netdesign.addons.evidence.measurements import (
    fit_order,
    measure,
    show_document,
    show_rows,
    summarise_times,
)
from netdesign.addons.history.settings import TRANSIENT_LEVELS, TransientSettings
from netdesign.addons.history.transient import solve_transient
from netdesign.coupling.balance import SuctionError
from netdesign.coupling.interface import STEADY_ERROR
from netdesign.coupling.scene import MESH_LEVELS, Scene, SolverSettings
from netdesign.coupling.solution import (
    EndPull,
    FailedSolution,
    Solution,
    require_solved,
)
from netdesign.coupling.steady.solve import solve_steady
from netdesign.outcome import Outcome, SolveError
from netdesign.report.drawing.plain_svg import (
    ACCENT,
    GREY,
    WIDTH,
    Chart,
    Frame,
    bounds_of,
)
from netdesign.report.words import ENGLISH
from netdesign.snow.element import share_template
from netdesign.snow.mesh import MeshSize

if TYPE_CHECKING:
    from rich.console import Console

HALVINGS = 2  # of every side: a truth is four times finer
# Rounding in the balance grows with the mesh; a truth is not handed out as a result.
_TRUTH_BALANCE = 1e-6
# Rounds beside which the snow lifts off take up to 25 on a fine mesh; a result would be
# left to a coarser one (measured: 180 linear solves, where 40 to 100 are usual).
_TRUTH_PATIENCE = 10.0
# No second mesh states an error as small: refinement goes on to the last.
_EVERY_MESH = 0.8 * STEADY_ERROR.floor


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Truth:
    """End pulls of the fine mesh, shape (2,) each [N/m]."""

    foot: NDArray[np.float64]
    head: NDArray[np.float64]

    def compare(self, solution: Solution) -> float:
        """Larger relative error of the two end pulls, as vectors [-]."""
        return max(self.compare_ends(solution))

    def compare_ends(self, solution: Solution) -> tuple[float, float]:
        """Relative errors of the pulls at foot and head [-]."""
        return (
            _relative(_vector(solution.foot), self.foot),
            _relative(_vector(solution.head), self.head),
        )


def solve_truth(
    scene: Scene,
    size: MeshSize,
    settings: SolverSettings,
    *,
    halvings: int = HALVINGS,
) -> Truth:
    """End pulls on a mesh finer than ``size`` in each direction, at the net's ends too.

    Every side of a triangle is halved so many times; by default it is four times finer.

    Raises
    ------
    SolveError
        If the fine mesh gives no converged solution.
    """
    fine = replace(
        settings,
        levels=(size, refine_size(size, halvings)),
        balance_tolerance=_TRUTH_BALANCE,
    )
    return solve_fine(scene, fine)


def solve_fine(scene: Scene, settings: SolverSettings) -> Truth:
    """Truth on the finest of the settings' meshes, however long it takes.

    Where the first flow on a fine mesh finds no contact, the coarsest of the usual
    meshes leads there. Suction just beyond what is accepted keeps it from being a
    result, not from being what coarser meshes are held against.

    Raises
    ------
    SolveError
        If that mesh gives no solution in balance.
    """
    patient = replace(settings, patience=_TRUTH_PATIENCE)
    try:
        return _solve_finest(scene, patient)
    except SolveError:
        levels = (MESH_LEVELS[0], *settings.levels)
        accuracy = min(settings.accuracy, _EVERY_MESH)
        return _solve_finest(scene, replace(patient, levels=levels, accuracy=accuracy))


def _solve_finest(scene: Scene, settings: SolverSettings) -> Truth:
    try:
        solution = solve_steady(scene, settings, on_failure="raise")
    except SuctionError as refusal:
        if refusal.held is None:
            raise
        solution = refusal.held
    if not _is_on(settings.levels[-1], require_solved(solution)):
        raise SolveError(Outcome.MAX_ITERATIONS)  # left to a coarser mesh
    return build_truth(solution)


def build_truth(solution: Solution | FailedSolution) -> Truth:
    """Truth from a fine solution.

    Raises
    ------
    SolveError
        If it has failed.
    """
    solved = require_solved(solution)
    return Truth(foot=_vector(solved.foot), head=_vector(solved.head))


def refine_size(size: MeshSize, times: int) -> MeshSize:
    """Mesh size whose triangles are cut in four ``times`` times."""
    return replace(size, subdivisions=size.subdivisions + times)


def find_level(solution: Solution, levels: tuple[MeshSize, ...]) -> MeshSize:
    """Level whose mesh a solution was found on, by its number of triangles."""
    return next((level for level in levels if _is_on(level, solution)), levels[-1])


def _is_on(size: MeshSize, solution: Solution) -> bool:
    """A mesh of this size has as many triangles as that of a solution."""
    scene = solution.scene
    template = share_template(scene.modelled_aspect, size, scene.layer_tops)
    return bool(template.triangles.shape[1] == solution.cost.elements)


def state_error(solution: Solution) -> float:
    """Larger relative error of the end forces that a solution states [-]."""
    return max(pull.error / pull.size for pull in (solution.foot, solution.head))


def _relative(pull: NDArray[np.float64], true: NDArray[np.float64]) -> float:
    return float(np.hypot(*(pull - true)) / np.hypot(*true))


def _vector(pull: EndPull) -> NDArray[np.float64]:
    return np.array([pull.x, pull.y])


BENCH_SCHEMA = "netdesign.bench/1"
HISTORY_ACCURACY = 0.01  # of the steps

# Accuracies asked for: of the truth, and of a pair of meshes (both are always solved).
# The iterations leave a 25th of them.
_TIGHT, _OFFERED = 1e-4, 5e-3


_REPEATS = 5  # of each timing
QUICK = {"finest": 2, "repeats": 3}  # place of the finest level; of each timing
_ASKED = (1e-2, 5e-3, 1e-3)  # accuracies whose times are told

Solve = Callable[[], Solution | FailedSolution]


def measure_steady(
    name: str, scene: Scene, finest: int = 3, repeats: int = _REPEATS
) -> list[Row]:
    """Rows of one scene: every pair of levels up to the finest.

    Raises
    ------
    SolveError
        If a mesh gives no converged solution.
    """
    settings = SolverSettings(accuracy=_OFFERED)
    tight = replace(settings, accuracy=_TIGHT)
    # cut in four once: to cut it twice would take minutes a scene
    truth = solve_truth(scene, MESH_LEVELS[finest], tight, halvings=1)
    rows = []
    for pair in pairwise(MESH_LEVELS[: finest + 1]):
        solve = partial(solve_steady, scene, replace(settings, levels=pair))
        rows.append(_measure(name, "steady", solve, truth, repeats))
    return rows


def measure_transient(name: str, scene: Scene) -> list[Row]:
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
        rows.append(_measure(name, "transient", solve, truth, _REPEATS))
    return rows


def time_accuracies(scenes: Collection[Scene]) -> list[dict[str, Any]]:
    """Times of all scenes to each accuracy, which is stated with the result."""
    shown = []
    for accuracy in _ASKED:
        settings = SolverSettings(accuracy=accuracy)
        solves = [partial(solve_steady, scene, settings) for scene in scenes]
        times = [min(measure(solve) for _ in range(_REPEATS)) for solve in solves]
        shown.append({"accuracy": accuracy, **summarise_times(times)})
    return shown


def _measure(
    name: str, method: Method, solve: Solve, truth: Truth, repeats: int
) -> Row:
    """Solve twice for result and memory, then repeatedly for the shortest time."""
    solution, peak_mb = _observe(solve)
    return Row(
        scene=name,
        method=method,
        elements=solution.cost.elements,
        degrees_of_freedom=solution.cost.degrees_of_freedom,
        wall_s=min(measure(solve) for _ in range(repeats)),
        error=truth.compare(solution),
        stated_error=state_error(solution),
        linear_solves=solution.cost.linear_solves,
        rounds=solution.cost.rounds,
        peak_mb=peak_mb,
    )


def _observe(solve: Solve) -> tuple[Solution, float]:
    """Solution, and the memory that a second, warm solve takes [MB]."""
    solution = require_solved(solve())
    tracemalloc.start()
    try:
        solve()
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    return solution, peak / 1e6


def write_bench(rows: Sequence[Row], asked: Sequence[dict[str, Any]]) -> dict[str, Any]:
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
        "asked": list(asked),
        "summary": summarise(rows),
    }


def print_bench(document: dict[str, Any], console: Console) -> None:
    """Print a line for each row, times to accuracies, then what all say together."""
    show_rows(document["rows"], console)
    show_rows(document["asked"], console)
    show_document(document["summary"], console)


Method = Literal["steady", "transient"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One method on one mesh.

    Attributes
    ----------
    scene, method : str
        What was solved, and how.
    path : str
        Always ``fast``, for the kernels: a field of the document's form.
    elements, degrees_of_freedom : int
        Of the finer mesh.
    wall_s : float
        Shortest of the repeated timings: what else runs can only lengthen one [s].
    error : float
        Worse of the end pulls, relative, against a mesh twice as fine as the
        finest that is measured [-].
    stated_error : float
        What the solution itself says [-].
    linear_solves, rounds : int
        Of both meshes.
    peak_mb : float
        Most memory that Python and NumPy held at once, beyond what they held before;
        SciPy's sparse factors are not seen [MB].
    """

    scene: str
    method: Method
    elements: int
    degrees_of_freedom: int
    wall_s: float
    error: float
    stated_error: float
    linear_solves: int
    rounds: int
    peak_mb: float
    path: str = "fast"


def summarise(rows: Sequence[Row]) -> dict[str, float | None]:
    """Figures of the steady rows over all scenes; None where there are too few.

    ``cost_order``: p in time ~ degrees of freedom^p; ``error_order``: q in error ~
    degrees of freedom^-q/2. Both are medians unless named otherwise.
    """
    steady = [row for row in rows if row.method == "steady"]
    fitted = [group for group in _group_by_scene(steady) if len(group) > 2]
    costs = [_fit(group, "wall_s") for group in fitted]
    orders = [-2.0 * _fit(group, "error") for group in fitted]
    return {
        "cost_order": median(costs) if costs else None,
        "worst_cost_order": max(costs, default=None),
        "error_order": median(orders) if orders else None,
    }


def _group_by_scene(rows: Sequence[Row]) -> list[list[Row]]:
    groups: dict[str, list[Row]] = defaultdict(list)
    for row in rows:
        groups[row.scene].append(row)
    return list(groups.values())


def _fit(rows: Sequence[Row], name: str) -> float:
    """Power of the degrees of freedom with which a field of the rows grows."""
    sizes = [row.degrees_of_freedom for row in rows]
    return fit_order(sizes, [getattr(row, name) for row in rows])


_TALL, _LEFT, _ABOVE, _BELOW = 200.0, 42.0, 28.0, 32.0  # of the panel, beside it [pt]


def draw_work_precision(rows: Sequence[Row]) -> str:
    """Run time against error: a dot a row, the median of each resolution joined."""
    chart, points = Chart(language="en"), [_place(row) for row in rows]
    (left, right), (low, high) = (
        bounds_of([axis]) for axis in zip(*points, strict=True)
    )
    frame = Frame(
        left=_LEFT,
        top=_ABOVE,
        width=WIDTH - _LEFT - 8.0,
        height=_TALL,
        x_low=right + 0.1,  # falling: better is to the right
        x_high=left - 0.1,
        y_low=low - 0.1,
        y_high=high + 0.1,
    )
    for number, (method, stroke) in enumerate(
        {"steady": ACCENT, "transient": GREY}.items()
    ):
        drawn = [row for row in rows if row.method == method]
        if drawn:
            _draw_rows(chart, frame, drawn, stroke)
            x = frame.left + 130.0 * number
            chart.line(((x, 7.0), (x + 18.0, 7.0)), stroke=stroke)
            chart.text(x + 22.0, 9.5, ENGLISH(f"bench_plot.{method}"))
    chart.axes(frame, x_ticks=False, y_ticks=False)
    for across in (True, False):
        draw_decades(chart, frame, across=across)
    chart.text(2.0, _ABOVE - 5.0, ENGLISH("bench_plot.time"))
    bottom = _ABOVE + _TALL + _BELOW
    middle = frame.left + frame.width / 2.0
    chart.text(middle, bottom - 6.0, ENGLISH("bench_plot.error"), anchor="middle")
    return chart.write(bottom, ENGLISH("bench_plot.title"))


def _draw_rows(chart: Chart, frame: Frame, rows: Sequence[Row], stroke: str) -> None:
    """Dots of all rows; steady ones have a line through the medians of their meshes."""
    for x, y in map(_place, rows):
        chart.dot((frame.x(x), frame.y(y)), 1.2, fill=stroke, stroke=stroke)
    if rows[0].method == "steady":
        levels = zip(*_group_by_scene(rows), strict=True)
        groups = [zip(*map(_place, level), strict=True) for level in levels]
        middles = [map(median, group) for group in groups]
        line = [(frame.x(x), frame.y(y)) for x, y in middles]
        chart.line(line, stroke=stroke, width=1.2)


def _place(row: Row) -> tuple[float, float]:
    """Logarithms of error [%] and run time [ms]."""
    return math.log10(100.0 * row.error), math.log10(1e3 * row.wall_s)
