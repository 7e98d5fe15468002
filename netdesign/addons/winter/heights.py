"""Series of daily snow heights with its gaps, spikes and winters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from datetime import date, datetime, time, timedelta
from itertools import pairwise

import numpy as np

from netdesign.numerics.arrays import Floats

LONGEST_GAP = 3  # days without a reading inside snow that a straight line may close
LARGEST_RISE = 0.6  # [m] within a day; more is shown as a spike, a fall by it too
# A gauge hardly shows one height in snow for so many days, nor bare ground a day after
# so much snow: a winter with either is incomplete (assumed).
_STILL_DAYS, _STILL_HEIGHT, _LOST_HEIGHT = 30, 0.1, 1.0
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
        Days without a reading, whose height is that of a straight line, or 0 between
        two winters.
    cut : tuple of str
        Winters whose readings end in snow, or whose gauge stood still or lost its snow
        in a day: incomplete.
    """

    first_day: date
    heights: tuple[float, ...]
    air_temperatures: tuple[float | None, ...] = ()
    filled: tuple[date, ...] = ()
    cut: tuple[str, ...] = ()

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


@dataclass(frozen=True, slots=True, kw_only=True)
class Gap:
    """Days without a reading between two readings.

    Attributes
    ----------
    before, after : date
        The readings beside it.
    days : tuple of date
        Days that were not read.
    is_closable : bool
        A straight line, or bare ground, may stand for what was not read.
    is_between : bool
        Longer than a line may close, from late snow of a winter to bare ground before
        another: no snow stands in it.
    """

    before: date
    after: date
    days: tuple[date, ...]
    is_closable: bool
    is_between: bool


def find_gaps(readings: Mapping[date, float]) -> tuple[Gap, ...]:
    """Gaps of a series.

    Parameters
    ----------
    readings : mapping of date to float
        HS [m], dates ascending.
    """
    gaps = []
    for (before, low), (after, high) in pairwise(readings.items()):
        places = range(1, (after - before).days)
        days = tuple(before + timedelta(days=place) for place in places)
        if not days:
            continue
        snowy = [name_winter(day) for day in days if day.month in _SNOW_MONTHS]
        is_long, winter = len(days) > LONGEST_GAP, name_winter(after)
        is_over = low > high == 0.0 and name_winter(before) != winter
        is_between = is_long and is_over and winter not in snowy
        is_bare = low == high == 0.0 and not snowy
        gaps.append(
            Gap(
                before=before,
                after=after,
                days=days,
                is_closable=not is_long or is_bare or is_between,
                is_between=is_between,
            )
        )
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
    measured = list(readings)
    first, warm = measured[0], air_temperatures or {}
    places = [(day - first).days for day in measured]
    every = range(places[-1] + 1)
    days = [first + timedelta(days=k) for k in every]
    heights = np.interp(np.array(every), places, list(readings.values()))
    between = [gap for gap in find_gaps(readings) if gap.is_between]
    for gap in between:
        heights[(gap.before - first).days + 1 : (gap.after - first).days] = 0.0
    ends = [*(gap.before for gap in between), measured[-1]]
    series = HeightSeries(
        first_day=first,
        heights=tuple(map(float, heights)),
        air_temperatures=tuple(warm.get(day) for day in days),
        filled=tuple(day for day in days if day not in readings),
    )
    doubtful = [day for day in ends if readings[day] > 0.0]
    gaps = {gap.days[0] for gap in between}
    doubtful += [day for day in find_losses(series) if day not in gaps]
    doubtful += find_stills(series)
    cut = dict.fromkeys(name_winter(day) for day in sorted(doubtful))
    return replace(series, cut=tuple(cut))


def find_losses(series: HeightSeries) -> tuple[date, ...]:
    """Bare days after one with more than ``_LOST_HEIGHT`` of snow.

    Parameters
    ----------
    series : HeightSeries
        Without gaps.
    """
    heights = np.array(series.heights)
    lost = (heights[:-1] > _LOST_HEIGHT) & (heights[1:] <= 0.0)
    return tuple(series.day(int(k) + 1) for k in np.flatnonzero(lost))


def find_stills(series: HeightSeries) -> tuple[date, ...]:
    """First days of ``_STILL_DAYS`` or more on which the same height of snow was read.

    Parameters
    ----------
    series : HeightSeries
        Without gaps.
    """
    heights = np.array(series.heights)
    starts = np.flatnonzero(np.diff(heights, prepend=np.nan) != 0.0)
    lengths = np.diff(starts, append=heights.size)
    still = (lengths >= _STILL_DAYS) & (heights[starts] > _STILL_HEIGHT)
    return tuple(series.day(int(k)) for k in starts[still])


def find_spikes(series: HeightSeries) -> tuple[date, ...]:
    """Days on which snow rose or fell by more than ``LARGEST_RISE``.

    Parameters
    ----------
    series : HeightSeries
        Without gaps.
    """
    steps = np.abs(np.diff(np.array(series.heights)))
    return tuple(series.day(int(k) + 1) for k in np.flatnonzero(steps > LARGEST_RISE))


def smooth(series: HeightSeries) -> HeightSeries:
    """Series whose heights are the medians of three days; its ends stay.

    For automatic gauges: each false rise beyond the model's tolerance is a layer of new
    snow that never leaves.

    Parameters
    ----------
    series : HeightSeries
        Without gaps.
    """
    measured: Floats = np.array(series.heights)
    heights = measured.copy()
    if measured.size > 2:
        heights[1:-1] = np.median([measured[:-2], measured[1:-1], measured[2:]], axis=0)
    return replace(series, heights=tuple(map(float, heights)))


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
