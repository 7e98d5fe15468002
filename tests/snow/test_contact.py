"""Letting go of a one-sided net or ground (N15). Stick and slip: test_flow.py."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.outcome import Outcome
from netdesign.snow.contact import may_lift, net_components
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
