"""Sheet Monitoring: forces and temperatures measured on members of net rows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from itertools import pairwise

from netdesign.site.cells.findings import Finding
from netdesign.site.cells.numbers import read_moment
from netdesign.site.columns.fields import normalise
from netdesign.site.headings import Table
from netdesign.site.lines import refuse_unknown_ids
from netdesign.site.model import Site
from netdesign.site.readings import Row, refuse, refuse_beside
from netdesign.site.tables import read_rows
from netdesign.structure.members import Member
from netdesign.words.message import say

Readings = list[tuple[datetime, float]]

_EPOCH = datetime(1970, 1, 1)
_MEMBERS = {normalise(one): str(one) for one in Member}  # by their words


@dataclass(frozen=True, slots=True, kw_only=True)
class MonitoringSeries:
    """Measurements at one member of one net row.

    Attributes
    ----------
    row_id, member : str
        Net row; ``foot_anchor``, ``uphill_guy``, ``downhill_guy`` or ``post``.
    times : tuple of float
        Ascending, from 0 at the first reading [s].
    tensions : tuple of float or None
        Per anchor [N]; None where a line has none.
    air_temperatures : tuple of float or None
        [K]; None where a line has none.
    source : str
        First cell.
    start : datetime or None
        Of the first reading; None where times are given without a date.
    """

    row_id: str
    member: str
    times: tuple[float, ...]
    tensions: tuple[float | None, ...]
    air_temperatures: tuple[float | None, ...]
    source: str
    start: datetime | None = None

    @property
    def pulls(self) -> Readings:
        """Tensions with their local times, ascending [N]; none without a date."""
        return self._date(self.tensions)

    @property
    def air(self) -> Readings:
        """Air temperatures with their local times [K]; none without a date."""
        return self._date(self.air_temperatures)

    def _date(self, values: Sequence[float | None]) -> Readings:
        if self.start is None:
            return []
        return [
            (self.start + timedelta(seconds=time), value)
            for time, value in zip(self.times, values, strict=True)
            if value is not None
        ]


def read_monitoring(
    table: Table | None, places: Mapping[str, str], findings: list[Finding]
) -> tuple[MonitoringSeries, ...]:
    """Series of the sheet, one for each net row and member; none without the sheet.

    Parameters
    ----------
    table : Table or None
        Sheet Monitoring, if there is one.
    places : mapping of str to str
        Cells of the ids of sheet Rows.
    findings : list of Finding
        Appended to: unknown rows, lines without a time or a measurement, times that
        do not ascend.
    """
    series: dict[tuple[str, str], list[tuple[float, Row]]] = {}
    lines = read_rows(table, findings)
    if places:
        refuse_unknown_ids((line["row"] for line in lines), places, findings)
    for line in lines:
        name, member = line["row"], line["member"]
        time = _read_time(line, findings)
        if time is None or not name.word or not member.word:
            continue
        if line["tension"].state == line["temperature"].state == "blank":
            rule = say("measured.no_measurement")
            refuse(name, rule, say("measured.accepted"), findings)
        key = (name.word, _MEMBERS[normalise(member.word)])
        series.setdefault(key, []).append((time, line))
    return tuple(_build(key, lines, findings) for key, lines in series.items())


def _build(
    key: tuple[str, str], lines: list[tuple[float, Row]], findings: list[Finding]
) -> MonitoringSeries:
    first, head = lines[0]
    is_dated = head["date"].state == "given"
    for (before, _), (after, line) in pairwise(lines):
        place = line["time"] if line["time"].state == "given" else line["date"]
        if (line["date"].state == "given") != is_dated:
            rule = say("measured.mixed")
            refuse(place, rule, say("measured.one_kind"), findings)
        elif after <= before:
            rule = say("measured.not_after")
            refuse(place, rule, say("measured.ascending"), findings)
    return MonitoringSeries(
        row_id=key[0],
        member=key[1],
        times=tuple(time - first for time, _ in lines),
        tensions=tuple(line["tension"].given_si for _, line in lines),
        air_temperatures=tuple(line["temperature"].given_si for _, line in lines),
        source=head["row"].place,
        start=_EPOCH + timedelta(seconds=first) if is_dated else None,
    )


def _read_time(line: Row, findings: list[Finding]) -> float | None:
    """Time of a line [s], from days or a date; None with a finding."""
    days, moment = line["time"], line["date"]
    if "faulty" in (days.state, moment.state):
        return None
    if days.state == moment.state == "given":
        refuse_beside(moment, days, findings)
    elif days.state == "given":
        return days.si
    elif moment.state == "given":
        local = read_moment(moment.word).replace(tzinfo=None)
        return (local - _EPOCH).total_seconds()
    else:
        seen = next(x for x in (days, moment, line["row"]) if x.cell is not None)
        rule = say("cell.neither", names=(days.field.name, moment.field.name))
        refuse(seen, rule, say("accepted.exactly_one"), findings)
    return None


def list_monitoring(site: Site, row_id: str) -> tuple[MonitoringSeries, ...]:
    """Series that sheet Monitoring has of a net row."""
    of_site: tuple[MonitoringSeries, ...] = site.of_addons.get("Monitoring", ())
    return tuple(series for series in of_site if series.row_id == row_id)
