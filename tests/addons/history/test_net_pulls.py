"""The net on nodes that the snow moves: forces of a step."""

import math

import numpy as np
import pytest

from netdesign.addons.evidence.verification.closed_forms import slide_on
from netdesign.addons.history.net_pulls import hold_net, measure_arcs
from tests.each import each

STIFFNESS = 50.0


def arc_points(count, *, opening=1.2, radius=1.0, exponent=1.0):
    """Foot, ``count`` nodes and head on a circle, the snow at its centre's side."""
    fractions = np.linspace(0.0, 1.0, count + 2) ** exponent
    angle = opening * (fractions - 0.5)
    points = radius * np.array([np.cos(angle), np.sin(angle)])
    return points - points[:, :1]


def bulged(points, seed=3, size=2e-3):
    """The same net, its nodes pushed a little out of line."""
    push = np.random.default_rng(seed).normal(scale=size, size=points.shape)
    push[:, [0, -1]] = 0.0
    return points + push


def strained(points, strain, *, spread=0.0):
    """Unstressed lengths of a net under this strain, tighter towards the foot."""
    places = np.linspace(1.0, -1.0, points.shape[1] - 1)
    return measure_arcs(points) / (1.0 + strain * (1.0 + spread * places))


@each("friction", [0.0, 0.2, 0.8])
@each("spread", [0.0, 0.5])
def test_forces_and_pulls_are_in_balance(friction, spread):
    """Sum of forces, and of their moments about the foot."""
    points = bulged(arc_points(9), size=0.02)
    lengths = strained(points, 0.05, spread=spread)
    net = slide_on(points, lengths, friction, STIFFNESS)
    size = np.hypot(*net.foot_pull)
    everything = net.forces.sum(axis=1) + net.foot_pull + net.head_pull
    np.testing.assert_allclose(everything, 0.0, atol=1e-13 * size)
    forces = np.column_stack([net.foot_pull, net.forces, net.head_pull])
    moment = (points[0] * forces[1] - points[1] * forces[0]).sum()
    assert moment == pytest.approx(0.0, abs=1e-12 * size)


@pytest.mark.parametrize("exponent", [1.0, 1.5], ids=["even", "graded"])
def test_arcs_of_a_circle_converge_at_order_four(exponent):
    opening, errors = 1.2, []
    for count in (7, 15, 31):
        arcs = measure_arcs(arc_points(count, opening=opening, exponent=exponent))
        errors.append(abs(arcs.sum() / opening - 1.0))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[-1] < 1e-6
    assert orders.min() > 3.5


def test_arcs_of_even_nodes_by_hand():
    """Chord 2 R sin(beta / 2), longer by beta^2 / 24."""
    opening, count = 1.2, 5
    beta = opening / (count + 1)
    expected = 2.0 * math.sin(beta / 2.0) * (1.0 + beta**2 / 24.0)
    arcs = measure_arcs(arc_points(count, opening=opening))
    np.testing.assert_allclose(arcs, expected, rtol=1e-13)


def test_held_net_is_one_that_sticks():
    """Nothing slides: by the law of its segments alone, and by much friction."""
    points = bulged(arc_points(7))
    lengths = strained(points, 0.02, spread=0.2)
    held = hold_net(points, lengths, stiffness=STIFFNESS)
    tensions = STIFFNESS * (measure_arcs(points) / lengths - 1.0)
    np.testing.assert_allclose(held.tensions, tensions, rtol=1e-12)
    sticks = slide_on(points, lengths, 40.0, STIFFNESS)
    assert not sticks.slide_signs.any()
    for name in ("forces", "foot_pull", "head_pull"):
        np.testing.assert_allclose(
            getattr(held, name), getattr(sticks, name), atol=1e-12
        )
