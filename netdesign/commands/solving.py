"""What commands share that solve many cases: options, and a site's solve."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from collections.abc import Sequence

    from netdesign.envelope.run import CaseResult
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


def solve_rows(
    site: Site, run: CheckRun, *, executor: str, cache: bool, quiet: bool
) -> tuple[Sequence[Sequence[CaseResult]], list[RowEnvelope] | None]:
    """Search or sample the rows of a site; the envelopes of a search."""
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
            return solve_site(site, run, runner), None
        envelopes = search_site(site, run, runner, progress.tell_wave)
        return [one.results for one in envelopes], envelopes
