"""Net row of a site as winters load it, and what was measured on it.

Friction and inclination stand in the middle of their ranges, all else is as designed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import timedelta

from netdesign.addons.winter.day import WinterRow
from netdesign.addons.winter.measured import Comparison, MeasuredPulls, compare_season
from netdesign.addons.winter.season import RowWinters
from netdesign.envelope.ranges import Case
from netdesign.outcome import ModelError
from netdesign.site.further_sheets import MonitoringSeries
from netdesign.site.model import NetRow, Site, StationWinter
from netdesign.snow.creep_law import BOUTILLIER_2004
from netdesign.snowpack.series import HeightSeries, name_winter
from netdesign.study.row_to_check import build_scene
from netdesign.words.message import Message, say

ASSUMED_FACTOR = 1.0  # snow height at the rows over the station's, where none is given
# Largest height of a series over the design height: beyond, metres may be centimetres.
_PLAUSIBLE = (0.15, 15.0)


def build_winter_row(site: Site, row: NetRow, winter: StationWinter) -> WinterRow:
    """Row with the middle of friction angle and inclination of the site's ranges.

    Raises
    ------
    ModelError
        If the model refuses the row.
    """
    case = Case(
        density=_find_middle(site, "density"),
        friction_angle=_find_middle(site, "friction_angle"),
        inclination=_find_middle(site, "inclination"),
    )
    # winters are compared with what was measured: on the ground as it is
    scene = replace(build_scene(row, case, BOUTILLIER_2004), ground=row.ground)
    return WinterRow(
        id=row.id,
        scene=scene,
        layout=row.layout,
        height_factor=winter.find_factor(row.id) or ASSUMED_FACTOR,
    )


def _find_middle(site: Site, name: str) -> float:
    interval = site.ranges[name]  # of all rows
    return (interval.low + interval.high) / 2.0


def require_plausible_heights(
    rows: Sequence[WinterRow], designed: Sequence[NetRow], winter: StationWinter
) -> None:
    """Refuse heights of which metres may have been taken for centimetres.

    Raises
    ------
    ModelError
        Naming the first row that they do not fit.
    """
    highest = max(winter.series.heights)
    for row, net_row in zip(rows, designed, strict=True):
        share = row.find_thickness(highest) / net_row.snow_thickness
        if not _PLAUSIBLE[0] <= share <= _PLAUSIBLE[1]:
            raise ModelError(
                say(
                    "winter_sheet.unlikely_heights",
                    highest=highest,
                    row=row.id,
                    share=share,
                )
            )


def list_measured_pulls(site: Site, row_id: str) -> tuple[MeasuredPulls, ...]:
    """Forces measured on a row, one value for each member.

    Readings without a date, and series of air temperature alone, are left out.

    Parameters
    ----------
    site : Site
        Whose sheet Monitoring was read.
    row_id : str
        Of the row.
    """
    found = [_date_readings(one) for one in site.monitoring if one.row_id == row_id]
    return tuple(one for one in found if one is not None and one.forces)


def name_measured_winters(pulls: Sequence[MeasuredPulls]) -> frozenset[str]:
    """Winters with readings, as "1999/2000".

    Parameters
    ----------
    pulls : sequence of MeasuredPulls
        Of a row.
    """
    days = {moment.date() for one in pulls for moment in one.moments}
    return frozenset(map(name_winter, days))


def compare_row(
    pulls: Sequence[MeasuredPulls],
    winters: RowWinters,
    row: WinterRow,
    series: HeightSeries,
) -> tuple[Comparison, ...]:
    """Readings of a row beside its curves, winter by winter and member by member.

    Parameters
    ----------
    pulls : sequence of MeasuredPulls
        Of the row.
    winters : RowWinters
        With the curves of the measured winters.
    row : WinterRow
        As loaded.
    series : HeightSeries
        Of the station.
    """
    found = [
        compare_season(one, season, row, series)
        for season in winters.seasons
        for one in pulls
    ]
    return tuple(one for one in found if one is not None)


def explain_unused(
    site: Site, row_id: str, compared: Sequence[Comparison]
) -> tuple[Message, ...]:
    """Reasons why measured forces of a row stand beside no curve.

    Parameters
    ----------
    site : Site
        With what was measured.
    row_id : str
        Of the row.
    compared : sequence of Comparison
        What stands beside a curve.
    """
    told = []
    used = {one.pulls.source for one in compared if one.computed}
    for series in site.monitoring:
        if series.row_id != row_id or series.source in used:
            continue
        if not any(force is not None for force in series.tensions):
            continue
        key = "monitoring.undated" if series.start is None else "monitoring.outside"
        told.append(say(key, place=series.source))
    return tuple(told)


def _date_readings(series: MonitoringSeries) -> MeasuredPulls | None:
    if series.start is None:
        return None
    known = [
        (series.start + timedelta(seconds=time), force)
        for time, force in zip(series.times, series.tensions, strict=True)
        if force is not None
    ]
    return MeasuredPulls(
        member=series.member,
        moments=tuple(moment for moment, _ in known),
        forces=tuple(force for _, force in known),
        source=series.source,
        air_temperatures=tuple(
            (series.start + timedelta(seconds=time), kelvin)
            for time, kelvin in zip(series.times, series.air_temperatures, strict=True)
            if kelvin is not None
        ),
    )
