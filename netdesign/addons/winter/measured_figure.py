"""Measured and computed force of a member against date."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import date, datetime, time, timedelta
from typing import Any

from netdesign.report.drawing.charts import Line, Panel, draw_panels
from netdesign.report.words import Words, show_member

_FORCES, _AIR = 150.0, 64.0  # heights of the panels [pt]
_DETAIL = timedelta(days=10)
_DETAIL_READINGS = 30  # at least
_DAY, _NOON = timedelta(days=1), timedelta(hours=12)

Points = list[tuple[datetime, float]]
Span = tuple[datetime, datetime]


def draw_measured(
    entry: Mapping[str, Any],
    air: Mapping[str, float],
    words: Words,
    span: Span | None = None,
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
    span : (datetime, datetime), optional
        What is shown; all readings and the days beside them unless told.
    """
    span = span or find_span(entry)
    value, low, high = (
        _cut([(_noon(one["date"]), float(one[key])) for one in entry["computed"]], span)
        for key in ("force_kN", "low_kN", "high_kN")
    )
    x, band = [at for at, _ in value], [[y for _, y in one] for one in (low, high)]
    member = show_member(words, entry["member"])
    swing = words("winter_measured.band")
    computed = words("winter_measured.computed")
    measured = words("winter_measured.measured")
    readings = _cut(_list_readings(entry), span)
    lines = [
        Line(label=swing, x=x, y=(), low=band[0], high=band[1]),
        Line(label=computed, x=x, y=[y for _, y in value], is_accent=True),
        _trace(readings, measured, has_dots=True),
    ]
    title = words("winter_measured.force", member=member)
    panels = [Panel(title=title, lines=lines, from_zero=True, height_pt=_FORCES)]
    if warmth := _cut(_list_air(entry, air), span):
        line, title = _trace(warmth, "", is_thin=True), words("winter_measured.air")
        panels.append(Panel(title=title, lines=[line], height_pt=_AIR))
    figure = words("winter_measured.figure", member=member, winter=entry["winter"])
    return draw_panels(panels, figure, span=span, language=words.language)


def find_span(entry: Mapping[str, Any]) -> Span:
    """Time of all readings with a day beside them.

    Parameters
    ----------
    entry : mapping
        Of ``measured`` in the winter document, with at least one reading.
    """
    moments = [moment for moment, _ in _list_readings(entry)]
    return min(moments) - _DAY, max(moments) + _DAY


def find_detail(entry: Mapping[str, Any]) -> Span | None:
    """Ten days in which the readings range most; None where they are too few for it.

    Parameters
    ----------
    entry : mapping
        Of ``measured`` in the winter document.
    """
    readings = _list_readings(entry)
    first, last = find_span(entry)
    if last - first < 2 * _DETAIL:
        return None
    best: tuple[float, Span] | None = None
    for begin in sorted({datetime.combine(m.date(), time()) for m, _ in readings}):
        span = begin, begin + _DETAIL
        forces = [force for _, force in _cut(readings, span)]
        if len(forces) < _DETAIL_READINGS:
            continue
        reach = max(forces) - min(forces)
        if best is None or reach > best[0]:
            best = reach, span
    return best[1] if best else None


def _trace(
    points: list[tuple[float, float]],
    label: str,
    *,
    has_dots: bool = False,
    is_thin: bool = False,
) -> Line:
    x, y = [x for x, _ in points], [y for _, y in points]
    return Line(label=label, x=x, y=y, has_dots=has_dots, is_thin=is_thin)


def _cut(points: Points, span: Span) -> list[tuple[float, float]]:
    """Points within the span, by the days since it began."""
    first, last = span
    return [((at - first) / _DAY, y) for at, y in points if first <= at <= last]


def _list_readings(entry: Mapping[str, Any]) -> Points:
    return [
        (datetime.fromisoformat(one["time"]), float(one["force_kN"]))
        for one in entry["readings"]
    ]


def _list_air(entry: Mapping[str, Any], air: Mapping[str, float]) -> Points:
    """Air temperature as read beside the forces, else that of the station."""
    own: Sequence[Mapping[str, Any]] = entry["air_temperatures"]
    if own:
        return [(datetime.fromisoformat(one["time"]), one["air_C"]) for one in own]
    return [(_noon(day), degrees) for day, degrees in sorted(air.items())]


def _noon(day: str) -> datetime:
    return datetime.combine(date.fromisoformat(day), time()) + _NOON
