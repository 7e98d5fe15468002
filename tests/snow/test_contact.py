"""Letting go of a one-sided net or ground (N15). Stick and slip: test_flow.py."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.outcome import Outcome
from netdesign.snow.contact import (
    may_lift,
    net_components,
    start_contact,
    update_contact,
)
from netdesign.snow.flow import solve_flow
from netdesign.snow.flow_step import compute_residual


@pytest.fixture
def inclined(a_mesh):
    return a_mesh(inclination_deg=30.0, sag=0.08)


def solve(law, mesh):
    result = solve_flow(law, mesh, tolerance=1e-9, max_iterations=60)
    assert result.outcome is Outcome.CONVERGED
    return result.state


def upward(mesh):
    return 2 * mesh.template.ground[1:] + 1


def update(law, mesh, contact, *, velocity=(), reaction=()):
    """Update after given entries of velocity and reaction, zero elsewhere."""
    fields = np.zeros((2, mesh.n_dofs))
    for field, changes in zip(fields, (velocity, reaction), strict=True):
        for place, value in changes:
            field[place] = value
    return update_contact(law, mesh, contact, *fields)


@pytest.mark.parametrize("sides", ["one-sided", "two-sided"])
def test_what_would_pull_lets_go_if_it_may(inclined, a_flow_problem, sides):
    law = replace(a_flow_problem(), ground_contact=sides, net_contact=sides)
    normal, _ = net_components(inclined)
    pulls = [(upward(inclined)[4], -1.0), (normal[3], 1.0)]
    pushes = [(upward(inclined)[5], 1.0), (normal[4], -1.0)]
    contact = update(law, inclined, start_contact(inclined), reaction=[*pulls, *pushes])
    may = sides == "one-sided"
    assert np.flatnonzero(contact.is_lifted).tolist() == ([4] if may else [])
    assert np.flatnonzero(contact.is_open).tolist() == ([3] if may else [])


@pytest.mark.parametrize(("speed", "stays_apart"), [(1.0, True), (-1.0, False)])
def test_what_moves_back_is_held_again(inclined, a_flow_problem, speed, stays_apart):
    """Away from the support: upwards on the ground, against the normal on the net."""
    law = replace(a_flow_problem(), ground_contact="one-sided", net_contact="one-sided")
    start = start_contact(inclined)
    lifted, is_open = start.is_lifted.copy(), start.is_open.copy()
    lifted[4] = is_open[3] = True
    normal, _ = net_components(inclined)
    contact = update(
        law,
        inclined,
        replace(start, is_lifted=lifted, is_open=is_open),
        velocity=[(upward(inclined)[4], speed), (normal[3], -speed)],
    )
    assert contact.is_lifted[4] == stays_apart
    assert contact.is_open[3] == stays_apart
    assert contact.is_pressed[3] is np.False_


@pytest.mark.parametrize("kind", ["free", "sliding"])
def test_complementarity_on_the_ground(inclined, a_flow_problem, kind):
    """(N15) node by node, and equilibrium where the snow has lifted."""
    slip = 50.0 if kind == "sliding" else 0.0
    law = a_flow_problem(ground=kind, slip_ratio=slip, friction=0.05)
    two = solve(law, inclined)
    assert (two.reaction[upward(inclined)] < 0.0).any()  # the case means something
    one_sided = replace(law, ground_contact="one-sided")
    one = solve(one_sided, inclined)
    lifted = one.contact.is_lifted
    assert lifted.any()
    may = may_lift(inclined.template)
    push, rise = (field[upward(inclined)] for field in (one.reaction, one.unknowns))
    scale, speed = np.abs(push).max(), np.abs(one.unknowns).max()
    assert not lifted[~may].any()
    assert (push[~lifted & may] >= -1e-12 * scale).all()
    assert (rise[lifted] >= -1e-12 * speed).all()
    np.testing.assert_array_equal(rise[~lifted], 0.0)
    residual = compute_residual(one_sided, inclined, one)
    np.testing.assert_allclose(residual[upward(inclined)[lifted]], 0.0, atol=1e-8)


@pytest.mark.parametrize("friction", [0.0, 0.05])
def test_complementarity_on_the_net(inclined, a_flow_problem, friction):
    law = a_flow_problem(friction=friction)
    normal, tangential = net_components(inclined)
    assert (solve(law, inclined).reaction[normal] > 0.0).any()
    one = solve(replace(law, net_contact="one-sided"), inclined)
    is_open = one.contact.is_open
    assert is_open.any()
    assert not one.contact.is_pressed[is_open].any()
    pressure, outward = -one.reaction[normal], one.unknowns[normal]
    scale, speed = np.abs(pressure).max(), np.abs(one.unknowns).max()
    assert (pressure[~is_open] >= -1e-12 * scale).all()
    assert (outward[is_open] <= 1e-12 * speed).all()
    np.testing.assert_allclose(pressure[is_open], 0.0, atol=1e-8 * scale)
    np.testing.assert_allclose(one.reaction[tangential[is_open]], 0.0, atol=1e-10)


def test_contact_that_never_pulls_is_the_two_sided_one(inclined, a_flow_problem):
    """Snow that sticks to the net presses on it everywhere."""
    law = a_flow_problem(friction=10.0)
    two, one = (
        solve(replace(law, net_contact=sides), inclined)
        for sides in ("two-sided", "one-sided")
    )
    assert not one.contact.is_open.any()
    np.testing.assert_allclose(one.stress, two.stress, atol=1e-12)
