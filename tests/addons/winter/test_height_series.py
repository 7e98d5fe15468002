"""Series of heights: gaps, spikes, winters."""

from datetime import date

import pytest

from netdesign.addons.winter.heights import (
    HeightSeries,
    find_gaps,
    smooth,
)


def a_series(heights, first=date(2011, 12, 28)):
    return HeightSeries(first_day=first, heights=tuple(heights))


@pytest.mark.parametrize(
    ("before", "low", "after", "high", "closable"),
    [
        (date(2012, 2, 1), 0.4, date(2012, 2, 5), 0.7, True),
        (date(2012, 2, 1), 0.4, date(2012, 2, 6), 0.7, False),
        (date(2012, 6, 30), 0.0, date(2012, 11, 30), 0.0, True),
        (date(2012, 6, 30), 0.0, date(2012, 12, 2), 0.0, False),
        (date(2012, 6, 30), 0.0, date(2012, 11, 2), 0.1, False),
    ],
)
def test_gaps_that_may_hide_snow_are_not_closed(before, low, after, high, closable):
    (gap,) = find_gaps({before: low, after: high})
    assert gap.is_closable is closable


def test_median_of_three_days_drops_a_single_spike():
    smoothed = smooth(a_series([0.2, 0.3, 1.9, 0.35, 0.5]))
    assert smoothed.heights == (0.2, 0.3, 0.35, 0.5, 0.5)
    assert smooth(a_series([0.2, 0.3])).heights == (0.2, 0.3)
