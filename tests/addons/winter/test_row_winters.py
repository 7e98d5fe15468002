"""All winters of a row: which are complete, what they tell together."""

from datetime import date

import pytest

from netdesign.addons.winter.heights import HeightSeries
from netdesign.addons.winter.season import (
    StationPacks,
    follow_winters,
    list_complete,
    split_packs,
)
from netdesign.addons.winter.settling import HS2SWE, MODELS
from tests.addons.winter.made_up_row import a_formula_solver


def a_series(tops, first=date(1990, 9, 1)):
    """Winters that rise to their tops [m] until March and are gone in May."""
    heights = []
    for year, top in enumerate(tops):
        days = (date(first.year + year + 1, 9, 1) - date(first.year + year, 9, 1)).days
        rising = [top * k / 120 for k in range(121)]
        falling = [top * (60 - k) / 60 for k in range(1, 61)]
        winter = [0.0] * 70 + rising + falling
        heights += winter + [0.0] * (days - len(winter))
    return HeightSeries(first_day=first, heights=tuple(heights))


def test_a_winter_is_complete_from_december_to_april():
    whole = a_series([1.0, 1.1])
    assert list_complete(whole) == ("1990/1991", "1991/1992")
    cut = HeightSeries(
        first_day=date(1990, 12, 2), heights=whole.heights[92 : 365 + 241]
    )
    assert list_complete(cut) == ()


def test_snow_goes_on_settling_through_september():
    series = HeightSeries(first_day=date(1990, 8, 30), heights=(0.0, 1.0, 0.5, 0.45))
    packs = split_packs(series, MODELS["delta-snow"])
    assert [list(days) for days in packs.values()] == [[0, 1], [2, 3]]
    assert packs["1990/1991"][2].ages.tolist() == [1]


def test_many_winters_have_return_values_and_curves_of_the_largest():
    tops = [1.0 + 0.07 * ((7 * k) % 16) for k in range(16)]
    station = StationPacks(series=a_series(tops), models=[HS2SWE, MODELS["delta-snow"]])
    found = follow_winters(station, a_formula_solver(), step=60)
    assert len(found.maxima) == found.sample.fit.count == 16
    largest = sorted(found.maxima, key=lambda one: -one.foot)[:3]
    assert {s.name for s in found.seasons} == {one.winter for one in largest}
    assert [one.winter for one in found.others["delta-snow"]] == [
        one.winter for one in found.maxima
    ]
    mean = sum(one.foot for one in found.maxima) / 16
    assert found.sample.fit.mean == pytest.approx(mean, rel=1e-12)
    for season in found.seasons:
        (looked_up,) = [one for one in largest if one.winter == season.name]
        assert looked_up.foot == pytest.approx(season.maximum.foot, rel=1e-6)


def test_one_winter_above_the_net_and_there_are_no_return_values():
    tops = [1.0 + 0.07 * k for k in range(16)]
    tops[5] = 4.3
    station = StationPacks(series=a_series(tops), models=[HS2SWE])
    found = follow_winters(station, a_formula_solver(), step=0)
    assert [one.winter for one in found.maxima if not one.is_proven] == ["1995/1996"]
    assert "1995/1996" in str(found.sample.lack)
    assert found.sample.fit is None


def test_an_incomplete_winter_counts_for_no_return_value():
    """Its snow stands above the net, and its series begins in January."""
    whole = a_series([4.3, *(1.0 + 0.07 * k for k in range(15))])
    series = HeightSeries(first_day=date(1991, 1, 9), heights=whole.heights[130:])
    station = StationPacks(series=series, models=[HS2SWE])
    found = follow_winters(station, a_formula_solver(), step=0)
    assert [one.winter for one in found.maxima if not one.is_proven] == ["1990/1991"]
    assert (found.sample.fit.count, found.sample.lack) == (15, None)
