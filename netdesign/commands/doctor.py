"""``netdesign doctor``: versions, threads and data, and a test of the program here.

It speaks English only: it is for whoever develops or examines the program.
"""

from __future__ import annotations

import json
import os
import platform
import sys
from collections.abc import Callable
from dataclasses import asdict, dataclass
from importlib import metadata
from typing import Any

import click

from netdesign import __version__
from netdesign.commands.options import json_option

_LIBRARIES = (
    *("numpy", "scipy", "scikit-fem", "pandas", "openpyxl", "defusedxml"),
    *("XlsxWriter", "jinja2", "matplotlib", "click", "rich", "pydantic"),
)
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_EXIT_UNSOUND = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class Probe:
    """One thing that was looked at."""

    what: str
    shows: str
    is_sound: bool = True


@click.command()
@json_option("list")
def doctor(*, as_json: bool) -> None:
    """Show versions, threads and data, and test that the program works here.

    \b
    netdesign doctor
    netdesign doctor --json
    """
    probes = [*_list_versions(), *_list_threads(), *_run_tests()]
    if as_json:
        document = {
            "schema": "netdesign.doctor/1",
            "sound": all(probe.is_sound for probe in probes),
            "probes": [asdict(probe) for probe in probes],
        }
        click.echo(json.dumps(document, indent=1))
    else:
        for probe in probes:
            mark = "ok" if probe.is_sound else "FAULT"
            click.echo(f"{mark:6}{probe.what:24}{probe.shows}")
    sys.exit(0 if all(probe.is_sound for probe in probes) else _EXIT_UNSOUND)


def _list_versions() -> list[Probe]:
    probes = [
        Probe(what="netdesign", shows=__version__),
        Probe(what="python", shows=platform.python_version()),
        Probe(what="system", shows=f"{platform.system()} {platform.machine()}"),
    ]
    for name in _LIBRARIES:
        try:
            probes.append(Probe(what=name, shows=metadata.version(name)))
        except metadata.PackageNotFoundError:
            probes.append(Probe(what=name, shows="is missing", is_sound=False))
    return probes


def _list_threads() -> list[Probe]:
    limits = {name: os.environ.get(name, "not set") for name in _THREADS}
    shown = {"processors": str(os.cpu_count()), **limits}
    return [Probe(what=what, shows=shows) for what, shows in shown.items()]


def _run_tests() -> list[Probe]:
    tests: dict[str, Callable[[], str]] = {
        "BLAS": _name_blas,
        "core": _name_core,
        "limit profiles": _load_profiles,
        "site workbook": _round_trip_example,
        "solver": _solve_small_scene,
    }
    return [_try(what, test) for what, test in tests.items()]


def _try(what: str, test: Callable[[], str]) -> Probe:
    try:
        return Probe(what=what, shows=test())
    except Exception as error:  # whatever fails here is what the doctor is asked for
        shows = f"{type(error).__name__}: {error}"
        return Probe(what=what, shows=shows, is_sound=False)


def _name_blas() -> str:
    import numpy as np

    config: Any = np.show_config(mode="dicts")
    blas = config.get("Build Dependencies", {}).get("blas", {})
    return f"{blas.get('name', 'unknown')} {blas.get('version', '')}".strip()


def _name_core() -> str:
    """Core that solves here."""
    from netdesign.core.library import name_core

    return name_core()


def _load_profiles() -> str:
    from netdesign.checks import list_standards, load_standard

    return ", ".join(load_standard(name).id for name in list_standards())


def _round_trip_example() -> str:
    import tempfile
    from pathlib import Path

    from netdesign.site.reader import read_site
    from netdesign.site.template.workbook import write_site_workbook

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "example.xlsx"
        write_site_workbook(path, example=True)
        site = read_site(path)
    if site.notes:
        raise RuntimeError("; ".join(map(str, site.notes)))
    return f"example written and read: {len(site.rows)} net rows"


def _solve_small_scene() -> str:
    """Uniform snow on freely gliding ground: the net carries its whole weight."""
    import time
    from math import radians

    from netdesign.cable.net import Net
    from netdesign.coupling.scene import Scene, SolverSettings
    from netdesign.coupling.solution import FailedSolution
    from netdesign.coupling.steady.solve import solve_steady
    from netdesign.errors import SolveError
    from netdesign.snow.ground import GroundLaw
    from netdesign.snow.snowpack import Snowpack

    snowpack = Snowpack(
        slope_angle=radians(38), thickness=2.5, upslope_length=6.0, density=300.0
    )
    net = Net(
        height_normal=2.5,
        inclination=radians(30),
        stiffness_per_m=8e6,
        slack=0.05,
        friction_angle=radians(30),
    )
    scene = Scene(snowpack=snowpack, ground=GroundLaw(kind="free"), net=net)
    start = time.perf_counter()
    solution = solve_steady(scene, SolverSettings(accuracy=0.1))
    elapsed = time.perf_counter() - start
    if isinstance(solution, FailedSolution):
        raise SolveError(solution.outcome, solution.reason)
    residual = solution.balance.relative_residual
    return f"balance residual {residual:.1e} of the weight, {elapsed:.2f} s"
