"""Options, workers and store of the commands that solve many cases."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.language import tell
from netdesign.commands.options import jobs_option
from netdesign.words.catalogue import Language

if TYPE_CHECKING:
    from netdesign.edge.progress import Phase, RunProgress
    from netdesign.site.model import Site
    from netdesign.solving.runner import Runner
    from netdesign.solving.workers import Job
    from netdesign.study.cases import CheckRun


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


def open_run(
    site: Site,
    run: CheckRun,
    *,
    executor: str,
    cache: bool,
    quiet: bool,
    profiles: int = 1,
    language: Language = "en",
) -> AbstractContextManager[tuple[Runner, RunProgress]]:
    """Workers, store and progress for the check of a site, open while it lasts."""
    from netdesign.study.cases import list_phases

    return open_phases(
        list_phases(site, run, profiles),
        processes=run.jobs,
        executor=executor,
        cache=cache,
        quiet=quiet,
        language=language,
    )


@contextmanager
def open_phases(
    phases: Sequence[Phase],
    *,
    processes: int,
    executor: str,
    cache: bool,
    quiet: bool,
    language: Language,
) -> Iterator[tuple[Runner, RunProgress]]:
    """Workers, store and progress of some phases, open while they last."""
    from netdesign.edge.progress import show_phases
    from netdesign.solving.session import open_runner
    from netdesign.solving.store import find_store

    with (
        open_runner(
            executor=executor,
            processes=processes,
            store=find_store() if cache else None,
            tell=lambda message: tell(message, language, err=True),
            expected=sum(phase.cases for phase in phases),
        ) as runner,
        show_phases(phases, quiet=quiet, language=language) as progress,
    ):
        follow_runner(progress, runner)
        yield runner, progress


def follow_runner(progress: RunProgress, runner: Runner) -> None:
    """Count every case of a runner; the first history begins their phase."""
    from netdesign.solving.solve import method_of

    def ask(jobs: Sequence[Job]) -> None:
        if any(method_of(job.settings) != "steady" for job in jobs):
            progress.enter("histories")
        progress.ask(len(jobs))

    runner.on_ask, runner.on_done = ask, progress.count_case
