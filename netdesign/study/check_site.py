"""The use case: site -> cases -> checks -> studies."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign import addon_table
from netdesign.checks import Standard
from netdesign.edge.progress import Phase, RunProgress
from netdesign.envelope.rows import RowEnvelope
from netdesign.site.model import Site
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

    def keep(job: RowsJob, judged: list[Studies]) -> None:
        keep_rows(names, job.site.rows, judged, runner)
        for studies in judged:
            watch.count_piece()
            on_row(studies)

    new = tuple(row for row in site.rows if row.id not in by_row)
    if new:
        job = _build_job(replace(site, rows=new), standards, run, runner)
        by_row |= judge_rows(_split(job, runner, watch), runner, keep)
    return _gather(site, by_row, standards, run)


def _split(job: RowsJob, runner: Runner, watch: RunProgress) -> list[RowsJob]:
    """Jobs of the rows of one: each is searched and judged in one process.

    Where there are too few rows for all processes, all solve cases of the same rows.
    """
    groups, pool = list_alike(job.site, job.run), runner.workers.pool
    if pool is None or len(groups) >= _ROWS_A_PROCESS * pool.processes:
        watch.enter("checks", say("phase.rows"))
        return [replace(job, site=replace(job.site, rows=rows)) for rows in groups]
    solved = solve_rows(job.site, job.run, runner)
    watch.enter("checks")
    return _list_jobs(job, solved)


def solve_rows(site: Site, run: CheckRun, runner: Runner) -> SolvedSite:
    """Solve the cases of every net row."""
    rows = search_site(site, run, runner)
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
    job = _build_job(solved.site, standards, run, runner)
    judged = judge_rows(_list_jobs(job, solved), runner, lambda *_: watch.count_piece())
    return _gather(solved.site, judged, standards, run)


def _build_job(
    site: Site, standards: Sequence[Standard], run: CheckRun, runner: Runner
) -> RowsJob:
    store = runner.store.path if runner.store else None
    return RowsJob(site=site, standards=tuple(standards), run=run, store=store)


def _list_jobs(job: RowsJob, solved: SolvedSite) -> list[RowsJob]:
    """Jobs of one solved row each."""
    return [
        replace(job, site=replace(job.site, rows=(row,)), solved=(of_row,))
        for row, of_row in zip(solved.site.rows, solved.rows, strict=True)
    ]


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
