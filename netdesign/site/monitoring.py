"""Sheet Monitoring: measured anchor tension and air temperature against time."""

from __future__ import annotations

from collections.abc import Collection
from datetime import datetime
from itertools import pairwise

from netdesign.site.cells import Workbook
from netdesign.site.diagnostics import Finding, add_nearest
from netdesign.site.fields import Field, SheetPlan
from netdesign.site.model import MonitoringSeries
from netdesign.site.readings import Reading, Row, refuse
from netdesign.site.tables import find_table, read_rows
from netdesign.units import SECONDS_PER_DAY, kelvin_from_celsius

MONITORING = SheetPlan(
    name="Monitoring",
    aliases=("Mesures", "Messungen"),
    fields=(
        Field(
            key="row",
            label="net row",
            aliases=("rangée", "filet", "Netzreihe", "Werkreihe"),
            kind="id",
            required=True,
            note="an id of sheet Nets",
        ),
        Field(
            key="member",
            label="member",
            aliases=("élément", "organe", "Bauteil"),
            kind="word",
            required=True,
            words={
                "foot_anchor": ("foot anchor", "ancrage de pied", "Fußanker"),
                "uphill_guy": (
                    *("uphill guy", "uphill anchor", "hauban amont", "ancrage amont"),
                    *("bergseitiges Seil", "bergseitiger Anker"),
                ),
                "downhill_guy": (
                    *("downhill guy", "downhill anchor", "hauban aval"),
                    *("ancrage aval", "talseitiges Seil", "talseitiger Anker"),
                ),
                "post": ("poteau", "Stütze"),
            },
        ),
        Field(
            key="time",
            label="time",
            aliases=("temps", "Zeit"),
            units=("d",),
            bounds=(0.0, 3650.0),
            note="days; or date and time in a column of its own",
        ),
        Field(
            key="date",
            label="date and time",
            aliases=("date", "date et heure", "Datum", "Zeitpunkt"),
            kind="text",
            note="2003-02-18 06:00",
        ),
        Field(
            key="tension",
            label="tension",
            aliases=("force", "effort", "Zugkraft", "Kraft"),
            units=("kN",),
            bounds=(0.0, 5000.0),
        ),
        Field(
            key="temperature",
            label="air temperature",
            aliases=("température de l'air", "Lufttemperatur"),
            units=("degC",),
            bounds=(-60.0, 50.0),
        ),
    ),
)


def read_monitoring(
    workbook: Workbook, row_ids: Collection[str], findings: list[Finding]
) -> tuple[MonitoringSeries, ...]:
    """Series of the sheet, one for each net row and member; none without the sheet.

    Parameters
    ----------
    workbook : Workbook
        As read.
    row_ids : collection of str
        Ids of sheet Nets.
    findings : list of Finding
        Appended to: unknown rows, lines without a time or a measurement, times that
        do not ascend.
    """
    table = find_table(workbook, MONITORING, findings)
    series: dict[tuple[str, str], list[tuple[float, Row]]] = {}
    for line in read_rows(table, findings) if table else ():
        name, member = line["row"], line["member"]
        if row_ids and name.word and name.word not in row_ids:
            accepted = add_nearest("an id of sheet Nets", name.word, row_ids)
            refuse(name, "is no id of sheet Nets", accepted, findings)
        time = _read_time(line, findings)
        if time is None or not name.word or not member.word:
            continue
        if line["tension"].state == line["temperature"].state == "blank":
            refuse(name, "begins a line without a measurement", _MEASURED, findings)
        series.setdefault((name.word, member.word), []).append((time, line))
    return tuple(_build(key, lines, findings) for key, lines in series.items())


_MEASURED = "a tension, an air temperature, or both"


def _build(
    key: tuple[str, str], lines: list[tuple[float, Row]], findings: list[Finding]
) -> MonitoringSeries:
    first = lines[0][0]
    for (before, _), (after, line) in pairwise(lines):
        if after <= before:
            place = line["time"] if line["time"].state == "given" else line["date"]
            refuse(place, "is not after the line before", "times ascending", findings)
    return MonitoringSeries(
        row_id=key[0],
        member=key[1],
        times=tuple(time - first for time, _ in lines),
        tensions=tuple(_value(line["tension"]) for _, line in lines),
        air_temperatures=tuple(_kelvin(line["temperature"]) for _, line in lines),
        source=lines[0][1]["row"].place,
    )


def _value(reading: Reading) -> float | None:
    return reading.si if reading.state == "given" else None


def _kelvin(reading: Reading) -> float | None:
    return kelvin_from_celsius(reading.number) if reading.state == "given" else None


def _read_time(line: Row, findings: list[Finding]) -> float | None:
    """Time of a line [s], from days or from a date; None with a finding."""
    time, date = line["time"], line["date"]
    if "faulty" in (time.state, date.state):
        return None
    if (time.state == "given") == (date.state == "given"):
        rule = "is given beside a date" if date.state == "given" else "has no time"
        place = time if time.state == "given" else line["row"]
        refuse(place, rule, "one of time [d] and date and time", findings)
        return None
    if time.state == "given":
        return time.number * SECONDS_PER_DAY
    try:
        moment = datetime.fromisoformat(date.word)
    except ValueError:
        refuse(date, "is no date", "such as 2003-02-18 06:00", findings)
        return None
    return (moment.replace(tzinfo=None) - datetime(1970, 1, 1)).total_seconds()
