"""Progress of long work, on stderr: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Protocol

# Cases of a row that an envelope usually takes: at first, and later in one go.
_FIRST_CASES, _LATER_CASES = 55, 6


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


class SearchWave(Protocol):
    """Where a search stands; ``envelope.search.Wave`` is one."""

    @property
    def rows_open(self) -> int:
        """Net rows that are not finished."""

    @property
    def cases_waiting(self) -> int:
        """Cases of the next wave."""

    @property
    def gap(self) -> float:
        """Largest gap that is left [-]."""


class SearchProgress:
    """Cases, gap and time left of a search whose length nobody knows beforehand."""

    def __init__(self, show: Callable[[int, int, str], None]) -> None:
        """Take what shows cases done, cases expected and a few words."""
        self._show = show
        self._done, self._expected, self._words = 0, 0, ""

    def count_case(self, _: object) -> None:
        """One more case is solved."""
        self._done += 1
        self._show(self._done, max(self._done, self._expected), self._words)

    def tell_wave(self, wave: SearchWave) -> None:
        """A wave is over."""
        self._expected = self._done + wave.cases_waiting + _LATER_CASES * wave.rows_open
        gap = (
            f"gap {100 * wave.gap:.2g} %" if math.isfinite(wave.gap) else "no bound yet"
        )
        self._words = f"{gap}, {wave.rows_open} rows open"
        self._show(self._done, max(self._done, self._expected), self._words)


@contextmanager
def show_search(rows: int, *, quiet: bool) -> Iterator[SearchProgress]:
    """Progress of the search of some net rows."""
    if quiet:
        yield SearchProgress(lambda *_: None)
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    console = Console(stderr=True)
    if not console.is_terminal:
        yield SearchProgress(_write_search_lines())
        return
    columns = (
        TextColumn("{task.completed:.0f} cases"),
        BarColumn(),
        TextColumn("{task.description}"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console, transient=True) as progress:
        task = progress.add_task("first cases", total=rows * _FIRST_CASES)
        yield SearchProgress(
            lambda done, total, words: progress.update(
                task,
                completed=done,
                total=max(total, rows),
                description=words or "first cases",
            )
        )


def _write_search_lines() -> Callable[[int, int, str], None]:
    """One line when the words change: after each wave."""
    last, start = "", time.monotonic()

    def show(done: int, expected: int, words: str) -> None:
        nonlocal last
        if words in ("", last):
            return
        last = words
        left = (time.monotonic() - start) / max(done, 1) * (expected - done)
        sys.stderr.write(f"{done} cases, {words}, about {left:.0f} s left\n")

    return show
