"""One process, a pool and a cluster give the same ends; what dies is named."""

import math
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import closing
from pathlib import Path

import pytest

from netdesign.coupling.scene import Scene
from netdesign.envelope.ranges import Case
from netdesign.solving.solve import encode_end
from netdesign.solving.workers import (
    LOST,
    ClusterError,
    DaskCluster,
    Job,
    OwnProcess,
    ProcessPool,
    build_workers,
    follow_futures,
)
from tests.solving.small_scene import COARSE, build_scene


class DyingScene(Scene):
    """Takes its whole process down as soon as somebody solves it."""

    @property
    def flow_problem(self):
        os._exit(9)


class LongScene(Scene):
    """Takes longer than any test waits."""

    @property
    def flow_problem(self):
        time.sleep(60.0)
        raise TimeoutError


class FaultyScene(Scene):
    """Raises what no case may raise: a bug."""

    @property
    def flow_problem(self):
        message = "spoilt"
        raise ZeroDivisionError(message)


def job(density, kind=Scene, *, friction_deg=30.0):
    case = Case(
        density=density, friction_angle=math.radians(friction_deg), inclination=0.2
    )
    return Job(scene=build_scene(case, kind), settings=COARSE)


JOBS = [
    job(density, friction_deg=friction)
    for density in (250.0, 300.0, 350.0)
    for friction in (10.0, 30.0)
]


def collect(workers, jobs):
    """Bytes of the ends of each job."""
    arrived = sorted(workers.solve(jobs), key=lambda one: one[0])
    assert [place for place, _ in arrived] == list(range(len(jobs)))
    return [encode_end(end) for _, end in arrived]


@pytest.fixture(scope="module")
def alone():
    return collect(OwnProcess(), JOBS)


@pytest.mark.parametrize("processes", [1, 2, 3])
def test_a_pool_gives_the_same_bytes_as_one_process(alone, processes):
    with closing(ProcessPool(processes, worth=1)) as pool:
        assert collect(pool, JOBS) == alone
    assert multiprocessing.active_children() == []


def kill_within(jobs):
    """The jobs with one more in their midst, which dies."""
    return [*jobs[:3], job(300.0, DyingScene, friction_deg=20.0), *jobs[3:]]


def test_a_worker_that_dies_costs_one_case_by_name(alone):
    with closing(ProcessPool(2, worth=1)) as pool:
        found = collect(pool, kill_within(JOBS))
    assert found.pop(3) == encode_end(LOST)
    assert found == alone
    assert multiprocessing.active_children() == []


def die_elsewhere(own, value):
    """A call that only the test's own process survives."""
    if os.getpid() != own:
        os._exit(9)
    return value


def raise_elsewhere(own, value):
    if os.getpid() != own:
        raise MemoryError
    return value


@pytest.mark.parametrize("work", [die_elsewhere, raise_elsewhere])
def test_a_call_that_a_worker_does_not_end_is_made_here(work):
    with closing(ProcessPool(2)) as pool:
        waiting = [
            pool.begin(math.hypot, 3.0, 4.0),
            pool.begin(work, os.getpid(), 0.31),
        ]
        assert [finish() for finish in waiting] == [5.0, 0.31]


def assert_fault(workers, alone):
    """The fault comes whole from wherever it was; the other ends are as ever."""
    spoilt = job(350.0, FaultyScene, friction_deg=20.0)
    arrived = dict(workers.solve([*JOBS, spoilt]))
    fault = arrived.pop(len(JOBS)).fault
    assert [encode_end(arrived[k]) for k in range(len(JOBS))] == alone
    assert (fault.kind, fault.message) == ("ZeroDivisionError", "spoilt")
    assert fault.place.startswith("coupling/")
    assert "test_workers.py" in fault.trace


@pytest.mark.parametrize("workers", [OwnProcess(), ProcessPool(2, worth=1)])
def test_a_fault_comes_whole_from_any_process(workers, alone):
    with closing(workers):
        assert_fault(workers, alone)


def test_an_interrupt_leaves_no_process_behind():
    pool = ProcessPool(2, worth=1)
    arriving = pool.solve(JOBS)
    next(arriving)
    arriving.close()
    pool.close()
    assert multiprocessing.active_children() == []


class Slow:
    """An answer that takes two seconds to be read."""

    def __reduce__(self):
        return time.sleep, (2.0,)


def answer(work):
    if work == "slow":
        return Slow()
    time.sleep(0.3)
    return b"x" * 5_000_000  # more than the pipe holds


def test_a_process_that_is_stopped_amid_an_answer_is_not_waited_for():
    """Half of an answer stays in the pipe; the pool would wait for its rest."""
    pool = ProcessPool(2, worth=1)
    _ = [pool.begin(answer, work) for work in ("slow", "long")]
    time.sleep(1.3)
    stopping = threading.Thread(target=pool.close, daemon=True)
    stopping.start()
    stopping.join(30.0)
    assert not stopping.is_alive()


PARENT = """
import subprocess
import sys
import time
sys.path[:0] = {path!r}
from tests.solving.test_workers import JOBS, ProcessPool

if __name__ == "__main__":
    pool = ProcessPool(2, worth=1)
    next(pool.solve(JOBS))
    print(*pool._pool._processes, flush=True)
    sys.stdin.read()
"""


def test_a_parent_that_is_killed_leaves_no_process_behind(tmp_path):
    script = tmp_path / "parent.py"
    script.write_text(PARENT.format(path=sys.path))
    parent = subprocess.Popen(
        [sys.executable, script], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    workers = [int(number) for number in parent.stdout.readline().split()]
    assert len(workers) == 2
    assert all(is_alive(worker) for worker in workers)
    parent.kill()
    parent.wait()
    parent.stdin.close()
    parent.stdout.close()
    limit = time.monotonic() + 10.0
    while any(is_alive(worker) for worker in workers):
        assert time.monotonic() < limit
        time.sleep(0.02)


def is_alive(number):
    """A process that has ended may stay in the list until somebody asks for it."""
    try:
        os.kill(number, 0)
    except ProcessLookupError:
        return False
    state = Path(f"/proc/{number}/stat")
    return not (state.exists() and state.read_text().split(")")[-1].split()[0] == "Z")


# --- a Dask cluster of two processes on loopback -------------------------------------


@pytest.fixture(scope="module")
def cluster():
    import dask
    import distributed

    # the first worker that dies is enough; by itself Dask waits for three more
    soon = dask.config.set({"distributed.scheduler.allowed-failures": 0})
    with soon, distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, host="127.0.0.1",
        dashboard_address="127.0.0.1:0", silence_logs=50,
    ) as running:  # fmt: skip
        yield running.scheduler_address.removeprefix("tcp://")


@pytest.mark.filterwarnings("ignore")
def test_a_cluster_gives_the_same_bytes_as_one_process(cluster, alone):
    with closing(build_workers(f"dask://{cluster}", 1)) as workers:
        assert collect(workers, JOBS) == alone


@pytest.mark.long
@pytest.mark.filterwarnings("ignore")
def test_a_cluster_worker_that_dies_costs_one_case_by_name(cluster, alone):
    with closing(DaskCluster(cluster)) as workers:
        found = collect(workers, kill_within(JOBS))
        workers._client.wait_for_workers(2, timeout=60)  # for those who come next
    assert found.pop(3) == encode_end(LOST)
    assert found == alone


@pytest.mark.filterwarnings("ignore")
def test_a_fault_comes_whole_from_a_cluster(cluster, alone):
    with closing(DaskCluster(cluster)) as workers:
        assert_fault(workers, alone)


SCHEDULER = """
import time, dask, distributed
if __name__ == "__main__":
    cluster = distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, host="127.0.0.1",
        protocol="tcp://", dashboard_address="127.0.0.1:0", silence_logs=50,
    )
    print(cluster.scheduler_address.removeprefix("tcp://"), flush=True)
    time.sleep(300)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="kills a process")
@pytest.mark.filterwarnings("ignore")
def test_a_scheduler_that_is_killed_is_named_with_its_address(alone, capfd):
    """All that was asked of it is cancelled: no fault of the program, and no case's."""
    root = Path(__file__).parents[2]
    with subprocess.Popen(
        [sys.executable, "-c", SCHEDULER], stdout=subprocess.PIPE, text=True, cwd=root
    ) as process:
        address = process.stdout.readline().strip()
        workers = DaskCluster(address)
        arriving = workers.solve([JOBS[0], job(300.0, LongScene)])
        place, end = next(arriving)
        assert (place, encode_end(end)) == (0, alone[0])
        process.kill()
        with pytest.raises(ClusterError) as caught:
            next(arriving)
        workers.close()
    message = str(caught.value)
    assert f"--executor dask://{address}: the connection" in message
    assert "finished cases are kept" in message
    assert "Traceback" not in capfd.readouterr().err


def test_a_worker_that_died_between_two_works_is_noticed_by_neither(alone):
    with closing(ProcessPool(2, worth=1)) as pool:
        assert collect(pool, JOBS) == alone
        executor = pool._pool
        os.kill(next(iter(executor._processes)), signal.SIGKILL)
        for _ in range(500):  # until the executor knows of it
            if executor._broken:
                break
            time.sleep(0.01)
        assert executor._broken
        assert pool.begin(math.hypot, 3.0, 4.0)() == 5.0
        assert collect(pool, JOBS) == alone


def test_a_cluster_that_lost_all_its_workers_is_named():
    class Deserted:
        def scheduler_info(self):
            return {"workers": {}}

    class Never:
        def is_empty(self):
            return False

        def next_batch(self, block):  # noqa: ARG002
            return []

    with pytest.raises(ClusterError, match="no worker for"):
        next(follow_futures(Deserted(), Never(), patience=0.0))
