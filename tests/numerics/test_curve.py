"""Curve through points: exact on parabolas, of third order."""

import math
from itertools import pairwise

import numpy as np
import pytest

from netdesign.numerics.curve import interpolate_curve, trace_curve

UNEVEN = np.array([0.0, 0.1, 0.35, 0.5, 0.8, 1.0])


def sines(parameter):
    return np.array([np.sin(2.0 * parameter), np.cos(3.0 * parameter)])


@pytest.mark.parametrize("seed", [1, 2])
def test_parabola_is_met_between_uneven_points(seed):
    """Its three-point slopes are exact, at the ends too."""
    squared, linear, constant = np.random.default_rng(seed).normal(size=(3, 2, 1))
    wanted = np.linspace(0.0, 1.0, 41)
    found = interpolate_curve(
        UNEVEN, squared * UNEVEN**2 + linear * UNEVEN + constant, wanted
    )
    expected = squared * wanted**2 + linear * wanted + constant
    np.testing.assert_allclose(found, expected, atol=1e-14)


def test_order_three_on_a_smooth_curve():
    errors = []
    wanted = np.linspace(0.0, 1.0, 401)
    for count in (9, 17, 33, 65):
        # uneven: neighbours differ by a smooth factor
        known = np.linspace(0.0, 1.0, count) ** 1.3
        found = interpolate_curve(known, sines(known), wanted)
        errors.append(np.abs(found - sines(wanted)).max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders.min() > 2.6
    assert orders[-1] > 2.9
    assert errors[-1] < 2e-5


def test_a_curve_is_traced_smoothly_through_its_points():
    """Nodes on a quarter circle, as far apart as a coarse mesh has them."""
    angles = [0.0, 0.02, 0.1, 0.4, 0.7, 1.1, math.pi / 2]
    nodes = [(math.sin(a), 1.0 - math.cos(a)) for a in angles]
    pieces = trace_curve(nodes, 6)
    ends = [(piece[0], piece[-1]) for piece in pieces]
    assert ends == [(pytest.approx(a), pytest.approx(b)) for a, b in pairwise(nodes)]
    drawn = [math.dist(point, (0.0, 1.0)) for piece in pieces for point in piece]
    assert drawn == pytest.approx([1.0] * len(drawn), abs=5e-3)  # chords: 2e-2
    assert trace_curve([(0.0, 0.0), (1.0, 2.0)], 6)[0][3] == pytest.approx((0.5, 1.0))
