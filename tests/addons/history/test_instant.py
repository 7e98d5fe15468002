"""One step of snow that pushes the net: balance, friction, order of the stepping."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from netdesign.addons.evidence.verification.closed_forms import slide_on
from netdesign.addons.history.instant import advance, advance_under
from netdesign.addons.history.net_pulls import (
    compute_node_forces,
    hold_net,
    join_points,
)
from netdesign.addons.history.settings import TRANSIENT_LEVELS, TransientSettings
from netdesign.addons.history.state import build_problem
from netdesign.addons.history.transient import run_history
from netdesign.outcome import SolveError
from tests.addons.history.starts import begin
from tests.each import each

STEP = 1e-4
CUT = 0.25  # of a step that does not converge, as in a history
TIGHT = {"tolerance": 1e-8, "balance_tolerance": 1e-10, "max_iterations": 30}


def pass_on(state, instant, step):
    """State after the step on its own vertices: no mending, so time alone counts."""
    return replace(
        state,
        time=state.time + step,
        body=replace(state.body, vertices=instant.displaced),
        lengths=instant.response.lengths,
        slide_signs=instant.response.slide_signs,
        top=instant.top,
        velocity=instant.velocity,
        moved=instant.displaced - state.body.vertices,
        step=step,
        stress=instant.stress,
        base_shear=instant.base_shear,
    )


def advance_cut(problem, state, step, **given):
    """A step, cut while it does not converge, and its length."""
    for _ in range(4):
        try:
            return advance(problem, state, step, **given, **TIGHT), step
        except SolveError:
            step *= CUT
    return advance(problem, state, step, **given, **TIGHT), step


def two_steps(scene):
    """Second step of a sagged net, BDF2, and the state that it began from."""
    problem, state = begin(scene)
    first, step = advance_cut(problem, state, STEP)
    state = pass_on(state, first, step)
    return problem, state, advance_cut(problem, state, 1.5 * step)[0]


# --- balance -----------------------------------------------------------------


@each("inclination", [0.0, 30.0])
@each("friction", [0.0, 5.0, 30.0])
def test_free_base_hangs_its_weight_on_the_net(a_scene, inclination, friction):
    """Pulls along X are the mass times sin psi, whatever phi is."""
    scene = a_scene(inclination_deg=inclination, friction_deg=friction)
    _, state, instant = two_steps(scene)
    weight = state.body.mass.sum() * math.sin(math.radians(40.0))
    pulled = instant.foot_pull[0] + instant.head_pull[0]
    assert pulled == pytest.approx(weight, rel=1e-8)
    assert instant.residual < 1e-9


@pytest.mark.parametrize("friction", [0.0, 5.0, 30.0])
def test_net_forces_are_those_at_the_steps_end(a_scene, friction):
    """Within the friction limit, from the lengths of the step's start."""
    problem, state, instant = two_steps(a_scene(friction_deg=friction))
    nodes = instant.displaced[:, state.carried]
    np.testing.assert_allclose(instant.points[:, 1:-1], nodes, atol=1e-12)
    again = slide_on(
        instant.points, state.lengths, problem.snow.friction, problem.stiffness
    )
    np.testing.assert_allclose(again.forces, instant.response.forces, atol=2e-9)
    tensions = again.tensions
    normal, tangential = compute_node_forces(instant.points, tensions)
    limit = problem.snow.friction * np.maximum(normal, 0.0)
    assert (np.abs(tangential) - limit).max() < 1e-9


# --- order -------------------------------------------------------------------


SPAN = 0.04  # of creep time, from 0.02 on: the net has come to rest


@cache
def rested(friction, build):
    """State of a sagged net at rest, to be started from as if it were the first."""
    states = []
    scene = build(friction_deg=friction)
    run_history(
        scene,
        TRANSIENT_LEVELS[0],
        TransientSettings(),
        0.02,
        on_state=states.append,
    )
    problem = build_problem(scene, densifies=True)
    return problem, replace(states[-1], step=0.0)


def pulls_after(problem, state, steps):
    for step in steps:
        instant = advance(problem, state, step, **TIGHT)
        state = pass_on(state, instant, step)
    assert state.time == pytest.approx(0.02 + SPAN, rel=1e-9)
    return np.concatenate([instant.foot_pull, instant.head_pull])


@pytest.mark.parametrize("friction", [0.0, 30.0])
@pytest.mark.parametrize("parts", [(1.0,), (2 / 3, 4 / 3)], ids=["even", "uneven"])
def test_stepping_is_of_second_order(a_scene, friction, parts):
    """Differences of halved steps fall by 4; no slip sets in on this stretch."""
    problem, state = rested(friction, a_scene)
    pulls = [
        pulls_after(problem, state, np.resize(parts, count) * (SPAN / count))
        for count in (8, 16, 32, 64)
    ]
    differences = np.hypot(*np.diff(pulls, axis=0).T.reshape(2, -1)).reshape(2, -1)
    sizes = np.hypot(*differences)
    orders = np.log2(sizes[:-1] / sizes[1:])
    np.testing.assert_allclose(orders, 2.0, atol=0.25)
    assert sizes[-1] < 2e-4 * np.abs(pulls[-1]).max()


# --- under given forces ------------------------------------------------------


def held(problem, state):
    """The net at the step's start, its forces as they are."""
    points = join_points(state.net_nodes, problem.head)
    return hold_net(points, state.lengths, stiffness=problem.stiffness)


EXCHANGE = {"tolerance": 1e-10, "max_iterations": 40}


def test_given_forces_and_base_drag_are_in_balance(a_scene):
    """Drag times the glide takes what the given forces leave of the weight."""
    drag = 0.05
    problem, state = begin(a_scene(), base_drag=drag)
    net = held(problem, state)
    instant = advance_under(problem, state, 1e-5, net, **EXCHANGE)
    assert instant.residual < 1e-9
    np.testing.assert_array_equal(instant.response.forces, net.forces)
    template = state.body.topology.template
    nodes = template.ground
    x, glide = -template.nodes[0, nodes], instant.velocity[0, nodes]
    # Simpson along the ground: v is quadratic on its edges
    lengths = np.abs(x[2::2] - x[:-2:2])
    middle = glide[:-2:2] + 4.0 * glide[1::2] + glide[2::2]
    dragged = drag * (lengths * middle).sum() / 6.0
    weight = state.body.mass.sum() * math.sin(math.radians(40.0))
    pulled = instant.foot_pull[0] + instant.head_pull[0]
    assert pulled + dragged == pytest.approx(weight, rel=1e-9)
