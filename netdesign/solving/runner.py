"""Ends of cases: from the store where it has them, else from the workers."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

from netdesign.coupling.solution import FailedSolution
from netdesign.outcome import Fault
from netdesign.solving.solve import CaseEnd
from netdesign.solving.store import FORGOTTEN, CaseStore, StoreError, name_case
from netdesign.solving.workers import (
    Job,
    OwnProcess,
    ProcessPool,
    Workers,
    build_workers,
)
from netdesign.words.message import Message, say

_Answer = TypeVar("_Answer")


@dataclass(slots=True, kw_only=True)
class Counts:
    """Counts of a run: the only part of its result that a second run may change."""

    solved: int = 0
    reused: int = 0
    lost: int = 0  # with their worker or by a fault: no other run can rely on this one


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
    on_ask : callable
        Called with the cases that are about to be solved.
    tell : callable
        Takes what the user should know.
    counts : Counts
        Of all calls so far.
    faults : dict of Fault to set of str
        Faults of the program so far, and the net rows that they befell as far as these
        are known. A run with any of them ends with ``outcome.EXIT_CODE``.
    """

    workers: Workers = field(default_factory=OwnProcess)
    store: CaseStore | None = None
    on_done: Callable[[object], None] = lambda _: None
    on_ask: Callable[[Sequence[Job]], None] = lambda _: None
    tell: Callable[[Message], None] = lambda _: None
    counts: Counts = field(default_factory=Counts)
    faults: dict[Fault, set[str]] = field(default_factory=dict)

    def solve(self, jobs: Sequence[Job]) -> list[CaseEnd]:
        """End of every job, in their order; equal jobs are solved once.

        Raises
        ------
        KeyError
            If workers lose a case.
        """
        names = [name_case(job.scene, job.settings) for job in jobs]
        nothing: dict[str, CaseEnd] = {}
        ends = self.ask_store(lambda store: store.find(names), nothing)
        for end in ends.values():
            self.on_done(end)
        pairs = zip(names, jobs, strict=True)
        missing = {name: job for name, job in pairs if name not in ends}
        if missing:
            self.on_ask([*missing.values()])
        unknown = [*missing]
        for place, end in self.workers.solve([*missing.values()]):
            ends[unknown[place]] = end
            self._note(unknown[place], end)
        self.counts.reused += len(jobs) - len(missing)
        return [ends[name] for name in names]

    def _note(self, name: str, end: CaseEnd) -> None:
        self.ask_store(lambda store: store.keep(name, end), None)
        self.counts.solved += 1
        if isinstance(end, FailedSolution):
            self.counts.lost += end.outcome in FORGOTTEN
            self.keep_fault(end.fault)
        self.on_done(end)

    def take(self, theirs: Counts, faults: Mapping[Fault, set[str]]) -> None:
        """Count what another runner did for this one, and remember its faults."""
        self.counts.solved += theirs.solved
        self.counts.reused += theirs.reused
        self.counts.lost += theirs.lost
        for _ in range(theirs.solved + theirs.reused):
            self.on_done(None)
        for fault, rows in faults.items():
            self.faults.setdefault(fault, set()).update(rows)

    def keep_fault(self, fault: Fault | None, row_id: str = "") -> None:
        """Remember a fault of the program, if it is one, and the net row it befell."""
        if fault is not None:
            self.faults.setdefault(fault, set()).update([row_id] if row_id else [])

    def find_row(self, name: str) -> list[str] | None:
        """Texts of a known net row of that name; None if there is none."""
        return self.ask_store(lambda store: store.find_row(name), None)

    def keep_row(self, name: str, texts: Sequence[str]) -> None:
        """Keep the texts of a judged net row for later runs."""
        self.ask_store(lambda store: store.keep_row(name, texts), None)

    def ask_store(
        self, ask: Callable[[CaseStore], _Answer], without: _Answer
    ) -> _Answer:
        """Answer of the store; ``without`` where there is none, or it fails.

        The run goes on without a store that has failed.
        """
        if self.store is None:
            return without
        try:
            return ask(self.store)
        except sqlite3.Error as error:
            self.tell(say("store.failed", cause=str(error)))
            self.store = None
            return without


@contextmanager
def open_runner(
    *,
    executor: str,
    processes: int,
    store: Path | None,
    tell: Callable[[Message], None],
    expected: int = 0,
) -> Iterator[Runner]:
    """Runner for the time of a ``with``.

    Parameters
    ----------
    executor : str
        "" for this machine, or ``dask://HOST:PORT``.
    processes : int
        On this machine.
    store : Path or None
        File of the finished cases; None keeps none.
    tell : callable
        Takes what the user should know, for instance that there can be no store.
    expected : int
        Number of cases, about; processes that it is worth are started now.

    Raises
    ------
    ClusterError
        If the executor cannot be used.
    """
    with ExitStack() as stack:
        workers = build_workers(executor, processes)
        stack.callback(workers.close)
        if isinstance(workers, ProcessPool):
            workers.prepare(expected)
        kept: CaseStore | None = None
        if store is not None:
            try:
                kept = stack.enter_context(CaseStore(store, tell))
            except StoreError as error:
                tell(say("store.going_on", reason=error.message))
        yield Runner(workers=workers, store=kept, tell=tell)
