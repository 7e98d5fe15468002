"""Two versions timed in turns, each in processes of its own, and the table of both.

The other version is driven by the command line and by ``probe.py``, which its own
Python runs and which prints times as JSON.
"""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
import sysconfig
import venv
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from netdesign.core.library import name_core
from netdesign.core.sources import SWITCH, SWITCHED_OFF
from netdesign.evidence.benchmark.scenes import INPUTS, NAMED, NAMES, write_site
from netdesign.evidence.runner import (
    SINGLE_THREADED,
    Clock,
    Time,
    describe_times,
    run_in_turns,
)
from netdesign.evidence.table import show_lines, show_rows
from netdesign.outcome import ModelError
from netdesign.report.words import Words
from netdesign.words.message import say

if TYPE_CHECKING:
    from rich.console import Console

SCHEMA = "netdesign.bench-against/1"
_PROBE = Path(__file__).with_name("probe.py")
_PYTHONS = ("bin/python", "Scripts/python.exe")
_ASK = "from importlib.metadata import version; print(version('netdesign'))"
_LONGEST_S = 900.0
_JUDGED = (0, 1, 4, 6)  # exit codes of a check that ended with a verdict
_PROCESSES = "2"
_AS_SLOW = 0.9  # ratios repeat to a tenth: what is less is slower
_SHORT_S = 0.1  # below it times are shown in milliseconds

Clocked = Literal["cpu_s", "wall_s"]
Side = Literal["this", "other"]
_SIDES: tuple[Side, Side] = ("this", "other")
_CLOCKS: tuple[Clocked, Clocked] = ("cpu_s", "wall_s")


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


_FEW = ("paper-0", "paper-30")
QUICK = Size(short=1, long=1, scenes=_FEW, solves=1, samples=3, rows=1)


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
    files = [NAMED / f"{name}.toml" for name in bench.size.scenes]
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
    words = ["solve", str(NAMED / f"{bench.size.scenes[0]}.toml"), "--json"]
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
    short, row = (str(INPUTS / f"{name}.toml") for name in ("short", "row"))
    warming = ["envelope", short, "--density", "300:310:2", *shared]
    ranges = {"density": "250:450", "friction": "15:45", "inclination": "25:35"}
    timed = ["envelope", row, "--accuracy", "0.005", *shared]
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
        raise RunFailure(_describe_last(done))
    return time


def _ask_probe(bench: Bench, words: Sequence[Any]) -> dict[str, Any]:
    python, *rest = map(str, words)
    _, done = bench.start([python, "-I", _PROBE, *rest])
    try:
        found: dict[str, Any] = json.loads(done.stdout)
    except ValueError:
        raise RunFailure(_describe_last(done)) from None
    return found


def _describe_last(done: subprocess.CompletedProcess[str]) -> str:
    """Last words of a process that failed, and its exit code."""
    lines = done.stderr.strip().splitlines() or [""]
    return f"{lines[-1][:200]} ({done.returncode})"


@dataclass(frozen=True, slots=True)
class Timed:
    """A measure, what one run of it gives, and whether it is long.

    Of each time it gives: its key, the clock it is asked by, and what is asked [s]. The
    clock is the processor's where one process works: what else runs on the machine does
    not change it. Where several work, it is the one on the wall.
    """

    measure: Measure
    asked: tuple[tuple[str, Clocked, float], ...]
    is_long: bool = False

    def count(self, size: Size) -> int:
        """Repeats."""
        return size.long if self.is_long else size.short


TIMED = (
    Timed(time_scenes, (("median", "cpu_s", 2.5e-3), ("p95", "cpu_s", 8e-3))),
    Timed(time_row, (("row", "cpu_s", 0.2),)),
    Timed(time_grid, (("grid", "wall_s", 1.0),)),
    Timed(time_site, (("site", "wall_s", 4.0), ("again", "wall_s", 0.7)), is_long=True),
    Timed(time_solve, (("solve", "cpu_s", 0.4),)),
    Timed(time_example, (("example", "wall_s", 3.0),), is_long=True),
)


def count_runs(size: Size) -> int:
    """Runs of both versions, with the compiled core and without."""
    return 2 * len(_SIDES) * sum(one.count(size) for one in TIMED)


def compare_versions(
    other: Path,
    size: Size | None = None,
    on_done: Callable[[object], None] | None = None,
) -> dict[str, Any]:
    """Times of this version beside those of another one, as one document.

    Every run is a process of its own with a store of its own. Versions take turns, and
    in every second repeat the other one begins.

    Parameters
    ----------
    other : Path
        Python that runs the other version.
    size : Size, optional
        All of it unless told otherwise; the document holds it.
    on_done : callable, optional
        Called after each run.
    """
    size = size or Size()
    pythons: dict[Side, Path] = {"this": Path(sys.executable), "other": other}
    rows = []
    with TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        bench = Bench(Path(folder), size, has_core=True)
        write_site(bench.folder / "site", size.rows)
        for has_core in (True, False):
            bench = replace(bench, has_core=has_core)
            for timed in TIMED:
                runs = _run_in_turns(timed, bench, pythons, on_done)
                rows += [
                    _describe_figure(place, *asked, runs, has_core=has_core)
                    for place, asked in enumerate(timed.asked)
                ]
    return {
        "schema": SCHEMA,
        "size": asdict(size),
        "pass": all(row["reached"] for row in rows),
        "provenance": {
            "this": read_version(pythons["this"]),
            "other": read_version(other),
            "core": name_core(),
            "python": platform.python_version(),
            "machine": platform.machine(),
            "processors": os.cpu_count(),
        },
        "rows": rows,
    }


def _run_in_turns(
    timed: Timed,
    bench: Bench,
    pythons: dict[Side, Path],
    on_done: Callable[[object], None] | None,
) -> dict[Side, list[list[Time]] | str]:
    """Runs of both; of a version that failed once, and is not run again, its words."""
    failures: dict[Side, str] = {}

    def run(side: Side) -> list[Time]:
        if side not in failures:
            try:
                return timed.measure(bench, pythons[side])
            except RunFailure as failure:
                failures[side] = str(failure)
        return []

    works = {side: partial(run, side) for side in _SIDES}
    times = run_in_turns(works, timed.count(bench.size), on_done)
    return {side: failures.get(side, times[side]) for side in _SIDES}


def _describe_figure(
    place: int,
    key: str,
    clock: Clocked,
    reach_s: float,
    runs: Mapping[Side, list[list[Time]] | str],
    *,
    has_core: bool,
) -> dict[str, Any]:
    """Row of the document; without the core it is asked only not to be slower."""
    this, other = (_sum_up(runs[side], place) for side in _SIDES)
    ratios = {
        one: other[one]["median"] / this[one]["median"]
        if this[one] and other[one] and this[one]["median"]
        else None
        for one in _CLOCKS
    }
    if has_core:
        reached = bool(this[clock]) and this[clock]["median"] <= reach_s
    else:
        reached = (ratios[clock] or 0.0) >= _AS_SLOW
    return {
        "what": key,
        "core": has_core,
        "clock": clock,
        "reach_s": reach_s if has_core else None,
        "reached": reached,
        "this": this,
        "other": other,
        "times_faster": ratios,
    }


def _sum_up(runs: list[list[Time]] | str, place: int) -> dict[str, Any]:
    """Median, least and most of each clock [s]; None where the version failed."""
    if isinstance(runs, str):
        return {"failure": runs, **dict.fromkeys(_CLOCKS)}
    found: dict[str, Any] = {"failure": None}
    for clock in _CLOCKS:
        found[clock] = describe_times([getattr(run[place], clock) for run in runs])
    return found


def print_versions(document: Mapping[str, Any], console: Console, words: Words) -> None:
    """Print each figure by each clock, with the compiled core and without."""
    show_lines([words("against.head", **document["provenance"])], console)
    rows = [
        _describe(row, clock, words) for row in document["rows"] for clock in _CLOCKS
    ]
    show_rows(rows, console, words, "against_table")


def _describe(row: Mapping[str, Any], clock: str, words: Words) -> dict[str, Any]:
    """Row by one clock; what is asked stands beside the clock that it is asked of."""
    is_asked = clock == row["clock"]
    return {
        "what": words(f"against_figure.{row['what']}"),
        "core": row["core"],
        "clock": words(f"against_clock.{clock}"),
        **{side: _show_side(row[side], clock, words) for side in ("this", "other")},
        "ratio": row["times_faster"][clock],
        "reach_s": row["reach_s"] if is_asked else None,
        "reached": row["reached"] if is_asked else None,
    }


def _show_side(found: Mapping[str, Any], clock: str, words: Words) -> str:
    """``2.6 (2.5 to 2.9) ms``: the median, the least and the most; or the failure."""
    if found["failure"] is not None:
        return words("against.failed", reason=found["failure"])
    times = found[clock]
    scale, unit = (1e3, "ms") if times["median"] < _SHORT_S else (1.0, "s")
    shown = {name: words.write(f"{scale * time:.3g}") for name, time in times.items()}
    return words("against.time", unit=unit, **shown)


@contextmanager
def open_version(path: Path) -> Iterator[Path]:
    """Python that runs the version of a wheel, a venv, or a venv's Python.

    A wheel is installed in a venv of its own, without its dependencies: they are those
    of this version, so that the programs are compared and not their libraries.

    Raises
    ------
    ModelError
        If the path is none of these, or the wheel cannot be installed.
    """
    if path.suffix == ".whl" and path.is_file():
        with TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            yield _install(path, Path(folder))
        return
    found = [path, *(path / name for name in _PYTHONS)]
    python = next((one for one in found if one.is_file()), None)
    if python is None:
        raise ModelError(say("against.no_version", path=str(path)))
    yield python.absolute()  # not resolved: a venv is known by its link


def read_version(python: Path) -> str:
    """Version of the program that a Python runs.

    Raises
    ------
    ModelError
        If it runs none.
    """
    try:
        told = subprocess.run(
            [python, "-I", "-c", _ASK],
            capture_output=True,
            text=True,
            check=True,
            timeout=_LONGEST_S,
        )
    except (OSError, subprocess.SubprocessError):
        raise ModelError(say("against.no_program", path=str(python))) from None
    return told.stdout.strip()


def _install(wheel: Path, folder: Path) -> Path:
    venv.create(folder, with_pip=True)
    python = next(folder / name for name in _PYTHONS if (folder / name).is_file())
    places = dict.fromkeys(sysconfig.get_path(name) for name in ("purelib", "platlib"))
    site = subprocess.run(
        [python, "-I", "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout.strip()
    (Path(site) / "libraries.pth").write_text("\n".join(places), encoding="utf-8")
    install = ["-I", "-m", "pip", "install", "--no-deps", "--no-index", "--quiet"]
    words = [str(python), *install, str(wheel.resolve())]
    if subprocess.run(words, capture_output=True, check=False).returncode:
        raise ModelError(say("against.not_installed", path=str(wheel)))
    return python
