"""Work that is measured: its clock, repeats in turns, processes, statistics."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from statistics import quantiles
from typing import TypeVar

import numpy as np

Name = TypeVar("Name", bound=str)
Item = TypeVar("Item")
Result = TypeVar("Result")

_CHUNK = 4  # items that a process takes at once, where they are short


class Clock:
    """Measures what runs within a ``with``; processes that have ended count too.

    Processor time tells of the work even where other programs keep the machine busy.

    Attributes
    ----------
    wall_s, cpu_s : float
        Known at the end [s].
    """

    wall_s: float
    cpu_s: float

    def __enter__(self) -> Clock:
        """Start."""
        self._wall, self._cpu = time.perf_counter(), _read_cpu()
        return self

    def __exit__(self, *_: object) -> None:
        """Stop."""
        self.wall_s = time.perf_counter() - self._wall
        self.cpu_s = _read_cpu() - self._cpu


def _read_cpu() -> float:
    """Processor time of this process and of its ended children [s]."""
    ended = os.times()  # of the children of Windows it knows nothing
    return time.process_time() + ended.children_user + ended.children_system


def measure(work: Callable[[], object]) -> float:
    """Wall time of a piece of work [s]."""
    with Clock() as clock:
        work()
    return clock.wall_s


def run_in_turns(
    works: Mapping[Name, Callable[[], Result]],
    repeats: int,
    on_done: Callable[[object], None] | None = None,
) -> dict[Name, list[Result]]:
    """Results of each work, all repeated in turns: a busy machine slows all of them.

    In every second repeat the last one begins.
    """
    results: dict[Name, list[Result]] = {name: [] for name in works}
    for number in range(repeats):
        for name in list(works)[:: -1 if number % 2 else 1]:
            results[name].append(works[name]())
            if on_done is not None:
                on_done(name)
    return results


def spread(
    work: Callable[[Item], Result],
    items: Sequence[Item],
    *,
    jobs: int = 1,
    chunk: int = _CHUNK,
    on_done: Callable[[Result], object] | None = None,
) -> list[Result]:
    """Results in the order of the items, whatever the processes did.

    A process takes so many items at once. Unlike ``envelope.run`` it does not go on
    after a process has died, but raises: a benchmark is to show that none dies.
    """
    results = []
    for result in _work_through(work, items, jobs, chunk):
        results.append(result)
        if on_done is not None:
            on_done(result)
    return results


def _work_through(
    work: Callable[[Item], Result], items: Sequence[Item], jobs: int, chunk: int
) -> Iterator[Result]:
    if jobs == 1:
        yield from map(work, items)
        return
    # each with one thread of the BLAS: the package has set that in the environment
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        try:
            yield from pool.map(work, items, chunksize=chunk)
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise


def summarise_times(times: Sequence[float]) -> dict[str, float | None]:
    """Median and 95th percentile [s]; None of fewer than two."""
    if len(times) < 2:
        return {"median_s": None, "p95_s": None}
    parts = quantiles(times, n=20, method="inclusive")
    return {"median_s": parts[9], "p95_s": parts[18]}


def fit_order(sizes: Sequence[float], values: Sequence[float]) -> float:
    """Power p of the best fit values ~ sizes^p, on logarithms [-]."""
    slope, _ = np.polyfit(np.log(sizes), np.log(values), 1)
    return float(slope)


def share(holds: Iterable[bool]) -> float | None:
    """Share of the entries that hold; None without any."""
    answers = list(holds)
    return sum(answers) / len(answers) if answers else None
