"""All winters of a row: maxima, some with a curve, and what they tell together."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from datetime import date

from netdesign.snowpack.follow import SettlingModel, follow_heights
from netdesign.snowpack.pack import DayPack
from netdesign.snowpack.series import HeightSeries, split_winters
from netdesign.winter.day import DaySolver
from netdesign.winter.gumbel import Gumbel, fit_gumbel
from netdesign.winter.maxima import AnnualMaximum, find_annual_maximum, find_many_maxima
from netdesign.winter.season import CURVE_STEP, Season, follow_season
from netdesign.winter.trend import Trend, find_trend

FIRST_DENSITY = 300.0  # of snow that lies on the first day of a series [kg/m3]; assumed
MANY = 4  # more winters than these go through a table
SHOWN = 3  # largest winters of a table that are solved with their layers
# A winter counts in statistics if its series covers these months and days (assumed).
_COVERED = ((12, 1), (4, 30))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StationPacks:
    """Snowpacks of a station's winters, the same for all rows.

    Attributes
    ----------
    series : HeightSeries
        Of the station.
    packs : mapping of str to mapping
        By settling model, then by winter, then by place in the series; the first model
        is that of the curves.
    """

    series: HeightSeries
    packs: Mapping[str, Mapping[str, Mapping[int, DayPack]]]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RowWinters:
    """Winters of one row by one settling model.

    Attributes
    ----------
    row_id, model : str
        Row, and name of the settling model.
    maxima : tuple of AnnualMaximum
        One of each winter, in their order.
    seasons : tuple of Season
        Winters with their layers: all of a few, else the largest.
    others : mapping of str to tuple of AnnualMaximum
        The same winters by the other settling models.
    statistics : Gumbel or None
        Of the complete winters with a proven maximum [N/m]; None of fewer than
        ``gumbel.LEAST_WINTERS``, or where a complete winter proves none.
    trend : Trend or None
        Of the same winters [N/m]; None of fewer than ``trend.LEAST_FOR_TREND``.
    """

    row_id: str
    model: str
    maxima: tuple[AnnualMaximum, ...]
    seasons: tuple[Season, ...]
    others: Mapping[str, tuple[AnnualMaximum, ...]]
    statistics: Gumbel | None
    trend: Trend | None

    @property
    def density_range(self) -> tuple[float, float] | None:
        """Least and largest equivalent density of all winters and models [kg/m3]."""
        every = [
            *self.maxima,
            *(one for group in self.others.values() for one in group),
        ]
        found = [one.equivalent_density for one in every if one.equivalent_density]
        return (min(found), max(found)) if found else None


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
    winters = {
        name: {k: packs[k] for k in range(days.start, days.stop)}
        for name, days in split_winters(series).items()
    }
    return {
        name: days
        for name, days in winters.items()
        if any(pack.heights.size for pack in days.values())
    }


def list_complete(series: HeightSeries) -> tuple[str, ...]:
    """Names of the winters whose months with snow the series covers.

    Parameters
    ----------
    series : HeightSeries
        Of the station.
    """
    first, last = series.first_day, series.day(len(series.heights) - 1)
    found = []
    for name in split_winters(series):
        year = int(name[:4])
        start, end = date(year, *_COVERED[0]), date(year + 1, *_COVERED[1])
        if first <= start and end <= last:
            found.append(name)
    return tuple(found)


def follow_station(
    series: HeightSeries, models: Sequence[SettlingModel]
) -> StationPacks:
    """Packs of a station's winters by some settling models.

    Parameters
    ----------
    series : HeightSeries
        Of the station.
    models : sequence of SettlingModel
        At least one; the first is that of the curves.
    """
    return StationPacks(
        series=series, packs={one.name: split_packs(series, one) for one in models}
    )


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
    maxima: dict[str, tuple[AnnualMaximum, ...]] = {}
    names = list(packs)
    if len(packs) > MANY:
        maxima = find_many_maxima(station.packs, solver)
        ranked = sorted(maxima[chosen], key=lambda one: -one.foot)[:SHOWN]
        largest = {one.winter for one in ranked if one.index is not None}
        names = sorted(largest | (set(measured) & packs.keys()))
    seasons = tuple(follow_season(name, packs[name], solver, step) for name in names)
    if not maxima:
        maxima = {one: _find_maxima(station.packs[one], solver) for one in rest}
        maxima[chosen] = tuple(season.maximum for season in seasons)
    counted = _count(maxima[chosen], list_complete(station.series))
    pulls = [one.foot for one in counted]
    return RowWinters(
        row_id=solver.row.id,
        model=chosen,
        maxima=maxima[chosen],
        seasons=seasons,
        others={one: maxima[one] for one in rest},
        statistics=fit_gumbel(pulls),
        trend=find_trend([int(one.winter[:4]) for one in counted], pulls),
    )


def _find_maxima(
    packs: Mapping[str, Mapping[int, DayPack]], solver: DaySolver
) -> tuple[AnnualMaximum, ...]:
    return tuple(
        find_annual_maximum(name, one, solver)[0] for name, one in packs.items()
    )


def _count(
    maxima: Sequence[AnnualMaximum], complete: Sequence[str]
) -> list[AnnualMaximum]:
    """Maxima of the complete winters; none where one of these is not proven."""
    counted = [one for one in maxima if one.winter in complete]
    return counted if all(one.is_proven for one in counted) else []
