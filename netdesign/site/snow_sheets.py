"""Sheets Snow and Winter: layers of rows, heights of a station."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from datetime import date

from netdesign.envelope.ranges import Ranges
from netdesign.site.cells.findings import Finding
from netdesign.site.cells.numbers import read_moment
from netdesign.site.headings import Table
from netdesign.site.lines import refuse_unknown_ids
from netdesign.site.model import InputEcho, NetRow, StationWinter
from netdesign.site.readings import Reading, Row, refuse
from netdesign.site.tables import read_rows
from netdesign.snow.creep_law import DENSEST_SNOW, ICE_DENSITY
from netdesign.snow.heights import (
    LONGEST_GAP,
    HeightSeries,
    build_series,
    find_gaps,
    find_spikes,
    find_stills,
)
from netdesign.snow.snowpack import THINNEST_LAYER, Layer
from netdesign.words.message import Message, say

LayersByRow = Mapping[str, Sequence[Row]]  # lines from the ground up, by net row

# Layers may miss the thickness of their net row by rounding to the centimetre.
_SUM_TOLERANCE = 0.0101  # [m]


def order_layers(rows: Sequence[Row], findings: list[Finding]) -> LayersByRow:
    """Lines by net row, from the ground up."""
    by_row: dict[str, list[Row]] = {}
    for row in rows:
        if row["row"].word and row["layer"].state == "given":
            by_row.setdefault(row["row"].word, []).append(row)
    for lines in by_row.values():
        lines.sort(key=lambda line: line["layer"].number)
        _check_numbers(lines, findings)
        _check_temperatures(lines, findings)
    return {name: tuple(lines) for name, lines in by_row.items()}


def build_layers(
    lines: Sequence[Row], slope_angle: Reading, findings: list[Finding]
) -> tuple[Layer, ...]:
    """Layers of one net row, from the ground up; none if a line is faulty.

    Parameters
    ----------
    lines : sequence of Row
        As ``read_layers`` gives them.
    slope_angle : Reading
        Turns vertical heights into thicknesses normal to the slope.
    findings : list of Finding
        Appended to.
    """
    layers = []
    for line in lines:
        if any(one.state == "faulty" for one in line.values()):
            continue
        density, temperature = line["density"], line["temperature"]
        thickness = measure_normal(line["thickness"], slope_angle)
        if thickness is None:
            continue
        layer = Layer(
            thickness=thickness,
            density=density.si,
            temperature=temperature.given_si,
        )
        layers.append(layer)
    if len(layers) < len(lines):
        return ()
    total = sum(layer.thickness for layer in layers)
    for line, layer in zip(lines, layers, strict=True):
        if layer.thickness < THINNEST_LAYER * total:
            rule = say("layer.too_thin", least=THINNEST_LAYER, total=total)
            refuse(line["thickness"], rule, say("layer.put_together"), findings)
    return tuple(layers)


def resolve_thickness(
    layers: tuple[Layer, ...],
    given: Reading,
    slope_angle: Reading,
    findings: list[Finding],
) -> float | None:
    """Snow thickness of layered snow [m]: the sum, which has to agree with sheet Rows.

    Parameters
    ----------
    layers : tuple of Layer
        Of the net row.
    given : Reading
        Thickness or vertical height in sheet Rows.
    slope_angle : Reading
        Of the net row.
    findings : list of Finding
        Appended to.
    """
    total = sum(layer.thickness for layer in layers)
    is_vertical = given.field.key == "snow_height"
    factor = math.cos(slope_angle.si) if is_vertical else 1.0
    if abs(total - given.si * factor) > _SUM_TOLERANCE:
        rule = say("layer.other_sum", sum=total / factor)
        refuse(given, rule, say("layer.sum_or_empty"), findings)
        return None
    return total


def check_layers(
    rows: tuple[NetRow, ...],
    snow: LayersByRow,
    ranges: Ranges,
    findings: list[Finding],
) -> None:
    """Refuse layers whose mean lies outside the range, or that get too dense.

    Parameters
    ----------
    rows : tuple of NetRow
        Built rows.
    snow : mapping of str to sequence of Row
        Lines of sheet Snow.
    ranges : Ranges
        Of the site.
    findings : list of Finding
        Appended to.
    """
    low, high = ranges["density"].low, ranges["density"].high
    for row in rows:
        if not row.layers:
            continue
        place = snow[row.id][0]["density"]
        mean = row.mean_density
        densest = max(layer.density for layer in row.layers) * high / mean
        if not low <= mean <= high:
            rule = say("layer.mean_outside", mean=mean)
            accepted = say("layer.mean_or_wider", low=low, high=high)
            refuse(place, rule, accepted, findings)
        elif densest > DENSEST_SNOW * ICE_DENSITY:
            rule = say("layer.too_dense", density=densest)
            accepted = say("layer.at_most_density", most=DENSEST_SNOW * ICE_DENSITY)
            refuse(place, rule, accepted, findings)


def echo_layers(lines: Sequence[Row]) -> tuple[InputEcho, ...]:
    """Every input of the layers of a net row."""
    echoes = []
    for line in lines:
        number = f"{line['layer'].number:g}"
        for key in ("thickness", "density", "temperature"):
            reading = line[key]
            if reading.state == "given":
                named = say(f"column.Snow.{reading.field.key}")
                name = say("column.of_layer", layer=number, name=named)
                echoes.append(reading.echo(name))
    return tuple(echoes)


def measure_normal(given: Reading, slope_angle: Reading) -> float | None:
    """Thickness normal to the slope [m], of itself or of a vertical height."""
    if given.field.key not in ("height", "snow_height"):
        return given.si
    if slope_angle.state == "faulty":
        return None
    return given.si * math.cos(slope_angle.si)


def _check_numbers(lines: list[Row], findings: list[Finding]) -> None:
    """Refuse gaps and doubles: 1 lies on the ground, then 2, and so on."""
    for expected, line in enumerate(lines, start=1):
        if line["layer"].number != expected:
            row = line["row"].word
            rule = say("layer.wrong_number", expected=expected, row=row)
            refuse(line["layer"], rule, say("layer.numbers"), findings)
            return


def _check_temperatures(lines: list[Row], findings: list[Finding]) -> None:
    """Refuse temperatures of some layers of a row only: the others would be unknown."""
    states = {line["temperature"].state for line in lines}
    if "given" not in states or "blank" not in states:
        return
    empty = next(line for line in lines if line["temperature"].state == "blank")
    rule = say("layer.temperature_lacks")
    refuse(empty["temperature"], rule, say("layer.all_or_none"), findings)


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
        source=lines[0]["date"].place,
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
    if series.starts_in_snow:
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
