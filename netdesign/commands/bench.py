"""``netdesign bench``: run time against error, stability, honesty of stated errors."""

from __future__ import annotations

import json
import sys
from typing import Any

import click

_EXIT_FAIL = 1


@click.command()
@click.option("--stress", type=click.IntRange(1), metavar="N", help="Random scenes.")
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True)
@click.option("--jobs", type=click.IntRange(1, 256), default=1, show_default=True)
@click.option("--json", "as_json", is_flag=True, help="Print the rows as JSON.")
def bench(*, stress: int | None, seed: int, jobs: int, as_json: bool) -> None:
    """Measure the program itself.

    \b
    netdesign bench --stress 2000 --seed 1 --jobs 2
    """
    if stress is not None:
        _run_stress(stress, seed, jobs, as_json=as_json)


def _run_stress(count: int, seed: int, jobs: int, *, as_json: bool) -> None:
    from netdesign.benchmark.stress import run_stress, write_stress
    from netdesign.progress import show_progress

    with show_progress(count, "scenes", quiet=False) as on_done:
        attempts = run_stress(count, seed, jobs=jobs, on_done=on_done)
    document = write_stress(attempts, seed)
    if as_json:
        _print_json(document)
    sys.exit(_EXIT_FAIL if document["failures"] else 0)


def _print_json(document: dict[str, Any]) -> None:
    click.echo(json.dumps(document, indent=1, allow_nan=False))
