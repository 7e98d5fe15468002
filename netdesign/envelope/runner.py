"""Ends of jobs: from the store where they are known, from workers where not."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from netdesign.envelope.known_search import KnownSearch
from netdesign.envelope.state import CaseEnd
from netdesign.envelope.store import CaseStore, name_case, name_search
from netdesign.envelope.workers import Job, OwnProcess, Workers
from netdesign.outcome import Outcome


@dataclass(slots=True, kw_only=True)
class Counts:
    """What a run did; the only thing about it that a second run may change."""

    solved: int = 0
    reused: int = 0
    failed: int = 0


@dataclass(slots=True, kw_only=True)
class Runner:
    """Solves each case once.

    Attributes
    ----------
    workers : Workers
        Where new cases are solved.
    store : CaseStore or None
        Where finished ones are kept; None keeps nothing beyond a call.
    on_done : callable
        Called after each distinct case of a call, from the store or new.
    say : callable
        Takes what the user should know.
    counts : Counts
        Of all calls so far.
    """

    workers: Workers = field(default_factory=OwnProcess)
    store: CaseStore | None = None
    on_done: Callable[[CaseEnd], None] = lambda _: None
    say: Callable[[str], None] = lambda _: None
    counts: Counts = field(default_factory=Counts)

    def solve(self, jobs: Sequence[Job]) -> list[CaseEnd]:
        """End of every job, in their order; equal jobs are solved once."""
        names = [name_case(job.scene, job.settings) for job in jobs]
        distinct = dict(zip(names, jobs, strict=True))
        ends = self._look_up(list(distinct))
        self.counts.reused += len(ends) + len(names) - len(distinct)
        for end in ends.values():
            self.on_done(end)
        missing = [name for name in distinct if name not in ends]
        for place, end in self.workers.solve([distinct[name] for name in missing]):
            ends[missing[place]] = end
            self._keep(missing[place], end)
            self.counts.solved += 1
            self.counts.failed += end.outcome is not Outcome.CONVERGED
            self.on_done(end)
        return [ends[name] for name in names]

    def find_search(self, task: object) -> KnownSearch | None:
        """What is known of the search of a task."""
        if self.store is None:
            return None
        try:
            return self.store.find_search(name_search(task))
        except TypeError:
            return None  # a task without a name is searched every time
        except sqlite3.Error as error:
            self._give_up(error)
            return None

    def keep_search(self, task: object, known: KnownSearch) -> None:
        """Keep a finished search for later runs."""
        if self.store is None:
            return
        try:
            self.store.keep_search(name_search(task), known)
        except TypeError:
            return
        except sqlite3.Error as error:
            self._give_up(error)

    def _look_up(self, names: list[str]) -> dict[str, CaseEnd]:
        if self.store is None:
            return {}
        try:
            return self.store.find(names)
        except sqlite3.Error as error:
            self._give_up(error)
            return {}

    def _keep(self, name: str, end: CaseEnd) -> None:
        if self.store is None:
            return
        try:
            self.store.keep(name, end)
        except sqlite3.Error as error:
            self._give_up(error)

    def _give_up(self, error: sqlite3.Error) -> None:
        """A store that fails under way costs its use, not the run."""
        self.say(f"the store of cases failed ({error}); going on without it")
        self.store = None
