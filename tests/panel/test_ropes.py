"""Ropes: length of a parabola, the root of (P2) over twenty orders of magnitude."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from netdesign.panel.equations import (
    compute_excess_length,
    estimate_force_along,
    measure_lengths,
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


def test_derivatives_of_the_lengths():
    """Against central differences, of two ropes at once."""
    rng = np.random.default_rng(17)
    shear, along = rng.uniform(-9e4, 9e4, (2, 2, 24)), np.array([37e3, 181e3])
    stiffness = np.array([1.7e6, 2.3e7])
    found = measure_lengths(shear, stiffness, along)
    share = 1e-5

    def change(moved, scaled):
        up = measure_lengths(shear + moved, stiffness, along * scaled).excess
        down = measure_lengths(shear - moved, stiffness, along / scaled).excess
        return (up - down) / 2.0

    by_along = change(0.0, math.exp(share)) / share
    np.testing.assert_allclose(found.by_log_along, by_along, rtol=1e-7)
    assert (found.by_log_along < 0.0).all()
    way = rng.uniform(-1.0, 1.0, shear.shape)
    by_shear = change(way, 1.0)
    expected = np.einsum("rcg,rcg->r", found.by_shear, way)
    np.testing.assert_allclose(expected, by_shear, rtol=1e-6)


@pytest.mark.parametrize("sag", [0.0, 0.06])
def test_first_figure_solves_its_equation(sag):
    load, span, rope = 37.1e3, 3.85, Rope(stiffness=14.2e6, sag=sag)
    along, hung = estimate_force_along(load, span, rope)
    assert along == pytest.approx(load * span**2 / (8 * hung), rel=1e-12)
    stretched = 8 / 3 * (hung / span) ** 2
    assert stretched == pytest.approx(8 / 3 * sag**2 + along / 14.2e6, rel=1e-9)
