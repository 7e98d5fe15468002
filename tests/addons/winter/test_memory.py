"""Past of the net: a chain that keeps the net's curve against states at rest."""

import numpy as np
import pytest

from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from tests.addons.winter.histories import follow_scenes
from tests.addons.winter.made_up_row import loaded

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
    alone = [
        solve_steady(one, SolverSettings(accuracy=5e-3), on_failure="raise")
        for one in scenes[:5]
    ]
    at_rest = [(one.foot.size, one.head.size) for one in alone]
    np.testing.assert_allclose(chain, [*at_rest, at_rest[0]], rtol=0.015)
