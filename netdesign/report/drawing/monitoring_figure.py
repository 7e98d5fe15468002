"""Measured tension and air temperature of a row."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.report.drawing.charts import Line, Panel, draw_panels
from netdesign.report.words import ENGLISH, Words, show_member
from netdesign.study.records import MonitoringRecord

_TALL = 84.0  # of a panel [pt]


def draw_monitoring(records: Sequence[MonitoringRecord], words: Words = ENGLISH) -> str:
    """SVG of all measured series of a net row; "" without any."""
    panels = [panel for record in records for panel in _list_panels(record, words)]
    if not panels:
        return ""
    return draw_panels(
        panels,
        _describe(panels, words),
        panel_pt=_TALL,
        is_log=False,
        time_label=words("drawing.days"),
        language=words.language,
    )


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
        air = words("drawing.air")
        line = Line(label=air, x=times, y=values, style=1, is_thin=True)
        panels.append(Panel(title=words("drawing.air_temperature"), lines=[line]))
    return panels


def _pick(
    times: Sequence[float], values: Sequence[float | None]
) -> tuple[list[float], list[float]]:
    """Times and values of the readings that exist."""
    known = [(t, v) for t, v in zip(times, values, strict=True) if v is not None]
    return [time for time, _ in known], [value for _, value in known]
