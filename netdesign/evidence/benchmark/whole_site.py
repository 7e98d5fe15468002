"""A site of many net rows, from its workbook's values to its reports, timed."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from netdesign.checks import load_standard
from netdesign.coupling.scene import SolverSettings
from netdesign.evidence.benchmark.clock import Clock
from netdesign.site.model import NetRow, Site
from netdesign.site.reader import read_site
from netdesign.site.template.workbook import write_site_workbook
from netdesign.solving.runner import Runner
from netdesign.solving.store import CaseStore
from netdesign.solving.workers import build_workers
from netdesign.study.check_run import CheckRun
from netdesign.study.check_site import check_site
from netdesign.study.records import Study

_STANDARD = "nf-p-95-304-style"
_LESS_SNOW = 0.03  # of the snow of the example's row, each time it is used again

Render = Callable[[Study], object]


@dataclass(frozen=True, slots=True, kw_only=True)
class Pass:
    """One run over the site, through a store."""

    wall_s: float
    cpu_s: float
    solved: int
    reused: int


def build_bench_site(count: int) -> Site:
    """Site of so many distinct net rows: the example's, again with less snow."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "example.xlsx"
        write_site_workbook(path, example=True)
        site = read_site(path)
    rows = [
        _vary_row(site.rows[k % len(site.rows)], k // len(site.rows))
        for k in range(count)
    ]
    return replace(site, rows=tuple(rows))


def _vary_row(row: NetRow, again: int) -> NetRow:
    share = 1.0 - _LESS_SNOW * again
    return replace(
        row,
        id=f"{row.id}.{again + 1}",
        snow_thickness=share * row.snow_thickness,
        upslope_length=share * row.upslope_length,
    )


def measure_site(count: int, render: Render, processes: int) -> tuple[Pass, Pass]:
    """Two runs of one site through one store: searched, checked, reported.

    Parameters
    ----------
    count : int
        Net rows.
    render : callable
        Makes all reports of a study.
    processes : int
        That solve cases; they are started within the time of the first run.
    """
    site = build_bench_site(count)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "cases.sqlite"
        first, second = (_run_once(site, render, path, processes) for _ in range(2))
    return first, second


def _run_once(site: Site, render: Render, path: Path, processes: int) -> Pass:
    run = CheckRun(settings=SolverSettings(accuracy=0.01))
    standard = load_standard(_STANDARD)
    with Clock() as clock:
        workers = build_workers("", processes)
        try:
            with CaseStore(path, lambda _: None) as store:
                runner = Runner(workers=workers, store=store)
                (study,) = check_site(site, [standard], run, runner)
                render(study)
        finally:
            workers.close()
    return Pass(
        wall_s=clock.wall_s,
        cpu_s=clock.cpu_s,
        solved=runner.counts.solved,
        reused=runner.counts.reused,
    )
