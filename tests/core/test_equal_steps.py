"""Steps of the compiled core against those in NumPy, on drawn untidy states."""

import numpy as np
import pytest

from netdesign.core.library import find_core
from netdesign.snow.contact import (
    net_components,
    update_contact,
)
from netdesign.snow.flow import _estimate_left, sample_material
from netdesign.snow.flow_step import (
    compile_flow,
    compute_residual,
    linearise_reaction,
    remove_rounding,
    take_step,
)
from tests.core.drawn import CLOSE, NUMBERS, compare, draw_case

pytestmark = pytest.mark.skipif(find_core() is None, reason="no compiled core here")


def step(problem, mesh, state):
    """Newton's step from a state, the error that it leaves, and what follows."""
    core = compile_flow(problem, mesh)
    material = sample_material(problem, mesh.template)
    contact = state.contact
    taken = take_step(core, None, problem, material, mesh, state, contact)
    assert (taken.wanted is None) == (core is None)
    left = _estimate_left(problem, material, mesh, state, taken, 1e9)
    after = taken.state
    wanted = taken.wanted or update_contact(
        problem, mesh, contact, after.unknowns, after.reaction
    )
    return after, left, wanted


@pytest.mark.parametrize("number", NUMBERS)
def test_a_step_is_that_of_numpy(number, in_numpy):
    problem, mesh, state = draw_case(number)
    found, left, wanted = step(problem, mesh, state)
    expected, known, follows = in_numpy(step, problem, mesh, state)
    # what a step in NumPy leaves out of balance is what either may be off by
    unbalanced = np.abs(expected.reaction - compute_residual(problem, mesh, expected))
    slack = max(CLOSE, 100 * unbalanced.max() / np.abs(expected.reaction).max())
    assert slack < 1e-6
    compare(found.stress, expected.stress, slack)
    compare(found.reaction, expected.reaction, slack)
    compare(found.unknowns, expected.unknowns, slack)
    if state.base_shear is not None:
        compare(found.base_shear, expected.base_shear, slack)
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
    compare(
        remove_rounding(problem, mesh, state).stress,
        in_numpy(remove_rounding, problem, mesh, state).stress,
        1e-8,
    )


@pytest.mark.parametrize("number", NUMBERS[:12])
def test_the_derivative_of_a_round_is_that_of_numpy(number, in_numpy):
    problem, mesh, state = draw_case(number)
    compare(
        linearise_reaction(problem, mesh, state),
        in_numpy(linearise_reaction, problem, mesh, state),
        1e-8,
    )
