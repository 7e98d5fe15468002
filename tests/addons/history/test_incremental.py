"""The paper's increments: its equations, and the exact sliding they approach."""

import math

import numpy as np
import pytest

from netdesign.addons.evidence.verification.closed_forms import slide_on
from netdesign.addons.history.net_pulls import measure_arcs
from netdesign.addons.history.staggered import (
    CableState,
    advance_increment,
    build_cable_state,
)
from netdesign.cable.net import compute_turning_angles
from netdesign.outcome import Outcome, SolveError
from tests.each import each

STIFFNESS = 2e7
FRICTION = math.tan(math.radians(15.0))
NODES = 20


def net_points(time: float):
    """A bulge of 0.3 that grows and shifts to the head, and a node row that climbs."""
    along = np.linspace(0.0, 1.0, NODES + 2)
    climbed = along + 0.03 * time * along * (1.0 - along)
    bulge = (1.2 + 0.4 * time * (1.0 + climbed)) * climbed * (1.0 - climbed)
    return np.array([bulge, 3.0 * climbed])


def slide(points, old_lengths):
    return slide_on(points, old_lengths, FRICTION, STIFFNESS)


def find_signs(before: CableState, after: CableState):
    """1 where the net slid to the foot, -1 to the head, 0 where it stuck."""
    slides = np.cumsum(after.unstressed_lengths - before.unstressed_lengths)[:-1]
    return np.sign(np.where(np.abs(slides) > 1e-14, slides, 0.0)).tolist()


def advance(state: CableState, points, **options) -> CableState:
    return advance_increment(
        state,
        measure_arcs(points),
        compute_turning_angles(points),
        friction=FRICTION,
        stiffness=STIFFNESS,
        **options,
    )


def initial_lengths():
    """Strain 1 % at time 0, less towards the foot, as far as friction allows."""
    final = measure_arcs(net_points(0.0))
    return slide(net_points(0.0), final / np.linspace(1.008, 1.012, NODES + 1)).lengths


def initial_state() -> CableState:
    final = measure_arcs(net_points(0.0))
    return build_cable_state(final, initial_lengths(), STIFFNESS)


def test_gliding_node_by_hand():
    """Eqs 10, 13, 14 with two unknowns, solved as they stand."""
    final, beta = np.array([1.03, 1.005]), 0.2
    state = build_cable_state(np.array([1.01, 1.01]), np.ones(2), STIFFNESS)
    step = advance_increment(
        state, final, np.array([beta]), friction=FRICTION, stiffness=STIFFNESS
    )
    # R_t = -R_n tan phi: (T1 - T0) cos = -(T1 + T0) sin tan phi
    lower = -math.cos(beta / 2) + FRICTION * math.sin(beta / 2)
    upper = math.cos(beta / 2) + FRICTION * math.sin(beta / 2)
    stuck = final - 1.0  # tensions over ES if nothing slid
    matrix = np.array([[-lower * final[0], -upper * final[1]], [1.0, 1.0]])
    sides = np.array([-lower * stuck[0] - upper * stuck[1], 0.0])
    growth = np.linalg.solve(matrix, sides)
    assert find_signs(state, step) == [1]
    np.testing.assert_allclose(step.unstressed_lengths, 1.0 + growth, rtol=1e-12)


def trace(way):
    """Points of a net by its complex steps."""
    places = np.cumsum(np.append(0.0, way))
    return np.array([places.real, places.imag])


@each("seed", range(60))
def test_gliding_nodes_are_found_for_random_nets(seed):
    """To 1 % of the exact tensions, strains of 1 % changing by up to a tenth."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 80))
    headings = np.cumsum(np.append(0.0, rng.uniform(-0.02, 1.0, n) * 2.0 / n))
    way = rng.uniform(0.1, 1.0, n + 1) * np.exp(1j * (headings + math.pi / 2.0))
    points = trace(way)
    friction = math.tan(math.radians(rng.integers(0, 46)))
    final = measure_arcs(points)
    old = final / (1.0 + 0.01 * np.exp(rng.normal(0.0, 0.5, n + 1)))
    old = slide_on(points, old, friction, STIFFNESS).lengths
    moved = trace(way * (1.0 + rng.uniform(-1e-3, 1e-3, n + 1)))
    step = advance_increment(
        build_cable_state(final, old, STIFFNESS),
        measure_arcs(moved),
        compute_turning_angles(moved),
        friction=friction,
        stiffness=STIFFNESS,
    )
    exact = slide_on(moved, old, friction, STIFFNESS)
    np.testing.assert_allclose(step.tensions, exact.tensions, rtol=1e-2)


def test_limit_of_rounds_is_an_error():
    with pytest.raises(SolveError) as failure:
        advance(initial_state(), net_points(0.2), max_rounds=1)
    assert failure.value.outcome is Outcome.MAX_ITERATIONS
