"""Slack of a hanging net by its sag."""

import numpy as np
import pytest

from netdesign.cable.net import find_slack
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
