"""Kills runs of ``check`` at chosen and at random moments; says what each one left.

A program of its own, ``python tests/faults/kill_runs.py SITE FOLDER KILLS SEED``: the
solver is imported once, each run is a fork of it, so that a hundred kills take a
minute. A run is killed either after a random time, or at a random one of the steps
below, before or after it is carried out. Every second kill finds old outputs there.
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
from netdesign.envelope import runner, store, workers
from netdesign.report import excel, files, html

OUTPUTS = ("study.json", "report.html", "report.xlsx")
NOW, BEFORE = "1700000000", "1600000000"  # of the run, and of the outputs it finds
# Where a kill may fall: the solve of a case, its way to the store and that of a
# search, each report, and each step of the way to disk.
STEPS = (
    (runner, "name_case"),
    (workers, "solve_job"),
    (store.CaseStore, "keep"),
    (store.CaseStore, "find"),
    (store.CaseStore, "keep_search"),
    (store.CaseStore, "find_search"),
    (files, "_render"),
    (html, "render_html"),
    (excel, "render_workbook"),
    (os, "fsync"),
    (Path, "chmod"),
    (Path, "replace"),
    (Path, "unlink"),
)


def count_steps(at=None, *, report=None):
    """Count all steps of this process, or kill it at one of them."""
    passed = 0

    def wrap(owner, name):
        real = getattr(owner, name)

        def counted(*args, **kwargs):
            nonlocal passed
            for is_before in (True, False):
                if not is_before:
                    result = real(*args, **kwargs)
                if passed == at:
                    os.kill(os.getpid(), signal.SIGKILL)
                passed += 1
            if report:
                report(passed)
            return result

        setattr(owner, name, counted)

    for owner, name in STEPS:
        wrap(owner, name)


def start(place, site, epoch=NOW, prepare=lambda: None):
    """Fork that checks the site in a folder; its process id."""
    place.mkdir(exist_ok=True)
    child = os.fork()
    if child:
        return child
    with contextlib.suppress(BaseException):
        os.chdir(place)
        silence = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silence, 1)
        os.dup2(silence, 2)
        os.environ |= {"NETDESIGN_STORE": "cases.sqlite", "SOURCE_DATE_EPOCH": epoch}
        sys.argv = ["netdesign", "check", str(site), "--out", "out", "--force"]
        sys.argv += ["--accuracy", "0.1", "--jobs", "1"]
        prepare()
        try:
            cli.main()
        except SystemExit as end:
            os._exit(end.code or 0)
    os._exit(99)


def finish(child):
    """Exit code of a run that is let alone."""
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


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
    old = {}
    if draw.random() < 0.5:
        (place / "out").mkdir(parents=True)
        for name, content in whole["old"].items():
            (place / "out" / name).write_bytes(content)
        old = whole["old"]
    if draw.random() < 0.5:
        at = draw.randrange(whole["steps"])
        code = finish(start(place, site, prepare=lambda: count_steps(at)))
    else:
        child = start(place, site)
        time.sleep(draw.uniform(0.0, whole["time"]))
        os.kill(child, signal.SIGKILL)
        code = finish(child)
    fault = judge(place, old, whole["new"])
    code_again = finish(start(place, site))
    if not fault and (code_again != whole["code"] or read(place) != whole["new"]):
        fault = f"continued: exit code {code_again}, outputs {sorted(read(place))}"
    return fault, code == -signal.SIGKILL


def measure_whole(folder, site):
    """Outputs, exit code, time and number of steps of runs that nobody kills."""
    finish(start(folder / "old", site, BEFORE))
    begin = time.monotonic()
    code = finish(start(folder / "new", site))
    elapsed = time.monotonic() - begin
    log = (folder / "steps").resolve()

    def prepare():
        count_steps(report=lambda passed: log.write_text(str(passed)))

    finish(start(folder / "counted", site, prepare=prepare))
    return {
        "code": code,
        "time": elapsed,
        "steps": int(log.read_text()),
        "old": read(folder / "old"),
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
