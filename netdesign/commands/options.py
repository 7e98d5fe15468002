"""Options that every command shares that solves many cases."""

from __future__ import annotations

from typing import Any

import click


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
