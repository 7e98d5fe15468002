"""Series of heights: gaps, spikes, winters."""

from datetime import date

import pytest

from netdesign.addons.winter.heights import (
    HeightSeries,
    build_series,
    find_gaps,
    smooth,
    split_winters,
)


def a_series(heights, first=date(2011, 12, 28)):
    return HeightSeries(first_day=first, heights=tuple(heights))


def test_short_gaps_are_closed_by_a_line_and_listed():
    readings = {date(2011, 12, 30): 0.9, date(2012, 1, 2): 1.2}
    (gap,) = find_gaps(readings)
    assert gap.is_closable
    series = build_series(readings, {date(2012, 1, 2): 268.0})
    assert series.heights == pytest.approx([0.9, 1.0, 1.1, 1.2], rel=1e-14)
    assert series.filled == gap.days == (date(2011, 12, 31), date(2012, 1, 1))
    assert series.air_temperatures == (None, None, None, 268.0)


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


def test_winters_begin_in_september():
    series = a_series([0.0] * 400, first=date(2009, 8, 30))
    assert split_winters(series) == {
        "2008/2009": slice(0, 2),
        "2009/2010": slice(2, 367),
        "2010/2011": slice(367, 400),
    }
