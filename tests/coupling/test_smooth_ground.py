"""Glide factors of 2.6 to 3.2 on practical sites: every one is solved.

The suite takes a few draws; ``python -m pytest -m robustness`` takes hundreds.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.history.settings import TransientSettings
from netdesign.addons.history.transient import solve_transient
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from tests.coupling.drawn_scenes import draw_smooth_site

DAY = 86400.0


def assert_pulls(scene):
    solution = solve_steady(scene, SolverSettings(accuracy=0.02))
    assert isinstance(solution, Solution), solution.reason
    assert solution.balance.relative_residual < 1e-8
    assert solution.foot.error < 0.02 * solution.foot.size
    assert solution.tension_min > 0.0
    return np.array([solution.foot.size, solution.head.size])


def follow(scene, start):
    settings = TransientSettings(
        start=start, accuracy=0.03, horizon=1e4 * DAY, stops_at_plateau=True
    )
    solution = solve_transient(scene, settings)
    assert isinstance(solution, Solution), solution.reason
    assert not solution.history.ended
    return solution


def assert_steady_demand(scene):
    """FACTS.md, section 12: 5 % over the steady state on sliding ground."""
    history = follow(scene, "steady")
    over = np.array([history.foot.size, history.head.size]) / assert_pulls(scene)
    assert history.history.plateau.reached
    assert over.min() > 0.97
    assert over.max() < 1.05


def put_two_sided(seed):
    return replace(draw_smooth_site(seed), ground_contact="two-sided")


def put_on(scene, glide_factor):
    thickness = scene.snowpack.thickness
    ground = build_ground_from_glide_factor(glide_factor, thickness)
    return replace(scene, ground=ground)


WHOLE = pytest.mark.robustness
MANY = pytest.param(range(24, 824), marks=WHOLE)
DOZENS = [pytest.param(seed, marks=WHOLE) for seed in range(4, 32)]


@pytest.mark.parametrize("seeds", [range(24), MANY])
def test_smooth_sites_are_solved(seeds):
    for seed in seeds:
        assert_pulls(draw_smooth_site(seed))


@pytest.mark.parametrize("seed", [*range(4), *DOZENS])
def test_a_history_on_smooth_ground_demands_its_steady_state(seed):
    assert_steady_demand(put_two_sided(seed))


@pytest.mark.parametrize("seed", [8, 9, 10])
def test_pulls_grow_with_the_glide_factor_towards_those_of_free_ground(seed):
    scene = draw_smooth_site(seed)
    grounds = [put_on(scene, glide) for glide in (1.0, 1.5, 2.4, 2.8, 3.2)]
    grounds.append(replace(scene, ground=GroundLaw(kind="free")))
    pulls = np.array([assert_pulls(one) for one in grounds])
    assert (np.diff(np.log(pulls), axis=0) > math.log(1.02)).all()
