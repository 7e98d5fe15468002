"""Geometry of the net, and closed forms against the equations that they solve."""

import math

import numpy as np
import pytest

from netdesign.cable.net import Net, compute_capstan_ratio, compute_parabola_sag
from tests.each import each


def test_sag_of_a_taut_cable():
    """FACTS.md, section 10, by hand: q 10 kN/m, c 4 m, ES 20 MN give f = 0.1817 m."""
    sag = compute_parabola_sag(10e3, 4.0, 20e6, 0.0)
    assert sag == pytest.approx((3 * 10e3 * 4.0**4 / (64 * 20e6)) ** (1 / 3), rel=1e-14)
    assert sag == pytest.approx(0.1817, abs=5e-5)  # printed to four places


@each("load", [1e-6, 1.0, 1e3])
@each("slack", [0.0, 1e-9, 1e-3, 0.1, 1.0])
def test_sag_satisfies_its_equation(load, slack):
    chord, stiffness = 3.0, 50.0
    sag = compute_parabola_sag(load, chord, stiffness, slack)
    stretch = load * chord**2 / (8 * sag * stiffness)
    assert 8 / 3 * (sag / chord) ** 2 == pytest.approx(slack + stretch, rel=1e-12)


def test_capstan_ratio():
    """Half a turn with a coefficient of 0.5: exp(pi / 2), the textbook case."""
    ratio = compute_capstan_ratio(math.pi, math.atan(0.5))
    assert ratio == pytest.approx(math.exp(math.pi / 2), rel=1e-14)


SOUND = {
    "height_normal": 3.0,
    "inclination": math.radians(30.0),
    "stiffness_per_m": 2e7,
    "slack": 0.05,
    "friction_angle": math.radians(25.0),
}


def a_net(**changes) -> Net:
    return Net(**{**SOUND, **changes})


def test_geometry():
    net = a_net()
    # cos 30 = sqrt(3)/2, tan 30 = 1/sqrt(3)
    assert net.chord == pytest.approx(2.0 * math.sqrt(3.0), rel=1e-15)
    np.testing.assert_allclose(net.head, [math.sqrt(3.0), 3.0], rtol=1e-15)
    assert np.hypot(*net.head) == pytest.approx(net.chord, rel=1e-15)
    assert a_net(inclination=0.0).head[0] == 0.0
    assert net.unstressed_length == pytest.approx(1.05 * net.chord, rel=1e-15)
