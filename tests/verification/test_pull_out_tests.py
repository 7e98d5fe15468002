"""Pull-out tests: reference values of three tests by correlation factors."""

import math

import pytest
from scipy.integrate import quad
from scipy.special import ndtr

REFERENCE = [(0.2, 0.80), (0.3, 0.73), (0.4, 0.66)]


@pytest.mark.parametrize(("variation", "correlated"), REFERENCE)
def test_three_tests_over_the_mean(variation, correlated):
    """Of a lognormal resistance of mean 1: the expected least of three over 1.05.

    It is less than the mean over 1.20.
    """
    sigma = math.sqrt(math.log(1.0 + variation**2))
    median = math.exp(-(sigma**2) / 2.0)
    least, _ = quad(
        lambda y: ndtr(-(math.log(y) - math.log(median)) / sigma) ** 3, 0, 9
    )
    assert min(least / 1.05, 1.0 / 1.20) == pytest.approx(correlated, abs=0.006)
