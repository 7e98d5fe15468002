"""Histories of snow far below the head of a slack net: they start as it hangs."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.history.instant import advance
from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.addons.history.state import build_problem, build_start, find_start
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.snow.ground import GroundLaw
from netdesign.snow.mesh import build_template
from tests.each import each

GROUNDS = (
    GroundLaw(),
    GroundLaw(kind="no-slip"),
    GroundLaw(kind="sliding", slip_length=5.0),
)


@each("ground", GROUNDS)
@each("thickness", [1.0, 1.7])
def test_the_first_instant_has_the_steady_pulls(a_scene, ground, thickness):
    """It was 2.5 to 10 times as much, or no number, where d < D_k / 2."""
    scene = a_scene(thickness_m=3.0, length_m=12.0, inclination_deg=30.0, slack=0.03)
    snow = replace(scene.snowpack, thickness=thickness)
    scene = replace(scene, snowpack=snow, ground=ground)
    problem, size = build_problem(scene, densifies=False), TRANSIENT_LEVELS[1]
    template = build_template(snow.upslope_length / thickness, size, scene.layer_tops)
    state = build_start(problem, template, find_start(scene, size, "steady"))
    first = advance(
        problem, state, 1e-6, tolerance=1e-4, balance_tolerance=1e-9, max_iterations=30
    )
    steady = solve_steady(scene, SolverSettings(accuracy=0.02), on_failure="raise")
    pulls = [np.hypot(*first.foot_pull), np.hypot(*first.head_pull)]
    expected = np.array([steady.foot.size, steady.head.size]) / scene.force_scale
    assert pulls == pytest.approx(expected, rel=0.02)
