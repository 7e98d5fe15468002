"""Trend of annual maxima: Mann-Kendall test and Sen's slope."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.addons.winter.statistics import find_trend

SERIES = st.lists(st.integers(0, 40), min_size=10, max_size=30)


def test_fewer_than_ten_winters_tell_no_trend():
    assert find_trend(range(9), range(9)) is None
    assert find_trend(range(10), range(10)).count == 10


def test_a_slope_counts_the_years_without_a_winter():
    years = [1990 + k for k in range(6)] + [2004 + k for k in range(6)]
    trend = find_trend(years, [0.3 * (year - 1990) for year in years])
    assert trend.slope == pytest.approx(0.3)
    assert trend.is_shown


@given(SERIES, st.floats(0.01, 1e4))
def test_the_unit_of_the_maxima_changes_the_slope_alone(maxima, unit):
    years = range(len(maxima))
    one, other = (
        find_trend(years, maxima),
        find_trend(years, [unit * x for x in maxima]),
    )
    assert other.slope == pytest.approx(unit * one.slope)
    assert other.p_value == pytest.approx(one.p_value)
