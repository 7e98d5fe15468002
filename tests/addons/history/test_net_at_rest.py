"""The net of a steady state as the polygon of a history: length, tensions, shape."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.history.instant import advance
from netdesign.addons.history.net_pulls import join_points, measure_arcs
from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.addons.history.state import find_net_at_rest
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.snow.ground import GroundLaw
from tests.addons.history.starts import begin
from tests.coupling.drawn_scenes import GROUNDS, draw_scene
from tests.each import each

SEEDS = range(8)
SIZE = TRANSIENT_LEVELS[1]


def find_middles(places):
    """Of the net's elements."""
    return (places[:-2:2] + places[2::2]) / 2.0


@each("seed", SEEDS)
def test_polygon_has_the_nets_length_and_the_steady_tensions(seed):
    scene = draw_scene(500 + seed, ground=GROUNDS[seed % 3])
    problem, state = begin(scene, "steady", SIZE)
    assert state.lengths.sum() == pytest.approx(problem.length, rel=1e-13)
    arcs = measure_arcs(join_points(state.net_nodes, problem.head))
    tensions = problem.stiffness * (arcs / state.lengths - 1.0)
    rest = find_net_at_rest(scene, SIZE)
    fractions = state.body.topology.template.net_fractions
    strain = np.interp(find_middles(fractions), find_middles(rest.places), rest.strain)
    np.testing.assert_allclose(
        tensions[: strain.size], problem.stiffness * strain, rtol=1e-4
    )
    if problem.has_freeboard:
        assert tensions[-1] == pytest.approx(
            problem.stiffness * rest.free_strain, rel=1e-4
        )
    assert tensions.min() > 0.0


THIN_GROUNDS = (
    GroundLaw(),
    GroundLaw(kind="no-slip"),
    GroundLaw(kind="sliding", slip_length=5.0),
)


@each("ground", THIN_GROUNDS)
@each("thickness", [1.0, 1.7])
def test_the_first_instant_has_the_steady_pulls(a_scene, ground, thickness):
    """It was 2.5 to 10 times as much, or no number, where d < D_k / 2."""
    scene = a_scene(thickness_m=3.0, length_m=12.0, inclination_deg=30.0, slack=0.03)
    snow = replace(scene.snowpack, thickness=thickness)
    scene = replace(scene, snowpack=snow, ground=ground)
    problem, state = begin(scene, "steady", SIZE, densifies=False)
    first = advance(
        problem, state, 1e-6, tolerance=1e-4, balance_tolerance=1e-9, max_iterations=30
    )
    steady = solve_steady(scene, SolverSettings(accuracy=0.02), on_failure="raise")
    pulls = [np.hypot(*first.foot_pull), np.hypot(*first.head_pull)]
    expected = np.array([steady.foot.size, steady.head.size]) / scene.force_scale
    assert pulls == pytest.approx(expected, rel=0.02)
