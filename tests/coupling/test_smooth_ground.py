"""Glide factors of 2.6 to 3.2 on practical sites: every one is solved.

The suite takes a few draws; ``python -m pytest -m robustness`` takes hundreds.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from tests.coupling.drawn_scenes import draw_smooth_site


def assert_pulls(scene):
    solution = solve_steady(scene, SolverSettings(accuracy=0.02))
    assert isinstance(solution, Solution), solution.reason
    assert solution.balance.relative_residual < 1e-8
    assert solution.foot.error < 0.02 * solution.foot.size
    assert solution.tension_min > 0.0
    return np.array([solution.foot.size, solution.head.size])


def put_on(scene, glide_factor):
    thickness = scene.snowpack.thickness
    ground = build_ground_from_glide_factor(glide_factor, thickness)
    return replace(scene, ground=ground)


WHOLE = pytest.mark.robustness
MANY = pytest.param(range(24, 824), marks=WHOLE)


@pytest.mark.parametrize("seeds", [range(24), MANY])
def test_smooth_sites_are_solved(seeds):
    for seed in seeds:
        assert_pulls(draw_smooth_site(seed))


@pytest.mark.parametrize("seed", [8, 9, 10])
def test_pulls_grow_with_the_glide_factor_towards_those_of_free_ground(seed):
    scene = draw_smooth_site(seed)
    grounds = [put_on(scene, glide) for glide in (1.0, 1.5, 2.4, 2.8, 3.2)]
    grounds.append(replace(scene, ground=GroundLaw(kind="free")))
    pulls = np.array([assert_pulls(one) for one in grounds])
    assert (np.diff(np.log(pulls), axis=0) > math.log(1.02)).all()
