"""Measured series of a net row, in the units of a study."""

from __future__ import annotations

from netdesign.site.further_sheets import MonitoringSeries
from netdesign.site.model import NetRow, Site
from netdesign.study.records import MonitoringRecord
from netdesign.units import celsius_from_kelvin, day_from_second, kilonewton_if_known
from netdesign.words.message import Message, say


def record_monitoring(site: Site, row: NetRow) -> list[MonitoringRecord]:
    """Measured series of a net row; nothing is solved for them.

    Parameters
    ----------
    site : Site
        With its sheets Monitoring and Winter, where it has them.
    row : NetRow
        One of its rows.
    """
    of_row = (one for one in site.monitoring if one.row_id == row.id)
    return [_record(one, _describe_model(one, site)) for one in of_row]


def _describe_model(series: MonitoringSeries, site: Site) -> Message:
    """Place where the model's forces stand, or what they need."""
    if site.winter is None:
        return say("monitoring.needs_winter")
    if series.start is None:
        return say("monitoring.undated", place=series.source)
    return say("monitoring.see_winter")


def _record(series: MonitoringSeries, model: Message) -> MonitoringRecord:
    return MonitoringRecord(
        member=series.member,
        source=series.source,
        times_d=[day_from_second(time) for time in series.times],
        tensions_kN=[kilonewton_if_known(value) for value in series.tensions],
        air_temperatures_C=[
            None if value is None else celsius_from_kelvin(value)
            for value in series.air_temperatures
        ],
        model=model,
    )
