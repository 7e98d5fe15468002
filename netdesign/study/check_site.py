"""The use case: site -> cases -> checks -> studies."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

from netdesign import addon_table
from netdesign.checks import Standard
from netdesign.edge.progress import Phase, RunProgress
from netdesign.envelope.rows import RowEnvelope
from netdesign.site.model import NetRow, Site
from netdesign.solving.runner import Runner
from netdesign.study.cases import list_alike, search_site
from netdesign.study.judge import gather_study
from netdesign.study.records import Study
from netdesign.study.row_to_check import CheckRun
from netdesign.study.side_by_side import (
    RowsJob,
    Studies,
    find_rows,
    judge_rows,
    keep_rows,
    name_rows,
)
from netdesign.words.message import say

# Progress that is not shown.
_SILENT = RunProgress([Phase(key="", words="", cases=0)], lambda _: None)
OnRow = Callable[[Studies], None]


def _keep_silent(_: Studies) -> None:
    """Report no row."""


_ROWS_A_PROCESS = 2  # at least; with fewer some processes would wait for the others


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedSite:
    """A site with the solved cases of its rows."""

    site: Site
    rows: Sequence[RowEnvelope]


def check_site(
    site: Site,
    standards: Sequence[Standard],
    run: CheckRun,
    runner: Runner | None = None,
    watch: RunProgress | None = None,
    on_row: OnRow | None = None,
) -> list[Study]:
    """Check a site against limit profiles; its cases are solved once.

    Parameters
    ----------
    site : Site
        What the engineer gives.
    standards : sequence of Standard
        Limit profiles.
    run : CheckRun
        Settings and identity of the run.
    runner : Runner, optional
        Where cases are solved and kept; this process unless told otherwise. It
        remembers the faults of the program. Rows that its store knows are neither
        solved nor judged again.
    watch : RunProgress, optional
        Told of every phase, wave and check.
    on_row : callable, optional
        Called with the studies of each row, one a profile, as soon as they are known.

    Returns
    -------
    list of Study
        One for each profile.

    Raises
    ------
    AddonError
        If a reliability is asked for, and the installation lacks its add-on.
    """
    if run.has_reliability:  # refused before anything is solved
        addon_table.load("--reliability", addon_table.ROW_RECORDS["reliability"])
    runner, watch = runner or Runner(), watch or _SILENT
    on_row = on_row or _keep_silent
    names = name_rows(site, standards, run) if runner.store else {}
    by_row = find_rows(names, runner, len(standards))
    for studies in by_row.values():
        on_row(studies)
    new = tuple(row for row in site.rows if row.id not in by_row)
    if new:
        part = replace(site, rows=new)
        by_row |= _judge_new(part, names, standards, run, runner, watch, on_row)
    return _gather(site, by_row, standards, run)


def _judge_new(
    site: Site,
    names: Mapping[str, str],
    standards: Sequence[Standard],
    run: CheckRun,
    runner: Runner,
    watch: RunProgress,
    on_row: OnRow,
) -> dict[str, Studies]:
    """Studies by the ids of the rows, solved, judged, and kept under their names.

    Each row is searched and judged in one process, where there are rows enough for all.
    """
    build = partial(_build_job, site, standards, run, runner)
    groups, pool = list_alike(site, run), runner.workers.pool
    if pool is None or len(groups) >= _ROWS_A_PROCESS * pool.processes:
        watch.enter("checks", say("phase.rows"))
        jobs = [build(rows) for rows in groups]
    else:  # all processes solve cases of the same few rows
        solved = solve_rows(site, run, runner, watch)
        watch.enter("checks")
        jobs = _list_jobs(solved, build)

    def keep(job: RowsJob, judged: list[Studies]) -> None:
        keep_rows(names, job.site.rows, judged, runner)
        for studies in judged:
            watch.count_piece()
            on_row(studies)

    return judge_rows(jobs, runner, keep)


def solve_rows(
    site: Site, run: CheckRun, runner: Runner, watch: RunProgress
) -> SolvedSite:
    """Solve the cases of every net row."""
    rows = search_site(site, run, runner, watch.report_wave)
    return SolvedSite(site=site, rows=rows)


def judge_solved(
    solved: SolvedSite,
    standards: Sequence[Standard],
    run: CheckRun,
    runner: Runner,
    watch: RunProgress,
) -> list[Study]:
    """Studies of a solved site, one for each profile."""
    watch.enter("checks")
    build = partial(_build_job, solved.site, standards, run, runner)
    judged = judge_rows(
        _list_jobs(solved, build), runner, lambda *_: watch.count_piece()
    )
    return _gather(solved.site, judged, standards, run)


def _list_jobs(solved: SolvedSite, build: Callable[..., RowsJob]) -> list[RowsJob]:
    pairs = zip(solved.site.rows, solved.rows, strict=True)
    return [build((row,), (of_row,)) for row, of_row in pairs]


def _build_job(
    site: Site,
    standards: Sequence[Standard],
    run: CheckRun,
    runner: Runner,
    rows: tuple[NetRow, ...],
    solved: tuple[RowEnvelope, ...] | None = None,
) -> RowsJob:
    return RowsJob(
        site=replace(site, rows=rows),
        solved=solved,
        standards=tuple(standards),
        run=run,
        store=runner.store.path if runner.store else None,
    )


def _gather(
    site: Site,
    of_rows: Mapping[str, Studies],
    standards: Sequence[Standard],
    run: CheckRun,
) -> list[Study]:
    return [
        gather_study(site, [of_rows[row.id][k] for row in site.rows], standard, run)
        for k, standard in enumerate(standards)
    ]
