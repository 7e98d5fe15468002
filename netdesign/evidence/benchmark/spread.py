"""The same work on many items, in one process or several."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from typing import TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")

_CHUNK = 4  # items that a process takes at once
_THREAD_VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def spread(
    work: Callable[[Item], Result],
    items: Sequence[Item],
    *,
    jobs: int = 1,
    on_done: Callable[[Result], None] | None = None,
) -> list[Result]:
    """Results in the order of the items, whatever the processes did.

    Unlike ``envelope.run`` it does not go on after a process has died, but raises:
    a benchmark is to show that none dies.
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


@contextmanager
def single_threaded_workers() -> Iterator[None]:
    """Worker processes inherit one BLAS thread each: there is one worker a core."""
    before = {name: os.environ.get(name) for name in _THREAD_VARIABLES}
    os.environ.update(dict.fromkeys(_THREAD_VARIABLES, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
