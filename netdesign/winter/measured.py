"""Forces measured at one member of a row, on the days of a series of heights."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime

from netdesign.snowpack.series import HeightSeries


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredPulls:
    """Readings at one member of a row.

    Attributes
    ----------
    member : str
        As in ``RowDay.member_forces``.
    moments : tuple of datetime, shape (n,)
        Ascending, local time.
    forces : tuple of float, shape (n,)
        Per anchor [N].
    source : str
        First cell; "" of pulls made up.
    air_temperatures : tuple of (datetime, float)
        Read beside them [K].
    """

    member: str
    moments: tuple[datetime, ...]
    forces: tuple[float, ...]
    source: str = ""
    air_temperatures: tuple[tuple[datetime, float], ...] = ()

    def list_days(self, series: HeightSeries) -> tuple[float, ...]:
        """Moment of each reading as days since a series began, shape (n,) [d].

        Parameters
        ----------
        series : HeightSeries
            Of the station.
        """
        return tuple(map(series.place, self.moments))

    def average_days(self, series: HeightSeries) -> Mapping[int, float]:
        """Mean force of each day [N], by its place in a station's series.

        Days outside the series are left out.

        Parameters
        ----------
        series : HeightSeries
            Of the station.
        """
        groups: dict[int, list[float]] = {}
        for moment, force in zip(self.moments, self.forces, strict=True):
            place = (moment.date() - series.first_day).days
            if 0 <= place < len(series.heights):
                groups.setdefault(place, []).append(force)
        return {k: sum(forces) / len(forces) for k, forces in groups.items()}
