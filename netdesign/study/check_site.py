"""The use case: site -> cases -> checks -> studies.

Rows are solved and judged side by side in a pool of workers, or in turn. A judgement
asks for one case after the other, so a row keeps one process busy. A worker has the
run's store, and does what this process would.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from pathlib import Path

from netdesign import addon_table
from netdesign.addon_table import OF_ROWS
from netdesign.checks import Standard
from netdesign.edge.progress import Phase, RunProgress
from netdesign.envelope.rows import RowEnvelope
from netdesign.outcome import Fault, catch_fault
from netdesign.site.model import NetRow, Project, Site
from netdesign.solving.runner import Counts, Runner
from netdesign.solving.store import (
    CaseStore,
    StoreError,
    identify_program,
    write_parts,
)
from netdesign.study.cases import list_alike, search_site
from netdesign.study.document import restore_row
from netdesign.study.judge import gather_study, judge_row
from netdesign.study.records import RowStudy, Study
from netdesign.study.row_to_check import CaseSolver, CheckRun
from netdesign.words.message import Message, say

Studies = list[RowStudy]  # of one row, one a profile


def cut_site(site: Site, row: NetRow) -> Site:
    """Part of a site on which one of its rows is judged: the row, and what bears on it.

    What is not listed here decides nothing of a row. The notes of a site, its file and
    the rest of its project stand beside the rows.
    """
    return Site(
        project=Project(
            snow_document=site.project.snow_document,
            glide_document=site.project.glide_document,
        ),
        ranges=site.at_row(row).ranges,
        rows=(row,),
        file_name="",
        sha256="",
        declared=tuple(
            declaration
            for declaration in site.declared
            if declaration.row_id in ("", row.id)
        ),
        confirmed=site.confirmed,
        catalogue=site.catalogue,
        links=site.links,
        of_addons={x: y for x, y in site.of_addons.items() if x in OF_ROWS},
    )


def name_rows(
    site: Site, standards: Sequence[Standard], run: CheckRun
) -> dict[str, str]:
    """Names of the records of a site's rows by all that decides them, by ids of rows.

    Command, time and number of processes are no part of a name: no record has them.
    A row with a value of a new kind has no name, and is judged every time.
    """
    settings = [run.settings, run.creep_law, run.has_reliability]
    names = {}
    with suppress(TypeError):
        shared = write_parts([identify_program(), settings, list(standards)])
        types = write_parts(list(site.catalogue))
        for row in site.rows:
            part = write_parts(replace(cut_site(site, row), catalogue=()))
            whole = f"[{shared}, {part}, {types}]"
            names[row.id] = hashlib.sha256(whole.encode()).hexdigest()
    return names


def find_rows(names: Mapping[str, str], runner: Runner) -> dict[str, Studies]:
    """Rows that the store knows, by their ids."""
    texts = {row_id: runner.find_row(name) for row_id, name in names.items()}
    return {
        row_id: list(map(restore_row, each)) for row_id, each in texts.items() if each
    }


def keep_rows(
    names: Mapping[str, str],
    rows: Iterable[NetRow],
    judged: Iterable[Studies],
    runner: Runner,
) -> None:
    """Keep the records of some rows; of a run that lost a case or met a fault, none.

    Another run could end otherwise.
    """
    if runner.faults or runner.counts.lost:
        return
    for row, studies in zip(rows, judged, strict=True):
        name = names.get(row.id)
        if name is not None:
            runner.keep_row(name, [study.written for study in studies])


@dataclass(frozen=True, slots=True, kw_only=True)
class RowsJob:
    """Some rows of a site, to be judged in one process.

    Attributes
    ----------
    site : Site
        With these rows alone: all rows of a large site take long to be sent.
    solved : sequence of RowEnvelope, or None
        Cases of these rows; None where they are to be searched first.
    standards : tuple of Standard
        Limit profiles.
    run : CheckRun
        Settings.
    store : Path or None
        File of known cases.
    """

    site: Site
    solved: Sequence[RowEnvelope] | None
    standards: tuple[Standard, ...]
    run: CheckRun
    store: Path | None


@dataclass(frozen=True, slots=True, kw_only=True)
class JudgedRows:
    """Studies of the rows of a job, and what a worker did for them.

    ``counts`` and ``faults`` are those of the worker's runner; the user reads the
    ``messages``.
    """

    studies: list[Studies]
    counts: Counts
    faults: dict[Fault, set[str]]
    messages: list[Message]


def judge_rows(
    jobs: Sequence[RowsJob],
    runner: Runner,
    on_job: Callable[[RowsJob, list[Studies]], None],
) -> dict[str, Studies]:
    """Studies of the rows of all jobs, by their ids.

    Parameters
    ----------
    jobs : sequence of RowsJob
        Each is done in one process.
    runner : Runner
        Its pool takes the jobs, if it has one; else this process does.
    on_job : callable
        Called with each job once it is done, and with what it found.
    """
    judged_at: dict[int, list[Studies]] = {}
    pool = runner.workers.pool
    if pool is not None and len(jobs) > 1:
        shown: dict[Message, None] = {}  # once, however many workers say it
        waiting = list(enumerate(jobs))[::-1]  # taken from its end
        for place, judged in pool.spread(judge_away, waiting):
            if judged is None:
                continue
            judged_at[place] = judged.studies
            for message in judged.messages:
                if message not in shown:
                    runner.tell(message)
            shown |= dict.fromkeys(judged.messages)
            runner.take(judged.counts, judged.faults)
            on_job(jobs[place], judged.studies)
    # Where a worker died, each case is now given to a worker; where it failed, it fails
    # here, by name and place.
    for place, job in enumerate(jobs):
        if place not in judged_at:
            judged_at[place] = _judge(job, runner)
            on_job(job, judged_at[place])
    return {
        row.id: studies
        for place, job in enumerate(jobs)
        for row, studies in zip(job.site.rows, judged_at[place], strict=True)
    }


def judge_away(job: RowsJob) -> JudgedRows | None:
    """Studies of the rows of a job, made by a worker.

    None where the program fails: the fault is met again where it can be told.
    """
    judged = catch_fault(partial(_judge_away, job), "")
    return None if isinstance(judged, Fault) else judged


def _judge_away(job: RowsJob) -> JudgedRows:
    messages: list[Message] = []
    with ExitStack() as stack:
        store: CaseStore | None = None
        if job.store is not None:
            try:
                opened = CaseStore(job.store, messages.append, is_open=True)
                store = stack.enter_context(opened)
            except StoreError as error:
                messages.append(say("store.going_on", reason=error.message))
        runner = Runner(store=store, tell=messages.append)
        studies = _judge(job, runner)
    for row in chain.from_iterable(studies):
        _ = row.written  # here, while others judge
    return JudgedRows(
        studies=studies,
        counts=runner.counts,
        faults=runner.faults,
        messages=messages,
    )


def _judge(job: RowsJob, runner: Runner) -> list[Studies]:
    solved = job.solved
    if solved is None:
        solved = search_site(job.site, job.run, runner)
    pairs = list(zip(job.site.rows, solved, strict=True))
    for row, of_row in pairs:
        again = (confirmation.confirmed for confirmation in of_row.confirmations)
        for result in (*of_row.results, *again):
            runner.keep_fault(result.fault, row.id)
    return [_judge_row(job, row, of_row, runner) for row, of_row in pairs]


def _judge_row(
    job: RowsJob,
    row: NetRow,
    solved: RowEnvelope,
    runner: Runner,
) -> Studies:
    """Studies of a row; profiles share its cases: forces do not depend on them."""
    solver = CaseSolver(job.run.settings, job.run.creep_law, runner)
    site = cut_site(job.site, row)
    return [
        judge_row(site, row, solved, standard, job.run, solver)
        for standard in job.standards
    ]


# Progress that is not shown.
_SILENT = RunProgress([Phase(key="", words="", cases=0)], lambda _: None)
OnRow = Callable[[Studies], None]


def _keep_silent(_: Studies) -> None:
    """Report no row."""


_ROWS_A_PROCESS = 2  # at least; with fewer some processes would wait for the others


def check_site(
    site: Site,
    standards: Sequence[Standard],
    run: CheckRun,
    runner: Runner | None = None,
    watch: RunProgress | None = None,
    on_row: OnRow | None = None,
    solved: Sequence[RowEnvelope] | None = None,
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
    solved : sequence of RowEnvelope, optional
        Of all rows; they are searched unless given.

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
    by_row = find_rows(names, runner)
    for studies in by_row.values():
        on_row(studies)

    def keep(job: RowsJob, judged: list[Studies]) -> None:
        keep_rows(names, job.site.rows, judged, runner)
        for studies in judged:
            watch.count_piece()
            on_row(studies)

    new = [k for k, row in enumerate(site.rows) if row.id not in by_row]
    if new:
        job = RowsJob(
            site=replace(site, rows=tuple(site.rows[k] for k in new)),
            solved=solved and tuple(solved[k] for k in new),
            standards=tuple(standards),
            run=run,
            store=runner.store.path if runner.store else None,
        )
        by_row |= judge_rows(_split(job, runner, watch), runner, keep)
    return [
        gather_study(site, [by_row[row.id][k] for row in site.rows], standard, run)
        for k, standard in enumerate(standards)
    ]


def _split(job: RowsJob, runner: Runner, watch: RunProgress) -> list[RowsJob]:
    """Jobs of the rows of one: each is searched and judged in one process.

    Where there are too few rows for all processes, all solve cases of the same rows.
    """
    solved, pool = job.solved, runner.workers.pool
    if solved is None:
        groups = list_alike(job.site, job.run)
        if pool is None or len(groups) >= _ROWS_A_PROCESS * pool.processes:
            watch.enter("checks", say("phase.rows"))
            return [replace(job, site=replace(job.site, rows=rows)) for rows in groups]
        solved = search_site(job.site, job.run, runner)
    watch.enter("checks")
    return [
        replace(job, site=replace(job.site, rows=(row,)), solved=(of_row,))
        for row, of_row in zip(job.site.rows, solved, strict=True)
    ]
