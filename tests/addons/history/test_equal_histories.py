"""Steps of histories in the compiled core against those in NumPy."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from netdesign.addons.evidence.benchmark.scenes import build_tables, draw_scene
from netdesign.addons.history.settings import TRANSIENT_LEVELS, TransientSettings
from netdesign.addons.history.snow import SnowIterate
from netdesign.addons.history.state import build_problem
from netdesign.addons.history.step import assemble_step, condense_step
from netdesign.addons.history.transient import run_history
from netdesign.addons.history.yielding import NetGuess, YieldingNodes, settle_net
from netdesign.cable.net import Net
from netdesign.core.library import find_core
from netdesign.outcome import ModelError, SolveError
from tests.core.drawn import assert_alike

pytestmark = pytest.mark.skipif(find_core() is None, reason="no compiled core here")

COARSE = TRANSIENT_LEVELS[0]
STARTS = ("steady", "sagged", "straight")


def draw_scenes(count):
    """Drawn nets that a history can follow, with two-sided contacts."""
    scenes, number = [], 0
    while len(scenes) < count:
        number += 1
        try:
            scene = build_tables(draw_scene(83, number))
        except ModelError:
            continue
        if isinstance(scene.net, Net):
            scenes.append(
                replace(scene, ground_contact="two-sided", net_contact="two-sided")
            )
    return scenes


SCENES = draw_scenes(16)


@cache
def follow(number):
    """States of a drawn history's first steps, whose iterates are untidy."""
    scene, states = SCENES[number], []
    settings = TransientSettings(start=STARTS[number % 3], max_steps=6)
    try:
        run = run_history(scene, COARSE, settings, 1.0, on_state=states.append)
    except SolveError as failure:
        return failure.outcome, states
    return run, states


def test_the_drawn_scenes_are_of_every_kind():
    snows = [build_problem(scene, densifies=True).snow for scene in SCENES]
    assert {one.ground for one in snows} == {"free", "sliding", "no-slip"}
    assert {len(one.layers) > 1 for one in snows} == {True, False}
    tops = {state.top for k in range(len(SCENES)) for state in follow(k)[1][:2]}
    assert tops >= {"held", "on-net"}


# Half of them, and all in the long run: in NumPy they take some seconds.
@pytest.mark.parametrize(
    "number",
    [
        pytest.param(number, marks=pytest.mark.long if number % 2 else ())
        for number in range(len(SCENES))
    ],
)
def test_a_history_is_the_same(number, in_numpy):
    (run, states), (plain, others) = (
        follow(number),
        in_numpy(follow.__wrapped__, number),
    )
    assert len(states) == len(others)
    if not hasattr(run, "moments"):
        assert run == plain
        return
    for one, other in zip(run.moments, plain.moments, strict=True):
        for name in ("foot", "head", "on_net"):
            assert_alike(getattr(one, name), getattr(other, name), 1e-8)
    assert run.linear_solves == plain.linear_solves
    assert_alike(run.state.body.vertices, plain.state.body.vertices, 1e-9)


def condense(problem, state, iterate, forces, moved, drag=0.0):
    step = 0.5 * state.step or 1e-6
    equations = assemble_step(replace(problem, base_drag=drag), state, step)
    condensed = equations.snow.condense(iterate)
    net = condense_step(equations, iterate, forces)
    return condensed.root, condensed.missing, condensed.answer(moved), net.per_force


@pytest.mark.parametrize("number", range(len(SCENES)))
def test_condensed_snow_is_the_same(number, in_numpy):
    rng = np.random.default_rng([83, number])
    problem = build_problem(SCENES[number], densifies=bool(number % 4))
    states = follow(number)[1][:3]
    if problem.snow.element == "mixed" or not states:
        return
    state, drag = states[-1], 0.05 if number % 2 else 0.0
    stress = state.stress
    if stress is not None:
        stress = stress + 0.05 * rng.normal(size=stress.shape)
    iterate = SnowIterate(
        0.1 * rng.normal(size=state.velocity.size), stress, state.base_shear
    )
    forces = rng.normal(size=state.net_nodes.shape)
    moved = rng.normal(size=2 * state.body.topology.template.net.size)
    given = (problem, state, iterate, forces, moved, drag)
    root, missing, found, per_force = condense(*given)
    expected = in_numpy(condense, *given)
    assert_alike(root, expected[0], 1e-9)
    assert_alike(missing, expected[1], 1e-8)
    assert_alike(per_force, expected[3], 1e-7)
    assert_alike(found.stress, expected[2].stress, 1e-8)
    assert_alike(found.unknowns, expected[2].unknowns, 1e-8)
    assert_alike(found.imbalance, expected[2].imbalance, 1e-7)
    assert found.change == pytest.approx(expected[2].change, rel=1e-6)
    assert (found.base_shear is None) == (expected[2].base_shear is None)
    if found.base_shear is not None:
        assert_alike(found.base_shear, expected[2].base_shear, 1e-8)


def test_arrays_of_an_iterate_are_not_those_of_the_next():
    problem = build_problem(SCENES[0], densifies=True)
    state = follow(0)[1][2]
    equations = assemble_step(problem, state, 1e-4)
    iterate = SnowIterate(
        equations.hold(state.velocity), state.stress, state.base_shear
    )
    kept = [np.copy(one) for one in iterate[:2]]
    net = np.ones(2 * equations.template.net.size)
    one, two = (equations.snow.condense(iterate).answer(net) for _ in range(2))
    for before, after in zip(kept, iterate[:2], strict=True):
        np.testing.assert_array_equal(before, after)
    np.testing.assert_array_equal(one.stress, two.stress)


def draw_net(number):
    """Net and nodes that no snow would give: slack, loose, kinked, far from rest."""
    rng = np.random.default_rng([89, number])
    count, head = int(rng.integers(1, 14)), np.array([0.4, 1.0])
    part = np.sort(rng.uniform(0.02, 0.98, count))
    outward = np.array([head[1], -head[0]])
    bulge = rng.choice([0.02, 0.1, 0.3]) * 4.0 * part * (1.0 - part)
    place = np.outer(head, part) + np.outer(outward, bulge)
    place += rng.choice([0.0, 1e-3, 3e-2]) * rng.normal(size=place.shape)
    points = np.column_stack([np.zeros(2), place, head])
    strain = rng.choice([0.02, 0.0, -0.02]) + rng.choice([0.0, 0.01]) * rng.normal(
        size=count + 1
    )
    root = rng.normal(size=(2 * count, 2 * count)) / np.sqrt(2 * count)
    softness = rng.choice([1e-5, 1e-3, 1e-2])
    nodes = YieldingNodes(
        positions=place + softness * rng.normal(size=place.shape),
        forces=rng.choice([0.0, 1.0]) * np.ones_like(place),
        compliance=softness * (root @ root.T + 0.1 * np.eye(2 * count)),
    )
    guess = NetGuess.at_rest(place, rng.integers(-1, 2, count).astype(np.int8))
    lengths = np.hypot(*np.diff(points)) / (1.0 + strain)
    return nodes, guess, head, lengths, float(rng.choice([0.0, 0.1, 0.6, 1.2, 30.0]))


def settle(number):
    nodes, guess, head, lengths, friction = draw_net(number)
    try:
        return settle_net(
            nodes, guess, head, lengths, friction=friction, stiffness=300.0
        )
    except SolveError as failure:
        return failure.outcome, failure.reason


@pytest.mark.long
def test_a_net_on_yielding_nodes_is_the_same(in_numpy):
    found, failed = 0, set()
    for number in range(200):
        one, other = settle(number), in_numpy(settle, number)
        if not isinstance(other[1], NetGuess):
            assert one == other
            failed.add(other[0])
            continue
        size = max(np.abs(other[0].tensions).max(), 1e-3)
        np.testing.assert_allclose(one[0].forces, other[0].forces, atol=1e-7 * size)
        np.testing.assert_allclose(one[1].place, other[1].place, atol=1e-8)
        np.testing.assert_allclose(one[1].slides, other[1].slides, atol=1e-8)
        found += 1
    assert found > 100
    assert failed
