"""Steps of the compiled core against those in NumPy, on drawn untidy states."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.core.library import find_core
from netdesign.coupling.steady import compiled
from netdesign.snow import flow
from netdesign.snow.contact import net_components
from netdesign.snow.flow import solve_flow
from netdesign.snow.flow_step import compute_residual, condense_to_net
from tests.core.drawn import CLOSE, NUMBERS, FlowInCore, assert_alike, draw_case
from tests.each import each

pytestmark = pytest.mark.skipif(find_core() is None, reason="no compiled core here")


def step(take, problem, mesh, state):
    """A state after a Newton's step, the error that it leaves, and what follows."""
    one = take(problem, mesh, state, tolerance=1e9, max_iterations=1)
    two = take(problem, mesh, state, tolerance=1e-99, max_iterations=2)
    return one.state, one.change, two.state.contact


@each("number", NUMBERS)
def test_a_step_is_that_of_numpy(number):
    problem, mesh, state = draw_case(number)
    found, left, wanted = step(FlowInCore, problem, mesh, state)
    expected, known, follows = step(solve_flow, problem, mesh, state)
    # what a step in NumPy leaves out of balance is what either may be off by
    unbalanced = np.abs(expected.reaction - compute_residual(problem, mesh, expected))
    slack = max(CLOSE, 100 * unbalanced.max() / np.abs(expected.reaction).max())
    assert slack < 1e-6
    assert_alike(found.stress, expected.stress, slack)
    assert_alike(found.reaction, expected.reaction, slack)
    assert_alike(found.unknowns, expected.unknowns, slack)
    if state.base_shear is not None:
        assert_alike(found.base_shear, expected.base_shear, slack)
    assert left == pytest.approx(known, rel=1e-6)
    # where nothing presses, rounding decides on which side of 0 the pressure is
    pressure = expected.reaction[net_components(mesh)[0]]
    told = np.abs(pressure) > 1e3 * slack * np.abs(expected.reaction).max()
    for name in ("sign", "is_pressed", "is_open"):
        one, other = getattr(wanted, name), getattr(follows, name)
        np.testing.assert_array_equal(one[told], other[told])
    np.testing.assert_array_equal(wanted.is_lifted, follows.is_lifted)


@each("number", NUMBERS[:12])
def test_the_derivative_of_a_round_is_that_of_numpy(number):
    problem, mesh, state = draw_case(number)
    found = FlowInCore(problem, mesh, state, tolerance=1e9, max_iterations=1)
    assert_alike(found.root, condense_to_net(problem, mesh, found.state), 1e-8)


def take_back(take, problem, mesh, state):
    """State after steps of which only some changes of contact are taken."""
    problem = replace(
        problem, friction=0.2, net_contact="two-sided", ground_contact="one-sided"
    )
    # all press: where nothing does, rounding decides
    held = replace(
        state.contact,
        is_open=np.zeros_like(state.contact.is_open),
        is_pressed=np.ones_like(state.contact.is_pressed),
    )
    start = replace(state, contact=held)
    return take(problem, mesh, start, tolerance=1e-99, max_iterations=4).state


@pytest.mark.parametrize("number", NUMBERS[:12])
@pytest.mark.parametrize("patience", [0, 1])
def test_changes_that_are_taken_back_are_those_of_numpy(number, patience, monkeypatch):
    """Half of each row of changes at step ``patience``, later one at a time."""
    monkeypatch.setattr(flow, "PATIENCE", patience)
    monkeypatch.setattr(compiled, "PATIENCE", patience)
    case = draw_case(number)
    found, expected = take_back(FlowInCore, *case), take_back(solve_flow, *case)
    assert_alike(found.reaction, expected.reaction, 1e-7)
    for name in ("sign", "is_open", "is_lifted"):
        one, other = getattr(found.contact, name), getattr(expected.contact, name)
        np.testing.assert_array_equal(one, other)
