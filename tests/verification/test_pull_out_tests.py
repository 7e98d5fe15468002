"""Pull-out tests: reference values of three tests, and how often a fractile holds."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ndtr, ndtri
from scipy.stats import t

from netdesign.resistance.fractile import (
    find_fractile,
    find_fractile_of_known_scatter,
)
from netdesign.resistance.pull_out import SingleTest
from tests.each import each

REFERENCE = [(0.2, 0.80, 0.67, 0.50), (0.3, 0.73, 0.55, 0.36), (0.4, 0.66, 0.45, 0.25)]


def spread(variation):
    return math.sqrt(math.log(1.0 + variation**2))


@pytest.mark.parametrize(("variation", "correlated", "known", "unknown"), REFERENCE)
def test_three_tests_over_the_mean(variation, correlated, known, unknown):
    """Of a lognormal resistance of mean 1, whose own scatter the tests have.

    By A.9 the expected least of three over 1.05, less than the mean over 1.20.
    """
    sigma = spread(variation)
    median = math.exp(-(sigma**2) / 2.0)
    sample = sigma * np.array([-1.0, 0.0, 1.0])  # their deviation is sigma
    tests = [SingleTest(load=median * math.exp(y), is_held=False) for y in sample]
    found = find_fractile_of_known_scatter(tests, variation).value
    assert found == pytest.approx(known, abs=0.006)
    assert find_fractile(tests).value == pytest.approx(unknown, abs=0.006)
    least, _ = quad(
        lambda y: ndtr(-(math.log(y) - math.log(median)) / sigma) ** 3, 0, 9
    )
    assert min(least / 1.05, 1.0 / 1.20) == pytest.approx(correlated, abs=0.006)


@each("share", [0.3, 0.8, 1.0])
@each("count", [2, 3, 5])
def test_a_further_anchor_holds_the_fractile_in_95_of_100(count, share):
    """Tests stop at the load that this share of the anchors does not hold."""
    rng = np.random.default_rng(17)
    sigma, rounds = spread(0.3), 1500
    stop = ndtri(share) * sigma
    holds, holds_unknown = [], []
    for logs in rng.normal(0.0, sigma, (rounds, count)):
        tests = [
            SingleTest(load=math.exp(min(y, stop)), is_held=bool(y > stop))
            for y in logs
        ]
        value = find_fractile_of_known_scatter(tests, 0.3).value
        holds.append(ndtr(-math.log(value) / sigma))
        if sum(not one.is_held for one in tests) > 1:
            value = find_fractile(tests).value
            holds_unknown.append(ndtr(-math.log(value) / sigma))
    assert np.mean(holds) > 0.94
    if len(holds_unknown) > rounds // 3:
        assert np.mean(holds_unknown) > 0.94
    if share == 1.0:  # none stopped: 95 % but for the draw
        assert np.mean(holds) == pytest.approx(0.95, abs=0.01)
        assert np.mean(holds_unknown) == pytest.approx(0.95, abs=0.01)


def test_one_pulled_and_one_held_at_the_mean():
    """Hazard h = sqrt(2 / pi) at the mean: the mean lies h sigma above the one pulled.

    The information on it is 1 + h^2 = 1.6366 tests.
    """
    sigma, hazard = spread(0.3), math.sqrt(2.0 / math.pi)
    tests = [
        SingleTest(load=1.0, is_held=False),
        SingleTest(load=math.exp(hazard * sigma), is_held=True),
    ]
    found = find_fractile_of_known_scatter(tests, 0.3)
    assert math.log(found.median) == pytest.approx(hazard * sigma, rel=1e-9)
    k = 1.6448536 * math.sqrt(1.0 + 1.0 / (1.0 + hazard**2))
    assert math.log(found.factor) == pytest.approx(k * sigma, rel=1e-7)


def test_quantile_of_two_tests():
    """t with one degree of freedom is the cotangent: cot(0.05 pi) = 6.3138."""
    assert t.ppf(0.95, 1) == pytest.approx(1.0 / math.tan(0.05 * math.pi), rel=1e-9)
    tests = [SingleTest(load=one, is_held=False) for one in (1.0, math.e)]
    factor = 6.313751515 * math.sqrt(1.5) * math.sqrt(0.5)
    assert math.log(find_fractile(tests).factor) == pytest.approx(factor, rel=1e-9)
