"""Times of a version: each of a process of its own."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from netdesign.core.sources import SWITCH, SWITCHED_OFF
from netdesign.evidence.benchmark.versions.inputs import (
    NAMES,
    ROW,
    SHORT,
    write_scene,
    write_scenes,
    write_site,
)
from netdesign.evidence.runner import SINGLE_THREADED, Clock, Time

_PROBE = Path(__file__).with_name("probe.py")
_LONGEST_S = 900.0
_JUDGED = (0, 1, 4, 6)  # exit codes of a check that ended with a verdict
_PROCESSES = "2"


class RunFailure(Exception):  # noqa: N818 - of a version that is timed, not of ours
    """A version did not do what it was timed for; the text is its own."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Size:
    """Amount of measurement: repeats of short and of long runs, and what they solve."""

    short: int = 5
    long: int = 3
    scenes: tuple[str, ...] = NAMES
    solves: int = 5
    samples: int = 10
    rows: int = 20


QUICK = Size(short=1, long=1, scenes=NAMES[:2], solves=1, samples=3, rows=1)


@dataclass(frozen=True, slots=True)
class Bench:
    """Inputs of all runs, in a folder, and how a process of a version is started.

    Attributes
    ----------
    folder : Path
        Of inputs and outputs.
    size : Size
        What the inputs were written for.
    has_core : bool
        A version may use its compiled core, if it has one.
    """

    folder: Path
    size: Size
    has_core: bool

    def write_inputs(self) -> None:
        """Write scenes and the site."""
        write_scenes(self.folder / "scenes", self.size.scenes)
        write_scene(self.folder / "row.toml", ROW)
        write_scene(self.folder / "short.toml", SHORT)
        write_site(self.folder / "site", self.size.rows)

    def start(
        self, words: Sequence[str | Path], store: Path | None = None
    ) -> tuple[Time, subprocess.CompletedProcess[str]]:
        """Run a Python to its end, with a store of its own.

        Raises
        ------
        RunFailure
            If it does not end.
        """
        environment = {
            name: value
            for name, value in os.environ.items()
            if not name.startswith(("PYTHON", "NETDESIGN"))
        }
        environment |= SINGLE_THREADED
        place = store or self.folder / "no-store"
        environment["XDG_CACHE_HOME"] = str(place)  # of versions that knew only this
        environment["NETDESIGN_STORE"] = str(place / "cases.sqlite")
        if not self.has_core:
            environment[SWITCH] = SWITCHED_OFF
        try:
            with Clock() as clock:
                done = subprocess.run(
                    list(map(str, words)),
                    capture_output=True,
                    text=True,
                    check=False,
                    cwd=self.folder,
                    env=environment,
                    timeout=_LONGEST_S,
                )
        except subprocess.TimeoutExpired:
            raise RunFailure(f"> {_LONGEST_S:g} s") from None
        return clock.time, done


Measure = Callable[[Bench, Path], list[Time]]


def time_scenes(bench: Bench, python: Path) -> list[Time]:
    """Median and 95th percentile of warm solves of the named scenes."""
    files = sorted((bench.folder / "scenes").iterdir())
    found = _ask_probe(bench, [python, "scenes", *files, bench.size.solves])
    if failed := [name for name, one in found.items() if one is None]:
        raise RunFailure(", ".join(failed))
    return [
        Time(
            *(
                float(np.quantile([one[clock] for one in found.values()], share))
                for clock in ("cpu_s", "wall_s")
            )
        )
        for share in (0.5, 0.95)
    ]


def time_row(bench: Bench, python: Path) -> list[Time]:
    """One net row searched over three ranges, in a process that is warm but for it."""
    return [_time_envelope(bench, python, samples="", jobs="1")]


def time_grid(bench: Bench, python: Path) -> list[Time]:
    """A grid over the same ranges; its processes are started within the time."""
    samples = f":{bench.size.samples}"
    return [_time_envelope(bench, python, samples=samples, jobs=_PROCESSES)]


def time_site(bench: Bench, python: Path) -> list[Time]:
    """A site of many rows with all reports, and again with its store."""
    with TemporaryDirectory(dir=bench.folder) as store:
        words = ["check", "site", "--jobs", _PROCESSES, "--cache", "--quiet"]
        more = ["--force", "--out", f"{store}/out"]
        return [
            _time_command(bench, python, [*words, *more], _JUDGED, Path(store))
            for _ in range(2)
        ]


def time_solve(bench: Bench, python: Path) -> list[Time]:
    """A scene solved from the command line, start of the program included."""
    words = ["solve", f"scenes/{bench.size.scenes[0]}.toml", "--json"]
    return [_time_command(bench, python, words, (0,))]


def time_example(bench: Bench, python: Path) -> list[Time]:
    """Each version's own example, checked and reported."""
    with TemporaryDirectory(dir=bench.folder) as out:
        words = ["check", "--example", "--jobs", _PROCESSES, "--no-cache", "--quiet"]
        return [
            _time_command(bench, python, [*words, "--out", out, "--force"], _JUDGED)
        ]


def _time_envelope(bench: Bench, python: Path, *, samples: str, jobs: str) -> Time:
    shared = ["--no-cache", "--confirm", "none", "--json", "--quiet", "--jobs", jobs]
    warming = ["envelope", "short.toml", "--density", "300:310:2", *shared]
    ranges = {"density": "250:450", "friction": "15:45", "inclination": "25:35"}
    timed = ["envelope", "row.toml", "--accuracy", "0.005", *shared]
    for name, span in ranges.items():
        timed += [f"--{name}", f"{span}{samples}"]
    words = [python, "command", json.dumps(warming), json.dumps(timed)]
    found = _ask_probe(bench, words)
    if found["exit_code"] not in (0, 4):
        raise RunFailure(f"{' '.join(timed)}: {found['exit_code']}")
    return Time(found["cpu_s"], found["wall_s"])


def _time_command(
    bench: Bench,
    python: Path,
    words: Sequence[str],
    accepted: Sequence[int],
    store: Path | None = None,
) -> Time:
    time, done = bench.start([python, "-I", "-m", "netdesign", *words], store)
    if done.returncode not in accepted:
        raise RunFailure(_tell_last(done))
    return time


def _ask_probe(bench: Bench, words: Sequence[Any]) -> dict[str, Any]:
    python, *rest = map(str, words)
    _, done = bench.start([python, "-I", _PROBE, *rest])
    try:
        found: dict[str, Any] = json.loads(done.stdout)
    except ValueError:
        raise RunFailure(_tell_last(done)) from None
    return found


def _tell_last(done: subprocess.CompletedProcess[str]) -> str:
    """Last words of a process that failed, and its exit code."""
    lines = done.stderr.strip().splitlines() or [""]
    return f"{lines[-1][:200]} ({done.returncode})"
