"""Measured tension and air temperature beside the model's history of the row."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.report.drawing.charts import Line, Panel, draw_panels
from netdesign.report.words import name_member
from netdesign.study.records import MonitoringRecord


def draw_monitoring(records: Sequence[MonitoringRecord], name: str) -> str:
    """SVG of all measured series of a net row; "" without any."""
    panels = [panel for record in records for panel in _list_panels(record)]
    if not panels:
        return ""
    return draw_panels(
        panels,
        name,
        "Measured tension and air temperature beside the model",
        is_log=False,
        panel_in=1.5,
        time_label="days since the first reading",
    )


def describe_monitoring(records: Sequence[MonitoringRecord]) -> str:
    """What the drawing must not be taken for."""
    starts = {record.model_start for record in records}
    note = (
        "The model's history starts at the first reading from a "
        f"{' or '.join(sorted(starts))} net with the middle of the ranges, not with "
        "the winter before it; its clock runs with the air temperature, at most 0 °C. "
        "In snow of one temperature warmth only makes time run faster: a daily swing "
        "of the tension is not in the model. Drawn for comparison, it decides nothing."
    )
    reasons = sorted({str(one.model_reason) for one in records if one.model_reason})
    return f"{note} Without a history: {'; '.join(reasons)}." if reasons else note


def _list_panels(record: MonitoringRecord) -> list[Panel]:
    member = name_member(record.member)
    lines = []
    if record.model_times_d:
        lines.append(
            Line(
                label="model",
                x=record.model_times_d,
                y=record.model_kN,
                is_accent=True,
            )
        )
    measured = _pick(record.times_d, record.tensions_kN)
    if measured[0]:
        lines.append(
            Line(label="measured", x=measured[0], y=measured[1], has_dots=True)
        )
    panels = []
    if lines:
        panels.append(Panel(title=f"{member}, tension [kN]", lines=lines))
    air = _pick(record.times_d, record.air_temperatures_C)
    if air[0]:
        line = Line(label="air", x=air[0], y=air[1], style=1)
        panels.append(Panel(title="Air temperature [°C]", lines=[line]))
    return panels


def _pick(
    times: Sequence[float], values: Sequence[float | None]
) -> tuple[list[float], list[float]]:
    """Times and values of the readings that exist."""
    known = [(t, v) for t, v in zip(times, values, strict=True) if v is not None]
    return [time for time, _ in known], [value for _, value in known]
