"""The net's geometry, and its guards at their bounds."""

import math

import numpy as np
import pytest

from netdesign.cable.net import (
    Net,
)

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
