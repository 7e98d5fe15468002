"""Net that slides over the snow against the capstan, Euler and Eytelwein."""

import math

import numpy as np
import pytest

from netdesign.addons.evidence.verification.closed_forms import slide_on
from netdesign.addons.history.net_pulls import (
    NetResponse,
    compute_node_forces,
    measure_arcs,
)
from netdesign.cable.net import compute_capstan_ratio
from tests.each import each

RADIUS = 2.0
TAIL = 1.0
WRAP = 1.2  # [rad]
STRAIN = 0.01  # before the step
STIFFNESS = 2e7
NODES = (21, 41, 81, 161)
FRICTION_ANGLES = np.radians([5.0, 20.0, 45.0])


def arc_points(n: int):
    """Foot, n nodes on an arc that bulges to the valley, head."""
    angles = np.linspace(-WRAP / 2.0, WRAP / 2.0, n)
    nodes = RADIUS * np.array([np.cos(angles), np.sin(angles)])
    tangents = np.array([-np.sin(angles), np.cos(angles)])
    foot = nodes[:, 0] - TAIL * tangents[:, 0]
    head = nodes[:, -1] + TAIL * tangents[:, -1]
    return np.column_stack([foot, nodes, head])


def slide(points, old_lengths, friction_angle: float) -> NetResponse:
    return slide_on(points, old_lengths, math.tan(friction_angle), STIFFNESS)


def observed_orders(errors):
    errors = np.abs(errors)
    return np.log2(errors[:-1] / errors[1:])


@each("end", ["head", "foot"])
@each("phi", FRICTION_ANGLES)
def test_capstan_ratio_where_the_whole_net_glides(phi, end):
    """All net but the pulled tail starts without tension: every node must glide."""
    errors = []
    for n in NODES:
        points = arc_points(n)
        old_lengths = measure_arcs(points)
        old_lengths[-1 if end == "head" else 0] /= 1.0 + 10.0 * STRAIN
        step = slide(points, old_lengths, phi)
        assert set(step.slide_signs) == {-1 if end == "head" else 1}
        pulled, held = step.tensions[[-1, 0] if end == "head" else [0, -1]]
        errors.append(pulled / held / compute_capstan_ratio(WRAP, phi) - 1.0)
    assert abs(errors[-1]) < 1e-4
    np.testing.assert_allclose(observed_orders(np.array(errors)), 2.0, atol=0.06)


def tail_before(slip_angle: float, rate: float) -> float:
    """Length of the tail under STRAIN whose change to TAIL makes the net glide so far.

    Tension over the slip angle is T0 exp(rate angle), and the unstressed length stays:
    R int_0^w d(angle) / (1 + e(angle)) + TAIL / (1 + e(w)) = (R w + a) / (1 + e(0)).
    """
    end_strain = STRAIN * math.exp(rate * slip_angle)
    arc = slip_angle - math.log((1.0 + end_strain) / (1.0 + STRAIN)) / rate
    unstressed = RADIUS * arc + TAIL / (1.0 + end_strain)
    return unstressed * (1.0 + STRAIN) - RADIUS * slip_angle


@each("end", ["head", "foot"])
@each("sense", [1.0, -1.0])
@each("phi", FRICTION_ANGLES)
def test_net_glides_just_as_far_as_the_pull_reaches(phi, sense, end):
    """Part of the arc glides, out or back in, the rest sticks; both ends."""
    slip_angle = 2.0 / 3.0 * WRAP
    rate = sense * math.tan(phi)
    errors = []
    for n in NODES:
        points = arc_points(n)
        old_lengths = measure_arcs(points)
        tail = -1 if end == "head" else 0
        old_lengths[tail] *= tail_before(slip_angle, rate) / TAIL
        step = slide(points, old_lengths / (1.0 + STRAIN), phi)
        start = STIFFNESS * STRAIN
        expected = start * compute_capstan_ratio(slip_angle, sense * phi)
        errors.append(step.tensions[tail] / expected - 1.0)
        assert step.tensions[-1 - tail] == pytest.approx(start, rel=1e-12)
        gliding = np.count_nonzero(step.slide_signs) * WRAP / (n - 1)
        assert gliding == pytest.approx(slip_angle, abs=WRAP / (n - 1))
        towards = sense if end == "foot" else -sense
        assert set(step.slide_signs) == {0, towards}
    assert abs(errors[-1]) < 1e-4
    np.testing.assert_allclose(observed_orders(np.array(errors)), 2.0, atol=0.05)


@each("end", ["head", "foot"])
@each("phi", FRICTION_ANGLES)
def test_snow_is_sheared_to_its_limit_and_never_beyond(phi, end):
    """From the forces alone, (C11): |R_t| = R_n tan(phi) at every node that glides."""
    points = arc_points(21)
    old_lengths = measure_arcs(points) / (1.0 + STRAIN)
    old_lengths[-1 if end == "head" else 0] *= 1.0 - STRAIN / 3.0
    step = slide(points, old_lengths, phi)
    normal, tangential = compute_node_forces(points, step.tensions)
    usage = tangential / (normal * math.tan(phi))
    glides = step.slide_signs != 0
    np.testing.assert_allclose(usage[glides], -step.slide_signs[glides], rtol=1e-8)
    assert np.abs(usage[~glides]).max(initial=0.0) <= 1.0
    assert (normal > 0.0).all()
