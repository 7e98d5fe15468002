"""Closed forms against the equations that they claim to solve, and their limits."""

import math

import pytest

from netdesign.cable.net import compute_capstan_ratio, compute_parabola_sag
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
