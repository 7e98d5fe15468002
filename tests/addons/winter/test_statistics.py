"""Which winters count in return values, why there are none, and the values."""

import pytest

from netdesign.addons.winter.maxima import AnnualMaximum
from netdesign.addons.winter.statistics import Gumbel, LimitedGumbel, Sample, fit_gumbel
from tests.each import each


def a_winter(k, ending="solved", foot=None, bound=None):
    pull = 2e3 + 310.0 * ((11 * k) % 37) if foot is None else foot
    return AnnualMaximum(winter=f"W{k}", ending=ending, foot=pull, bound=bound)


def choose(winters):
    return Sample(maxima=tuple(winters))


SOLVED = [a_winter(k) for k in range(20)]


def test_known_maxima_are_fitted_by_moments():
    found = choose([*SOLVED, a_winter(20, "no snow", 0.0)])
    assert isinstance(found.fit, Gumbel)
    assert found.fit == fit_gumbel([*[one.foot for one in SOLVED], 0.0])
    assert (found.lack, found.left_out, found.bounds) == (None, [], [])


def test_bounds_make_a_limit_and_winters_without_one_are_left_out():
    bounded = [a_winter(k, "doubtful", 0.0, 1.4e3 + k) for k in (30, 31)]
    found = choose([*SOLVED, *bounded, a_winter(40, "doubtful", 2.2e3)])
    assert isinstance(found.fit, LimitedGumbel)
    assert found.fit.limit == 1.4e3 + 31
    assert (found.fit.count, found.left_out) == (22, ["W40"])
    assert found.lack is None


OVER, UNKNOWN = a_winter(50, "overtopped"), a_winter(60, "doubtful")
HIGH = a_winter(70, "doubtful", 0.0, 1e5)


@each(
    "winters, key",
    [
        (SOLVED[:14], "few"),
        ([*SOLVED, HIGH], "few_above"),
        ([*SOLVED, OVER], "overtopped"),
        ([*SOLVED[:17], UNKNOWN, a_winter(61, "doubtful")], "unbounded"),
        ([*SOLVED[:14], UNKNOWN], "few"),
    ],
)
def test_without_return_values_there_is_a_reason(winters, key):
    found = choose(winters)
    assert found.fit is None
    assert found.lack.key == f"winter_sample.{key}"
    for one in found.lack.arguments.get("winters", ()):
        assert one in {"W50", "W60", "W61"}


@pytest.mark.parametrize(
    ("period", "factor"), [(2.0, -0.164), (10.0, 1.305), (100.0, 3.137)]
)
def test_frequency_factors_are_those_of_the_textbooks(period, factor):
    fit = Gumbel(count=40, mean=17.3, deviation=5.9)
    got = (fit.find_return_value(period)[0] - 17.3) / 5.9
    assert got == pytest.approx(factor, abs=6e-4)
