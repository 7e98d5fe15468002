"""Kills runs of ``check`` at random steps; says what each one left.

``python tests/faults/kill_runs.py SITE FOLDER KILLS SEED``: each run is a fork. No
moment is counted from the start, so that none ends unharmed on a slow machine.
"""

import contextlib
import json
import os
import random
import signal
import sqlite3
import sys
import time
from pathlib import Path

from netdesign import cli
from netdesign.report import files, page
from netdesign.report.workbook import excel
from netdesign.solving import runner, store, workers

NOW, BEFORE = "1700000000", "1600000000"  # of the run, and of the outputs it finds
# Where a kill may fall: the solve of a case, its way to the store and that of a
# net row, each report, and each step of the way to disk.
STEPS = (
    (runner, "name_case"),
    (workers, "solve_job"),
    (store.CaseStore, "keep"),
    (store.CaseStore, "find"),
    (store.CaseStore, "keep_row"),
    (store.CaseStore, "find_row"),
    (files, "render_kind"),
    (page, "render_html"),
    (excel, "render_workbook"),
    (os, "fsync"),
    (Path, "chmod"),
    (Path, "replace"),
    (Path, "unlink"),
)


def tell_steps(pipe, at=None):
    """Write a byte for every step of this process, or kill it at one of them."""
    passed = 0

    def wrap(owner, name):
        real = getattr(owner, name)

        def told(*args, **kwargs):
            nonlocal passed
            for is_before in (True, False):
                if not is_before:
                    result = real(*args, **kwargs)
                if passed == at:
                    os.kill(os.getpid(), signal.SIGKILL)
                passed += 1
                os.write(pipe, b".")
            return result

        setattr(owner, name, told)

    for owner, name in STEPS:
        wrap(owner, name)


def start(place, site, epoch=NOW, at=None):
    """Fork that checks the site in a folder, or dies at a step; its id, its pipe."""
    place.mkdir(exist_ok=True)
    steps, pipe = os.pipe()
    child = os.fork()
    if child:
        os.close(pipe)
        return child, steps
    with contextlib.suppress(BaseException):
        os.chdir(place)
        silence = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silence, 1)
        os.dup2(silence, 2)
        os.environ |= {"NETDESIGN_STORE": "cases.sqlite", "SOURCE_DATE_EPOCH": epoch}
        sys.argv = ["netdesign", "check", str(site), "--out", "out", "--force"]
        sys.argv += ["--accuracy", "0.1", "--jobs", "1"]
        tell_steps(pipe, at)
        try:
            cli.main()
        except SystemExit as end:
            os._exit(end.code or 0)
    os._exit(99)


def pass_steps(steps, count):
    """Wait until a run has passed so many steps, or has ended; how many it passed."""
    passed = 0
    while passed < count and (told := os.read(steps, min(count - passed, 4096))):
        passed += len(told)
    return passed


def finish(run):
    """Exit code of a run that is let alone, and its number of steps."""
    child, steps = run
    passed = pass_steps(steps, sys.maxsize)
    os.close(steps)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), passed


def finish_killed(run, at, pause):
    """Exit code of a run that is killed from outside a moment after a step."""
    child, steps = run
    pass_steps(steps, at + 1)
    time.sleep(pause)
    os.kill(child, signal.SIGKILL)
    return finish((child, steps))[0]


def read(place):
    """Outputs that are there, by name."""
    out = place / "out"
    return {one.name: one.read_bytes() for one in out.iterdir()} if out.exists() else {}


def judge(place, old, new):
    """What is wrong with a folder after a kill; "" if nothing is."""
    found = {k: v for k, v in read(place).items() if not k.startswith(".")}
    if not (found.items() <= new.items() or found.items() <= old.items()):
        return f"half written or of two runs: {sorted(found)}"
    base = place / "cases.sqlite"
    if base.exists():
        with contextlib.closing(sqlite3.connect(base)) as connection:
            if connection.execute("PRAGMA quick_check").fetchone() != ("ok",):
                return "the store is damaged"
    return ""


def kill_one(place, site, draw, whole):
    """Kill one run and continue; what was wrong, and whether the kill came in time."""
    old = whole["old"] if draw.random() < 0.5 else {}
    if old:
        (place / "out").mkdir(parents=True)
        for name, content in old.items():
            (place / "out" / name).write_bytes(content)
    at = draw.randrange(whole["steps_over_old"] if old else whole["steps"])
    if draw.random() < 0.5:
        code, _ = finish(start(place, site, at=at))
    else:
        code = finish_killed(start(place, site), at, draw.uniform(0.0, whole["pause"]))
    fault = judge(place, old, whole["new"])
    code_again, _ = finish(start(place, site))
    if not fault and (code_again != whole["code"] or read(place) != whole["new"]):
        fault = f"continued: exit code {code_again}, outputs {sorted(read(place))}"
    return fault, code == -signal.SIGKILL


def measure_whole(folder, site):
    """Outputs, exit code and steps of runs that nobody kills, and the mean pause."""
    finish(start(folder / "old", site, BEFORE))
    old = read(folder / "old")
    begin = time.monotonic()
    code, steps = finish(start(folder / "new", site))
    elapsed = time.monotonic() - begin
    (folder / "old" / "cases.sqlite").unlink()
    return {
        "code": code,
        "steps": steps,
        "steps_over_old": finish(start(folder / "old", site))[1],
        "pause": elapsed / steps,
        "old": old,
        "new": read(folder / "new"),
    }


def main():
    site, folder, kills, seed = sys.argv[1:]
    place, draw = Path(folder), random.Random(int(seed))
    whole = measure_whole(place, Path(site).resolve())
    ends = [
        kill_one(place / f"killed {k}", Path(site).resolve(), draw, whole)
        for k in range(int(kills))
    ]
    document = {
        "code": whole["code"],
        "outputs": sorted(whole["new"]),
        "differs_from_old": whole["new"] != whole["old"],
        "steps": whole["steps"],
        "in_time": sum(in_time for _, in_time in ends),
        "faults": [f"kill {k}: {fault}" for k, (fault, _) in enumerate(ends) if fault],
    }
    sys.stdout.write(json.dumps(document) + "\n")


if __name__ == "__main__":
    main()
