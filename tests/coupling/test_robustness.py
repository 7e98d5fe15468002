"""Whole ranges of friction, inclination, slack, stiffness, mesh: nothing fails.

The suite runs a thinned part of them; ``python -m pytest -m robustness`` runs all,
in about ten minutes. A scene may be refused before it is solved; histories of drawn
scenes are those of tests/addons/history/test_drawn_histories.py.
"""

import itertools
from contextlib import suppress

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.outcome import ModelError
from netdesign.snow.mesh import MeshSize

FRICTIONS = [float(phi) for phi in range(46)]
INCLINATIONS = [0.0, 10.0, 20.0, 30.0, 40.0]
SLACKS = [0.0, 0.05, 0.15]
STIFFNESSES = [2e3, 2e4, 1e5]
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


def thin(seed, count):
    """Some scenes of the whole grid."""
    grid = list_scenes(FRICTIONS)
    chosen = np.random.default_rng(seed).choice(len(grid), count, replace=False)
    return [grid[place] for place in chosen]


WHOLE = pytest.mark.robustness
OF_FRICTION = [pytest.param(list_scenes([one]), marks=WHOLE) for one in FRICTIONS]


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
