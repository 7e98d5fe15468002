"""Rounds of flow and net in one call of the core against their steps one by one."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.cable.net import Net
from netdesign.core.library import find_core
from netdesign.coupling.interface import find_support_forces, share_net_forces
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady import compiled
from netdesign.coupling.steady.compiled import prepare_rounds
from netdesign.coupling.steady.net import (
    SteadyProblem,
    find_contact_curve,
    hang_net,
    start_net,
)
from netdesign.coupling.steady.round import flow_along, place_along
from netdesign.evidence.benchmark.scenes import build_tables, draw_scene
from netdesign.outcome import ModelError, SolveError
from netdesign.snow import compiled_mesh
from netdesign.snow.shared_mesh import share_template

pytestmark = pytest.mark.skipif(find_core() is None, reason="no compiled core here")

SETTINGS = SolverSettings()
TOLERANCE, STILL = 1e-5, 1e9  # any net is settled
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


def play(problem, state, net, curve):
    """A round by the core and step by step; what failed is None."""
    core = prepare_rounds(problem, 40)
    found = core.take(curve, state, net, TOLERANCE, STILL)
    try:
        mesh = place_along(problem, curve)
        flow = flow_along(problem, mesh, state, SETTINGS, TOLERANCE)
        on_net = share_net_forces(problem.snow, mesh, flow.state.reaction)
        hung = hang_net(problem, net, on_net)
    except SolveError:
        return found, None
    return found, (mesh, flow, hung)


def assert_alike(one, other):
    size = np.abs(other).max()
    np.testing.assert_allclose(one, other, rtol=0.0, atol=CLOSE * max(size, 1e-300))


@pytest.mark.parametrize("number", range(len(PROBLEMS)))
def test_a_round_is_the_same_in_one_call(number):
    problem = PROBLEMS[number]
    state, net = None, start_net(problem)
    for _ in range(2):  # from nothing, then from the round before
        curve = find_contact_curve(problem, net)
        found, steps = play(problem, state, net, curve)
        assert steps is not None or found is None  # the core finds nothing of its own
        if found is None:  # then the steps are taken
            return
        mesh, flow, hung = steps
        for name in ("nodes", "weights", "gradients", "load", "net_normal", "axes"):
            assert_alike(getattr(found.mesh, name), getattr(mesh, name))
        if amplifies_rounding(problem):
            return
        assert found.linear_solves == flow.linear_solves
        assert_alike(found.state.stress, flow.state.stress)
        assert_alike(found.state.reaction, flow.state.reaction)
        for name in ("sign", "is_pressed", "is_open", "is_lifted"):
            one, other = (getattr(f.state.contact, name) for f in (found, flow))
            np.testing.assert_array_equal(one, other)
        for name in ("forces", "lengths", "parts"):
            assert_alike(getattr(found.net, name), getattr(hung, name))
        for name in ("curve", "tension", "foot_pull", "head_pull"):
            assert_alike(getattr(found.net.cable, name), getattr(hung.cable, name))
        state, net = flow.state, hung


@pytest.mark.parametrize("number", range(len(PROBLEMS)))
def test_forces_of_the_stresses_are_the_same_in_one_call(number, monkeypatch):
    problem = PROBLEMS[number]
    net = start_net(problem)
    found, steps = play(problem, None, net, find_contact_curve(problem, net))
    if found is None or amplifies_rounding(problem):
        return
    monkeypatch.setattr("netdesign.coupling.interface._ROUNDING", 1e9)  # none removed
    mesh, flow, hung = steps
    _, expected = find_support_forces(problem.snow, mesh, flow.state)
    forces, settled = found.from_stresses
    assert_alike(forces.on_net, expected.on_net)
    assert_alike(forces.on_ground, expected.on_ground)
    assert_alike(forces.ground_normal, expected.ground_normal)
    size = np.abs(expected.on_net).max()
    assert forces.unbalanced == pytest.approx(expected.unbalanced, abs=1e-9 * size)
    assert_alike(
        settled.cable.curve, hang_net(problem, hung, expected.on_net).cable.curve
    )


@pytest.mark.parametrize("number", range(0, len(PROBLEMS), 4))
def test_a_round_goes_on_from_results_as_from_what_they_say(number):
    problem = PROBLEMS[number]
    net = start_net(problem)
    curve = find_contact_curve(problem, net)
    core, other = prepare_rounds(problem, 40), prepare_rounds(replace(problem), 40)
    before = core.take(curve, None, net, 1e-3, STILL)
    if before is None:
        return
    assert before.moved == np.abs(before.image - curve).max()
    kept = before.state.stress.copy()
    found = [
        one.take(before.image, before.state, before.net, TOLERANCE, STILL)
        for one in (core, other)
    ]
    np.testing.assert_array_equal(before.state.stress, kept)
    assert len({one is None for one in found}) == 1
    if found[0] is not None:
        for one in found[1:]:
            np.testing.assert_array_equal(one.net.forces, found[0].net.forces)
            np.testing.assert_array_equal(one.state.stress, found[0].state.stress)


def test_a_net_that_moves_is_not_settled():
    problem = PROBLEMS[0]
    net = start_net(problem)
    curve = find_contact_curve(problem, net)
    found = prepare_rounds(problem, 40).take(curve, None, net, TOLERANCE, 1e-12)
    assert found.from_stresses is None


def test_a_curve_in_the_ground_is_none():
    problem = PROBLEMS[0]
    net = start_net(problem)
    curve = find_contact_curve(problem, net).copy()
    curve[1, 3] = -1e-3
    core = prepare_rounds(problem, 40)
    assert core.take(curve, None, net, TOLERANCE, STILL) is None


def test_what_the_core_does_not_take_is_left_to_numpy(monkeypatch):
    problem = PROBLEMS[0]
    mixed = replace(problem, snow=replace(problem.snow, element="mixed"))
    assert prepare_rounds(mixed, 40) is None
    compiled._describe_form.__wrapped__.cache_clear()
    monkeypatch.setattr(compiled, "describe_template", lambda *_: None)
    assert prepare_rounds(replace(problem), 40) is None  # a template too large for it
    compiled._describe_form.__wrapped__.cache_clear()


def test_what_the_core_reads_of_a_template_stays_with_its_form():
    """Numbers have caches of their own, which may forget them before."""
    problem = PROBLEMS[0]
    compiled._describe_form.__wrapped__.cache_clear()
    compiled_mesh.number_template.__wrapped__.cache_clear()
    compiled_mesh._locate_template.__wrapped__.cache_clear()
    rounds = prepare_rounds(replace(problem), 40)
    kept = {one.__array_interface__["data"][0] for one in rounds.kept}
    place = rounds.argument.place
    assert {place.triangles, place.net, place.orientation} <= kept
    assert {rounds.argument.mesh.triangles, rounds.argument.plan} <= kept
