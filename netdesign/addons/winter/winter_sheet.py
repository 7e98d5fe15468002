"""Sheet Winter: daily heights of a station, and how they reach the net rows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import date

from netdesign.addons.winter.heights import (
    LONGEST_GAP,
    HeightSeries,
    build_series,
    find_gaps,
    find_spikes,
    find_stills,
)
from netdesign.site.cells.findings import Finding
from netdesign.site.cells.numbers import read_moment
from netdesign.site.headings import Table
from netdesign.site.lines import refuse_unknown_ids
from netdesign.site.readings import Reading, Row, refuse
from netdesign.site.tables import read_rows
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
class StationWinter:
    """Series of a station, and how it reaches the rows.

    Attributes
    ----------
    series : HeightSeries
        Snow heights [m] and air temperatures [K], gaps closed.
    station : str
        Its name; may be empty.
    altitude : float or None
        [m].
    height_factor : float or None
        f_H of the rows that have none of their own [-]; None where none is given.
    row_factors : mapping of str to float
        f_H of single rows by their id [-].
    file : str
        Name of the file of a station alone; empty for sheet Winter of a site.
    notes : tuple of Message
        What was filled, what looks odd.
    """

    series: HeightSeries
    station: str = ""
    altitude: float | None = None
    height_factor: float | None = None
    row_factors: Mapping[str, float] = field(default_factory=dict)
    file: str = ""
    notes: tuple[Message, ...] = ()

    def find_factor(self, row_id: str) -> float | None:
        """f_H of a row [-]; None where none is given.

        Parameters
        ----------
        row_id : str
            As in sheet Rows.
        """
        return self.row_factors.get(row_id, self.height_factor)


_MOST_LISTED = 8  # days in one remark


def read_winter(
    table: Table | None, places: Mapping[str, str], findings: list[Finding]
) -> StationWinter | None:
    """Series of the sheet; None without it, or where it is refused.

    Parameters
    ----------
    table : Table or None
        Sheet Winter, if there is one.
    places : mapping of str to str
        Cells of the ids of sheet Rows; with none, any row may be named.
    findings : list of Finding
        Appended to: days that are none or come twice, gaps inside snow, and remarks on
        what was filled and on steep rises.
    """
    if table is None:
        return None
    faults = len(findings)
    lines = read_rows(table, findings)
    days = _read_days(lines, findings)
    heights = _list_given(days, "snow_height")
    if not heights:
        if lines and len(findings) == faults:
            rule = say("winter_sheet.no_height")
            refuse(lines[0]["date"], rule, say("winter_sheet.heights"), findings)
        return None
    _check_gaps(heights, days, findings)
    factor, row_factors = _read_factors(lines, places, findings)
    series = build_series(heights, _list_given(days, "temperature"))
    notes = _note_oddities(series, heights, days, findings)
    return StationWinter(
        series=series,
        station=lines[0]["station"].word,
        altitude=lines[0]["altitude"].given_si,
        height_factor=factor,
        row_factors=row_factors,
        notes=notes,
    )


def _list_days(days: Sequence[date]) -> Message:
    """The first days, and how many more there are."""
    listed = tuple(day.isoformat() for day in days[:_MOST_LISTED])
    if more := len(days) - len(listed):
        return say("winter_sheet.days_more", days=listed, count=more)
    return say("winter_sheet.days", days=listed)


def _read_days(lines: list[Row], findings: list[Finding]) -> dict[date, Row]:
    """Lines by their day, ascending; days that are none or not in order are refused."""
    days: dict[date, Row] = {}
    last: date | None = None
    for line in lines:
        if line["date"].state != "given":
            continue
        day = read_moment(line["date"].word).date()
        if last is not None and day <= last:
            rule = say("winter_sheet.not_after" if day < last else "winter_sheet.twice")
            refuse(line["date"], rule, say("winter_sheet.one_a_day"), findings)
            continue
        days[day], last = line, day
    return days


def _list_given(days: Mapping[date, Row], key: str) -> dict[date, float]:
    """Numbers of a column by day, where one is given [SI]."""
    found = {day: line[key].given_si for day, line in days.items()}
    return {day: number for day, number in found.items() if number is not None}


def _check_gaps(
    heights: Mapping[date, float], days: Mapping[date, Row], findings: list[Finding]
) -> None:
    for gap in find_gaps(heights):
        if gap.is_closable:
            continue
        rule = say(
            "winter_sheet.gap", count=len(gap.days), before=gap.before.isoformat()
        )
        accepted = say("winter_sheet.shorter", most=LONGEST_GAP)
        refuse(days[gap.after]["date"], rule, accepted, findings)


def _note_oddities(
    series: HeightSeries,
    heights: Mapping[date, float],
    days: Mapping[date, Row],
    findings: list[Finding],
) -> tuple[Message, ...]:
    """Remarks in the findings, and one of each kind for the page of the winter."""
    gaps = [
        gap
        for gap in find_gaps(heights)
        if gap.is_closable
        and not gap.is_between
        and any(heights[day] > 0 for day in (gap.before, gap.after))
    ]
    filled = [day for gap in gaps for day in gap.days]
    lines = list(days.values())
    odd: list[tuple[Message, Reading]] = []
    if gaps:
        told = say("winter_sheet.filled", days=_list_days(filled))
        odd.append((told, days[gaps[0].after]["date"]))
    for key, at in (
        ("winter_sheet.spike", find_spikes(series)),
        ("winter_sheet.still", find_stills(series)),
    ):
        if at:
            line = days.get(at[0], lines[0])
            odd.append((say(key, days=_list_days(at)), line["snow_height"]))
    if series.cut:
        told = say("winter_sheet.cut", winters=series.cut)
        odd.append((told, lines[-1]["snow_height"]))
    if series.heights[0] > 0.0:  # what fell before the first day is unknown
        odd.append((say("winter_sheet.starts_in_snow"), lines[0]["snow_height"]))
    for note, reading in odd:
        refuse(reading, note, "", findings, severity="note")
    return tuple(note for note, _ in odd)


def _read_factors(
    lines: Sequence[Row], places: Mapping[str, str], findings: list[Finding]
) -> tuple[float | None, Mapping[str, float]]:
    """Height factor of all rows [-], None without one, and those of single rows."""
    first = lines[0]
    general = None if first["row"].word else first["height_factor"].given_si
    factors: dict[str, float | None] = {}
    if places:
        refuse_unknown_ids((line["row"] for line in lines), places, findings)
    for line in lines:
        row, factor = line["row"], line["height_factor"]
        if row.word in factors:
            rule = say("winter_sheet.row_twice")
            refuse(row, rule, say("winter_sheet.one_a_row"), findings)
        elif row.word:
            factors[row.word] = factor.given_si
            if factor.state == "blank":
                rule = say("winter_sheet.row_without_factor")
                refuse(row, rule, say("winter_sheet.one_a_row"), findings)
        elif factor.given_si not in (None, general):
            rule = say("winter_sheet.factor_of_none")
            refuse(factor, rule, say("winter_sheet.factor_place"), findings)
    return general, {row: one for row, one in factors.items() if one is not None}
