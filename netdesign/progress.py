"""Progress of long work, on stderr: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def show_progress(
    total: int, what: str, *, quiet: bool
) -> Iterator[Callable[[object], None] | None]:
    """Give a function to call after each of ``total`` pieces; None when quiet."""
    if quiet:
        yield None
        return
    from rich.console import Console
    from rich.progress import Progress

    console = Console(stderr=True)
    if not console.is_terminal:
        yield _count_quarters(total, what)
        return
    with Progress(console=console, transient=True) as progress:
        task = progress.add_task(what, total=total)
        yield lambda _: progress.advance(task)


def _count_quarters(total: int, what: str) -> Callable[[object], None]:
    done = 0

    def on_done(_: object) -> None:
        nonlocal done
        done += 1
        if done * 4 // total > (done - 1) * 4 // total:
            sys.stderr.write(f"{done} of {total} {what}\n")

    return on_done
