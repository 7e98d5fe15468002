"""Slack of a hanging net by its sag."""

import math
from itertools import pairwise

import numpy as np
import pytest

from netdesign.cable.sag import find_slack
from tests.each import each

SAGS = [1e-6, 2e-5, 3e-5, *np.linspace(0.001, 0.3, 60)]


@each("sag", SAGS)
def test_it_is_the_length_of_a_parabola(sag):
    nodes, weights = np.polynomial.legendre.leggauss(60)
    at = 0.5 * (nodes + 1.0)  # along the chord, from 0 to 1
    slopes = 4.0 * sag * (1.0 - 2.0 * at)
    # the root less 1, without cancellation
    excess = slopes**2 / (1.0 + np.sqrt(1.0 + slopes**2))
    assert find_slack(sag) == pytest.approx(0.5 * weights @ excess, rel=1e-7, abs=1e-15)


def test_it_grows_with_the_sag_so_that_a_sag_has_one_slack():
    slacks = [find_slack(sag) for sag in sorted(SAGS)]
    assert all(one < other for one, other in pairwise(slacks))


@each("sag", SAGS[3:])
def test_it_is_less_than_that_of_a_small_sag_and_of_a_chain(sag):
    assert find_slack(sag) <= 8.0 / 3.0 * sag**2 * (1 + 1e-9)
    # catenary of the same sag: sinh(u) / u - 1, with (cosh u - 1) / 2 u = sag
    low, high = 1e-9, 3.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        is_low = (math.cosh(middle) - 1.0) / (2.0 * middle) < sag
        low, high = (middle, high) if is_low else (low, middle)
    assert find_slack(sag) <= math.sinh(low) / low - 1.0 + 1e-9
