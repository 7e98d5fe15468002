"""Winters of a row: maxima, curves with their governing days, what they tell together.

Theory: addons/winter/THEORY.md, section 2.
"""

from __future__ import annotations

from bisect import bisect
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from datetime import date
from functools import cached_property

import numpy as np

from netdesign.addons.winter.day import DaySolver, RowDay, WinterRow
from netdesign.addons.winter.heights import HeightSeries, split_winters
from netdesign.addons.winter.maxima import (
    AnnualMaximum,
    find_annual_maximum,
    find_equivalent,
    find_largest,
    find_many_maxima,
)
from netdesign.addons.winter.settling import (
    DayPack,
    SettlingModel,
    follow_heights,
)
from netdesign.addons.winter.statistics import Sample
from netdesign.addons.winter.uniform_table import UniformTable

HIGH_SHARE = 0.9  # of the largest pull: days above it count as days of high load
CURVE_STEP = 4  # days between those of the curve
# Layers pull at most so many times what uniform snow of their mass does (seen: 1.13).
LAYERED_GAIN = 1.15
# Between two solved days so near to each other [d], and as dense as that, it is at most
# so much above theirs.
_NEAR, _AS_DENSE, _BETWEEN = 8, 0.1, 0.1
_BATCH = 8


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Season:
    """Winter of a row, day by day with its layers.

    Attributes
    ----------
    name : str
        As "1999/2000".
    maximum : AnnualMaximum
        By uniform snow of each day, which usually pulls more than layers.
    curve : tuple of RowDay
        Ascending: those of the curve, and those that may govern.
    highest : RowDay
        Day of the largest snow height.
    days : slice
        Of the winter in the series of heights.
    equivalent_density : float or None
        Of uniform snow of the largest height that pulls as much as the governing day
        [kg/m3]; None where there is none.
    """

    name: str
    maximum: AnnualMaximum
    curve: tuple[RowDay, ...]
    highest: RowDay
    days: slice
    equivalent_density: float | None

    @property
    def governing(self) -> RowDay | None:
        """Day of the largest foot pull; None if no day has one."""
        return find_largest(self.curve)

    @property
    def high_days(self) -> int:
        """Days above ``HIGH_SHARE`` of the largest pull, read from the curve."""
        points = [(day.index, day.pull) for day in self.curve if day.pull is not None]
        if not points:
            return 0
        places, pulls = np.array(points).T
        every = np.arange(places[0], places[-1] + 1)
        curve = np.interp(every, places, pulls)
        return int((curve > HIGH_SHARE * pulls.max()).sum())


def follow_season(
    name: str,
    packs: Mapping[int, DayPack],
    solver: DaySolver,
    step: int = CURVE_STEP,
    table: UniformTable | None = None,
) -> Season:
    """Season of a row: its annual maximum, and the curve of its forces.

    Parameters
    ----------
    name : str
        Of the winter.
    packs : mapping of int to DayPack
        Snowpack of each day by its place in the series, ascending; at least one.
    solver : DaySolver
        Of the row.
    step : int
        Days between those of the curve; 0 for the days near the maximum alone.
    table : UniformTable, optional
        Of the row: days of uniform snow are read from it.
    """
    maximum, uniform = find_annual_maximum(name, packs, solver, table=table)
    highest = max(packs, key=lambda k: packs[k].height)
    heaviest = max(packs, key=lambda k: packs[k].mass)
    evenly = set(list(packs)[::step]) if step else set()
    wanted = sorted(evenly | {highest, heaviest})
    curve = _solve_coarsely({k: packs[k] for k in wanted}, solver)
    curve = _sharpen(_solve_near(uniform, curve, packs, solver), solver)
    governing = find_largest(curve.values())
    top = curve[highest].thickness
    return Season(
        name=name,
        maximum=maximum,
        curve=tuple(curve[k] for k in sorted(curve)),
        highest=curve[highest],
        days=slice(min(packs), max(packs) + 1),
        equivalent_density=(
            find_equivalent(top, governing, solver) if governing else None
        ),
    )


def _solve_near(
    uniform: Sequence[RowDay],
    curve: Mapping[int, RowDay],
    packs: Mapping[int, DayPack],
    solver: DaySolver,
) -> dict[int, RowDay]:
    """Curve with all days that may govern, the likeliest first."""
    pulls = {day.index: day.foot.value for day in uniform if day.foot}
    prepared = solver.prepare({k: packs[k] for k in pulls}, layered=True)
    solved = dict(curve)
    left = {
        day.index: day
        for day in prepared
        if day.index not in curve or curve[day.index].reason is not None
    }
    while left:
        best = find_largest(solved.values())
        gains = {
            k: day.foot.value / pulls[k]
            for k, day in sorted(solved.items())
            if k in pulls and day.foot
        }
        most = {
            k: pulls[k] * (_find_gain(day, solved, gains) if day.layers else 1.0)
            for k, day in left.items()
        }
        least = best.foot.low if best and best.foot else 0.0
        order = sorted(left, key=lambda k: -most[k])
        batch = [k for k in order[:_BATCH] if most[k] >= least]
        if not batch:
            break
        near = {k: packs[k] for k in batch}
        left = {k: day for k, day in left.items() if k not in near}
        solved |= _solve_coarsely(near, solver)
        # what may govern is not given up for a coarse accuracy
        failed = {k: pack for k, pack in near.items() if solved[k].reason}
        again = solver.solve(solver.prepare(failed, layered=True))
        solved |= {day.index: day for day in again}
    return solved


def _find_gain(
    day: RowDay, solved: Mapping[int, RowDay], gains: Mapping[int, float]
) -> float:
    """Most by which the layers of a day may pull more than its uniform snow.

    The gains of the two nearest solved days bound it, if these lie within 8 days of
    each other and their densities within a tenth of the day's; otherwise
    ``LAYERED_GAIN`` does. ``gains`` ascends by day.
    """
    places = list(gains)
    after = bisect(places, day.index)
    around = places[max(after - 1, 0) : after + 1]
    is_alike = (
        len(around) == 2
        and around[1] - around[0] <= _NEAR
        and all(abs(solved[k].density / day.density - 1.0) <= _AS_DENSE for k in around)
    )
    if not is_alike:
        return LAYERED_GAIN
    return min(LAYERED_GAIN, (1.0 + _BETWEEN) * max(gains[k] for k in around))


def _solve_coarsely(
    packs: Mapping[int, DayPack], solver: DaySolver
) -> dict[int, RowDay]:
    """Layered days to the accuracy of a curve."""
    solved = solver.coarse.solve(solver.prepare(packs, layered=True))
    return {day.index: day for day in solved}


def _sharpen(curve: Mapping[int, RowDay], solver: DaySolver) -> dict[int, RowDay]:
    """Curve whose largest forces, of the net and of each member, are accurate.

    Days are solved again while one that was not may have the largest of some force.
    """
    sharpened = dict(curve)
    left = {k: day for k, day in curve.items() if day.ending == "solved"}
    while doubtful := _list_doubtful(sharpened, left.keys()):
        days = solver.solve([left.pop(k).unsolved for k in sorted(doubtful)])
        sharpened |= {day.index: day for day in days}
    return sharpened


def _list_doubtful(days: Mapping[int, RowDay], left: Collection[int]) -> set[int]:
    """Days that may have the largest of some force: of each force the likeliest.

    Of those ``left`` whose band reaches above that of all accurate days, and above the
    largest value, the one with the highest: once it is accurate, others may no longer
    be in doubt.
    """
    tops: dict[str, float] = {}
    for place, day in days.items():
        for name, band in day.bands.items():
            top = band.value if place in left else band.high
            tops[name] = max(top, tops.get(name, 0.0))
    likeliest: dict[str, tuple[float, int]] = {}
    for place in left:
        for name, band in days[place].bands.items():
            if band.high > tops[name]:
                best = likeliest.get(name, (0.0, place))
                likeliest[name] = max(best, (band.high, place))
    return {place for _, place in likeliest.values()}


FIRST_DENSITY = 300.0  # of snow that lies on the first day of a series [kg/m3]; assumed
MANY = 4  # more winters than these go through a table
SHOWN = 3  # largest winters of a table that are solved with their layers
# A winter counts in statistics if its series covers these months and days (assumed).
_COVERED = ((12, 1), (4, 30))


@dataclass(frozen=True, kw_only=True, eq=False)
class StationPacks:
    """Snowpacks of a station's winters, the same for all rows.

    Attributes
    ----------
    series : HeightSeries
        Of the station.
    models : sequence of SettlingModel
        At least one; the first is that of the curves.
    """

    series: HeightSeries
    models: Sequence[SettlingModel]

    @cached_property
    def packs(self) -> Mapping[str, Mapping[str, Mapping[int, DayPack]]]:
        """Packs by settling model, then by winter, then by place in the series."""
        return {model.name: split_packs(self.series, model) for model in self.models}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RowWinters:
    """Winters of one row by one settling model.

    Attributes
    ----------
    row : WinterRow
        As loaded.
    station : StationPacks
        Snow from which they come.
    model : str
        Name of the settling model.
    maxima : tuple of AnnualMaximum
        One of each winter, in their order.
    seasons : tuple of Season
        Winters with their layers: all of a few, else the largest.
    others : mapping of str to tuple of AnnualMaximum
        The same winters by the other settling models.
    sample : Sample
        Complete winters, with the distribution of their maxima.
    """

    row: WinterRow
    station: StationPacks
    model: str
    maxima: tuple[AnnualMaximum, ...]
    seasons: tuple[Season, ...]
    others: Mapping[str, tuple[AnnualMaximum, ...]]
    sample: Sample

    @property
    def density_range(self) -> tuple[float, float] | None:
        """Least and largest equivalent density of winters not cut, all models [kg/m3].

        None where no winter is left.
        """
        every = [
            *self.maxima,
            *(maximum for group in self.others.values() for maximum in group),
        ]
        cut = self.station.series.cut
        densities = [
            maximum.equivalent_density
            for maximum in every
            if maximum.equivalent_density and maximum.winter not in cut
        ]
        return (min(densities), max(densities)) if densities else None


def split_packs(
    series: HeightSeries, model: SettlingModel
) -> dict[str, dict[int, DayPack]]:
    """Packs of each winter with snow, by its name and by their place in the series.

    Parameters
    ----------
    series : HeightSeries
        Of the station.
    model : SettlingModel
        Followed over the whole series: snow of last winter goes on settling.
    """
    packs = follow_heights(series.heights, model, FIRST_DENSITY)
    return {
        name: dict(list(enumerate(packs))[days])
        for name, days in split_winters(series).items()
        if any(pack.heights.size for pack in packs[days])
    }


def list_complete(series: HeightSeries) -> tuple[str, ...]:
    """Names of the winters whose months with snow the series covers to bare ground.

    Parameters
    ----------
    series : HeightSeries
        Of the station.
    """
    first, last = series.first_day, series.day(len(series.heights) - 1)
    complete = []
    for name in split_winters(series):
        year = int(name[:4])
        start, end = date(year, *_COVERED[0]), date(year + 1, *_COVERED[1])
        if first <= start and end <= last and name not in series.cut:
            complete.append(name)
    return tuple(complete)


def follow_winters(
    station: StationPacks,
    solver: DaySolver,
    step: int = CURVE_STEP,
    measured: Collection[str] = (),
) -> RowWinters:
    """Winters of a row: by the first model with layers, by the others their maxima.

    Parameters
    ----------
    station : StationPacks
        By at least one model.
    solver : DaySolver
        Of the row.
    step : int
        Days between those of a curve.
    measured : collection of str
        Winters that have a curve in any case.
    """
    chosen, *rest = station.packs
    packs = station.packs[chosen]
    names, is_many = list(packs), len(packs) > MANY
    groups = station.packs
    if not is_many:  # those of the first model come with their curves
        groups = {model: groups[model] for model in rest}
    maxima, table = find_many_maxima(groups, solver, by_table=is_many)
    if is_many:
        ranked = sorted(maxima[chosen], key=lambda maximum: -maximum.foot)[:SHOWN]
        largest = {maximum.winter for maximum in ranked if maximum.index is not None}
        names = sorted(largest | (set(measured) & packs.keys()))
    seasons = tuple(
        follow_season(name, packs[name], solver, step, table) for name in names
    )
    if not is_many:
        maxima[chosen] = tuple(season.maximum for season in seasons)
    complete = list_complete(station.series)
    sample = [maximum for maximum in maxima[chosen] if maximum.winter in complete]
    return RowWinters(
        row=solver.row,
        station=station,
        model=chosen,
        maxima=maxima[chosen],
        seasons=seasons,
        others={model: maxima[model] for model in rest},
        sample=Sample(maxima=tuple(sample)),
    )
