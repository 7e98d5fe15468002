"""Cost of envelopes and closeness of their bounds: the figures of its README.

Sizes are arguments, so that the same functions serve a quick look and the full table.
"""

from __future__ import annotations

import math
import random
import sys
import tempfile
from collections.abc import Callable
from contextlib import closing
from dataclasses import asdict, dataclass, replace
from itertools import product
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

from netdesign.core.library import find_core
from netdesign.coupling.scene import SolverSettings
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.envelope.rows import RowEnvelope, RowTask, build_point_task, list_grid
from netdesign.envelope.run import run_cases
from netdesign.envelope.search import run_grid, search_rows
from netdesign.evidence.benchmark.against import Bench, Size, time_site
from netdesign.evidence.benchmark.scenes import write_site
from netdesign.evidence.runner import Clock
from netdesign.evidence.scene import build_scene
from netdesign.numerics.arrays import Floats
from netdesign.outcome import ModelError
from netdesign.search.maxima import RESOLVED_SHARE, Maxima, MaximaSearch, SearchSettings
from netdesign.search.surrogate import Point
from netdesign.snow.ground import GroundLaw
from netdesign.solving.runner import Runner
from netdesign.solving.workers import ProcessPool
from netdesign.structure.layout import SupportLayout
from netdesign.words.message import say

SCHEMA = "netdesign.bench-envelope/1"
ACCURACY = 0.005
_AXES = ("density", "friction_angle", "inclination")
_PROCESSES = 2
# Points of a grid that are solved: all near a maximum of the model, and one in so many
# of the others; of a small grid all.
_NEAR, _EVERY, _WHOLE = 0.95, 40, 200
_WIDTHS = (0.6, 0.4, 0.3, 0.2)  # of made-up peaks; the last may be missed
_ROUNDING = 1e-9

OnRow = Callable[[dict[str, Any]], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class BenchSize:
    """Amount of measurement; the defaults are those of the table of figures to reach.

    Only the random scenes are fewer: 200 of them take most of an hour.
    """

    grid: int = 10  # samples of each range
    rows: int = 20
    missed_scenes: int = 5
    missed_grid: int = 15
    peaks: int = 25  # of each width


QUICK = BenchSize(grid=4, rows=2, missed_scenes=1, missed_grid=5, peaks=2)


def run_envelope_bench(
    size: BenchSize | None = None, on_row: OnRow = lambda _: None
) -> dict[str, Any]:
    """All figures as one document, each with whether it is reached.

    Parameters
    ----------
    size : BenchSize, optional
        The table's own unless told otherwise; the document holds it.
    on_row : callable, optional
        Takes each row of the table once it is measured; its texts are messages.
    """
    size = size or BenchSize()
    measures: tuple[Callable[[], dict[str, Any]], ...] = (
        _measure_one_row,
        lambda: _measure_grid(size),
        lambda: _measure_site(size),
        lambda: _measure_missed(size),
        lambda: _measure_narrow(size),
    )
    rows = []
    for measure in measures:
        row = measure()
        on_row(row)
        rows.append(row | {name: str(row[name]) for name in ("what", "reach")})
    return {
        "schema": SCHEMA,
        "size": asdict(size),
        "pass": all(row["reached"] for row in rows),
        "rows": rows,
    }


def build_random_task(seed: int, settings: SolverSettings | None = None) -> RowTask:
    """Net row drawn from the usual ranges of the theory page; same seed, same row."""
    draw = random.Random(seed)
    thickness = draw.uniform(1.5, 5.0)
    kind = draw.choice(("free", "no-slip", "sliding"))
    slip = draw.uniform(0.1, 4.0) * thickness if kind == "sliding" else 0.0
    solver = settings or SolverSettings(accuracy=ACCURACY)
    return RowTask(
        scene=build_scene(
            (thickness, 350.0),
            slope=draw.uniform(30.0, 50.0),
            length=draw.uniform(2.0, 8.0) * thickness,
            ground=GroundLaw(kind=kind, slip_length=slip),  # type: ignore[arg-type]
            height=thickness * draw.uniform(1.0, 1.2),
            stiffness=10.0 ** draw.uniform(6.5, 7.7),
            slack=draw.uniform(0.0, 0.1),
        ),
        ranges=_build_ranges(),
        layout=SupportLayout(
            post_spacing=draw.uniform(2.5, 4.0),
            uphill_anchor_distance=draw.uniform(2.0, 5.0),
            downhill_anchor_distance=draw.uniform(2.0, 5.0),
        ),
        settings=solver,
        search=SearchSettings(gap=ACCURACY),
        confirmed_by=None,
    )


def measure_excess(task: RowTask, found: RowEnvelope, samples: int) -> float | None:
    """Largest force of a grid beyond the stated bound, relative; None without cases.

    Negative if the bound holds everywhere. Of a large grid those points are solved at
    which the search's own model comes near a maximum, and every 40th of the others,
    in case the model is wrong. Cases that fail count as far as they give a force.
    """
    points = _choose_points(found, samples)
    results = run_cases([build_point_task(task, point) for point in points], Runner())
    excess = [
        result.member_forces[member].value / found.maxima.upper_bound[place] - 1.0
        for result in results
        if result.is_converged
        for place, member in enumerate(found.members)
        if found.maxima.upper_bound[place] > 0.0
    ]
    return max(excess, default=None)


def _choose_points(found: RowEnvelope, samples: int) -> list[Point]:
    """Points of a grid near a maximum of the model, and every 40th of the others."""
    grid = list_grid([samples] * len(found.task.ranges.axes))
    model, maxima = found.maxima.surrogate, found.maxima
    if model is None or len(grid) <= _WHOLE:
        return grid
    chosen = set(grid[::_EVERY])
    for place in range(len(found.members)):
        least = _NEAR * maxima.maximum[place]
        if least > 0.0:
            near = model.evaluate(np.array(grid), place)[0] >= least
            chosen |= {
                point for point, is_near in zip(grid, near, strict=True) if is_near
            }
    return sorted(chosen)


def _build_ranges() -> Ranges:
    return Ranges(
        intervals=(
            ("density", Interval(low=250.0, high=450.0)),
            (
                "friction_angle",
                Interval(low=math.radians(15.0), high=math.radians(45.0)),
            ),
            ("inclination", Interval(low=math.radians(25.0), high=math.radians(35.0))),
        )
    )


def _example_task() -> RowTask:
    """Three metres of snow on sliding ground, the same for every machine."""
    task = build_random_task(0)
    slope = math.degrees(task.scene.snowpack.slope_angle)
    ground = GroundLaw(kind="sliding", slip_length=3.0)
    scene = build_scene(
        (3.0, 350.0), slope=slope, length=15.0, ground=ground, slack=0.05
    )
    return replace(task, scene=scene)


def _measure_one_row() -> dict[str, Any]:
    task = _example_task()
    runner = Runner()
    with Clock() as clock:
        (found,) = search_rows([task], runner)
    extremes = found.extremes.values()
    scale = task.search.small_share * max(one.force.value for one in extremes)
    gap = max(one.hidden / max(one.force.value, scale) for one in extremes)
    error = max(
        pull.error / pull.size
        for result, doubt in zip(found.results, found.maxima.doubts, strict=True)
        if result.solution is not None and doubt is None  # not far below the maxima
        for pull in (result.solution.foot, result.solution.head)
    )
    solved = runner.counts.solved
    return {
        "what": say("bench.row_what"),
        "reach": say("bench.row_reach"),
        "reached": found.maxima.is_closed
        and clock.wall_s <= 1.0
        and solved <= 80
        and max(gap, error) <= ACCURACY * (1.0 + 1e-9),
        "wall_s": clock.wall_s,
        "cpu_s": clock.cpu_s,
        "cases": len(found.results),
        "solved": solved,
        "skipped": found.skipped,
        "gap": gap,
        "numerical_error": error,
        "is_closed": found.maxima.is_closed,
    }


def _measure_grid(size: BenchSize) -> dict[str, Any]:
    with Clock() as clock, closing(ProcessPool(_PROCESSES)) as pool:
        runner = Runner(workers=pool)
        grid = run_grid(_example_task(), dict.fromkeys(_AXES, size.grid), runner)
    failed = sum(not result.is_converged for result in grid.results)
    return {
        "what": say("bench.grid_what", grid=size.grid),
        "reach": say("bench.grid_reach"),
        "reached": not failed and clock.wall_s <= 5.0,
        "processes": _PROCESSES,
        "wall_s": clock.wall_s,
        "cpu_s": clock.cpu_s,
        "cases": len(grid.results),
        "solved": runner.counts.solved,
        "skipped": grid.skipped,
        "failed": failed,
    }


def _measure_site(size: BenchSize) -> dict[str, Any]:
    """Two checks as a user runs them; the second is told from the store."""
    with tempfile.TemporaryDirectory() as folder:
        inputs = Size(rows=size.rows)
        bench = Bench(Path(folder), inputs, has_core=find_core() is not None)
        write_site(bench.folder / "site", size.rows)
        first, second = time_site(bench, Path(sys.executable))
    ratio = second.wall_s / first.wall_s
    return {
        "what": say("bench.site_what", rows=size.rows),
        "reach": say("bench.site_reach"),
        "reached": first.wall_s <= 15.0 and ratio <= 0.1,
        "processes": _PROCESSES,
        "first": asdict(first),
        "second": asdict(second),
        "second_over_first": ratio,
        "second_over_first_cpu": second.cpu_s / first.cpu_s,
    }


def _measure_missed(size: BenchSize) -> dict[str, Any]:
    excess, open_gaps, refused = [], 0, 0
    for seed in range(size.missed_scenes):
        task = build_random_task(seed)
        try:
            (found,) = search_rows([task], Runner())
        except ModelError:  # a drawn corner that the model refuses
            refused += 1
            continue
        if found.gap:
            open_gaps += 1
            continue
        excess.append(measure_excess(task, found, size.missed_grid))
    known = [one for one in excess if one is not None]
    missed = sum(one > _ROUNDING for one in known)
    return {
        "what": say("bench.missed_what", grid=size.missed_grid),
        "reach": say("bench.missed_reach"),
        "reached": missed == 0 and bool(known),
        "scenes": len(known),
        "refused": refused,
        "not_proven": open_gaps,
        "missed": missed,
        "largest_excess": max(known, default=None),
    }


def _measure_narrow(size: BenchSize) -> dict[str, Any]:
    points = measure_peaks(size.peaks, _WIDTHS)
    return {
        "what": say("bench.peaks_what"),
        "reach": say("bench.peaks_reach", width=RESOLVED_SHARE),
        "reached": not any(
            point["missed"] for point in points if point["width"] >= RESOLVED_SHARE
        ),
        "points": points,
    }


Response = Callable[[Floats], Floats]

_SAMPLES = 21  # of each axis, for the true maximum
_SIGMA = 2.3548  # widths at half height of a Gaussian bell, in its sigmas


def build_peak(seed: int, width: float) -> Response:
    """Tilted plane with a peak as high as a tenth of it to itself; three parameters.

    Parameters
    ----------
    seed : int
        Equal seeds give equal responses.
    width : float
        Of the peak at half its height, as a share of a range.

    Returns
    -------
    callable
        Places of shape (n, 3) to values of shape (n,).
    """
    rng = np.random.default_rng(seed)
    top, height = rng.uniform(0.0, 1.0, 3), rng.uniform(1.0, 10.0)
    slope, sigma = 1.5 * rng.normal(size=3), width / _SIGMA

    def respond(at: Floats) -> Floats:
        square = np.sum((at - top) ** 2, axis=1)
        bell: Floats = np.exp(-square / (2.0 * sigma**2))
        return 10.0 + at @ slope + height * bell

    return respond


def search_peak(response: Response) -> tuple[Maxima, float]:
    """Search of one response, and its true maximum over the bound, less 1.

    The truth is that of a dense grid; the excess is negative where the bound holds.
    """
    found = _drive(response)
    axis = np.linspace(0.0, 1.0, _SAMPLES)
    truth = float(response(np.array(list(product(axis, repeat=3)))).max())
    return found, truth / found.upper_bound[0] - 1.0


def measure_peaks(count: int, widths: tuple[float, ...]) -> list[dict[str, Any]]:
    """Missed peaks by width; a search that did not close states no bound."""
    points = []
    for width in widths:
        ends = [search_peak(build_peak(seed, width)) for seed in range(count)]
        points.append(
            {
                "width": width,
                "searches": count,
                "not_closed": sum(not found.is_closed for found, _ in ends),
                "missed": sum(
                    found.is_closed and excess > _ROUNDING for found, excess in ends
                ),
                "median_cases": median(len(found.points) for found, _ in ends),
            }
        )
    return points


def _drive(response: Response) -> Maxima:
    search = MaximaSearch(3, SearchSettings())
    while points := search.ask():
        values = response(np.array(points)).tolist()
        search.tell([(value,) for value in values])
    if search.result is None:
        raise AssertionError("a search that asks no more has ended")
    return search.result
