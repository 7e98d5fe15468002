"""Words of the section drawing: labels of forces, dimensions, scale, legend."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from netdesign.report.drawing.figures import ACCENT, GREY, INK, TEXT_PT
from netdesign.report.drawing.plain_svg import WIDTH
from netdesign.report.drawing.section_frame import LABEL, Paper, Point
from netdesign.report.drawing.sketch import Sketch
from netdesign.report.words import Words

SLIP_DASH = "2.2 1.5"  # of the net where the snow slips on it
_LINE = 11.0  # from one line of a label to the next [pt]
_LEGEND = (
    ("drawing.net_sticks", INK, 1.8, ""),
    ("drawing.net_slips", INK, 1.8, SLIP_DASH),
    ("drawing.force_on_ground", ACCENT, 1.5, ""),
)


@dataclass(frozen=True, slots=True)
class Label:
    """A force by name, and where on the paper it belongs [pt]."""

    name: str
    force: str
    at: Point


def place_labels(sketch: Sketch, labels: Sequence[Label]) -> None:
    """Labels hang left below their anchors; those that would touch move down."""
    ceiling = -math.inf
    for label in sorted(labels, key=lambda label: label.at[1]):
        x, y = label.at
        top = max(y, ceiling)
        if top > y:
            sketch.line([(x, y), (x, top + 7.0)], stroke=GREY, width=0.4)
        base = top + TEXT_PT
        sketch.words((x - 5.0, base), label.name, anchor="end")
        sketch.words((x - 5.0, base + _LINE), label.force, anchor="end", fill=ACCENT)
        ceiling = top + LABEL


def draw_scale_bar(sketch: Sketch, paper: Paper) -> None:
    """Bar of a round length near one inch."""
    inch = 72.0 / paper.scale
    length = max(step for step in (0.5, 1, 2, 5, 10) if step <= max(0.5, 0.9 * inch))
    right, bottom = WIDTH - 11.0, paper.height - 14.0
    left = right - length * paper.scale
    sketch.line([(left, bottom), (right, bottom)], width=1.6)
    middle = ((left + right) / 2, bottom - 4.5)
    sketch.words(middle, f"{sketch.write_tick(length)} m", anchor="middle")


def draw_legend(sketch: Sketch, words: Words) -> None:
    """Explain the lines; the words end at them, however wide their font is."""
    right = WIDTH - 11.0
    for place, (key, stroke, width, dash) in enumerate(_LEGEND):
        y = 12.0 + 13.0 * place
        ends = [(right - 19.0, y), (right, y)]
        sketch.line(ends, stroke=stroke, width=width, dash=dash)
        sketch.words((right - 25.0, y + 2.6), words(key), anchor="end")


def draw_dimensions(sketch: Sketch, paper: Paper, words: Words) -> None:
    """Thickness of the snow at its cut end, angle of the slope at the low end."""
    frame, drawing, unit = paper.frame, paper.frame.drawing, paper.frame.unit
    x = frame.top_end - 0.08 * unit
    ends = paper.all_at([(x, 0.0), (x, drawing.snow_thickness_m)])
    sketch.line(ends, stroke=GREY, width=0.5)
    reach = 0.03 * unit
    for y in (0.0, drawing.snow_thickness_m):
        tick = paper.all_at([(x - reach, y), (x + reach, y)])
        sketch.line(tick, stroke=GREY, width=0.5)
    at = paper.at((x - 0.05 * unit, drawing.snow_thickness_m / 2))
    text = f"d = {words.show_with_unit('snow_thickness_m', drawing.snow_thickness_m)}"
    sketch.words((at[0] - 2.0, at[1]), text, anchor="end")
    _draw_angle(sketch, paper, words)


def _draw_angle(sketch: Sketch, paper: Paper, words: Words) -> None:
    frame = paper.frame
    x, y = paper.at((frame.low_end - 0.42 * frame.unit, 0.0))
    radius = 0.34 * frame.unit * paper.scale
    sketch.line([(x, y), (x + 1.15 * radius, y)], stroke=GREY, width=0.5)
    steps = [frame.slope * k / 12 for k in range(13)]
    arc = [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in steps]
    sketch.line(arc, stroke=GREY, width=0.5)
    half = frame.slope / 2
    at = (x + 1.15 * radius * math.cos(half), y + 1.15 * radius * math.sin(half) + 2.6)
    text = f"ψ = {words.show_with_unit('slope_deg', frame.drawing.slope_deg)}"
    sketch.words(at, text)
