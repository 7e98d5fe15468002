"""The net of a steady state as the polygon of a history: length, tensions, shape."""

import numpy as np
import pytest

from netdesign.addons.history import state
from netdesign.addons.history.net_pulls import measure_arcs
from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.addons.history.state import (
    build_problem,
    build_start,
    find_net_at_rest,
    find_start,
)
from netdesign.numerics.curve import interpolate_curve
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.mesh import build_template
from tests.coupling.drawn_scenes import GROUNDS, draw_scene
from tests.each import each

SEEDS = range(8)
SIZE = TRANSIENT_LEVELS[1]


def begin(scene, start="steady"):
    problem = build_problem(scene, densifies=True)
    pack = scene.snowpack
    template = build_template(
        pack.upslope_length / pack.thickness, SIZE, scene.layer_tops
    )
    state = build_start(problem, template, find_start(scene, SIZE, start))
    return problem, state


def find_middles(places):
    """Of the net's elements."""
    return (places[:-2:2] + places[2::2]) / 2.0


def list_points(problem, state):
    return np.column_stack(
        [np.zeros(2), state.body.vertices[:, state.carried], problem.head]
    )


@each("seed", SEEDS)
def test_polygon_has_the_nets_length_and_the_steady_tensions(seed):
    scene = draw_scene(500 + seed, ground=GROUNDS[seed % 3])
    problem, state = begin(scene)
    assert state.lengths.sum() == pytest.approx(problem.length, rel=1e-13)
    arcs = measure_arcs(list_points(problem, state))
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


@each("seed", SEEDS)
def test_polygon_lies_on_the_net_at_rest(seed):
    """But for what chords are shorter than arcs."""
    scene = draw_scene(500 + seed, ground=GROUNDS[seed % 3])
    problem, state = begin(scene)
    rest = find_net_at_rest(scene, SIZE)
    net = state.body.vertices[:, state.body.topology.net]
    fractions = state.body.topology.template.net_fractions
    expected = interpolate_curve(rest.places, rest.curve, fractions)[:, ::2]
    np.testing.assert_allclose(net, expected, atol=4e-3)
    stands_out = scene.net.height_normal > 1.01 * scene.snowpack.thickness
    assert (state.top == "on-net") is stands_out
    assert net[1, -1] == pytest.approx(1.0, abs=1e-4)  # moves with the sag
    np.testing.assert_allclose(list_points(problem, state)[:, -1], problem.head)


def test_mesh_of_another_size_gets_a_net_of_the_same_shape(a_scene):
    scene = a_scene(slack=0.03, ground="no-slip", inclination_deg=20.0)
    problem = build_problem(scene, densifies=True)
    rest = find_net_at_rest(scene, TRANSIENT_LEVELS[2])
    states = [
        build_start(problem, build_template(5.0, size), rest)
        for size in TRANSIENT_LEVELS[:2]
    ]
    sags = [state.body.vertices[0, state.body.topology.net].max() for state in states]
    assert sags[0] == pytest.approx(sags[1], rel=0.03)


def test_a_scene_without_a_steady_state_says_what_to_choose(a_scene, monkeypatch):
    def fail(*_, **__):
        raise SolveError(Outcome.NO_EQUILIBRIUM, "the net has none.")

    monkeypatch.setattr(state, "find_net_at_rest", fail)
    scene = a_scene()
    with pytest.raises(SolveError, match=r"none\): choose the start sagged") as failure:
        find_start(scene, SIZE, "steady")
    assert failure.value.outcome is Outcome.NO_EQUILIBRIUM
    assert find_start(scene, SIZE, "straight") == "straight"
