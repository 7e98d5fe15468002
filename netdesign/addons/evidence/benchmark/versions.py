"""The same commands of two versions timed in turns, each in processes of its own.

The other version's own Python runs ``probe.py``, which prints times as JSON.
"""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
import sysconfig
import venv
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from netdesign.addons.evidence.benchmark.scenes import (
    INPUTS,
    NAMED,
    NAMES,
    change_value,
    write_heights,
    write_offices,
    write_site,
)
from netdesign.addons.evidence.measurements import run_in_turns
from netdesign.core.library import name_core
from netdesign.outcome import ModelError
from netdesign.words.message import say

SCHEMA = "netdesign.bench-against/2"
_PROBE = Path(__file__).with_name("probe.py")
_PYTHONS = ("bin/python", "Scripts/python.exe")
_ASK = "from importlib.metadata import version; print(version('netdesign'))"
_LONGEST_S = 900.0
_PROCESSES = "2"
_SIDES = ("this", "other")
_FOLLOWED = ("paper-30", "layered")  # in time, with two-sided contacts
_CLOCKS = {"processor": "cpu_s", "wall": "wall_s"}

_HEIGHTS, _WINTERS = "heights.csv", 35

# Sites beside the first one, each with another value in one of its cells.
CHANGED = {
    "length": ("Rows", "upslope length L [m]", "17.3"),
    "resistance": ("Anchors", "tendon R_k [kN]", "823"),
}

Command = list[str]
Times = dict[str, float]  # by the names of the clocks [s]


@dataclass(frozen=True, slots=True, kw_only=True)
class Size:
    """Amount of measurement: repeats, and what they solve."""

    repeats: int = 5
    scenes: tuple[str, ...] = NAMES
    samples: int = 10
    rows: int = 20


QUICK = Size(repeats=1, scenes=("paper-0", "paper-30"), samples=3, rows=1)


class Figure(NamedTuple):
    """Commands of one process, timed after those that warm it, and their exit codes."""

    timed: list[Command]
    warming: list[Command] = []  # noqa: RUF012 - of a tuple, never changed
    accepted: tuple[int, ...] = (0,)


_CHECKED = (0, 1, 4, 6)  # exit codes of a check that ended


def list_figures(size: Size, folder: Path) -> dict[str, Figure]:
    """Figures of a version, whose files are in a folder.

    What follows ``site`` finds its rows in the store: all, all but one, all but those
    that one type bears.
    """
    scenes = [
        ["solve", str(NAMED / f"{scene}.toml"), "--json"] for scene in size.scenes
    ]
    first = [_search("short", "1", density="300:310:2")]
    spans = {"density": "250:450", "friction": "15:45", "inclination": "25:35"}
    grid = {name: f"{span}:{size.samples}" for name, span in spans.items()}
    check = ["check", "--jobs", _PROCESSES, "--quiet", "--force", "--out"]
    site, length, resistance = (
        Figure([[*check, str(folder / "out"), str(folder / listed)]], [], _CHECKED)
        for listed in ("site", *CHANGED)
    )
    in_time = ["--json", "--method", "transient"]
    history = [["solve", str(NAMED / f"{scene}.toml"), *in_time] for scene in _FOLLOWED]
    heights = ["--heights", str(folder / _HEIGHTS)]
    winter = ["winter", "--example", "--no-cache", "--quiet", "--force"]
    winter += ["--out", str(folder / "winter"), "--row", "A1"]
    own, office, bare = (
        Figure([[*check, str(folder / "own"), *listed, "--no-cache"]], [], _CHECKED)
        for listed in (
            ["--example"],
            *([str(folder / f"{name}.xlsx")] for name in ("office", "bare")),
        )
    )
    return {
        "solve": Figure(scenes[:1]),
        "scenes": Figure(scenes, scenes),
        "row": Figure([_search("row", "1", **spans)], first, (0, 4)),
        "grid": Figure([_search("row", _PROCESSES, **grid)], first, (0, 4)),
        "site": site,
        "again": site,
        "length": length,
        "resistance": resistance,
        "example": own,
        "office": office,
        "bare": bare,
        "history": Figure(history, history),
        "winter": Figure([winter], [], (0, 4)),
        "winters": Figure(
            [[*winter, "--row", "A2", "--row", "A3", *heights]], [], (0, 4)
        ),
    }


def _search(name: str, jobs: str, **ranges: str) -> Command:
    words = ["envelope", str(INPUTS / f"{name}.toml"), "--no-cache", "--json"]
    words += ["--confirm", "none", "--quiet", "--jobs", jobs]
    return [*words, *(f"--{quantity}={span}" for quantity, span in ranges.items())]


def count_runs(size: Size) -> int:
    """Processes of both versions."""
    return len(_SIDES) * size.repeats * len(list_figures(size, Path()))


def compare_versions(
    other: Path,
    size: Size | None = None,
    on_done: Callable[[object], None] | None = None,
) -> dict[str, Any]:
    """Times of this version beside those of another one, as one document.

    Versions take turns, and in every second repeat the other one begins. Each repeat of
    a version has a store of its own.

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
    pythons = dict(zip(_SIDES, (Path(sys.executable), other), strict=True))
    counts: Counter[tuple[str, str]] = Counter()

    def run(side: str, what: str) -> Times | str:
        counts[side, what] += 1
        folder = Path(place) / f"{side}-{counts[side, what]}"
        if not folder.exists():
            write_sites(folder, size.rows)
        return time_figure(pythons[side], list_figures(size, folder)[what], folder)

    rows = []
    with TemporaryDirectory(ignore_cleanup_errors=True) as place:
        for what in list_figures(size, Path()):
            works = {side: partial(run, side, what) for side in _SIDES}
            times = run_in_turns(works, size.repeats, on_done)
            rows += [_describe(what, clock, times) for clock in _CLOCKS]
    return {
        "schema": SCHEMA,
        **{side: read_version(python) for side, python in pythons.items()},
        "core": name_core(),
        "python": platform.python_version(),
        "machine": platform.machine(),
        "processors": os.cpu_count(),
        "size": asdict(size),
        "pass": all(row["this_s"] is not None for row in rows),
        "rows": rows,
    }


def write_sites(folder: Path, rows: int) -> None:
    """Write a site, copies with one value changed, and a station's snow heights."""
    write_site(folder / "site", rows)
    write_heights(folder / _HEIGHTS, _WINTERS)
    write_offices(folder)
    for name, change in CHANGED.items():
        write_site(folder / name, rows)
        change_value(folder / name, *change)


def time_figure(python: Path, figure: Figure, folder: Path) -> Times | str:
    """Times of a figure in a process of a version; the last words of one that fails."""
    kept = {name: x for name, x in os.environ.items() if not name.startswith("PYTHON")}
    # versions before NETDESIGN_STORE know the other one
    store = {"NETDESIGN_STORE": str(folder / "cases"), "XDG_CACHE_HOME": str(folder)}
    try:
        done = subprocess.run(
            [python, "-I", _PROBE, json.dumps([figure.warming, figure.timed])],
            capture_output=True,
            text=True,
            check=False,
            env=kept | store,
            timeout=_LONGEST_S,
        )
    except subprocess.TimeoutExpired:
        return f"> {_LONGEST_S:g} s"
    last = (done.stderr.strip().splitlines() or [""])[-1][:200]
    try:
        printed = json.loads(done.stdout)
    except ValueError:
        return f"{last} ({done.returncode})"
    strange = [code for code in printed["codes"] if code not in figure.accepted]
    return f"{last} ({strange[0]})" if strange else printed["times"]


def _describe(
    what: str, clock: str, of_sides: Mapping[str, list[Times | str]]
) -> dict[str, Any]:
    """Row of the document: median, least and most of each version [s]."""
    row: dict[str, Any] = {"what": what, "clock": clock}
    failures = []
    for side, runs in of_sides.items():
        failed = [run for run in runs if isinstance(run, str)]
        times = [run[_CLOCKS[clock]] for run in runs if not isinstance(run, str)]
        row[f"{side}_s"] = None if failed else median(times)
        row[f"{side}_between_s"] = None if failed else [min(times), max(times)]
        failures += failed[:1]
    this, other = (row[f"{side}_s"] for side in _SIDES)
    row["times_faster"] = other / this if this and other else None
    return row | {"failure": "; ".join(failures)}


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
    candidates = [path, *(path / name for name in _PYTHONS)]
    python = next((candidate for candidate in candidates if candidate.is_file()), None)
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
        printed = subprocess.run(
            [python, "-I", "-c", _ASK],
            capture_output=True,
            text=True,
            check=True,
            timeout=_LONGEST_S,
        )
    except (OSError, subprocess.SubprocessError):
        raise ModelError(say("against.no_program", path=str(python))) from None
    return printed.stdout.strip()


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
