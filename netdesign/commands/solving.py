"""What commands share that solve many cases: options, and a site's solve."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from netdesign.envelope.run import CaseResult
    from netdesign.envelope.runner import Runner
    from netdesign.envelope.search import RowEnvelope
    from netdesign.site.model import Site
    from netdesign.site_cases import CheckRun


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
        click.option(
            "--jobs", type=click.IntRange(1, 256), help="Processes [number of cores]."
        ),
    ):
        command = option(command)
    return command


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SolvedRows:
    """Cases of every row, the envelopes of a search, and what solves further ones."""

    results: Sequence[Sequence[CaseResult]]
    envelopes: list[RowEnvelope] | None  # None for a grid
    runner: Runner


@contextmanager
def open_rows(
    site: Site, run: CheckRun, *, executor: str, cache: bool, quiet: bool
) -> Iterator[SolvedRows]:
    """Search or sample the rows of a site; workers and store stay open within."""
    from netdesign.envelope.session import open_runner
    from netdesign.envelope.store import find_store
    from netdesign.progress import show_search
    from netdesign.site_cases import search_site, solve_site

    with (
        show_search(len(site.rows), quiet=quiet) as progress,
        open_runner(
            executor=executor,
            processes=run.jobs,
            store=find_store() if cache else None,
            say=lambda text: click.echo(text, err=True),
            on_done=progress.count_case,
        ) as runner,
    ):
        if site.ranges.is_grid:
            results = solve_site(site, run, runner)
            yield SolvedRows(results=results, envelopes=None, runner=runner)
            return
        found = search_site(site, run, runner, progress.tell_wave)
        results = [list(one.results) for one in found]
        yield SolvedRows(results=results, envelopes=found, runner=runner)
