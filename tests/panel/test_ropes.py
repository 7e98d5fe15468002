"""Ropes: length of a parabola, the root of (P2) over twenty orders of magnitude."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from netdesign.panel.equations import (
    compute_excess_length,
)
from netdesign.panel.inputs import Rope
from netdesign.panel.strips import ROPE_POINTS
from tests.each import each
from tests.panel.one_rope import find_force_along


@pytest.mark.parametrize("sag", [0.02, 0.0731, 0.17, 0.3])
def test_length_of_a_parabola(sag):
    b = 4 * sag
    closed = (math.sqrt(1 + b**2) + math.asinh(b) / b) / 2 - 1
    assert compute_excess_length(sag) == pytest.approx(closed, rel=1e-12)


@each("sag", [0.0, 0.051, 0.15])
@each("stiffness", [1.3e6, 1.8e7, 1e13])
def test_rope_has_its_length(stiffness, sag):
    """The length under tension, integrated by other means."""
    rope = Rope(stiffness=stiffness, sag=sag)
    pull = np.array([[21e3], [-73e3]])
    along = find_force_along(pull * ROPE_POINTS, rope)
    size = float(np.hypot(*pull)[0])

    def unstressed(xi):
        stretched = math.hypot(1.0, size * xi / along)
        return stretched / (1.0 + along / stiffness * stretched)

    length, _ = quad(unstressed, 0.0, 1.0, epsabs=1e-14)
    assert length - 1.0 == pytest.approx(compute_excess_length(sag), abs=1e-13)
