"""What commands share that solve many cases: options, and a site's solve."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.language import tell
from netdesign.commands.options import jobs_option
from netdesign.words.catalogue import Language

if TYPE_CHECKING:
    from netdesign.checks import Standard
    from netdesign.edge.progress import RunProgress
    from netdesign.envelope.run import CaseResult
    from netdesign.envelope.runner import Runner
    from netdesign.envelope.search import RowEnvelope
    from netdesign.envelope.workers import Job
    from netdesign.site.model import Site
    from netdesign.study.cases import CheckRun
    from netdesign.study.records import Study


def solving_options(command: Any) -> Any:
    """Add ``--jobs``, ``--executor`` and ``--no-cache``."""
    for option in (
        click.option(
            "--cache/--no-cache",
            default=True,
            help="Keep finished cases, and use those of earlier runs.",
        ),
        click.option(
            "--executor",
            default="",
            metavar="dask://HOST:PORT",
            help="Solve on a running Dask cluster [this machine].",
        ),
        jobs_option(),
    ):
        command = option(command)
    return command


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SolvedRows:
    """Cases of every row, the envelopes of a search, and what solves further ones."""

    results: Sequence[Sequence[CaseResult]]
    envelopes: list[RowEnvelope] | None  # None for a grid
    runner: Runner
    progress: RunProgress


@contextmanager
def open_rows(
    site: Site,
    run: CheckRun,
    *,
    executor: str,
    cache: bool,
    quiet: bool,
    profiles: int = 1,
    language: Language = "en",
) -> Iterator[SolvedRows]:
    """Search or sample the rows of a site; workers, store and progress stay open."""
    from netdesign.edge.progress import show_phases
    from netdesign.envelope.session import open_runner
    from netdesign.envelope.store import find_store
    from netdesign.study.cases import list_phases, search_site, solve_site

    with (
        open_runner(
            executor=executor,
            processes=run.jobs,
            store=find_store() if cache else None,
            tell=lambda message: tell(message, language, err=True),
        ) as runner,
        show_phases(
            list_phases(site, run, profiles), quiet=quiet, language=language
        ) as progress,
    ):
        follow_runner(progress, runner)
        envelopes: list[RowEnvelope] | None = None
        if site.ranges.is_grid:
            results = solve_site(site, run, runner)
        else:
            envelopes = search_site(site, run, runner, progress.tell_wave)
            results = [list(one.results) for one in envelopes]
        yield SolvedRows(
            results=results, envelopes=envelopes, runner=runner, progress=progress
        )


def follow_runner(progress: RunProgress, runner: Runner) -> None:
    """Count every case of a runner; that histories have begun is seen by them."""
    from netdesign.solving.solve import method_of

    def ask(jobs: Sequence[Job]) -> None:
        if any(method_of(job.settings) != "steady" for job in jobs):
            progress.enter("histories")
        progress.ask(len(jobs))

    runner.on_ask, runner.on_done = ask, progress.count_case


def judge_rows(
    site: Site, run: CheckRun, solved: SolvedRows, profiles: Sequence[Standard]
) -> list[Study]:
    """Study of each profile; what was measured on the site is followed once."""
    from netdesign.study.cases import follow_site
    from netdesign.study.check_site import judge_site
    from netdesign.study.probe import Probe

    solved.progress.enter("measured")
    measured = follow_site(site, run, solved.runner)
    solved.progress.enter("checks")
    probe = Probe(run.settings, run.creep_law, solved.runner)
    studies = [
        judge_site(
            site,
            solved.results,
            profile,
            run,
            probe,
            measured,
            solved.envelopes,
            solved.progress.count_piece,
        )
        for profile in profiles
    ]
    solved.progress.enter("reports")
    _keep_faults(site, solved)
    return studies


def _keep_faults(site: Site, solved: SolvedRows) -> None:
    """Tell the runner which net rows the faults in their cases befell."""
    for row, of_row in zip(site.rows, solved.results, strict=True):
        for result in of_row:
            solved.runner.keep_fault(result.fault, row.id)
    for row, envelope in zip(site.rows, solved.envelopes or (), strict=False):
        for one in envelope.confirmations:
            solved.runner.keep_fault(one.confirmed.fault, row.id)
