"""Whole ranges of friction, inclination, slack, stiffness, mesh: nothing fails.

The suite runs a thinned part of them; ``python -m pytest -m robustness`` runs all,
in about ten minutes. A scene may be refused before it is solved, and a history may
end early with a reason; neither may hide in a result.
"""

import itertools
import math
from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.history.settings import TRANSIENT_LEVELS, TransientSettings
from netdesign.addons.history.transient import run_history
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.outcome import ModelError, SolveError
from netdesign.snow.creep_law import PAPER_FLUIDITY
from netdesign.snow.mesh import MeshSize

FRICTIONS = [float(phi) for phi in range(46)]
INCLINATIONS = [0.0, 10.0, 20.0, 30.0, 40.0]
SLACKS = [0.0, 0.05, 0.15]
STIFFNESSES = [2e3, 2e4, 1e5]
DAY = 86400.0
QUICK = SolverSettings(accuracy=0.1)


def uniform(rows):
    """Mesh whose triangles are about 1 / rows high, with little grading."""
    size = 1.0 / rows
    return MeshSize(
        net_spacing=min(size, 0.34),
        corner=size / 4.0,
        sectors=2,
        upslope_spacing=2.0 * size,
    )


def list_scenes(frictions):
    return list(itertools.product(frictions, INCLINATIONS, SLACKS, STIFFNESSES))


def build_scenes(a_scene, grid):
    """Scenes of a grid by their place in it, but for those that the model refuses."""
    for key in grid:
        friction, inclination, slack, stiffness = key
        given = {"friction_deg": friction, "inclination_deg": inclination}
        with suppress(ModelError):  # the net would lie on the ground: test_net.py
            yield key, a_scene(slack=slack, stiffness_kN_per_m=stiffness, **given)


def steady_reasons(a_scene, grid, settings=QUICK):
    """What went wrong, by scene; scenes that are refused beforehand do not count."""
    wrong = {}
    for key, scene in build_scenes(a_scene, grid):
        result = solve_steady(scene, settings)
        if not isinstance(result, Solution):
            wrong[key] = result.reason
        elif not result.balance.relative_residual < 1e-8:
            wrong[key] = "balance"
    return wrong


def explained(reasons):
    """Physics that the model names; anything else is a failure of the solver."""
    named = ("touch the ground", "folds over", "pull on the net")
    return all(
        any(name in str(reason) for name in named) for reason in reasons.values()
    )


def history_faults(a_scene, grid, start, level=0):
    wrong = {}
    for key, scene in build_scenes(a_scene, grid):
        friction, inclination, *_ = key
        scene = replace(scene, fluidity=PAPER_FLUIDITY)
        settings = TransientSettings(start=start, stops_at_plateau=True, accuracy=0.03)
        try:
            run = run_history(
                scene, TRANSIENT_LEVELS[level], settings, 5.0 * DAY / scene.time_scale
            )
        except SolveError as failure:  # a sagged net may lie on the ground
            if "touches the ground" not in str(failure.reason):
                wrong[key] = failure.reason
            continue
        if not max(moment.residual for moment in run.moments) < 1e-8:
            wrong[key] = "balance"
        elif run.ended and len(run.moments) < 3:
            wrong[key] = run.ended
        elif friction >= 15.0 and inclination <= 30.0 and not run.plateau.reached:
            # smoother or steeper, the snow may slide past the head for good
            wrong[key] = f"no plateau, {run.ended or 'not ended'}"
        elif len(run.moments) + run.rejected > 400:
            wrong[key] = f"{len(run.moments)} steps, {run.rejected} rejected"
        elif not all(math.isfinite(m.tension_max) for m in run.moments):
            wrong[key] = "not finite"
    return wrong


def thin(seed, count):
    """Some scenes of the whole grid."""
    grid = list_scenes(FRICTIONS)
    chosen = np.random.default_rng(seed).choice(len(grid), count, replace=False)
    return [grid[place] for place in chosen]


WHOLE = pytest.mark.robustness
OF_FRICTION = [pytest.param(list_scenes([one]), marks=WHOLE) for one in FRICTIONS]
OF_HISTORY = [
    pytest.param(
        list(itertools.product([one], INCLINATIONS[::2], SLACKS, STIFFNESSES[1:])),
        marks=WHOLE,
    )
    for one in FRICTIONS
]


@pytest.mark.parametrize("grid", [thin(4, 80), *OF_FRICTION])
def test_steady(a_scene, grid):
    wrong = steady_reasons(a_scene, grid)
    assert explained(wrong), wrong


# The frictions and meshes on which a prototype stalled (FACTS.md, section 10), and all.
STALLED = [(rows, [2.0, 6.0, 10.0]) for rows in (2, 10)]
EVERY = [pytest.param(n, FRICTIONS[::3], marks=WHOLE) for n in (2, 4, 8, 16, 24)]


@pytest.mark.parametrize(("rows", "frictions"), [*STALLED, *EVERY])
def test_steady_on_plain_meshes(a_scene, rows, frictions):
    settings = SolverSettings(accuracy=0.1, levels=(MESH_LEVELS[0], uniform(rows)))
    grid = list(itertools.product(frictions, [0.0, 30.0], [0.0], [2e4]))
    assert steady_reasons(a_scene, grid, settings) == {}


@pytest.mark.parametrize("start", ["straight", "sagged"])
@pytest.mark.parametrize("grid", [thin(5, 8), *OF_HISTORY])
def test_histories(a_scene, grid, start):
    assert history_faults(a_scene, grid, start) == {}
