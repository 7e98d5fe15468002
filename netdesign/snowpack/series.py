"""Series of daily snow heights: its gaps, its spikes, its winters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date, datetime, time, timedelta
from itertools import pairwise

import numpy as np

from netdesign.numerics.arrays import Floats

LONGEST_GAP = 3  # days without a reading inside snow that a straight line may close
LARGEST_RISE = 0.6  # [m] within a day; more is shown as a spike
_FIRST_MONTH = 9  # of a winter: September (northern hemisphere)
_SNOW_MONTHS = (12, 1, 2, 3)  # a gap that holds one of them may hide snow (assumed)


@dataclass(frozen=True, slots=True, kw_only=True)
class HeightSeries:
    """Snow heights of a station, one a day, without a gap.

    Attributes
    ----------
    first_day : date
        Of the first height.
    heights : tuple of float
        HS [m].
    air_temperatures : tuple of float or None
        [K]; None where a day has none.
    filled : tuple of date
        Days without a reading, whose height is that of a straight line.
    """

    first_day: date
    heights: tuple[float, ...]
    air_temperatures: tuple[float | None, ...] = ()
    filled: tuple[date, ...] = ()

    def day(self, index: int) -> date:
        """Date of a height."""
        return self.first_day + timedelta(days=index)

    def place(self, moment: datetime) -> float:
        """Days from the beginning of the first day to a moment [d]."""
        begin = datetime.combine(self.first_day, time())
        return (moment - begin).total_seconds() / 86400.0

    @property
    def days(self) -> tuple[date, ...]:
        """Date of each height."""
        return tuple(map(self.day, range(len(self.heights))))

    @property
    def starts_in_snow(self) -> bool:
        """Snow lies on the first day: nobody knows what fell before."""
        return self.heights[0] > 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Gap:
    """Days without a reading between two readings.

    Attributes
    ----------
    before, after : date
        The readings beside it.
    is_closable : bool
        A straight line, or bare ground, may stand for what was not read.
    """

    before: date
    after: date
    is_closable: bool

    @property
    def days(self) -> tuple[date, ...]:
        """Days that were not read."""
        count = (self.after - self.before).days - 1
        return tuple(self.before + timedelta(days=k + 1) for k in range(count))


def find_gaps(readings: Mapping[date, float]) -> tuple[Gap, ...]:
    """Gaps of a series.

    Parameters
    ----------
    readings : mapping of date to float
        HS [m], dates ascending.
    """
    gaps = []
    for (before, low), (after, high) in pairwise(readings.items()):
        gap = Gap(before=before, after=after, is_closable=True)
        if not gap.days:
            continue
        is_bare = low == high == 0.0
        hides = any(day.month in _SNOW_MONTHS for day in gap.days)
        is_long = len(gap.days) > LONGEST_GAP
        closable = not is_long or (is_bare and not hides)
        gaps.append(Gap(before=before, after=after, is_closable=closable))
    return tuple(gaps)


def build_series(
    readings: Mapping[date, float],
    air_temperatures: Mapping[date, float] | None = None,
) -> HeightSeries:
    """Series without gaps; straight lines stand in them.

    Parameters
    ----------
    readings : mapping of date to float
        HS [m], dates ascending, at least one.
    air_temperatures : mapping of date to float, optional
        [K].
    """
    given = list(readings)
    first, warm = given[0], air_temperatures or {}
    places = [(day - first).days for day in given]
    every = range(places[-1] + 1)
    days = [first + timedelta(days=k) for k in every]
    heights = np.interp(np.array(every), places, list(readings.values()))
    return HeightSeries(
        first_day=first,
        heights=tuple(map(float, heights)),
        air_temperatures=tuple(warm.get(day) for day in days),
        filled=tuple(day for day in days if day not in readings),
    )


def find_spikes(series: HeightSeries) -> tuple[date, ...]:
    """Days on which snow rose by more than ``LARGEST_RISE``.

    Parameters
    ----------
    series : HeightSeries
        Without gaps.
    """
    rises = np.diff(np.array(series.heights))
    return tuple(series.day(int(k) + 1) for k in np.flatnonzero(rises > LARGEST_RISE))


def smooth(series: HeightSeries) -> HeightSeries:
    """Series whose heights are the medians of three days; its ends stay.

    For automatic gauges: each false rise beyond the model's tolerance is a layer of new
    snow that never leaves.

    Parameters
    ----------
    series : HeightSeries
        Without gaps.
    """
    given: Floats = np.array(series.heights)
    heights = given.copy()
    if given.size > 2:
        heights[1:-1] = np.median([given[:-2], given[1:-1], given[2:]], axis=0)
    return HeightSeries(
        first_day=series.first_day,
        heights=tuple(map(float, heights)),
        air_temperatures=series.air_temperatures,
        filled=series.filled,
    )


def name_winter(day: date) -> str:
    """Winter of a day, from September to August, as "1999/2000".

    Parameters
    ----------
    day : date
        Any.

    Examples
    --------
    >>> name_winter(date(2000, 1, 31)), name_winter(date(2000, 9, 1))
    ('1999/2000', '2000/2001')
    """
    first = day.year - (day.month < _FIRST_MONTH)
    return f"{first}/{first + 1}"


def split_winters(series: HeightSeries) -> dict[str, slice]:
    """Days of each winter, by its name, in their order.

    Parameters
    ----------
    series : HeightSeries
        Without gaps.
    """
    names = [name_winter(day) for day in series.days]
    starts = [k for k, name in enumerate(names) if k == 0 or name != names[k - 1]]
    ends = [*starts[1:], len(names)]
    return {names[a]: slice(a, b) for a, b in zip(starts, ends, strict=True)}
