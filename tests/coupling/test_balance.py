"""Balances: measured on faulty states, refused at their bounds."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.cable.funicular import Funicular
from netdesign.coupling.balance import check_balance, measure_balance, negative_share
from netdesign.coupling.interface import SupportForces
from netdesign.coupling.solution import Balance
from netdesign.outcome import Outcome, SolveError
from tests.each import each

TOLERANCE = 1e-8

SOUND = Balance(
    weight_along_slope=1e5,
    relative_residual=TOLERANCE,
    friction_excess=TOLERANCE,
    smallest_tension=1e-9,
    suction_share=0.0,
    ground_tension_share=0.0,
)


REFUSED = [
    ("relative_residual", math.nextafter(TOLERANCE, 1.0), "force missing"),
    ("relative_residual", math.nan, "force missing"),
    ("relative_residual", math.inf, "force missing"),
    ("friction_excess", math.nextafter(TOLERANCE, 1.0), "shear beyond the friction"),
    ("friction_excess", math.nan, "shear beyond the friction"),
    ("smallest_tension", 0.0, "would have to push"),
    ("smallest_tension", -1.0, "would have to push"),
    ("smallest_tension", math.nan, "would have to push"),
]


@each("field, value, reason", REFUSED)
def test_breaches_are_refused(field, value, reason):
    with pytest.raises(SolveError, match=reason) as raised:
        check_balance(replace(SOUND, **{field: value}), TOLERANCE)
    assert raised.value.outcome is Outcome.BALANCE_VIOLATED


# --- a state in balance by hand ----------------------------------------------

SCALE = 2e4


@pytest.fixture
def state(a_mesh, a_flow_problem):
    """Weight carried by the ground along Y and by the net along X, half at each end."""
    mesh, law = a_mesh(), a_flow_problem(friction=0.5)
    weight = mesh.area * np.array(law.gravity)
    on_net = np.zeros((2, mesh.template.net.size))
    on_net[0, 1:] = weight[0] / (on_net.shape[1] - 1)
    half = np.array([weight[0] / 2, 0.0])
    cable = Funicular(
        outcome=Outcome.CONVERGED,
        curve=mesh.nodes[:, mesh.template.net],
        pull=half,
        tension=np.full((2, mesh.template.net.size // 2), 0.7),
        foot_pull=half,
        head_pull=half,
    )
    forces = SupportForces(
        on_net=on_net,
        on_ground=np.array([0.0, weight[1]]),
        ground_normal=np.full(4, -weight[1] / 4),
        unbalanced=0.0,
    )
    return law, mesh, forces, cable


def measure(state, friction=0.5, **changes):
    law, mesh, forces, cable = state
    held = cable.foot_pull + cable.head_pull
    law, changed = replace(law, friction=friction), replace(forces, **changes)
    return measure_balance(law, mesh, changed, held, cable.tension, SCALE)


def test_state_in_balance(state):
    law, mesh, _, _ = state
    balance = measure(state)
    assert balance.relative_residual <= 1e-15
    assert balance.friction_excess == 0.0
    assert balance.smallest_tension == pytest.approx(0.7 * SCALE, rel=1e-15)
    weight = mesh.area * law.gravity[0] * SCALE
    assert balance.weight_along_slope == pytest.approx(weight, rel=1e-15)
    assert (balance.suction_share, balance.ground_tension_share) == (0.0, 0.0)


@pytest.mark.parametrize("axis", [0, 1])
def test_force_missing_along_either_axis(state, axis):
    _, mesh, forces, _ = state
    on_ground = forces.on_ground.copy()
    on_ground[axis] += 1e-3 * mesh.area  # gravity is 1: a thousandth of the weight
    found = measure(state, on_ground=on_ground).relative_residual
    assert found == pytest.approx(1e-3, rel=1e-9)


def test_force_left_on_a_free_node(state):
    _, mesh, _, _ = state
    found = measure(state, unbalanced=1e-5 * mesh.area).relative_residual
    assert found == pytest.approx(1e-5, rel=1e-12)


def test_shear_beyond_friction(state):
    """A straight upright net: normal along X, shear along Y."""
    _, mesh, forces, _ = state
    pressure = forces.on_net[0, 3]
    for normal, shear, excess in (
        (pressure, 0.5 * pressure + 2e-4 * mesh.area, 2e-4),
        (pressure, 0.5 * pressure, 0.0),
        (-1e-3, -1e-4, 1e-4 / mesh.area),  # friction is no adhesion
    ):
        on_net = forces.on_net.copy()
        on_net[:, 3] = normal, shear
        found = measure(state, on_net=on_net)
        assert found.friction_excess == pytest.approx(excess, rel=1e-9, abs=1e-17)
        adheres = measure(state, friction=math.inf, on_net=on_net)
        assert adheres.friction_excess == 0.0


def test_shares_of_suction_and_of_pulling_ground(state):
    _, _, forces, _ = state
    on_net = forces.on_net.copy()
    pressed = float(on_net[0, 2:].sum())
    on_net[0, 1] = -0.1 * pressed
    balance = measure(state, on_net=on_net, ground_normal=np.array([3.0, -1.0, 1.0]))
    assert balance.suction_share == pytest.approx(0.1, rel=1e-12)
    assert balance.ground_tension_share == pytest.approx(1 / 4, rel=1e-15)
    assert measure(state, ground_normal=np.array([-1.0])).ground_tension_share == 1.0


@given(st.lists(st.integers(-1000, 1000), max_size=6))
def test_share_that_pulls_is_a_number_from_0_to_1(forces):
    share = negative_share(np.array(forces, dtype=float) / 7.0)
    pulling = -sum(force for force in forces if force < 0)
    assert 0.0 <= share <= 1.0
    assert (share == 0.0) == (pulling == 0)
    assert (share == 1.0) == (pulling > 0 and sum(forces) <= 0)


@pytest.mark.parametrize("share", [math.nextafter(0.05, 1.0), 0.99, math.inf, math.nan])
def test_snow_that_would_pull_on_the_net_is_refused(share):
    check_balance(replace(SOUND, suction_share=0.05), TOLERANCE)
    with pytest.raises(SolveError, match="would pull on the net") as raised:
        check_balance(replace(SOUND, suction_share=share), TOLERANCE)
    assert raised.value.outcome is Outcome.OUT_OF_VALIDITY
    # adhering snow may pull on a wall
    check_balance(replace(SOUND, suction_share=share, smallest_tension=None), TOLERANCE)
