"""Pressure of the snow along the net, beside the section drawing."""

from __future__ import annotations

from netdesign.report.drawing.label_board import Box, LabelBoard
from netdesign.report.drawing.plain_svg import WIDTH, Chart, Frame, Point
from netdesign.report.drawing.section_labels import LEGEND_BOTTOM
from netdesign.report.drawing.style import ACCENT, TEXT_PT
from netdesign.report.words import Words
from netdesign.study.support_records import Drawing

CHART_WIDTH = 150.0  # of all that stands right of the section [pt]
_LEFT, _HEIGHT = WIDTH - 112.0, 62.0
_TITLES = 2.6 * TEXT_PT  # two lines above the chart
CHART_BOTTOM = LEGEND_BOTTOM + _TITLES + _HEIGHT + 4.0 * TEXT_PT


def list_pressures(drawing: Drawing) -> list[Point]:
    """Pressure [kPa] and height above the slope [m] where both are known."""
    pairs = zip(drawing.pressure_kPa, drawing.net_m, strict=False)
    return [(pressure, y) for pressure, (_, y) in pairs if pressure is not None]


def draw_pressure(
    sketch: Chart, drawing: Drawing, words: Words, board: LabelBoard
) -> None:
    """Pressure to the right, height upwards; nothing where no pressure is known."""
    known = list_pressures(drawing)
    if len(known) < 2:
        return
    top = LEGEND_BOTTOM + _TITLES + 10.0
    right = WIDTH - 8.0
    title = top - 2.1 * TEXT_PT
    sketch.text(right, title, words("drawing.pressure"), anchor="end", bold=True)
    line = (right, title + 1.2 * TEXT_PT)
    sketch.text(*line, words("drawing.over_height"), anchor="end")
    frame = Frame(
        left=_LEFT,
        top=top,
        width=right - _LEFT,
        height=_HEIGHT,
        x_low=min(0.0, *(pressure for pressure, _ in known)),
        x_high=1.05 * max(0.1, *(pressure for pressure, _ in known)),
        y_low=0.0,
        y_high=max(drawing.head_m[1], known[-1][1]),
    )
    sketch.axes(frame)
    points = [(frame.x(pressure), frame.y(y)) for pressure, y in known]
    edge = [(frame.x(0.0), points[0][1]), *points, (frame.x(0.0), points[-1][1])]
    sketch.area(edge, "#f1dfda")
    sketch.line(points, stroke=ACCENT, width=1.2)
    board.reserve(Box(WIDTH - CHART_WIDTH, LEGEND_BOTTOM, WIDTH, CHART_BOTTOM))


def describe_pressure(drawing: Drawing, words: Words) -> list[str]:
    """Least and largest pressure in words; nothing where none is known."""
    known = [pressure for pressure, _ in list_pressures(drawing)]
    if len(known) < 2:
        return []
    low, high = words.show_share(min(known)), words.show_share(max(known))
    band = words("show.band", low=low, high=high)
    return [words("show.label", label=words("drawing.pressure"), text=band)]
