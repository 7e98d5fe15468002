"""Full disks, places that cannot be written, two runs at once, clocks, Ctrl-C."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest

FAIL, USAGE, INTERRUPTED = 1, 2, 130
OUTPUTS = {"study.json", "report.html", "report.xlsx", ".netdesign.json"}

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="POSIX limits, signals")


def long(*values):
    return pytest.param(*values, marks=pytest.mark.long)


def rare(*values):
    """Values of a test that are tried with ``-m faults`` only."""
    return pytest.param(*values, marks=pytest.mark.faults)


def end(process):
    """Exit code and messages."""
    _, messages = process.communicate(timeout=120)
    assert "Traceback" not in messages
    return process.returncode, messages


def read(folder):
    return {p.name: p.read_bytes() for p in folder.iterdir() if p.is_file()}


def limit_files(size):
    """Lines of Python after which no file of the process can be larger [bytes]."""
    return (
        f"import resource; resource.setrlimit(resource.RLIMIT_FSIZE, ({size},) * 2)\n"
    )


@pytest.mark.parametrize("size", [long(2_000), rare(60_000), rare(110_000)])
def test_a_full_disk_leaves_nothing_and_costs_nothing(begin, clean, tmp_path, size):
    """No room for any case in the store, or for some, nor for the outputs; later on."""
    code, messages = end(begin("--out", "out", "--jobs", 1, before=limit_files(size)))
    assert code == USAGE
    assert "cannot write: File too large" in messages
    assert "going on without it" in messages
    assert read(tmp_path / "out") == {}
    assert end(begin("--out", "out", "--jobs", 1))[0] == FAIL
    assert read(tmp_path / "out") == clean


@pytest.mark.long
def test_two_runs_at_once_leave_the_outputs_of_one(begin, tmp_path):
    """Both may overwrite: whoever comes last, the three outputs are of one run."""
    runs = [
        begin("--out", "out", "--force", "--jobs", 1, env={"SOURCE_DATE_EPOCH": epoch})
        for epoch in ("1700000000", "1800000000")
    ]
    assert [end(run)[0] for run in runs] == [FAIL, FAIL]
    found = read(tmp_path / "out")
    assert found.keys() == OUTPUTS
    year = json.loads(found["study.json"])["provenance"]["started"][:4]
    (other,) = {"2023", "2027"} - {year}
    assert f"{year}-" in found["report.html"].decode()
    assert f"{other}-" not in found["report.html"].decode()


@pytest.mark.long
def test_of_two_runs_the_second_replaces_what_the_first_wrote(begin, clean, tmp_path):
    """Neither may overwrite files of others; each may replace the program's own."""
    ends = [end(run) for run in [begin("--out", "out", "--jobs", 1) for _ in "ab"]]
    assert [code for code, _ in ends] == [FAIL, FAIL]
    assert read(tmp_path / "out") == clean


# Wall clock and file times go back by a day at each look; nothing is pinned.
BACKWARDS = """
import itertools, time, datetime
steps = itertools.count()
time.time = lambda: 1.7e9 - 86_400.0 * next(steps)
class Clock(datetime.datetime):
    @classmethod
    def now(cls, tz=None):
        return cls.fromtimestamp(time.time(), tz)
datetime.datetime = Clock
"""


@pytest.mark.parametrize(
    ("before", "epoch"),
    [
        long(BACKWARDS, ""),
        *(rare("", epoch) for epoch in ("0", "-86400", "253402300799")),
    ],
    ids=["back a day at each look", "1970", "1969", "9999"],
)
def test_the_clock_decides_nothing_but_the_date(begin, clean, tmp_path, before, epoch):
    run = begin(
        *("--out", "out", "--jobs", 1), before=before, env={"SOURCE_DATE_EPOCH": epoch}
    )
    assert end(run)[0] == FAIL
    found = read(tmp_path / "out")
    assert found.keys() == OUTPUTS
    study, expected = json.loads(found["study.json"]), json.loads(clean["study.json"])
    started = study["provenance"].pop("started")
    assert started != expected["provenance"].pop("started")
    assert study.pop("digest") != expected.pop("digest")  # it seals the date too
    assert study == expected


@pytest.mark.parametrize("pause", [rare(0.0), long(0.05), rare(0.4)])
def test_ctrl_c_twice_ends_as_once(begin, clean, tmp_path, pause):
    """In the midst of a pool; nothing is written, and a run continues it."""
    options = ("--out", "out", "--jobs", 2)
    pool = "import netdesign.solving.workers as w; w._WORTH_A_POOL = 1\n"
    run = begin(*options, before=pool, start_new_session=True)
    assert "1 solved, about" in run.stderr.readline()
    run.send_signal(signal.SIGINT)
    time.sleep(pause)
    run.send_signal(signal.SIGINT)
    code, messages = end(run)
    assert code == INTERRUPTED
    assert messages.splitlines()[-1].startswith("interrupted; to continue: netdesign")
    assert not (tmp_path / "out").exists()
    with pytest.raises(ProcessLookupError):  # its workers are gone too
        os.killpg(run.pid, 0)
    assert end(begin("--out", "out", "--jobs", 1))[0] == FAIL
    assert read(tmp_path / "out") == clean


KILL_A_WORKER = """
import os, signal
import netdesign.solving.workers as w
w._WORTH_A_POOL = 1
spread = w.ProcessPool.spread
def kill_one(pool, work, waiting):
    w.ProcessPool.spread = spread  # once: the next call may find a pool that is broken
    arrivals = spread(pool, work, waiting)
    yield next(arrivals)
    os.kill(next(iter(pool._pool._processes)), signal.SIGKILL)
    return (yield from arrivals)
w.ProcessPool.spread = kill_one
"""


@pytest.mark.long
def test_a_worker_killed_from_outside_changes_nothing(begin, clean, tmp_path):
    """The case in its hands was no culprit: it is solved again."""
    run = begin("--out", "out", "--jobs", 2, before=KILL_A_WORKER)
    assert end(run)[0] == FAIL
    assert read(tmp_path / "out").keys() == OUTPUTS
    found = json.loads((tmp_path / "out" / "study.json").read_text(encoding="utf-8"))
    expected = json.loads(clean["study.json"])
    assert found["rows"] == expected["rows"]


READ_ONLY = 'mount --bind out out && mount -o remount,ro,bind out && exec "$@"'


@pytest.mark.long
def test_a_folder_of_a_read_only_disk_is_refused_before_solving(begin, tmp_path):
    (tmp_path / "out").mkdir()
    own = ["unshare", "--mount", "sh", "-c", READ_ONLY, "sh"]
    try:
        subprocess.run([*own, "true"], cwd=tmp_path, check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("no leave to make a disk read-only here")
    run = begin("--out", "out", "--jobs", 1, under=own)
    code, messages = end(run)
    assert code == USAGE
    assert "out cannot be written to" in messages
    assert "cases" not in messages
    assert not (tmp_path / "cases.sqlite").exists()
