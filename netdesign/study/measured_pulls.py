"""Measured forces of sheet Monitoring, as winters take them: on their dates."""

from __future__ import annotations

from datetime import timedelta

from netdesign.site.model import MonitoringSeries, Site
from netdesign.winter.measured import MeasuredPulls


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


def list_undated(site: Site) -> tuple[str, ...]:
    """First cells of the measured forces whose times have no date.

    Parameters
    ----------
    site : Site
        Whose sheet Monitoring was read.
    """
    return tuple(one.source for one in site.monitoring if one.start is None)


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
    )
