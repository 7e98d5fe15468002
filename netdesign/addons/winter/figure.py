"""Figures of a winter: forces and layers against date, measured forces beside them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from datetime import datetime, timedelta
from typing import Any

from netdesign.addons.charts import Line, Mark, Panel, draw_panels, shade
from netdesign.report.words import Words, show_member

_FORCES, _MEMBERS, _SNOW, _AIR = 150.0, 96.0, 104.0, 64.0  # heights of the panels [pt]
_LOOSE, _DENSE = 80.0, 600.0  # ends of the greys [kg/m3]
_MEMBERS_SHOWN = ("foot_anchor", "uphill_guy", "post")

Days = list[tuple[float, Mapping[str, Any]]]  # days since the first, and what is known


def draw_winter(
    winter: Mapping[str, Any], air: Mapping[str, float], words: Words
) -> str:
    """SVG of one winter of a row; "" without a curve.

    Parameters
    ----------
    winter : mapping
        Entry of ``winters`` of the winter document.
    air : mapping of str to float
        Air temperature by date [C]; may be empty.
    words : Words
        Language.
    """
    if not winter["curve"]:
        return ""
    span = _find_span(winter["curve"])
    every = [(datetime.fromisoformat(day["date"]), day) for day in winter["curve"]]
    days = _cut(every, span)
    marks = [
        Mark(
            x=(datetime.fromisoformat(winter[key]) - span[0]) / _DAY,
            label=words(label),
            is_accent=key == "governing_date",
        )
        for key, label in (
            ("height_max_date", "winter_page.mark_highest"),
            ("governing_date", "winter_page.mark_governing"),
        )
        if winter[key]
    ]
    panels = _list_forces(days, words, marks)
    values = tuple(line.label for panel in panels for line in panel.lines)
    figure = words("winter_page.figure", winter=winter["name"])
    description = words("drawing.with_values", what=figure, values=values)
    panels.append(_show_snow(days, (span[1] - span[0]) / _DAY, words))
    warmth = [(datetime.fromisoformat(day), y) for day, y in sorted(air.items())]
    panels += _show_air(_cut(warmth, span), words("winter_page.air_title"))
    return draw_panels(panels, description, span=span, language=words.language)


def _list_forces(days: Days, words: Words, marks: Sequence[Mark]) -> list[Panel]:
    """Panel of the net's pulls, and of the members where their forces are known."""
    pulls = {
        words(f"winter_column.{end}"): [day[f"{end}_kN_per_m"] for _, day in days]
        for end in ("foot", "head")
    }
    members = {
        show_member(words, member): [day["members_kN"].get(member) for _, day in days]
        for member in _MEMBERS_SHOWN
    }
    panels = [
        Panel(
            title=words(title),
            lines=_list_lines(days, forces, words),
            marks=marks if forces is pulls else (),
            from_zero=True,
            height_pt=height,
        )
        for title, forces, height in (
            ("winter_page.pulls_title", pulls, _FORCES),
            ("winter_page.members_title", members, _MEMBERS),
        )
    ]
    return panels if panels[1].lines else panels[:1]


def _list_lines(
    days: Days, forces: Mapping[str, Sequence[float | None]], words: Words
) -> list[Line]:
    """Lines of those that have a force, named with their largest one."""
    return [
        Line(
            label=f"{words.show_number('max_kN', max(pulls))} {name}",
            x=[at for at, _ in days],
            y=[math.nan if force is None else force for force in values],
            style=number,
            is_accent=number == 0,
        )
        for number, (name, values) in enumerate(forces.items())
        if (pulls := [force for force in values if force is not None])
    ]


def _show_snow(days: Days, last: float, words: Words) -> Panel:
    """Layers of each day as tiles: the darker, the denser."""
    tiles = []
    ends = [*(at for at, _ in days[1:]), last]
    for (start, day), end in zip(days, ends, strict=True):
        base = 0.0
        uniform = {key: day[key] for key in ("thickness_m", "density_kg_m3")}
        for layer in day["layers"] or [uniform]:
            upper = base + layer["thickness_m"]
            fill = shade(layer["density_kg_m3"] or _LOOSE, _LOOSE, _DENSE)
            tiles.append((start, end, base, upper, fill))
            base = upper
    densities = range(100, 600, 100)
    return Panel(
        title=words("winter_page.layers_title"),
        tiles=tiles,
        key=[(shade(rho, _LOOSE, _DENSE), f"{rho} kg/m³") for rho in densities],
        from_zero=True,
        height_pt=_SNOW,
    )


def _find_span(days: Sequence[Mapping[str, Any]]) -> tuple[datetime, datetime]:
    """First and last day with snow, a little room beside them."""
    snowy = [day for day in days if day["thickness_m"] > 0] or days
    moments = [datetime.fromisoformat(day["date"]) for day in snowy]
    return min(moments) - 3 * _DAY, max(moments) + 5 * _DAY


_DAY, _NOON = timedelta(days=1), timedelta(hours=12)


def draw_measured(
    entry: Mapping[str, Any], air: Mapping[str, float], words: Words
) -> str:
    """SVG of one member's readings beside the chain.

    Parameters
    ----------
    entry : mapping
        Of ``measured`` in the winter document, with at least one reading.
    air : mapping of str to float
        Air temperature of the station by date [C]; may be empty.
    words : Words
        Language.
    """
    measured = _list_readings(entry["readings"], "force_kN")
    moments = [moment for moment, _ in measured]
    span = min(moments) - _DAY, max(moments) + _DAY
    chain = _cut([(_noon(day["date"]), day) for day in entry["computed"]], span)
    x = [at for at, _ in chain]
    value, low, high = (
        [float(day[key]) for _, day in chain]
        for key in ("force_kN", "low_kN", "high_kN")
    )
    member = show_member(words, entry["member"])
    points = _cut(measured, span)
    lines = [
        Line(label=words("winter_measured.band"), x=x, y=(), low=low, high=high),
        Line(label=words("winter_measured.computed"), x=x, y=value, is_accent=True),
        Line(
            label=words("winter_measured.measured"),
            x=[at for at, _ in points],
            y=[force for _, force in points],
            has_dots=True,
        ),
    ]
    title = words("winter_measured.force", member=member)
    panels = [Panel(title=title, lines=lines, from_zero=True, height_pt=_FORCES)]
    warmth = _list_readings(entry["air_temperatures"], "air_C") or [
        (_noon(day), degrees) for day, degrees in sorted(air.items())
    ]
    panels += _show_air(_cut(warmth, span), words("winter_measured.air"))
    figure = words("winter_measured.figure", member=member, winter=entry["winter"])
    return draw_panels(panels, figure, span=span, language=words.language)


def _show_air(points: Sequence[tuple[float, float]], title: str) -> list[Panel]:
    """Panel of air temperatures by the days since the span began; none of none."""
    if not points:
        return []
    x, y = [at for at, _ in points], [degrees for _, degrees in points]
    line = Line(label="", x=x, y=y, is_thin=True)
    return [Panel(title=title, lines=[line], height_pt=_AIR)]


def _cut(
    points: Sequence[tuple[datetime, Any]], span: tuple[datetime, datetime]
) -> list[tuple[float, Any]]:
    """Points within the span, by the days since it began."""
    first, last = span
    return [((at - first) / _DAY, y) for at, y in points if first <= at <= last]


def _list_readings(
    entries: Sequence[Mapping[str, Any]], key: str
) -> list[tuple[datetime, float]]:
    return [
        (datetime.fromisoformat(read["time"]), float(read[key])) for read in entries
    ]


def _noon(day: str) -> datetime:
    return datetime.fromisoformat(day) + _NOON
