"""Pull-out against figures worked out beforehand in the collection of standards."""

import pytest

from netdesign.calculation.quantity import leaf
from netdesign.checks.forces import resist_by_friction, resist_by_tests
from tests.each import each


def correlate(*, mean, on_mean, least, on_least):
    return resist_by_tests(
        leaf("R_m", mean, "kN", "test"),
        leaf("ξ_m", on_mean, "-", "test"),
        leaf("R_min", least, "kN", "test"),
        leaf("ξ_min", on_least, "-", "test"),
    ).value


def test_least_governs_where_the_tests_scatter():
    """Two tests: 400 / 1.30 = 307.7 on the mean, 300 / 1.20 = 250 on the least."""
    found = correlate(mean=400.0, on_mean=1.30, least=300.0, on_least=1.20)
    assert found == pytest.approx(250.0, rel=1e-15)


def test_mean_governs_where_its_factor_is_the_larger():
    """Three tests within 5 %: 315 / 1.20 = 262.5 against 300 / 1.05 = 285.7."""
    found = correlate(mean=315.0, on_mean=1.20, least=300.0, on_least=1.05)
    assert found == pytest.approx(262.5, rel=1e-15)


@each("factor", [0.0, -1.2, -1e-9])
@each("place", ["on_mean", "on_least"])
def test_a_factor_that_is_not_above_zero_gives_no_resistance(place, factor):
    factors = {"on_mean": 1.3, "on_least": 1.2} | {place: factor}
    assert correlate(mean=400.0, least=300.0, **factors) is None


@pytest.mark.parametrize(("friction", "pressing"), [(0.4, -5.0), (-0.4, 100.0)])
def test_a_base_that_nothing_presses_has_no_friction(friction, pressing):
    found = resist_by_friction(
        leaf("μ_b", friction, "-", "test"),
        leaf("γ_E", 1.5, "-", "test"),
        leaf("V_k", pressing, "kN", "test"),
    )
    assert found.value is None
    assert found.lacks
