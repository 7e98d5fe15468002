"""Builders shared by the tests; the defaults are the reference scene of the paper.

BLAS threads are pinned before numpy is imported: the matrices are small, and the
order of a threaded sum must not decide a last digit.
"""

from __future__ import annotations

import os
import sys
import tempfile

for _library in ("OPENBLAS", "OMP", "MKL"):
    os.environ[f"{_library}_NUM_THREADS"] = "1"

# Compiled modules are kept, whatever the shell says: else every program that a test
# starts compiles the package again, and each worker all tests.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# Runs of the program must neither use nor fill the user's store of finished cases.
if "NETDESIGN_STORE" not in os.environ:
    os.environ["NETDESIGN_STORE"] = os.path.join(  # noqa: PTH118
        tempfile.mkdtemp(prefix="netdesign-tests-"), "cases.sqlite"
    )

import gc  # noqa: E402  (all of these after the environment)
import math  # noqa: E402
from collections.abc import Callable  # noqa: E402
from functools import cache  # noqa: E402
from pathlib import Path  # noqa: E402

import numpy as np  # noqa: E402
import pytest  # noqa: E402
from hypothesis import settings  # noqa: E402

from netdesign.coupling.scene import MESH_LEVELS, Scene, SolverSettings  # noqa: E402
from netdesign.coupling.solution import Solution  # noqa: E402
from netdesign.coupling.steady.solve import solve_steady  # noqa: E402
from netdesign.snow.ground import GroundKind  # noqa: E402
from netdesign.snow.law import FlowLayer, FlowProblem  # noqa: E402
from netdesign.snow.mesh import MeshSize, build_template, place_nodes  # noqa: E402
from netdesign.snow.placed_mesh import PlacedMesh, build_placed_mesh  # noqa: E402
from tests.program import Ended, call_program  # noqa: E402
from tests.scenes import build_scene  # noqa: E402

# Drawn values are the same in every run, and a slow machine is no failure.
settings.register_profile("fixed", derandomize=True, database=None, deadline=None)
settings.load_profile("fixed")


def _build_flow_problem(
    *,
    exponent: float = 3.0,
    bulk_ratio: float = 1.8,
    slope_deg: float = 40.0,
    ground: GroundKind = "free",
    slip_ratio: float = 0.0,
    friction: float = 0.5,
) -> FlowProblem:
    slope = math.radians(slope_deg)
    return FlowProblem(
        exponent=exponent,
        layers=(FlowLayer(bulk_ratio=bulk_ratio),),
        gravity=(math.sin(slope), -math.cos(slope)),
        ground=ground,
        slip_ratio=slip_ratio,
        friction=friction,
    )


def _build_mesh(
    *,
    inclination_deg: float = 0.0,
    sag: float = 0.0,
    aspect: float = 5.0,
    size: MeshSize = MESH_LEVELS[1],
) -> PlacedMesh:
    """Mesh against a parabola of this sag, over the thickness, across the chord."""
    template = build_template(aspect, size)
    along = template.net_fractions
    head_x = math.tan(math.radians(inclination_deg))
    chord = math.hypot(head_x, 1.0)
    offset = 4.0 * sag * along * (1.0 - along) / chord
    curve = np.array([along * head_x + offset, along - offset * head_x])
    return build_placed_mesh(template, place_nodes(template, curve))


FINE_LEVELS = MESH_LEVELS[1:]  # each halves the sizes of the one before


@cache
def _solve(first_level: int = 0, **scene: object) -> Solution:
    """Tight solution on two neighbouring fine levels, 140 and 340 triangles first."""
    settings = SolverSettings(
        accuracy=0.1,
        stress_tolerance=1e-8,
        shape_tolerance=1e-7,
        levels=FINE_LEVELS[first_level : first_level + 2],
    )
    solution = solve_steady(
        build_scene(**scene),  # type: ignore[arg-type]
        settings,
        on_failure="raise",
    )
    assert isinstance(solution, Solution)
    return solution


@pytest.fixture(scope="session")
def a_scene() -> Callable[..., Scene]:
    """Scene from engineer's units: ``a_scene(inclination_deg=30)``."""
    return build_scene


@pytest.fixture(scope="session")
def a_flow_problem() -> Callable[..., FlowProblem]:
    """Dimensionless law of one instant: ``a_flow_problem(exponent=1.0)``."""
    return _build_flow_problem


@pytest.fixture(scope="session")
def a_mesh() -> Callable[..., PlacedMesh]:
    """Placed mesh: ``a_mesh(inclination_deg=30, sag=0.1)``."""
    return _build_mesh


@pytest.fixture(scope="session")
def solved() -> Callable[..., Solution]:
    """Tight solution of ``a_scene(...)`` on two fine levels; solved once."""
    return _solve


@pytest.fixture
def call(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Callable[..., Ended]:
    """Calls the program in this process, in an empty folder: ``call("init")``."""
    monkeypatch.chdir(tmp_path)
    return call_program


def pytest_collection_finish() -> None:
    """What was collected stays: no collection of garbage need look at it again."""
    gc.collect()
    gc.freeze()


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: object) -> object:
    """Each worker goes through a half: what a module shares is made by one of them."""
    if config.getvalue("dist") != "load":
        return None
    from xdist.scheduler import WorkStealingScheduling

    return WorkStealingScheduling(config, log)
