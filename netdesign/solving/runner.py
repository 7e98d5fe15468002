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
from netdesign.solving.solve import CaseEnd, is_stuck
from netdesign.solving.store import FORGOTTEN, CaseStore, StoreError, name_case
from netdesign.solving.workers import (
    Batch,
    Ends,
    Job,
    OwnProcess,
    ProcessPool,
    Workers,
    build_workers,
    find_in_turn,
)
from netdesign.words.message import Message, say

_Answer = TypeVar("_Answer")


@dataclass(slots=True, kw_only=True)
class Counts:
    """Counts of a run: the only part of its result that a second run may change."""

    solved: int = 0
    reused: int = 0
    failed: int = 0
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
        """End of every job, in their order; equal jobs are solved once."""
        return [ends[0] for ends in self.solve_batches([(job,) for job in jobs])]

    def solve_batches(self, batches: Sequence[Batch]) -> list[Ends]:
        """Ends of every batch, in their order; equal cases are solved once.

        Raises
        ------
        KeyError
            If workers lose a case.
        """
        named = [
            [(name_case(job.scene, job.settings), job) for job in batch]
            for batch in batches
        ]
        names = [name for batch in named for name, _ in batch]
        nothing: dict[str, CaseEnd] = {}
        solved_cases = self.ask_store(lambda store: store.find(names), nothing)
        for end in solved_cases.values():
            self.on_done(end)
        solved = self.counts.solved
        while missing := _list_missing(named, solved_cases):
            todo = [tuple(batch.values()) for batch in missing]
            self.on_ask([job for batch in todo for job in batch])
            for place, ends in self.workers.solve(todo):
                for name, end in zip(missing[place], ends, strict=False):
                    solved_cases[name] = end
                    self._note(name, end)
            if any(batch.keys().isdisjoint(solved_cases) for batch in missing):
                # without this the loop would not end
                raise KeyError("workers lost a batch")
        answers = [
            find_in_turn([name for name, _ in batch], solved_cases.__getitem__)
            for batch in named
        ]
        self.counts.reused += sum(map(len, answers)) - (self.counts.solved - solved)
        return answers

    def _note(self, name: str, end: CaseEnd) -> None:
        self.ask_store(lambda store: store.keep(name, end), None)
        self.counts.solved += 1
        if isinstance(end, FailedSolution):
            self.counts.failed += 1
            self.counts.lost += end.outcome in FORGOTTEN
            self.keep_fault(end.fault)
        self.on_done(end)

    def take(self, theirs: Counts, faults: Mapping[Fault, set[str]]) -> None:
        """Count what another runner did for this one, and remember its faults."""
        self.counts.solved += theirs.solved
        self.counts.reused += theirs.reused
        self.counts.failed += theirs.failed
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


_Named = list[tuple[str, Job]]


def _list_missing(
    batches: Sequence[_Named], ends: dict[str, CaseEnd]
) -> list[dict[str, Job]]:
    """Unknown cases of each batch that has any; a shared one goes with the first.

    The second batch waits for that case, and may then need no more.
    """
    missing_batches: list[dict[str, Job]] = []
    claimed: set[str] = set()
    for batch in batches:
        missing: dict[str, Job] = {}
        for name, job in batch:
            if name in claimed or (name in ends and is_stuck(ends[name])):
                break
            if name not in ends:
                missing[name] = job
                claimed.add(name)
        if missing:
            missing_batches.append(missing)
    return missing_batches


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
