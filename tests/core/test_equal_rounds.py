"""Rounds of flow and net in one call of the core against their steps one by one."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.evidence.benchmark.scenes import build_tables, draw_scene
from netdesign.cable.net import Net
from netdesign.core.library import find_core
from netdesign.coupling.interface import find_support_forces
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady import compiled
from netdesign.coupling.steady.compiled import prepare_rounds
from netdesign.coupling.steady.net import (
    SteadyProblem,
    cut_net,
    find_contact_curve,
    hang_net,
    start_net,
)
from netdesign.coupling.steady.round import OffMeshError, take_round
from netdesign.outcome import ModelError, SolveError
from netdesign.snow.element import share_template
from tests.each import each

pytestmark = pytest.mark.skipif(find_core() is None, reason="no compiled core here")

SETTINGS = SolverSettings()
TOLERANCE, STILL = 1e-8, 1e9  # any net is settled
CLOSE = 1e-9
MOST_CONTRAST = 100.0


def draw_problems(count):
    """Problems of drawn nets on the coarsest mesh, which the core takes."""
    problems, number = [], 0
    while len(problems) < count:
        number += 1
        try:
            scene = build_tables(draw_scene(31, number))
        except ModelError:
            continue
        if not isinstance(scene.net, Net):
            continue
        net, thickness = scene.net, scene.snowpack.thickness
        size = SETTINGS.levels[0]
        problem = SteadyProblem(
            snow=scene.steady_flow_problem,
            template=share_template(scene.modelled_aspect, size, scene.layer_tops),
            head=net.head / thickness,
            length=net.unstressed_length / thickness,
            slack=net.slack,
            stiffness=net.stiffness_per_m / scene.force_scale,
        )
        if problem.snow.element == "velocity":
            problems.append(problem)
    return problems


PROBLEMS = draw_problems(40)


def test_the_drawn_nets_are_of_every_kind():
    snows = [one.snow for one in PROBLEMS]
    assert {one.ground for one in snows} == {"free", "sliding", "no-slip"}
    assert {len(one.layers) > 1 for one in snows} == {True, False}
    assert {one.has_freeboard for one in PROBLEMS} == {True, False}
    assert {one.ground_contact for one in snows} == {"one-sided", "two-sided"}
    assert {one.end_load > 0.0 for one in snows} == {True, False}
    tame = [one for one in PROBLEMS if not amplifies_rounding(one)]
    assert len(tame) > 0.7 * len(PROBLEMS)
    assert sum(len(one.snow.layers) > 1 for one in tame) > 3


def amplifies_rounding(problem):
    """Layers that creep at most unlike rates: the last digit decides on contacts."""
    rates = [layer.fluidity_ratio for layer in problem.snow.layers]
    return max(rates) > MOST_CONTRAST * min(rates)


def begin(problem, still=STILL):
    """The core, and a net to begin with."""
    return prepare_rounds(problem, SETTINGS, still), start_net(problem)


def try_to(take, *given):
    """Result, or the outcome and the reason of a failure."""
    try:
        return take(*given)
    except SolveError as failure:
        return failure.outcome, failure.reason


def play(problem, core, state, net):
    """A round along a net by the core and step by step; None where both fail alike."""
    curve = find_contact_curve(problem, net)
    found = try_to(core.take, curve, state, net, TOLERANCE)
    steps = try_to(take_round, problem, SETTINGS, curve, state, net, TOLERANCE)
    if isinstance(found, tuple) or isinstance(steps, tuple):
        assert found == steps
        return None
    return found, steps


def assert_alike(one, other):
    size = np.abs(other).max()
    np.testing.assert_allclose(one, other, rtol=0.0, atol=CLOSE * max(size, 1e-300))


@each("number", range(len(PROBLEMS)))
def test_a_round_is_the_same_in_one_call(number):
    problem = PROBLEMS[number]
    core, net = begin(problem)
    state = None
    for _ in range(2):  # from nothing, then from the round before
        both = play(problem, core, state, net)
        if both is None:
            return
        found, steps = both
        for name in ("nodes", "weights", "gradients", "load", "net_normal", "axes"):
            assert_alike(getattr(found.mesh, name), getattr(steps.mesh, name))
        np.testing.assert_array_equal(found.mesh.dofs, steps.mesh.dofs)
        if amplifies_rounding(problem):
            return
        assert found.linear_solves == steps.linear_solves
        assert_alike(found.state.stress, steps.state.stress)
        assert_alike(found.state.reaction, steps.state.reaction)
        for name in ("sign", "is_pressed", "is_open", "is_lifted"):
            one, other = (getattr(f.state.contact, name) for f in (found, steps))
            np.testing.assert_array_equal(one, other)
        assert_same_net(found.net, steps.net)
        state, net = steps.state, steps.net


def assert_same_net(found, expected):
    for name in ("forces", "lengths", "parts"):
        assert_alike(getattr(found, name), getattr(expected, name))
    for name in ("curve", "tension", "foot_pull", "head_pull"):
        assert_alike(getattr(found.cable, name), getattr(expected.cable, name))


def draw_net(number):
    """Forces on a net, some of which nothing holds, and a start far from any end."""
    rng = np.random.default_rng([31, number])
    problem = PROBLEMS[number % len(PROBLEMS)]
    longer = rng.choice([1.0, 1.5])  # long and pushed down, some parts cannot rise
    problem = replace(problem, length=longer * problem.length)
    count = problem.template.net.size
    down = rng.choice([-0.2, -20.0])
    forces = rng.normal([[1.0], [down]], 0.3, (2, count)) / count
    if number % 7 == 0:
        forces[0, 1] = rng.choice([np.nan, np.inf])
    rises = cut_net(problem.template, float(problem.head[1])).rises
    pull = rng.normal([0.0, -down], 0.4)
    return problem, forces, pull, rises * problem.length / rises.sum()


def test_a_net_is_the_same_in_one_call():
    found, lost = 0, set()
    for number in range(5 * len(PROBLEMS)):
        problem, *drawn = draw_net(number)
        core, _ = begin(problem)
        hung = try_to(core.hang, *drawn)
        with np.errstate(invalid="ignore", over="ignore"):
            expected = try_to(hang_net, problem, *drawn)
        if isinstance(expected, tuple):
            assert hung == expected
            lost.add(expected[1])
            continue
        assert_same_net(hung, expected)
        found += 1
    assert found > 2 * len(PROBLEMS)
    assert len(lost) == 2  # no equilibrium, and none in which every part rises


@pytest.mark.long
@pytest.mark.parametrize("number", range(len(PROBLEMS)))
def test_forces_of_the_stresses_are_the_same_in_one_call(number, monkeypatch):
    problem = PROBLEMS[number]
    core, net = begin(problem)
    both = play(problem, core, None, net)
    if both is None or amplifies_rounding(problem):
        return
    monkeypatch.setattr("netdesign.coupling.interface._ROUNDING", 1e9)  # none removed
    found, steps = both
    _, expected = find_support_forces(problem.snow, steps.mesh, steps.state)
    forces, settled = found.from_stresses
    assert_alike(forces.on_net, expected.on_net)
    assert_alike(forces.on_ground, expected.on_ground)
    assert_alike(forces.ground_normal, expected.ground_normal)
    size = np.abs(expected.on_net).max()
    assert forces.unbalanced == pytest.approx(expected.unbalanced, abs=1e-9 * size)
    hung = hang_net(problem, expected.on_net, steps.net.cable.pull, steps.net.parts)
    assert_alike(settled.cable.curve, hung.cable.curve)


@each("number", range(0, len(PROBLEMS), 4))
def test_a_round_goes_on_from_results_as_from_what_they_say(number):
    problem = PROBLEMS[number]
    core, net = begin(problem)
    other, _ = begin(replace(problem))
    curve = find_contact_curve(problem, net)
    before = try_to(core.take, curve, None, net, 1e-3)
    if isinstance(before, tuple):
        return
    assert before.moved == np.abs(before.image - curve).max()
    kept = before.state.stress.copy()
    one, two = (
        try_to(each.take, before.image, before.state, before.net, TOLERANCE)
        for each in (core, other)
    )
    np.testing.assert_array_equal(before.state.stress, kept)
    if isinstance(one, tuple):
        assert one == two
        return
    np.testing.assert_array_equal(one.net.forces, two.net.forces)
    np.testing.assert_array_equal(one.state.stress, two.state.stress)


def test_a_net_that_moves_is_not_settled():
    core, net = begin(PROBLEMS[0], still=1e-12)
    curve = find_contact_curve(PROBLEMS[0], net)
    assert core.take(curve, None, net, TOLERANCE).from_stresses is None


@pytest.mark.parametrize(
    ("axis", "moved", "told"), [(1, -1e-3, "touch the ground"), (0, -20.0, "bulges")]
)
def test_a_curve_in_the_ground_or_folded_over_has_no_mesh(axis, moved, told):
    core, net = begin(PROBLEMS[0])
    curve = find_contact_curve(PROBLEMS[0], net).copy()
    curve[axis, 3] = moved + (0.0 if axis else curve[0, 3])
    with pytest.raises(OffMeshError, match=told):
        core.take(curve, None, net, TOLERANCE)


def test_what_the_core_does_not_take_is_left_to_numpy(monkeypatch):
    problem = PROBLEMS[0]
    mixed = replace(problem, snow=replace(problem.snow, element="mixed"))
    assert begin(mixed)[0] is None
    compiled._describe_form.__wrapped__.cache_clear()
    monkeypatch.setattr(compiled, "describe_template", lambda *_: None)
    assert begin(replace(problem))[0] is None  # a template too large for it
    compiled._describe_form.__wrapped__.cache_clear()


def test_what_the_core_reads_of_a_template_stays_with_its_form():
    """What is found of a template has its own cache, which may forget it before."""
    problem = PROBLEMS[0]
    compiled._describe_form.__wrapped__.cache_clear()
    compiled.describe_template.__wrapped__.cache_clear()
    rounds, _ = begin(replace(problem))
    kept = {one.__array_interface__["data"][0] for one in rounds.kept}
    place = rounds.argument.place
    assert {place.triangles, place.net, place.orientation} <= kept
    assert {rounds.argument.mesh.triangles, rounds.argument.plan} <= kept
