"""Polygon of the net: tensions, angles, node forces, friction bounds."""

import math

import numpy as np
import pytest

from netdesign.addons.history.net_pulls import (
    compute_node_forces,
    compute_tensions,
    measure_arcs,
    pull_nodes,
)
from netdesign.cable.net import compute_turning_angles
from tests.each import each

STRAIGHT = np.array([[0.0, 0.5, 1.5], [0.0, 1.0, 3.0]])
BULGED = np.array([[0.0, 0.4, 0.7, 0.5, 0.6], [0.0, 0.6, 1.3, 2.1, 3.0]])


@each("angle", [-2.0, -0.1, 0.0, 1e-9, 0.3, 3.0])
def test_turning_angle_of_one_node(angle):
    """Up the slope's normal, then towards the snow by the angle."""
    points = np.array([[0.0, 0.0, -math.sin(angle)], [0.0, 1.0, 1.0 + math.cos(angle)]])
    assert compute_turning_angles(points)[0] == pytest.approx(angle, rel=1e-12)


def test_tensions_follow_the_strain_and_are_never_negative():
    final = np.array([1.02, 1.0, 0.9])
    tensions = compute_tensions(final, np.array([1.0, 1.0, 1.0]), 2e7)
    np.testing.assert_allclose(tensions, [0.02 * 2e7, 0.0, 0.0], rtol=1e-12)
    assert compute_tensions(np.array([2.2]), np.array([2.0]), 1.0)[0] == pytest.approx(
        0.1, rel=1e-12
    )


def pull(points, tensions):
    return pull_nodes(points, np.ones(tensions.size), tensions)


def test_components_are_those_of_the_vector():
    """Along bisector and across, found by turning the lower segment's direction."""
    tensions = np.array([3.0, 2.0, 2.5, 1.0])
    normal, tangential = compute_node_forces(BULGED, tensions)
    lower = np.diff(BULGED)[:, :-1] / np.hypot(*np.diff(BULGED))[:-1]
    turn = np.exp(0.5j * compute_turning_angles(BULGED))
    along = (lower[0] + 1j * lower[1]) * turn  # across the bisector, to the head
    x, y = pull(BULGED, tensions).forces
    np.testing.assert_allclose(x + 1j * y, along * (tangential + 1j * normal))


def arc_points(count, opening=1.2, exponent=1.0):
    """Foot, ``count`` nodes and head on a circle of radius 1."""
    angle = opening * (np.linspace(0.0, 1.0, count + 2) ** exponent - 0.5)
    return np.array([np.cos(angle), np.sin(angle)])


@pytest.mark.parametrize("exponent", [1.0, 1.5], ids=["even", "graded"])
def test_arcs_of_a_circle_converge_at_order_four(exponent):
    errors = [
        abs(measure_arcs(arc_points(count, exponent=exponent)).sum() / 1.2 - 1.0)
        for count in (7, 15, 31)
    ]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[-1] < 1e-6
    assert orders.min() > 3.5


def test_arcs_of_even_nodes_by_hand():
    """Chord 2 R sin(beta / 2), longer by beta^2 / 24."""
    beta = 1.2 / 6
    expected = 2.0 * math.sin(beta / 2.0) * (1.0 + beta**2 / 24.0)
    np.testing.assert_allclose(measure_arcs(arc_points(5)), expected, rtol=1e-13)


def test_forces_sum_to_nothing():
    net = pull(BULGED, np.array([3.0, 2.0, 2.5, 0.0]))
    total = net.forces.sum(axis=1) + net.foot_pull + net.head_pull
    np.testing.assert_allclose(total, 0.0, atol=1e-15)


def test_ends_are_pulled_towards_each_other():
    net = pull(STRAIGHT, np.array([2.0, 5.0]))
    along = np.array([1.0, 2.0]) / math.sqrt(5.0)
    np.testing.assert_allclose(net.foot_pull, 2.0 * along, rtol=1e-15)
    np.testing.assert_allclose(net.head_pull, -5.0 * along, rtol=1e-15)
