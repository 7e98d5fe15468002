"""Indices and crossings of responses whose answers are known in closed form."""

import math

import numpy as np
import pytest

from netdesign.search.sensitivity import (
    measure_sensitivity,
    measure_unexplained,
)
from tests.search.synthetic import drive

# f = 10 + 4 x + 2 y + 3 (x - 1/2)(z - 1/2): variances 16/12, 4/12, 9/144
LINEAR = (16.0 / 12.0, 4.0 / 12.0, 0.0)
MIXED = 9.0 / 144.0
TOTAL = sum(LINEAR) + MIXED


@pytest.fixture(scope="module")
def found():
    return drive(
        lambda u: np.array([
            10.0 + 4.0 * u[0] + 2.0 * u[1] + 3.0 * (u[0] - 0.5) * (u[2] - 0.5), 7.0,
        ]),
        3,
    )  # fmt: skip


def test_sobol_indices_are_those_of_the_closed_form(found):
    x, y, z = measure_sensitivity(found, 0)[0]
    for one, variance in zip((x, y, z), LINEAR, strict=True):
        assert one.first_order == pytest.approx(variance / TOTAL, abs=1e-6)
    assert x.total == pytest.approx((LINEAR[0] + MIXED) / TOTAL, abs=1e-6)
    assert y.total == pytest.approx(LINEAR[1] / TOTAL, abs=1e-6)
    assert z.total == pytest.approx(MIXED / TOTAL, abs=1e-6)


def test_the_tornado_goes_through_the_governing_case(found):
    """The maximum lies at (1, 1, 1): 10 + 4 + 2 + 3/4."""
    x, y, _ = measure_sensitivity(found, 0)[0]
    assert x.at_high == pytest.approx(16.75)
    assert x.at_low == pytest.approx(12.0 - 0.75)
    assert (y.low, y.high) == pytest.approx((14.75, 16.75))


def test_what_the_model_cannot_see_is_its_error():
    smooth = drive(lambda u: np.array([5.0 + u[0] ** 2]), 1)
    rough = drive(lambda u: np.array([5.0 + math.sin(40.0 * u[0])]), 1, max_cases=9)
    assert measure_unexplained(smooth, 0) == pytest.approx(0.0, abs=1e-9)
    assert measure_unexplained(rough, 0) > 0.3
