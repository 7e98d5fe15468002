"""Steps of the compiled core against those in NumPy, on drawn untidy states."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.core.library import find_core
from netdesign.snow import flow, flow_step
from netdesign.snow.contact import net_components
from netdesign.snow.flow import solve_flow
from netdesign.snow.flow_step import (
    compute_residual,
    linearise_reaction,
    remove_rounding,
)
from tests.core.drawn import CLOSE, NUMBERS, assert_alike, draw_case

pytestmark = pytest.mark.skipif(find_core() is None, reason="no compiled core here")


def step(problem, mesh, state):
    """A state after a Newton's step, the error that it leaves, and what follows."""
    one = solve_flow(problem, mesh, state, tolerance=1e9, max_iterations=1)
    two = solve_flow(problem, mesh, state, tolerance=1e-99, max_iterations=2)
    return one.state, one.change, two.state.contact


@pytest.mark.parametrize("number", NUMBERS)
def test_a_step_is_that_of_numpy(number, in_numpy):
    problem, mesh, state = draw_case(number)
    found, left, wanted = step(problem, mesh, state)
    expected, known, follows = in_numpy(step, problem, mesh, state)
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


@pytest.mark.parametrize("number", NUMBERS[:12])
def test_a_correction_is_that_of_numpy(number, in_numpy):
    problem, mesh, state = draw_case(number)
    assert_alike(
        remove_rounding(problem, mesh, state).stress,
        in_numpy(remove_rounding, problem, mesh, state).stress,
        1e-8,
    )


@pytest.mark.parametrize("number", NUMBERS[:12])
def test_the_derivative_of_a_round_is_that_of_numpy(number, in_numpy):
    problem, mesh, state = draw_case(number)
    assert_alike(
        linearise_reaction(problem, mesh, state),
        in_numpy(linearise_reaction, problem, mesh, state),
        1e-8,
    )


def take_back(problem, mesh, state):
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
    return solve_flow(problem, mesh, start, tolerance=1e-99, max_iterations=4).state


@pytest.mark.parametrize("number", NUMBERS[:12])
@pytest.mark.parametrize("patience", [0, 1])
def test_changes_that_are_taken_back_are_those_of_numpy(
    number, patience, in_numpy, monkeypatch
):
    """Half of each row of changes at step ``patience``, later one at a time."""
    monkeypatch.setattr(flow, "_PATIENCE", patience)
    case = draw_case(number)
    found, expected = take_back(*case), in_numpy(take_back, *case)
    assert_alike(found.reaction, expected.reaction, 1e-7)
    for name in ("sign", "is_open", "is_lifted"):
        one, other = getattr(found.contact, name), getattr(expected.contact, name)
        np.testing.assert_array_equal(one, other)


def solve(problem, mesh, state):
    return solve_flow(problem, mesh, state, tolerance=0.1)


def test_a_mesh_that_is_too_large_for_the_core_is_solved_in_numpy(
    in_numpy, monkeypatch
):
    case = draw_case(0)
    expected = in_numpy(solve, *case)
    monkeypatch.setattr(flow_step, "prepare_flow", lambda *_: None)
    np.testing.assert_array_equal(solve(*case).state.stress, expected.state.stress)
