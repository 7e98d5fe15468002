"""Workers that solve cases: this process, a pool, or a Dask cluster.

All give the same ends for the same jobs, in an order of their own. A worker that
dies costs only the case that killed it, which is named.
"""

from __future__ import annotations

import gc
import logging
import multiprocessing
import os
import pickle
import signal
import socket
import threading
import time
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Protocol, TypeVar

from netdesign.coupling.scene import Scene
from netdesign.coupling.solution import FailedSolution
from netdesign.outcome import (
    SENTENCE,
    Fault,
    ModelError,
    NetDesignError,
    Outcome,
    SolveError,
    catch_fault,
)
from netdesign.snow.triangulation import load_delaunay
from netdesign.solving.solve import (
    CaseEnd,
    Settings,
    describe_case,
    keep_state,
    solve_scene,
)
from netdesign.words.message import say

NO_MEMORY = say("worker.no_memory")
LOST = FailedSolution(outcome=Outcome.WORKER_FAILED, reason=say("worker.died"))
_AHEAD = 2  # jobs in the hands of a pool, for each of its processes
_WORTH_A_POOL = 60  # jobs; starting processes takes as long as these
_REACH_S = 5.0  # how long a cluster may take to answer
_PORTS = 65_536
_DESERTED_S = 60.0  # how long it may be without a worker; they are being started again
_POLL_S = 0.01
_THREADS = Path("/proc/self/task")  # of this process, on Linux

Item = TypeVar("Item")
Found = TypeVar("Found")


class ClusterError(NetDesignError):
    """The cluster cannot be used as asked: a fault of the command line."""

    exit_code = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class Job:
    """One case to solve."""

    scene: Scene
    settings: Settings


Arrival = tuple[int, CaseEnd]  # place among the jobs, and its end


class Workers(Protocol):
    """Solver of jobs; ends arrive in any order, each with its job's place."""

    @property
    def pool(self) -> ProcessPool | None:
        """Processes of this machine that can do more than solve; None without any."""

    def solve(self, jobs: Sequence[Job]) -> Iterator[Arrival]:
        """Solve all jobs."""

    def close(self) -> None:
        """Release the workers, and stop what still runs."""


def _call_packed(packed: bytes) -> Any:
    """Result of a call that was packed by the process that wants it."""
    call: Callable[[], Any] = pickle.loads(packed)
    return call()


def solve_job(job: Job) -> CaseEnd:
    """Solve one case; a failure comes back as an outcome, even that of a bug."""
    try:
        end = catch_fault(partial(_solve, job), describe_case(job.scene, job.settings))
    except SolveError as error:
        return FailedSolution(outcome=error.outcome, reason=error.reason)
    except ModelError as error:
        return FailedSolution(outcome=Outcome.OUT_OF_VALIDITY, reason=error.message)
    except MemoryError:
        return FailedSolution(outcome=Outcome.WORKER_FAILED, reason=NO_MEMORY)
    if isinstance(end, Fault):
        return FailedSolution(outcome=Outcome.PROGRAM_FAULT, reason=SENTENCE, fault=end)
    return end


def _solve(job: Job) -> CaseEnd:
    solution = solve_scene(job.scene, job.settings)
    if isinstance(solution, FailedSolution):
        return solution
    history = solution.history
    reason = None if history is None else history.unproven
    if reason is not None:
        return FailedSolution(outcome=Outcome.PLATEAU_NOT_REACHED, reason=reason)
    state = keep_state(solution)
    if not state.is_finite:
        return FailedSolution(
            outcome=Outcome.NONFINITE, reason=Outcome.NONFINITE.message
        )
    return state


class OwnProcess:
    """Solves one job after the other, here."""

    pool = None

    def solve(self, jobs: Sequence[Job]) -> Iterator[Arrival]:
        """Solve all jobs in their order."""
        yield from enumerate(map(solve_job, jobs))

    def close(self) -> None:
        """Nothing is held."""


class ProcessPool:
    """Solves jobs in several processes; small first waves in this one.

    Processes are started by the first wave that is worth it. They ignore Ctrl-C,
    which is the parent's to handle, and are stopped by ``close`` at once.
    """

    def __init__(self, processes: int, *, worth: int = _WORTH_A_POOL) -> None:
        """Keep the number of processes, and of jobs that are worth starting them."""
        self.processes, self._worth = processes, worth
        self._pool: ProcessPoolExecutor | None = None

    def prepare(self, jobs: int) -> None:
        """Start the processes now, if so many jobs are worth it and it is quick.

        Before other threads begin: afterwards no copy of this process is sound. Else
        they are started by the first job.
        """
        if jobs < self._worth:
            return
        self._worth = 1
        if can_fork():
            self._start().submit(int)  # a pool starts its processes with its first task

    def solve(self, jobs: Sequence[Job]) -> Iterator[Arrival]:
        """Solve all jobs; suspects of a crash are tried again, each alone."""
        if self._pool is None and len(jobs) < self._worth:
            yield from OwnProcess().solve(jobs)
            return
        waiting = list(enumerate(jobs))[::-1]
        while waiting:
            for place, job in (yield from self.spread(solve_job, waiting)):
                yield place, _solve_alone(job)

    def begin(self, work: Callable[..., Found], *arguments: Any) -> Callable[[], Found]:
        """Call that a worker makes meanwhile; its result is that of what is returned.

        What it is given is packed here and now: the pool would do so in a thread of its
        own, while this one goes on and fills what the values keep of themselves.
        Where the worker dies or fails, the call is made here when it is asked for.
        """
        packed = pickle.dumps(partial(work, *arguments), pickle.HIGHEST_PROTOCOL)
        call: Callable[[], Found] = partial(_call_packed, packed)
        caught = partial(catch_fault, call, work.__name__)
        try:
            future = self._start().submit(caught)
        except BrokenProcessPool:  # a worker has died since its last work
            self.close()
            return partial(work, *arguments)

        def finish() -> Found:
            with suppress(BrokenProcessPool, MemoryError):
                answer = future.result()
                if not isinstance(answer, Fault):
                    return answer
            return work(*arguments)  # a fault is met again where it can be told

        return finish

    def spread(
        self, work: Callable[[Item], Found], waiting: list[tuple[int, Item]]
    ) -> Generator[tuple[int, Found], None, list[tuple[int, Item]]]:
        """Results of a function for items, each with its item's place, as they arrive.

        Items are taken from the end of ``waiting``. Returns those that were in hand
        when the pool broke, if it did; from then on everything is done in a pool.
        """
        held: dict[Future[Found], tuple[int, Item]] = {}
        pool = self._start()
        try:
            while waiting or held:
                while waiting and len(held) < _AHEAD * self.processes:
                    held[pool.submit(work, waiting[-1][1])] = waiting[-1]
                    waiting.pop()
                for future in wait(held, return_when=FIRST_COMPLETED).done:
                    answer = future.result()
                    place, _ = held.pop(future)
                    yield place, answer
        except BrokenProcessPool:
            self.close()
            self._worth = 0  # what kills a worker shall not kill this process
            return sorted(held.values(), key=lambda entry: entry[0])
        return []

    @property
    def pool(self) -> ProcessPool | None:
        """The pool itself, if its processes run or start at once."""
        return self if self._pool is not None or can_fork() else None

    def _start(self) -> ProcessPoolExecutor:
        if self._pool is None:
            self._pool = _start_pool(self.processes)
        return self._pool

    def close(self) -> None:
        """Stop the processes, whatever they do."""
        pool, self._pool = self._pool, None
        if pool is not None:
            _stop(pool)


class DaskCluster:
    """Solves jobs on the workers of a running Dask scheduler (extra ``dask``)."""

    pool = None

    def __init__(self, address: str) -> None:
        """Connect to ``HOST:PORT``, with or without ``tcp://``.

        Raises
        ------
        ClusterError
            If the extra is not installed, no scheduler answers there, or the workers
            have another version of the solver.
        """
        try:
            from distributed import Client
        except ImportError:
            raise ClusterError(say("cluster.needs_extra", address=address)) from None
        # here, since workers of a pool need no store
        from netdesign.solving.store import identify_solver

        _require_answer(address)
        self._address = address
        # what Dask logs of a lost connection is told by a ClusterError
        logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
        try:
            self._client = Client(
                f"tcp://{address.removeprefix('tcp://')}",
                timeout=_REACH_S,
                set_as_default=False,
            )
            versions = self._client.run(identify_solver)
        except (OSError, ValueError) as error:
            raise _name_silence(address, error) from None
        own = identify_solver()
        others = {v for v in versions.values() if v != own}
        if others or not versions:
            self.close()
            raise _refuse_versions(address, own, tuple(sorted(others)))

    def solve(self, jobs: Sequence[Job]) -> Iterator[Arrival]:
        """Solve all jobs; those lost with a worker are tried again, each alone.

        The scheduler gives up every job that waited with one that kills workers.

        Raises
        ------
        ClusterError
            If the connection to the scheduler is lost, or it has no workers.
        """
        from distributed import CancelledError
        from distributed.comm import CommClosedError

        try:
            yield from self._solve(jobs)
        except (CancelledError, CommClosedError) as error:  # Dask cancels its tasks
            kind = type(error).__name__
            lost = say("cluster.lost", address=self._address, kind=kind)
            raise ClusterError(lost) from None

    def _solve(self, jobs: Sequence[Job]) -> Iterator[Arrival]:
        from distributed import KilledWorker, as_completed

        places = {
            self._client.submit(solve_job, job, pure=False): place
            for place, job in enumerate(jobs)
        }
        suspects: list[int] = []
        arriving = as_completed(list(places), loop=self._client.loop)
        for future in follow_futures(self._client, arriving):
            try:
                yield places[future], future.result()
            except KilledWorker:
                suspects.append(places[future])
        for place in sorted(suspects):
            alone = [jobs[place]]
            ends = [LOST] if len(jobs) == 1 else [end for _, end in self._solve(alone)]
            yield place, ends[0]

    def close(self) -> None:
        """Disconnect; what still runs for this client is cancelled."""
        self._client.close()


def follow_futures(
    client: Any, arriving: Any, patience: float = _DESERTED_S
) -> Iterator[Any]:
    """Futures of a cluster as they finish, as long as it has workers.

    Raises
    ------
    ClusterError
        If it has had no worker for ``patience`` [s]: nothing would ever arrive.
    """
    last_seen = time.monotonic()
    while not arriving.is_empty():
        finished = arriving.next_batch(block=False)
        yield from finished
        if finished:
            last_seen = time.monotonic()
            continue
        time.sleep(_POLL_S)
        if time.monotonic() - last_seen > patience:
            if not client.scheduler_info()["workers"]:
                raise ClusterError(say("cluster.deserted", seconds=patience))
            last_seen = time.monotonic()


def build_workers(executor: str, processes: int) -> Workers:
    """Workers by name: "" for a pool, "dask://HOST:PORT" for a cluster.

    Raises
    ------
    ClusterError
        For any other name, and where the cluster cannot be used.
    """
    if executor.startswith("dask://") and len(executor) > len("dask://"):
        return DaskCluster(executor.removeprefix("dask://"))
    if executor:
        raise ClusterError(say("cluster.accepted", executor=executor))
    return OwnProcess() if processes == 1 else ProcessPool(processes)


def _require_answer(address: str) -> None:
    """Refuse at once an address without a scheduler; Dask would retry for minutes."""
    host, _, port = address.removeprefix("tcp://").rpartition(":")
    if not (host and port.isascii() and port.isdecimal() and int(port) < _PORTS):
        raise ClusterError(say("cluster.accepted", executor=f"dask://{address}"))
    try:
        socket.create_connection((host.strip("[]"), int(port)), _REACH_S).close()
    except (OSError, ValueError) as error:
        raise _name_silence(address, error) from None


def _name_silence(address: str, error: Exception) -> ClusterError:
    kind = type(error).__name__
    return ClusterError(say("cluster.silent", address=address, kind=kind))


def _refuse_versions(
    address: str, version: str, others: tuple[str, ...]
) -> ClusterError:
    if not others:
        return ClusterError(say("cluster.no_worker", address=address, version=version))
    return ClusterError(
        say("cluster.other_version", address=address, found=others, version=version)
    )


def _solve_alone(job: Job) -> CaseEnd:
    """End of a job that may have killed its worker, in a process of its own."""
    pool = _start_pool(1)
    try:
        return pool.submit(solve_job, job).result()
    except BrokenProcessPool:
        return LOST
    finally:
        _stop(pool)


def _start_pool(processes: int) -> ProcessPoolExecutor:
    return ProcessPoolExecutor(
        processes,
        mp_context=multiprocessing.get_context(_choose_start()),
        initializer=_begin,
        initargs=gc.get_threshold(),
    )


def _choose_start() -> str:
    """``fork`` where it is sound; what every copy would load is loaded before."""
    if not can_fork():
        return "spawn"
    load_delaunay()
    return "fork"


def can_fork() -> bool:
    """A copy of this process is a sound one: it has no thread but this, on Linux.

    A copy is there at once; a process that is started anew loads the program first.
    """
    return _THREADS.is_dir() and len(list(_THREADS.iterdir())) == 1


def _begin(*collection: int) -> None:
    """Begin a worker: it leaves Ctrl-C to its parent, and ends with it.

    It looks for unused objects as seldom as its parent does.
    """
    gc.set_threshold(*collection)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """Wait for the parent's end and follow: a killed parent tells workers nothing."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _stop(pool: ProcessPoolExecutor) -> None:
    """End a pool without waiting for the cases in hand."""
    # The pool has no public way to stop a running call before Python 3.14.
    for process in list((getattr(pool, "_processes", None) or {}).values()):
        process.terminate()
    # A process that dies amid an answer leaves half of it: the pool waits for the rest
    # while anybody may write.
    if (answers := getattr(pool, "_result_queue", None)) is not None:
        answers._writer.close()
    pool.shutdown(wait=True, cancel_futures=True)
