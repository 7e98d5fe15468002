"""Measured and computed force of a member against date; residuals of a fit."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import date, datetime, time, timedelta
from typing import Any

from netdesign.report.drawing.plain_svg import WIDTH, Chart, Frame
from netdesign.report.drawing.style import ACCENT, GREY, INK, PALE, TEXT_PT
from netdesign.report.words import Words, show_member

_LEFT, _RIGHT = 36.0, 116.0  # beside the panels [pt]
_HEAD, _GAP, _FOOT = 16.0, 24.0, 18.0  # above, between, below the panels [pt]
_FORCES, _AIR = 150.0, 64.0  # heights of the panels [pt]
_MONTHS_FROM = 45.0  # days from which on months are named, not days
_DETAIL = 10.0  # days of a detail
_DETAIL_READINGS = 3.0  # a day, at least
_DOTTED = 150  # most readings that are dots
_NOON = 0.5

Points = list[tuple[datetime, float]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Span:
    """Time shown by a figure, from its first to its last moment."""

    first: datetime
    last: datetime

    @property
    def days(self) -> float:
        """Length [d]."""
        return (self.last - self.first).total_seconds() / 86400.0

    def place(self, moment: datetime) -> float:
        """Days since the first moment."""
        return (moment - self.first).total_seconds() / 86400.0

    def cut(self, points: Points) -> Points:
        """Points within the span."""
        return [one for one in points if self.first <= one[0] <= self.last]


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
    span : Span, optional
        What is shown; all readings and the days beside them unless told.
    """
    span = span or find_span(entry)
    chart = Chart(language=words.language)
    member = show_member(words, entry["member"])
    title = words("winter_measured.force", member=member)
    _draw_forces(chart, entry, span, title, words)
    top = _HEAD + _FORCES
    warmth = span.cut(_list_air(entry, air))
    if warmth:
        top += _GAP
        _draw_air(chart, warmth, span, top, words)
        top += _AIR
    _label_time(chart, span, top)
    figure = words("winter_measured.figure", member=member, winter=entry["winter"])
    return chart.write(top + _FOOT, figure)


def find_span(entry: Mapping[str, Any]) -> Span:
    """Span of all readings with a day beside them.

    Parameters
    ----------
    entry : mapping
        Of ``measured`` in the winter document, with at least one reading.
    """
    moments = [moment for moment, _ in _list_readings(entry)]
    day = timedelta(days=1)
    return Span(first=min(moments) - day, last=max(moments) + day)


def find_detail(entry: Mapping[str, Any]) -> Span | None:
    """Ten days in which the readings range most; None where they are too few for it.

    Parameters
    ----------
    entry : mapping
        Of ``measured`` in the winter document.
    """
    readings = _list_readings(entry)
    if find_span(entry).days < 2.0 * _DETAIL:
        return None
    best: tuple[float, Span] | None = None
    for begin in sorted({datetime.combine(m.date(), time()) for m, _ in readings}):
        span = Span(first=begin, last=begin + timedelta(days=_DETAIL))
        forces = [force for _, force in span.cut(readings)]
        if len(forces) < _DETAIL_READINGS * _DETAIL:
            continue
        reach = max(forces) - min(forces)
        if best is None or reach > best[0]:
            best = reach, span
    return best[1] if best else None


def _draw_forces(
    chart: Chart, entry: Mapping[str, Any], span: Span, title: str, words: Words
) -> None:
    computed, low, high = (
        span.cut(_list_computed(entry, key))
        for key in ("force_kN", "low_kN", "high_kN")
    )
    readings = span.cut(_list_readings(entry))
    top = max([value for _, value in (*readings, *high)], default=1.0)
    frame = _place(span, _HEAD, _FORCES, 0.0, 1.06 * top or 1.0)
    chart.text(_LEFT, _HEAD - 5.0, title, bold=True)
    if computed:
        edge = [_point(frame, span, one) for one in (*high, *reversed(low))]
        chart.area(edge, PALE)
        chart.line(
            [_point(frame, span, one) for one in computed], stroke=ACCENT, width=1.4
        )
    places = [_point(frame, span, one) for one in readings]
    chart.line(places, stroke=INK, width=0.6)
    if len(places) <= _DOTTED:
        for x, y in places:
            chart.rectangle(x - 1.2, y - 1.2, 2.4, 2.4, INK)
    chart.axes(frame, x_ticks=False)
    names = (
        ("winter_measured.measured", INK, 0.6),
        ("winter_measured.computed", ACCENT, 1.4),
        ("winter_measured.band", PALE, 6.0),
    )
    for place, (key, stroke, width) in enumerate(names):
        x, y = frame.left + frame.width + 4.0, frame.top + 10.0 + 12.0 * place
        chart.line(((x, y - 2.5), (x + 9.0, y - 2.5)), stroke=stroke, width=width)
        chart.text(x + 12.0, y, words(key))


def _draw_air(
    chart: Chart, warmth: Points, span: Span, top: float, words: Words
) -> None:
    values = [value for _, value in warmth]
    low, high = min(values), max(values)
    frame = _place(span, top, _AIR, low, max(high, low + 1.0))
    chart.text(_LEFT, top - 5.0, words("winter_measured.air"), bold=True)
    chart.line([_point(frame, span, one) for one in warmth], width=0.7)
    if low < 0.0 < high:
        ends = ((frame.left, frame.y(0.0)), (frame.left + frame.width, frame.y(0.0)))
        chart.line(ends, stroke=GREY, width=0.5, dash="2 2")
    chart.axes(frame, x_ticks=False)


def _label_time(chart: Chart, span: Span, bottom: float) -> None:
    """First day of each month, or single days of a short span."""
    frame = _place(span, 0.0, bottom, 0.0, 1.0)
    is_long = span.days > _MONTHS_FROM
    step = max(1, round(span.days / 10.0))
    day = span.first.date() + timedelta(days=1)
    count = 0
    while datetime.combine(day, time()) <= span.last:
        if day.day == 1 if is_long else count % step == 0:
            x = frame.x(span.place(datetime.combine(day, time())))
            chart.line(((x, bottom), (x, bottom + 3.0)), stroke=GREY)
            label = f"{day:%m/%Y}" if is_long else f"{day:%d/%m}"
            if x < frame.left + frame.width - 2.0:
                chart.text(x + 2.0, bottom + TEXT_PT + 4.0, label)
        day += timedelta(days=1)
        count += 1


def _place(span: Span, top: float, height: float, low: float, high: float) -> Frame:
    return Frame(
        left=_LEFT,
        top=top,
        width=WIDTH - _LEFT - _RIGHT,
        height=height,
        x_low=0.0,
        x_high=max(span.days, 1.0),
        y_low=low,
        y_high=high,
    )


def _point(
    frame: Frame, span: Span, point: tuple[datetime, float]
) -> tuple[float, float]:
    return frame.x(span.place(point[0])), frame.y(point[1])


def _list_readings(entry: Mapping[str, Any]) -> Points:
    return [
        (datetime.fromisoformat(one["time"]), float(one["force_kN"]))
        for one in entry["readings"]
    ]


def _list_computed(entry: Mapping[str, Any], key: str) -> Points:
    """Values of the chain at noon of their days."""
    return [(_noon(day["date"]), float(day[key])) for day in entry["computed"]]


def _list_air(entry: Mapping[str, Any], air: Mapping[str, float]) -> Points:
    """Air temperature as read beside the forces, else that of the station."""
    own: Sequence[Mapping[str, Any]] = entry["air_temperatures"]
    if own:
        return [(datetime.fromisoformat(one["time"]), one["air_C"]) for one in own]
    return [(_noon(day), degrees) for day, degrees in sorted(air.items())]


def _noon(day: str) -> datetime:
    return datetime.combine(date.fromisoformat(day), time()) + timedelta(days=_NOON)


_HEIGHT, _BELOW = 110.0, 22.0  # of and below the panel of residuals [pt]
_BANDS = ((2.0, "#eef0f2"), (1.0, "#dfe2e6"))  # deviations and their greys
_STROKES = (ACCENT, INK, GREY, "#555b63")

Residual = Mapping[str, Any]


def draw_residuals(residuals: Sequence[Residual], words: Words) -> str:
    """SVG of the residuals of a fit; "" without any.

    Parameters
    ----------
    residuals : sequence of mapping
        Entries of ``residuals`` of the winter document.
    words : Words
        Language.
    """
    if not residuals:
        return ""
    chart = Chart(language=words.language)
    first = min(date.fromisoformat(one["date"]) for one in residuals)
    days = [(date.fromisoformat(one["date"]) - first).days for one in residuals]
    shares = [100.0 * math.expm1(one["residual"]) for one in residuals]
    frame = _place_residuals(days, shares, residuals)
    chart.text(_LEFT, _HEAD - 5.0, words("fit_page.figure_title"), bold=True)
    _draw_bands(chart, frame, days, residuals)
    zero = frame.y(0.0)
    chart.line(((frame.left, zero), (frame.left + frame.width, zero)), stroke=GREY)
    chart.axes(frame, x_ticks=False)
    members = list(dict.fromkeys(one["member"] for one in residuals))
    for member, stroke in zip(members, _STROKES, strict=False):
        for day, share, one in zip(days, shares, residuals, strict=True):
            if one["member"] == member:
                chart.ring(frame.x(day), frame.y(share), stroke)
    _name_members(chart, frame, members, words)
    _label_days(chart, frame, days, residuals)
    height = _HEAD + _HEIGHT + _BELOW
    return chart.write(height, words("fit_page.figure"))


def _place_residuals(
    days: Sequence[int], shares: Sequence[float], residuals: Sequence[Residual]
) -> Frame:
    """Frame that holds all residuals and two deviations of most of them."""
    usual = sorted(one["deviation"] for one in residuals)[len(residuals) // 2]
    reach = 1.1 * max(*(abs(share) for share in shares), 200.0 * usual)
    return Frame(
        left=_LEFT,
        top=_HEAD,
        width=WIDTH - _LEFT - _RIGHT,
        height=_HEIGHT,
        x_low=-2.0,
        x_high=max(days) + 2.0,
        y_low=-reach,
        y_high=reach,
    )


def _draw_bands(
    chart: Chart, frame: Frame, days: Sequence[int], residuals: Sequence[Residual]
) -> None:
    """Greys of one and two deviations; of several members the widest of a day."""
    widest: dict[int, float] = {}
    for day, one in zip(days, residuals, strict=True):
        widest[day] = max(one["deviation"], widest.get(day, 0.0))
    for count, fill in _BANDS:
        ends = [
            (frame.x(day), min(100.0 * math.expm1(count * wide), frame.y_high))
            for day, wide in widest.items()
        ]
        above = [(x, frame.y(end)) for x, end in ends]
        below = [(x, frame.y(-end)) for x, end in ends]
        if len(ends) > 1:
            chart.area([*above, *below[::-1]], fill)


def _name_members(
    chart: Chart, frame: Frame, members: Sequence[str], words: Words
) -> None:
    x = frame.left + frame.width + 8.0
    for place, (member, stroke) in enumerate(zip(members, _STROKES, strict=False)):
        y = frame.top + 8.0 + place * (TEXT_PT + 5.0)
        chart.ring(x, y - 2.5, stroke)
        chart.text(x + 8.0, y, show_member(words, member))


def _label_days(
    chart: Chart, frame: Frame, days: Sequence[int], residuals: Sequence[Residual]
) -> None:
    """Dates of the first and the last reading, and ticks of all."""
    bottom = frame.top + frame.height
    for day in sorted(set(days)):
        x = frame.x(day)
        chart.line(((x, bottom), (x, bottom + 3.0)), stroke=GREY)
    dated = dict(zip(days, (one["date"] for one in residuals), strict=True))
    for day, anchor in ((min(days), "start"), (max(days), "end")):
        y = bottom + TEXT_PT + 5.0
        chart.text(frame.x(day), y, dated[day], anchor=anchor)
