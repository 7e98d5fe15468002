"""What an envelope costs and how well it bounds: the figures of the README.

Sizes are arguments, so that the same functions serve a quick look and the full table.
"""

from __future__ import annotations

import math
import random
import resource
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.envelope.adaptive import SearchSettings
from netdesign.envelope.grid import Interval
from netdesign.envelope.parameters import Box
from netdesign.envelope.runner import Runner
from netdesign.envelope.search import (
    RowEnvelope,
    RowTask,
    refine_settings,
    run_grid,
    search_rows,
)
from netdesign.envelope.store import CaseStore
from netdesign.envelope.workers import Job, ProcessPool, Workers
from netdesign.errors import ModelError
from netdesign.snow.ground import GroundLaw
from netdesign.snow.snowpack import Snowpack
from netdesign.structure.layout import SupportLayout

SCHEMA = "netdesign.bench-envelope/1"
ACCURACY = 0.005
_AXES = ("density", "friction_angle", "inclination")
_MEGABYTE = 2**20


@dataclass(frozen=True, slots=True, kw_only=True)
class BenchSize:
    """How much is measured; the defaults are those of the table of targets."""

    grid: int = 10  # samples of each range
    rows: int = 20
    missed_scenes: int = 200
    missed_grid: int = 15
    worker_cases: int = 200
    types: int = 40
    portfolio: tuple[int, ...] = (2_500, 5_000, 10_000)


THINNED = BenchSize(
    grid=4,
    rows=3,
    missed_scenes=2,
    missed_grid=4,
    worker_cases=64,
    types=2,
    portfolio=(500, 1_000, 2_000),
)


def run_envelope_bench(size: BenchSize = THINNED) -> dict[str, Any]:
    """All figures as one document.

    Parameters
    ----------
    size : BenchSize
        ``BenchSize()`` for the full table, which takes hours for its check against
        grids; ``THINNED`` for a quick look. The document says which.
    """
    measures: tuple[Callable[[BenchSize], dict[str, Any]], ...] = (
        _measure_one_row,
        _measure_grid,
        _measure_site,
        _measure_missed,
        _measure_workers,
        _measure_portfolio,
    )
    return {
        "schema": SCHEMA,
        "is_thinned": size != BenchSize(),
        "rows": [measure(size) for measure in measures],
    }


def build_random_task(seed: int, settings: SolverSettings | None = None) -> RowTask:
    """Net row drawn from the usual ranges of the theory page; same seed, same row."""
    draw = random.Random(seed)
    thickness = draw.uniform(1.5, 5.0)
    kind = draw.choice(("free", "no-slip", "sliding"))
    slip = draw.uniform(0.1, 4.0) * thickness if kind == "sliding" else 0.0
    solver = settings or SolverSettings(accuracy=ACCURACY)
    return RowTask(
        scene=Scene(
            snowpack=Snowpack(
                slope_angle=math.radians(draw.uniform(30.0, 50.0)),
                thickness=thickness,
                upslope_length=draw.uniform(2.0, 8.0) * thickness,
                density=350.0,
            ),
            ground=GroundLaw(kind=kind, slip_length=slip),  # type: ignore[arg-type]
            net=Net(
                height_normal=thickness * draw.uniform(1.0, 1.2),
                inclination=math.radians(30.0),
                stiffness_per_m=10.0 ** draw.uniform(6.5, 7.7),
                slack=draw.uniform(0.0, 0.1),
                friction_angle=math.radians(30.0),
            ),
        ),
        box=_box(),
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

    Negative if the bound holds everywhere. Cases that fail count as far as they
    give a force.
    """
    results = run_grid(task, dict.fromkeys(_AXES, samples), Runner())
    excess = [
        result.member_forces[member].value / found.maxima.upper_bound[place] - 1.0
        for result in results
        if result.is_converged
        for place, member in enumerate(found.members)
        if found.maxima.upper_bound[place] > 0.0
    ]
    return max(excess, default=None)


def _box() -> Box:
    return Box(
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
    pack = replace(task.scene.snowpack, thickness=3.0, upslope_length=15.0)
    net = Net(
        height_normal=3.0,
        inclination=math.radians(30.0),
        stiffness_per_m=2e7,
        slack=0.05,
        friction_angle=math.radians(30.0),
    )
    ground = GroundLaw(kind="sliding", slip_length=3.0)
    scene = replace(task.scene, snowpack=pack, net=net, ground=ground)
    return replace(task, scene=scene)


def _measure_one_row(_: BenchSize) -> dict[str, Any]:
    task = _example_task()
    runner = Runner()
    start = time.perf_counter()
    (found,) = search_rows([task], runner)
    elapsed = time.perf_counter() - start
    scale = task.search.small_share * max(found.maxima.maximum)
    gap = max(
        (upper - most) / max(most, scale)
        for upper, most in zip(
            found.maxima.upper_bound, found.maxima.maximum, strict=True
        )
    )
    error = max(
        pull.error / pull.size
        for result in found.results
        if result.solution is not None
        for pull in (result.solution.foot, result.solution.head)
    )
    return {
        "what": "three parameters, one net row",
        "wall_s": elapsed,
        "cases": len(found.results),
        "solved": runner.counts.solved,
        "skipped": found.skipped,
        "gap": gap,
        "numerical_error": error,
        "is_closed": found.maxima.is_closed,
    }


def _measure_grid(size: BenchSize) -> dict[str, Any]:
    start = time.perf_counter()
    results = run_grid(_example_task(), dict.fromkeys(_AXES, size.grid), Runner())
    return {
        "what": f"dense grid of {size.grid} x {size.grid} x {size.grid} cases",
        "wall_s": time.perf_counter() - start,
        "cases": len(results),
        "failed": sum(not result.is_converged for result in results),
    }


def _measure_site(size: BenchSize) -> dict[str, Any]:
    """Rows, searched and confirmed, through a store: first and second run.

    Without reports: those are measured where they are made.
    """
    finer = refine_settings(SolverSettings(accuracy=ACCURACY))
    tasks = [
        replace(build_random_task(seed), confirmed_by=finer)
        for seed in range(size.rows)
    ]
    times, solved = [], []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(2):
            start = time.perf_counter()
            with CaseStore(Path(folder) / "cases.sqlite", lambda _: None) as store:
                runner = Runner(store=store)
                search_rows(tasks, runner)
            times.append(time.perf_counter() - start)
            solved.append(runner.counts.solved)
    return {
        "what": f"{size.rows} net rows, searched and confirmed, without reports",
        "wall_s": times[0],
        "solved": solved[0],
        "second_run_s": times[1],
        "second_run_solved": solved[1],
        "second_over_first": times[1] / times[0],
    }


def _measure_missed(size: BenchSize) -> dict[str, Any]:
    excess, open_gaps = [], 0
    for seed in range(size.missed_scenes):
        task = build_random_task(seed)
        try:
            (found,) = search_rows([task], Runner())
        except ModelError:  # a drawn corner that the model refuses
            continue
        if found.gap:
            open_gaps += 1
            continue
        excess.append(measure_excess(task, found, size.missed_grid))
    known = [one for one in excess if one is not None]
    return {
        "what": f"grids of {size.missed_grid}^3 against the bound",
        "scenes": len(known),
        "not_proven": open_gaps,
        "missed": sum(one > 1e-9 for one in known),
        "largest_excess": max(known, default=None),
    }


def _measure_workers(size: BenchSize) -> dict[str, Any]:
    count = max(2, round(size.worker_cases ** (1.0 / 3.0)))
    task = _example_task()
    times = {}
    for processes in (1, 2):
        pool = ProcessPool(processes, worth=1)
        try:
            _drain(pool, [Job(scene=task.scene, settings=task.settings)] * processes)
            runner = Runner(workers=pool)
            start = time.perf_counter()
            results = run_grid(task, dict.fromkeys(_AXES, count), runner)
            times[processes] = time.perf_counter() - start
        finally:
            pool.close()
    return {
        "what": "2 workers against 1, processes started beforehand",
        "cases": len(results),
        "one_s": times[1],
        "two_s": times[2],
        "speed_up": times[1] / times[2],
    }


def _drain(workers: Workers, jobs: Sequence[Job]) -> None:
    for _ in workers.solve(jobs):
        pass


def _measure_portfolio(size: BenchSize) -> dict[str, Any]:
    types = [build_random_task(seed) for seed in range(size.types)]
    points = []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "cases.sqlite"
        with CaseStore(path, lambda _: None) as store:
            search_rows(types, Runner(store=store))
        for rows in size.portfolio:
            start = time.perf_counter()
            with CaseStore(path, lambda _: None) as store:
                runner = Runner(store=store)
                found = search_rows(
                    [types[k % len(types)] for k in range(rows)], runner
                )
            points.append(
                {
                    "rows": len(found),
                    "wall_s": time.perf_counter() - start,
                    "solved": runner.counts.solved,
                    "peak_mb": _peak_megabytes(),
                }
            )
    return {"what": f"rows of {size.types} types through the store", "points": points}


def _peak_megabytes() -> float:
    """Largest memory of this process so far."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (_MEGABYTE if sys.platform == "darwin" else 1024)
