"""``netdesign doctor``: versions, threads and data, and a test of the program here."""

from __future__ import annotations

import os
import platform
import sys
from collections.abc import Callable
from dataclasses import dataclass
from importlib import metadata
from typing import Any

import click

from netdesign import __version__
from netdesign.commands.options import take_options
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

_LIBRARIES = (
    *("numpy", "scipy", "scikit-fem", "pandas", "openpyxl", "defusedxml"),
    *("rapidfuzz", "XlsxWriter", "jinja2", "click", "rich", "pydantic"),
)
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_EXIT_UNSOUND = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class Probe:
    """Result of a test: its subject, the value shown, and whether it is sound."""

    what: Message | str
    shows: Message | str
    is_sound: bool = True


@click.command()
@take_options("doctor")
def doctor(*, language: Language) -> None:
    """Show versions, threads and data, and test that the program works here."""
    probes = [*_list_versions(), *_list_threads(), *_run_tests()]
    for probe in probes:
        key = "doctor.ok" if probe.is_sound else "doctor.fault"
        parts = (say(key), probe.what, probe.shows)
        mark, what, shows = (render(part, language) for part in parts)
        click.echo(f"{mark:8}{what:24}{shows}")
    sys.exit(0 if all(probe.is_sound for probe in probes) else _EXIT_UNSOUND)


def _list_versions() -> list[Probe]:
    probes = [
        Probe(what="netdesign", shows=__version__),
        Probe(what="python", shows=platform.python_version()),
        Probe(
            what=say("doctor.system"), shows=f"{platform.system()} {platform.machine()}"
        ),
    ]
    for name in _LIBRARIES:
        try:
            probes.append(Probe(what=name, shows=metadata.version(name)))
        except metadata.PackageNotFoundError:
            probes.append(Probe(what=name, shows=say("doctor.missing"), is_sound=False))
    return probes


def _list_threads() -> list[Probe]:
    limits = [
        Probe(what=name, shows=os.environ.get(name) or say("doctor.not_set"))
        for name in _THREADS
    ]
    return [Probe(what=say("doctor.processors"), shows=str(os.cpu_count())), *limits]


def _run_tests() -> list[Probe]:
    tests: tuple[tuple[Message | str, Callable[[], Message | str]], ...] = (
        ("BLAS", _name_blas),
        (say("doctor.profiles"), _load_profiles),
        (say("doctor.workbook"), _round_trip_example),
        (say("doctor.solver"), _solve_small_scene),
    )
    return [
        _look_at_core(),
        _measure_store(),
        *(_try(what, test) for what, test in tests),
    ]


def _try(what: Message | str, test: Callable[[], Message | str]) -> Probe:
    try:
        return Probe(what=what, shows=test())
    except Exception as error:  # whatever fails here is what the doctor is asked for  # noqa: BLE001
        shows = f"{type(error).__name__}: {error}"
        return Probe(what=what, shows=shows, is_sound=False)


def _name_blas() -> str:
    import numpy as np

    config: Any = np.show_config(mode="dicts")
    blas = config.get("Build Dependencies", {}).get("blas", {})
    return f"{blas.get('name', 'unknown')} {blas.get('version', '')}".strip()


def _look_at_core() -> Probe:
    """Name the core that solves here, or why the compiled core is not used."""
    from netdesign.core.library import find_core, is_switched_off, name_core
    from netdesign.core.sources import SWITCH, SWITCHED_OFF, read_switch

    what, word = say("doctor.core"), read_switch()
    if word not in ("", SWITCHED_OFF):
        message = say("doctor.switch", name=SWITCH, word=word, off=SWITCHED_OFF)
        return Probe(what=what, shows=message, is_sound=False)
    if find_core() is not None:
        return Probe(what=what, shows=name_core())
    why = "doctor.switched_off" if is_switched_off() else "doctor.not_compiled"
    return Probe(what=what, shows=say(why))


def _measure_store() -> Probe:
    """Place and size of the store; the next run sets a damaged store aside."""
    from netdesign.edge.input_files import is_there
    from netdesign.solving.store import find_store

    path, what = find_store(), say("doctor.store")
    if not is_there(path):
        return Probe(what=what, shows=say("doctor.no_store", path=str(path)))
    megabytes = path.stat().st_size / 1e6
    message = say("doctor.store_size", path=str(path), megabytes=megabytes)
    return Probe(what=what, shows=message)


def _load_profiles() -> str:
    from netdesign.checks import list_standards, load_standard

    return ", ".join(load_standard(name).id for name in list_standards())


def _round_trip_example() -> Message:
    import tempfile
    from pathlib import Path

    from netdesign.site.reader import read_site
    from netdesign.site.template.office_workbook import write_site_workbook

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "example.xlsx"
        write_site_workbook(path, example=True)
        site = read_site(path)
    if site.notes:
        raise RuntimeError("; ".join(map(str, site.notes)))
    return say("doctor.example", rows=len(site.rows))


# Uniform snow on freely gliding ground: the net carries its whole weight.
_SCENE = {
    "slope": {"angle_deg": 38.0},
    "snow": {"thickness_m": 2.5, "upslope_length_m": 6.0, "density_kg_m3": 300.0},
    "net": {"stiffness_kN_per_m": 8000.0, "slack": 0.05, "friction_deg": 30.0},
    "solve": {"accuracy": 0.1},
}


def _solve_small_scene() -> Message:
    import time

    from netdesign.coupling.solution import require_solved
    from netdesign.files.scene import SceneFile, build_scene_of_file
    from netdesign.solving.solve import solve_scene

    to_solve = build_scene_of_file(SceneFile.model_validate(_SCENE))
    start = time.perf_counter()
    solution = require_solved(solve_scene(to_solve.scene, to_solve.settings))
    elapsed = time.perf_counter() - start
    residual = solution.balance.relative_residual
    return say("doctor.solved", residual=residual, seconds=elapsed)
