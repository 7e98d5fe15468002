"""Stations and spans: integrals of polynomials, exact, and what supports take."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from netdesign.panel.strips import ROPE_POINTS, build_stations
from tests.each import each

COUNTS = [1, 2, 4, 6]


def draw_load(count, *, is_even):
    """Polynomial that K stations carry exactly."""
    drawn = np.random.default_rng(count).uniform(-1.3, 2.1, count)
    coefficients = np.zeros(2 * count if is_even else count)
    coefficients[:: 2 if is_even else 1] = drawn
    return Polynomial(coefficients)


def deflect(load, *, is_held):
    """-load integrated twice; 0 at xi = 1, and in mid-panel 0 or level."""
    twice = -load.integ(2)
    slope = -(twice(1.0) - twice(0.0)) if is_held else 0.0
    return twice + Polynomial([-twice(1.0) - slope, slope])


@each("has_mid_anchors", [False, True])
@each("count", COUNTS)
def test_spans_integrate_exactly(count, has_mid_anchors):
    stations = build_stations(count, has_mid_anchors=has_mid_anchors)
    load = draw_load(count, is_even=not has_mid_anchors)
    places = np.append(stations.xi, 0.0)
    for span, is_held in ((stations.lower, has_mid_anchors), (stations.upper, False)):
        curve = deflect(load, is_held=is_held)
        values = load(stations.xi)
        np.testing.assert_allclose(span.deflection @ values, curve(places), atol=1e-12)
        # z falls while xi grows
        slope = -curve.deriv()
        np.testing.assert_allclose(span.shear @ values, slope(ROPE_POINTS), atol=1e-12)
        ends = slope(np.array([1.0, 0.0]))
        np.testing.assert_allclose(span.end_shear @ values, ends, atol=1e-12)


@each("has_mid_anchors", [False, True])
@each("count", COUNTS)
def test_supports_take_the_whole_load(count, has_mid_anchors):
    stations = build_stations(count, has_mid_anchors=has_mid_anchors)
    load = draw_load(count, is_even=not has_mid_anchors)
    whole = load.integ()(1.0)
    assert stations.weights @ load(stations.xi) == pytest.approx(whole, abs=1e-13)
    for span in (stations.lower, stations.upper):
        at_post, in_middle = span.end_shear @ load(stations.xi)
        assert at_post - in_middle == pytest.approx(whole, abs=1e-12)
