"""Opens workers and store for one run, and closes them however it ends."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from netdesign.solving.runner import Runner
from netdesign.solving.store import CaseStore, StoreError
from netdesign.solving.workers import ProcessPool, build_workers
from netdesign.words.message import Message, say


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
