"""Options that several commands have, each with its name, type and limits once."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from netdesign.words.catalogue import LANGUAGES

Decorator = Callable[..., Any]

MOST_PROCESSES = 256

force_option: Decorator = click.option(
    "--force", is_flag=True, help="Overwrite existing outputs."
)
quiet_option: Decorator = click.option(
    "--quiet", is_flag=True, help="No progress, no messages."
)


def json_option(what: str) -> Decorator:
    """``--json``, as ``as_json``: print something as one document."""
    return click.option(
        "--json", "as_json", is_flag=True, help=f"Print the {what} as JSON."
    )


def out_option(text: str, **more: Any) -> Decorator:
    """``--out``: a folder, which need not exist."""
    folder = click.Path(path_type=Path, file_okay=False)
    return click.option("--out", type=folder, help=text, **more)


def jobs_option(text: str = "Processes [number of cores].", **more: Any) -> Decorator:
    """``--jobs``: how many processes solve; None for one a core."""
    processes = click.IntRange(1, MOST_PROCESSES)
    return click.option("--jobs", type=processes, help=text, **more)


def accuracy_option(text: str, *, default: float, least: float = 1e-4) -> Decorator:
    """``--accuracy``: a share of a force."""
    share = click.FloatRange(least, 0.1)
    return click.option(
        "--accuracy", type=share, default=default, show_default=True, help=text
    )


def language_option(text: str = "Of what is printed.", **more: Any) -> Decorator:
    """``--language``: English unless told otherwise."""
    return click.option(
        "--language",
        type=click.Choice(LANGUAGES),
        default=LANGUAGES[0],
        show_default=True,
        help=text,
        **more,
    )
