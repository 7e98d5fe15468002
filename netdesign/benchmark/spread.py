"""The same work on many items, in one process or several."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import TypeVar

from netdesign.envelope.run import single_threaded_workers

Item = TypeVar("Item")
Result = TypeVar("Result")

_CHUNK = 4  # items that a process takes at once


def spread(
    work: Callable[[Item], Result],
    items: Sequence[Item],
    *,
    jobs: int = 1,
    on_done: Callable[[Result], None] | None = None,
) -> list[Result]:
    """Results in the order of the items, whatever the processes did.

    Unlike ``envelope.run`` this is no place to go on after a process has died:
    what is measured here is that none does, so its end is raised.
    """
    results = []
    for result in _work_through(work, items, jobs):
        results.append(result)
        if on_done is not None:
            on_done(result)
    return results


def _work_through(
    work: Callable[[Item], Result], items: Sequence[Item], jobs: int
) -> Iterator[Result]:
    if jobs == 1:
        yield from map(work, items)
        return
    with (
        single_threaded_workers(),
        ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool,
    ):
        try:
            yield from pool.map(work, items, chunksize=_CHUNK)
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise
