"""Progress of long work, on stderr: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Protocol

_LATER_CASES = 6  # of a row that a search has to go on with
_ENOUGH = 3  # cases from which a phase is timed by itself
_SILENCE_S = 5.0  # longest that plain lines keep silent while cases end


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
        if done <= total and done * 4 // total > (done - 1) * 4 // total:
            sys.stderr.write(f"{done} of {total} {what}\n")

    return on_done


@dataclass(frozen=True, slots=True, kw_only=True)
class Phase:
    """Part of a run.

    Attributes
    ----------
    key, words : str
        Its name, for programs and for people.
    cases, most : int
        About so many solves; ``most`` has room for the largest number seen.
    cost : float
        Time of one over that of a steady case in one process [-].
    pieces : int
        Checks, or whatever else of it is counted; 0 where cases are all there is.
    unit : str
        What a piece is called, in the plural.
    seconds : float
        What it takes besides solves [s].
    """

    key: str
    words: str
    cases: int
    most: int = 0
    cost: float = 1.0
    pieces: int = 0
    unit: str = "checks"
    seconds: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Standing:
    """Where a run stands.

    ``open`` counts the solves of this phase and all later ones, as far as they can be
    known: never 0 while there may be another. ``seconds`` is None as long as nothing
    is known of it; ``stage`` changes with what a plain line is worth.
    """

    done: int
    open: int
    words: str
    stage: str
    seconds: float | None

    @property
    def count(self) -> str:
        """``40 solved, about 90 to go``."""
        to_go = f", about {self.open} to go" if self.open else ""
        return f"{self.done} solved{to_go}"

    @property
    def left(self) -> str:
        """``about 12 s left``; "" as long as nothing is known of it."""
        return "" if self.seconds is None else f"about {self.seconds:.0f} s left"

    def __str__(self) -> str:
        """``search: 40 solved, about 90 to go; gap 2 %; about 12 s left``."""
        head, _, rest = self.words.partition("; ")
        return "; ".join(filter(None, (f"{head}: {self.count}", rest, self.left)))


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


class RunProgress:
    """Solves of all phases of a run: those done, and those still expected."""

    def __init__(
        self,
        phases: Sequence[Phase],
        show: Callable[[Standing], None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Take the phases in their order, what shows a standing, and a clock [s]."""
        self._phases, self._show, self._clock = tuple(phases), show, clock
        self._place, self._done, self._waiting = 0, 0, 0
        self._pace: float | None = None  # seconds of a case whose cost is 1
        self._begin()

    @property
    def _phase(self) -> Phase:
        return self._phases[self._place]

    def _begin(self) -> None:
        self._began, self._before = self._clock(), self._done
        self._expected, self._pieces = self._phase.cases, 0
        self._words, self._stage = "", self._phase.key

    def enter(self, key: str) -> None:
        """A phase begins, if it is one of those to come; there is no way back."""
        keys = [phase.key for phase in self._phases]
        if key not in keys[self._place + 1 :]:
            return
        self._keep_pace()
        self._place, self._waiting = keys.index(key), 0
        self._begin()
        self._tell()

    def ask(self, count: int) -> None:
        """So many cases are about to be solved."""
        self._waiting = count
        self._tell()

    def count_case(self, _: object = None) -> None:
        """One more case is solved."""
        self._done += 1
        self._waiting = max(0, self._waiting - 1)
        self._tell()

    def count_piece(self) -> None:
        """One more piece of the phase is finished."""
        self._pieces += 1
        self._waiting = 0
        self._tell()

    def tell_wave(self, wave: SearchWave) -> None:
        """A wave of a search is over."""
        later = wave.cases_waiting + _LATER_CASES * wave.rows_open
        self._expected = self._done_here + later
        gap = (
            f"gap {100 * wave.gap:.2g} %" if math.isfinite(wave.gap) else "no bound yet"
        )
        self._words = f"{gap}, {wave.rows_open} rows open" if wave.rows_open else ""
        self._stage = self._words or self._stage  # that a search is over is not news
        self._tell()

    @property
    def _done_here(self) -> int:
        return self._done - self._before

    def _measure_pace(self) -> float | None:
        """As this phase has it; until it is known, as the first one had it."""
        if self._done_here < _ENOUGH:
            return self._pace
        elapsed = self._clock() - self._began
        return elapsed / self._done_here / self._phase.cost

    def _keep_pace(self) -> None:
        """Of the first phase that tells: costs of later ones are known less well."""
        if self._pace is None:
            self._pace = self._measure_pace()

    def _count_left(self) -> int:
        """Solves of this phase that are still expected.

        Where it has pieces: as many for each as so far, the expected ones counting
        like as many pieces that were seen.
        """
        phase, left = self._phase, self._expected - self._done_here
        if phase.pieces:
            seen = (phase.cases + self._done_here) / (phase.pieces + self._pieces)
            left = math.ceil(seen * (phase.pieces - self._pieces))
        return max(left, self._waiting)

    def _estimate_seconds(self, left: int) -> float | None:
        pace = self._measure_pace()
        if pace is None:
            return None
        rest = self._phases[self._place :]
        later = sum(one.cases * one.cost for one in rest[1:])
        solves = left * self._phase.cost * pace + later * (self._pace or pace)
        return solves + sum(one.seconds for one in rest)

    def _tell(self) -> None:
        left = self._count_left()
        later = sum(one.cases for one in self._phases[self._place + 1 :])
        is_last = self._place == len(self._phases) - 1
        phase, words = self._phase, [self._words]
        if phase.pieces:
            words.append(f"{self._pieces} of {phase.pieces} {phase.unit}")
        self._show(
            Standing(
                done=self._done,
                open=max(left + later, 0 if is_last else 1),
                words="; ".join([phase.words, *filter(None, words)]),
                stage=self._stage,
                seconds=self._estimate_seconds(left),
            )
        )


@contextmanager
def show_phases(phases: Sequence[Phase], *, quiet: bool) -> Iterator[RunProgress]:
    """Progress of a run of several phases, the last of which solves nothing."""
    if quiet:
        yield RunProgress(phases, lambda _: None)
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
    from rich.table import Column

    console = Console(stderr=True)
    if not console.is_terminal:
        yield RunProgress(phases, _write_lines())
        return
    text = Column(no_wrap=True, overflow="ellipsis", ratio=1)
    columns = (
        TimeElapsedColumn(),
        BarColumn(12),
        TextColumn("{task.description}", table_column=text),
    )
    with Progress(*columns, console=console, transient=True, expand=True) as progress:
        task = progress.add_task("", total=sum(phase.cases for phase in phases))

        def show(standing: Standing) -> None:
            # what matters least stands last, where a narrow terminal cuts it
            told = (standing.count, standing.left, standing.words)
            progress.update(
                task,
                completed=standing.done,
                total=standing.done + standing.open,
                description="; ".join(filter(None, told)),
            )

        yield RunProgress(phases, show)


def _write_lines(
    clock: Callable[[], float] = time.monotonic,
) -> Callable[[Standing], None]:
    """One line for each stage, and between them before anybody wonders."""
    last, told = "", clock()

    def show(standing: Standing) -> None:
        nonlocal last, told
        is_new = standing.stage != last and standing.done > 0
        if is_new or clock() - told >= _SILENCE_S:
            last, told = standing.stage, clock()
            sys.stderr.write(f"{standing}\n")

    return show
