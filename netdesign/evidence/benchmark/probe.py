"""Script for another version's Python: it times that version from within.

It is run by its path, with any version, so it imports nothing of this one: only the
command line and the two names that every version has, wherever they were.

``probe.py scenes FILE... REPEATS`` prints the times of warm solves of each scene;
``probe.py command WARMING TIMED``, with a command's words as JSON lists, prints the
time of the second in a process that has loaded what it needs for the first.
"""

import contextlib
import importlib
import io
import json
import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from statistics import median
from typing import Any

_READ = (
    ("netdesign", "read_scene"),
    ("netdesign.files.scene", "read_scene"),
    ("netdesign.scene_file", "read_scene"),
)
_SOLVE = (
    ("netdesign", "solve_steady"),
    ("netdesign.coupling.steady.solve", "solve_steady"),
    ("netdesign.coupling.steady", "solve_steady"),
)


def find(places: Sequence[tuple[str, str]]) -> Any:
    """First of some names that this version has."""
    for module, name in places:
        with contextlib.suppress(ImportError, AttributeError):
            return getattr(importlib.import_module(module), name)
    raise SystemExit(f"none of {', '.join('.'.join(place) for place in places)}")


def read_clocks() -> tuple[float, float]:
    """Wall time, and processor time of this process and its ended children [s]."""
    ended = os.times()
    cpu = time.process_time() + ended.children_user + ended.children_system
    return time.perf_counter(), cpu


def time_scenes(paths: Sequence[str], repeats: int) -> dict[str, Any]:
    """Times by scene: the median of warm solves; None of a scene without a result."""
    read, solve = find(_READ), find(_SOLVE)
    found: dict[str, Any] = {}
    for path in paths:
        scene, settings = read(Path(path))
        if type(solve(scene, settings)).__name__ == "FailedSolution":
            found[Path(path).stem] = None
            continue
        times = []
        for _ in range(repeats):
            before = read_clocks()
            solve(scene, settings)
            times.append([b - a for a, b in zip(before, read_clocks(), strict=True)])
        wall, cpu = (median(column) for column in zip(*times, strict=True))
        found[Path(path).stem] = {"wall_s": wall, "cpu_s": cpu}
    return found


def run_command(words: Sequence[str]) -> object:
    """Exit code of a command; what it prints is not shown."""
    from netdesign.cli import main

    sys.argv = ["netdesign", *words]
    with contextlib.redirect_stdout(io.StringIO()):
        try:
            main()
        except SystemExit as end:
            return end.code or 0


def time_command(warming: Sequence[str], timed: Sequence[str]) -> dict[str, Any]:
    """Times of a command that follows another one, and its exit code."""
    run_command(warming)
    before = read_clocks()
    code = run_command(timed)
    wall, cpu = (b - a for a, b in zip(before, read_clocks(), strict=True))
    return {"wall_s": wall, "cpu_s": cpu, "exit_code": code}


if __name__ == "__main__":
    kind, *rest = sys.argv[1:]
    if kind == "scenes":
        told = time_scenes(rest[:-1], int(rest[-1]))
    else:
        told = time_command(*map(json.loads, rest))
    sys.stdout.write(json.dumps(told))
