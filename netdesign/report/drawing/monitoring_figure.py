"""Measured tension and air temperature of a row."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.report.drawing.charts import Line, Panel
from netdesign.report.drawing.letters import measure_words
from netdesign.report.drawing.plain_svg import (
    WIDTH,
    Chart,
    Frame,
    bounds_of,
    drop_straight,
)
from netdesign.report.drawing.style import GREY, INK, SOFT, TEXT_PT
from netdesign.report.words import ENGLISH, Words, show_member
from netdesign.study.records import MonitoringRecord

_LEFT, _GAP, _TALL = 34.0, 8.0, 84.0  # of a panel; its height [pt]
_ABOVE, _BELOW = 18.0, 20.0  # it: its title; its ticks [pt]
_MARGIN = 0.08  # of the values, above and below them
_MOST_DOTS = 60  # of a line; more would be a band
_DOT = 1.2  # half the width of a dot [pt]


def draw_monitoring(records: Sequence[MonitoringRecord], words: Words = ENGLISH) -> str:
    """SVG of all measured series of a net row; "" without any."""
    panels = [panel for record in records for panel in _list_panels(record, words)]
    if not panels:
        return ""
    chart = Chart(language=words.language)
    lines = [line for panel in panels for line in panel.lines]
    times = bounds_of([line.x for line in lines])
    room = max(measure_words(line.label, TEXT_PT) for line in lines) + _GAP
    for place, panel in enumerate(panels):
        top = place * (_ABOVE + _TALL + _BELOW) + _ABOVE
        _draw_panel(chart, panel, _frame(panel, times, top, room))
    height = len(panels) * (_ABOVE + _TALL + _BELOW) + TEXT_PT
    days = words("drawing.days")
    chart.text(_LEFT + (WIDTH - _LEFT - room) / 2, height - 3, days, anchor="middle")
    return chart.write(height, _describe(panels, words))


def _frame(panel: Panel, times: tuple[float, float], top: float, room: float) -> Frame:
    """Place of a panel; ``room`` is for the names of its lines [pt]."""
    low, high = bounds_of([line.y for line in panel.lines])
    margin = _MARGIN * ((high - low) or 1.0)
    return Frame(
        left=_LEFT,
        top=top,
        width=WIDTH - _LEFT - room,
        height=_TALL,
        x_low=times[0],
        x_high=times[1],
        y_low=low - margin,
        y_high=high + margin,
    )


def _draw_panel(chart: Chart, panel: Panel, frame: Frame) -> None:
    chart.text(frame.left, frame.top - 6, panel.title, bold=True)
    chart.axes(frame)
    for line in panel.lines:
        points = [(frame.x(x), frame.y(y)) for x, y in zip(line.x, line.y, strict=True)]
        chart.line(
            drop_straight(points),
            stroke=INK if line.has_dots else SOFT,
            width=0.6,
            dash="" if line.has_dots else "5 1.6",
        )
        if line.has_dots and len(points) <= _MOST_DOTS:
            for x, y in points:
                chart.rectangle(x - _DOT, y - _DOT, 2 * _DOT, 2 * _DOT, GREY)
        x, y = points[-1]
        chart.text(x + _GAP / 2, y + TEXT_PT / 3, line.label)


def _describe(panels: Sequence[Panel], words: Words) -> str:
    """Words for what the drawing says, with the range of each line."""
    values = [
        words(
            "show.label",
            label=words("drawing.of_member", member=panel.title, what=line.label),
            text=words(
                "show.band",
                low=words.show_share(min(line.y)),
                high=words.show_share(max(line.y)),
            ),
        )
        for panel in panels
        for line in panel.lines
    ]
    what = words("drawing.monitoring")
    return words("drawing.with_values", what=what, values=tuple(values))


def describe_monitoring(
    records: Sequence[MonitoringRecord], words: Words = ENGLISH
) -> str:
    """Note below the drawing: where the model's forces stand, or what they need."""
    told = dict.fromkeys(words.show(record.model) for record in records)
    return words("drawing.monitoring_note", model=tuple(told))


def _list_panels(record: MonitoringRecord, words: Words) -> list[Panel]:
    member = show_member(words, record.member)
    panels = []
    times, values = _pick(record.times_d, record.tensions_kN)
    if times:
        label, title = (
            words("drawing.measured"),
            words("drawing.tension", member=member),
        )
        line = Line(label=label, x=times, y=values, has_dots=True)
        panels.append(Panel(title=title, lines=[line]))
    times, values = _pick(record.times_d, record.air_temperatures_C)
    if times:
        line = Line(label=words("drawing.air"), x=times, y=values)
        panels.append(Panel(title=words("drawing.air_temperature"), lines=[line]))
    return panels


def _pick(
    times: Sequence[float], values: Sequence[float | None]
) -> tuple[list[float], list[float]]:
    """Times and values of the readings that exist."""
    known = [(t, v) for t, v in zip(times, values, strict=True) if v is not None]
    return [time for time, _ in known], [value for _, value in known]
