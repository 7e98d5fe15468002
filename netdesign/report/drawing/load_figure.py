"""Loads along the height of a net: of the coupled calculation, and of the guideline.

The area left of each line is the load along the slope, but for friction on the net.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from netdesign.report.drawing.letters import measure_words
from netdesign.report.drawing.plain_svg import WIDTH, Chart, Frame
from netdesign.report.drawing.style import ACCENT, GREY, INK, TEXT_PT
from netdesign.report.words import Words
from netdesign.study.case_records import GuidelineRecord

_LEFT, _TOP, _HEIGHT = 34.0, 16.0, 118.0
_BELOW = 26.0  # ticks and the name of the axis
_SAMPLE = 18.0  # of a line in the legend
_BETWEEN = 9.0


@dataclass(frozen=True, slots=True)
class _Line:
    """One load: its name, its looks, pressure [kPa] and height [m]."""

    label: str
    stroke: str
    dashes: str
    points: list[tuple[float, float]]


def draw_loads(record: GuidelineRecord, height: float, words: Words) -> str:
    """SVG of both loads over the height of the net; "" without a solved pressure.

    Parameters
    ----------
    record : GuidelineRecord
        Of one net row.
    height : float
        Of the net, normal to the slope [m].
    words : Words
        Of the language.
    """
    lines = list(_list_lines(record, height, words))
    if len(lines) < 2:
        return ""
    legend = (
        max(measure_words(one.label, TEXT_PT) for one in lines) + _SAMPLE + _BETWEEN
    )
    most = max(pressure for one in lines for pressure, _ in one.points)
    frame = Frame(
        left=_LEFT,
        top=_TOP,
        width=WIDTH - _LEFT - legend - 2.0 * _BETWEEN,
        height=_HEIGHT,
        x_low=0.0,
        x_high=1.05 * most,
        y_low=0.0,
        y_high=height,
    )
    sketch = Chart(language=words.language)
    sketch.axes(frame)
    sketch.text(0.0, TEXT_PT, words("loads.height"), bold=True)
    bottom = _TOP + _HEIGHT + _BELOW
    end = frame.left + frame.width
    sketch.text(end, bottom, words("loads.pressure"), anchor="end", bold=True)
    for place, one in enumerate(lines):
        points = [(frame.x(max(0.0, p)), frame.y(y)) for p, y in one.points]
        sketch.line(points, stroke=one.stroke, width=1.3, dash=one.dashes)
        y = _TOP + TEXT_PT + place * 1.7 * TEXT_PT
        start = end + 2.0 * _BETWEEN
        sample = [(start, y - 2.6), (start + _SAMPLE, y - 2.6)]
        sketch.line(sample, stroke=one.stroke, width=1.3, dash=one.dashes)
        sketch.text(start + _SAMPLE + 4.0, y, one.label)
    values = tuple(one.label for one in lines)
    title = words("drawing.with_values", what=words("loads.title"), values=values)
    return sketch.write(bottom + 4.0, title)


def _list_lines(
    record: GuidelineRecord, height: float, words: Words
) -> Iterator[_Line]:
    load = words.show_number("load_kN_per_m", record.solved_load_kN_per_m)
    if record.along_net:
        points = [(pressure, y) for y, pressure in record.along_net]
        yield _Line(words("loads.coupled", load=load), ACCENT, "", points)
    looks = {
        "same_snow": (INK, "5 2"),
        "load_case_1": (GREY, "1.5 1.5"),
        "load_case_2": (GREY, "6 1.5 1.5 1.5"),
    }
    for case in record.cases:
        if case.load_kN_per_m is None:
            continue
        pressure = case.load_kN_per_m / height
        shown = words.show_number("load_kN_per_m", case.load_kN_per_m)
        label = words(f"loads.{case.name}", load=shown)
        stroke, dashes = looks[case.name]
        edge = [(0.0, 0.0), (pressure, 0.0), (pressure, height), (0.0, height)]
        yield _Line(label, stroke, dashes, edge)
