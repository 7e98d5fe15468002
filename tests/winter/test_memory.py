"""Past of the net: a chain that keeps the net's curve against states at rest.

Spoilt: a net that is given no time to follow (a creep time of 1e-7) fails this file.
"""

import math

import numpy as np
import pytest

from netdesign.coupling.history.settings import TRANSIENT_LEVELS
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from netdesign.snowpack.follow import follow_heights
from netdesign.snowpack.hs2swe import HS2SWE
from netdesign.winter.day import RowDay
from tests.winter.made_up_row import SLOPE, a_solver, loaded
from tests.winter.memory import follow_scenes, solve_alone

UP_AND_BACK = (150.0, 250.0, 350.0, 450.0, 300.0, 150.0)
# Creep times in which the snow of each ground has followed, by (Y8) and more.
GROUNDS = {
    "no slip": (GroundLaw(kind="no-slip"), 0.2),
    "N 2.4": (build_ground_from_glide_factor(2.4, 3.0), 0.02),
    "free": (GroundLaw(), 0.002),
}


@pytest.mark.parametrize("name", GROUNDS)
def test_density_up_and_back_leaves_no_force_behind(name):
    ground, creep_time = GROUNDS[name]
    scenes = [loaded(density, 3.0, ground) for density in UP_AND_BACK]
    chain = follow_scenes(scenes, [creep_time] * len(scenes))
    at_rest = solve_alone(scenes[:5])
    np.testing.assert_allclose(chain, [*at_rest, at_rest[0]], rtol=0.015)


def test_a_net_without_time_remembers():
    """The check above can fail: without creep the net keeps the old snow's curve."""
    scenes = [loaded(density, 3.0, GROUNDS["no slip"][0]) for density in (450.0, 200.0)]
    chain = follow_scenes(scenes, [0.2, 1e-7], steps=6)
    assert chain[1, 0] > 1.1 * solve_alone(scenes[1:])[0, 0]


def test_snow_of_one_height_pulls_towards_that_of_the_largest_density():
    """Constant height, no melt: it rises ever more slowly, below its limit.

    By HS2SWE; delta-snow reads a settling below its tolerance as none, and stays.
    """
    packs = follow_heights([1.6] * 401, HS2SWE)
    solver = a_solver(accuracy=0.01)
    days = {k: packs[k] for k in (6, 20, 60, 150, 400)}
    solved = solver.solve(solver.prepare(days, layered=False))
    limit = RowDay(
        index=0,
        thickness=1.6 * math.cos(SLOPE),
        density=HS2SWE.largest_density,
        ending="open",
    )
    (largest,) = solver.solve([limit])
    pulls = np.array([day.foot.value for day in solved])
    days_apart = np.diff([6, 20, 60, 150, 400])
    assert np.all(np.diff(pulls) > 0.0)
    assert np.all(np.diff(np.diff(pulls) / days_apart) < 0.0)
    assert pulls[-1] < largest.foot.value


@pytest.mark.parametrize(
    ("increments", "allowed"),
    [(8, 0.04), pytest.param(20, 0.015, marks=pytest.mark.slow)],
)
def test_snow_that_accretes_on_free_ground_ends_at_rest(increments, allowed):
    """From half the net's height to its head; each snow is laid anew on the old net.

    With twenty: ``python -m pytest -m slow tests/winter/test_memory.py``.
    """
    heights = np.linspace(1.6, 3.0, increments + 1)
    scenes = [loaded(300.0, float(height), GroundLaw()) for height in heights]
    chain = follow_scenes(scenes, [0.003] * len(scenes), size=TRANSIENT_LEVELS[0])
    np.testing.assert_allclose(chain[-3:], solve_alone(scenes[-3:]), rtol=allowed)
