"""Progress of long work, on stderr: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterator, Sequence, Sized
from contextlib import contextmanager
from dataclasses import dataclass

from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

_SILENCE_S = 5.0  # longest that plain lines keep silent while cases end


@contextmanager
def show_progress(
    total: int, what: str, *, quiet: bool, language: Language
) -> Iterator[Callable[[object], None] | None]:
    """Function to call after each of ``total`` pieces; None when quiet.

    ``what`` names the pieces: a text ``piece.what`` of every language.
    """
    phase = Phase(key=what, words=say(f"piece.{what}"), cases=total)
    with show_phases([phase], quiet=quiet, language=language) as progress:
        yield None if quiet else progress.count_case


@dataclass(frozen=True, slots=True, kw_only=True)
class Phase:
    """Part of a run.

    Attributes
    ----------
    key : str
        Its name, for programs.
    words : Message
        Its name, for people.
    cases : int
        About so many solves.
    pieces : int
        Net rows; 0 where cases are all there is.
    """

    key: str
    words: Message | str
    cases: int
    pieces: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Standing:
    """Progress of a run at one moment.

    ``open`` counts the solves of this phase and all later ones, as far as they can be
    known: never 0 while there may be another. ``words`` are the phase and what else
    is known of it.
    """

    done: int
    open: int
    phase: str
    words: tuple[Message | str, ...]

    @property
    def line(self) -> Message:
        """``search: 40 solved, about 90 to go; 2 of 7 net rows``."""
        phase, *rest = self.words
        counted = say("progress.solved", done=self.done)
        if self.open:
            counted = say("progress.solved_to_go", done=self.done, open=self.open)
        return say("progress.line", phase=phase, parts=(counted, *rest))


class RunProgress:
    """Solves of all phases of a run: those done, and those still expected."""

    def __init__(
        self,
        phases: Sequence[Phase],
        show: Callable[[Standing], None],
        clear: Callable[[], None] = lambda: None,
    ) -> None:
        """Take the phases in their order, and what shows a standing.

        ``clear`` takes what is shown off the screen, until there is more to show.
        """
        self.clear = clear
        self._phases, self._show = tuple(phases), show
        self._place, self._done, self._before = 0, 0, 0
        self._waiting, self._pieces = 0, 0
        self._named = self._phase.words

    @property
    def _phase(self) -> Phase:
        return self._phases[self._place]

    def enter(self, key: str, words: Message | None = None) -> None:
        """Begin a phase, if it lies ahead; no phase begins twice.

        ``words`` are its name for people, where it does more than its own says.
        """
        keys = [phase.key for phase in self._phases]
        if key not in keys[self._place + 1 :]:
            return
        self._place, self._before = keys.index(key), self._done
        self._waiting, self._pieces = 0, 0
        self._named = words or self._phase.words
        self._tell()

    def ask(self, cases: Sized) -> None:
        """Count the cases that are about to be solved."""
        self._waiting = len(cases)
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

    def _tell(self) -> None:
        expected = self._phase.cases - (self._done - self._before)
        later = sum(phase.cases for phase in self._phases[self._place + 1 :])
        is_last = self._place == len(self._phases) - 1
        words: tuple[Message | str, ...] = (self._named,)
        if self._phase.pieces:
            pieces = {"done": self._pieces, "all": self._phase.pieces}
            unit = say("progress.rows")
            words = (*words, say("progress.pieces", **pieces, unit=unit))
        self._show(
            Standing(
                done=self._done,
                open=max(max(expected, self._waiting) + later, 0 if is_last else 1),
                phase=self._phase.key,
                words=words,
            )
        )


@contextmanager
def show_phases(
    phases: Sequence[Phase], *, quiet: bool, language: Language
) -> Iterator[RunProgress]:
    """Progress of a run of several phases, the last of which solves nothing."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
    from rich.table import Column

    console = Console(stderr=True)
    if quiet or console.is_dumb_terminal:  # one that cannot take a bar off again
        yield RunProgress(phases, lambda _: None)
        return
    if not console.is_terminal:

        def write(standing: Standing) -> None:
            sys.stderr.write(f"{render(standing.line, language)}\n")

        yield RunProgress(phases, show_stages(write, _SILENCE_S))
        return
    text = Column(no_wrap=True, overflow="ellipsis", ratio=1)
    columns = (
        TimeElapsedColumn(),
        BarColumn(12),
        TextColumn("{task.description}", table_column=text),
    )
    progress = Progress(*columns, console=console, transient=True, expand=True)
    with progress:
        task = progress.add_task("", total=sum(phase.cases for phase in phases))
        last = ""

        def show(standing: Standing) -> None:
            nonlocal last
            is_new, last = standing.phase != last, standing.phase
            progress.start()
            progress.update(
                task,
                refresh=is_new,  # seen even where it is over before the next look
                completed=standing.done,
                total=standing.done + standing.open,
                description=render(standing.line, language),
            )

        yield RunProgress(phases, show, clear=progress.stop)


def show_stages(
    write: Callable[[Standing], object], silence_s: float = math.inf
) -> Callable[[Standing], None]:
    """Writes each phase once, and what there is at least every so many seconds."""
    last = ""
    shown_at = time.monotonic()

    def show(standing: Standing) -> None:
        nonlocal last, shown_at
        is_new = standing.phase != last and standing.done > 0
        if is_new or time.monotonic() - shown_at >= silence_s:
            last, shown_at = standing.phase, time.monotonic()
            write(standing)

    return show
