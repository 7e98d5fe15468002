"""Pressure on the net over its height: of the model, and of the guideline's load.

The model's line is the pressure normal to the net. What it holds by friction comes in
addition: the area beside the line is the load along the slope less the friction. Of the
guideline the load over its loaded height is drawn, which is all of it.
"""

from __future__ import annotations

from itertools import pairwise

from netdesign.report.drawing.plain_svg import (
    BLUE,
    INK,
    TEXT_PT,
    Chart,
    Frame,
    Point,
)
from netdesign.report.words import ENGLISH, Words
from netdesign.study.case_records import GuidelineCase, GuidelineRecord

_WIDTH, _HEIGHT = 160.0, 132.0
_LEFT, _TOP, _BELOW = 22.0, 16.0, 46.0
_SAMPLE = 16.0  # of a line in the legend
_DASH = "4 2.4"
LOAD_CASES = ("load_case_1", "load_case_2")


def find_larger_case(record: GuidelineRecord) -> GuidelineCase | None:
    """Load case of the guideline with the largest load along the slope."""
    known = [x for x in record.cases if x.name in LOAD_CASES and x.load_kN_per_m]
    return max(known, key=lambda one: one.load_kN_per_m or 0.0, default=None)


def find_friction(record: GuidelineRecord) -> float | None:
    """Part of the model's load along the slope that friction brings [kN/m].

    The rest is the area of the pressure over the height, by trapezes.
    """
    if len(record.along_net) < 2:
        return None
    area = sum(
        0.5 * (p0 + p1) * (y1 - y0) for (y0, p0), (y1, p1) in pairwise(record.along_net)
    )
    return record.solved_load_kN_per_m - area


def draw_pressure(
    record: GuidelineRecord, height: float, words: Words = ENGLISH
) -> str:
    """SVG of the pressures; "" where no case of the model is known.

    Parameters
    ----------
    record : GuidelineRecord
        Loads of one net row by both.
    height : float
        Of the net, normal to the slope [m].
    words : Words
        Of the language.
    """
    if len(record.along_net) < 2:
        return ""
    lines = [("drawing.by_model", BLUE, "", [(p, y) for y, p in record.along_net])]
    larger = find_larger_case(record)
    if larger is not None:
        lines.append(("drawing.by_guideline", INK, _DASH, _trace(larger, height)))
    most = max(pressure for *_, points in lines for pressure, _ in points)
    frame = Frame(
        left=_LEFT,
        top=_TOP,
        width=_WIDTH - _LEFT - 8.0,
        height=_HEIGHT - _TOP - _BELOW,
        x_low=0.0,
        x_high=1.08 * max(most, 0.1),
        y_low=0.0,
        y_high=max(height, *(y for *_, points in lines for _, y in points)),
    )
    sketch = Chart(language=words.language)
    sketch.axes(frame)
    sketch.text(0.0, TEXT_PT, words("drawing.height"))
    bottom = _HEIGHT - _BELOW + 22.0
    end = frame.left + frame.width
    sketch.text(end, bottom, words("drawing.pressure"), anchor="end")
    for place, (key, stroke, dash, points) in enumerate(lines):
        path = [(frame.x(max(0.0, p)), frame.y(y)) for p, y in points]
        sketch.line(path, stroke=stroke, width=1.4, dash=dash)
        y = bottom + (place + 1) * 1.35 * TEXT_PT
        sample = [(_LEFT, y - 2.6), (_LEFT + _SAMPLE, y - 2.6)]
        sketch.line(sample, stroke=stroke, width=1.4, dash=dash)
        sketch.text(_LEFT + _SAMPLE + 4.0, y, words(key))
    texts = tuple(_describe(words, key, points) for key, *_, points in lines)
    title = words("drawing.with_values", what=words("drawing.pressures"), values=texts)
    return sketch.write(_HEIGHT + 4.0, title, _WIDTH)


def _trace(case: GuidelineCase, height: float) -> list[Point]:
    """Outline of the load over the height that it stands on."""
    top = case.loaded_share * height
    pressure = (case.load_kN_per_m or 0.0) / top
    return [(0.0, 0.0), (pressure, 0.0), (pressure, top), (0.0, top)]


def _describe(words: Words, key: str, points: list[Point]) -> str:
    most = words.show_share(max(pressure for pressure, _ in points))
    return words("show.label", label=words(key), text=f"≤ {most} kPa")
