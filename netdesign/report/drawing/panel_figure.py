"""The last panel of a row: elevation, plan, and the tension along its two ropes.

All three share the axis along the row: the row's end is at the left, an inner post at
the right. Forces are to one scale.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from netdesign.report.drawing.figures import ACCENT, GREY, INK, PALE, TEXT_PT
from netdesign.report.drawing.plain_svg import WIDTH, Frame
from netdesign.report.drawing.sketch import Point, Sketch
from netdesign.report.view.panel_tables import name_rope
from netdesign.report.words import ENGLISH, Words
from netdesign.study.support_records import PanelDrawing, PanelRecord

_LEFT, _SPAN = 150.0, 160.0  # of the panel on paper [pt]
_LONGEST = 46.0  # arrow [pt]
_CHART, _GAP, _EDGE = 56.0, 26.0, 22.0


@dataclass(frozen=True, slots=True, kw_only=True)
class _View:
    """One of the two views: its place, and which part of the section it shows."""

    top: float
    part: int  # 0: downslope, 1: out of the ground
    origin: float  # value at its top [m]
    sign: float
    scale: float  # [pt/m]

    def at(self, along: float, value: float) -> Point:
        """Point on paper."""
        y = self.top + self.sign * (value - self.origin) * self.scale
        return _LEFT + along * self.scale, y


def draw_panel(panel: PanelRecord, words: Words = ENGLISH) -> str:
    """SVG of the drawn case's panel at a row's end; "" without one."""
    drawn = panel.drawing
    if drawn is None or not _is_whole(drawn):
        return ""
    spacing = 2.0 * drawn.places_m[-1]
    scale = _SPAN / spacing
    sketch = Sketch(language=words.language)
    per_kn = _LONGEST / max(drawn.lower_along_kN, drawn.upper_along_kN, 1e-9)
    bottom = _EDGE
    for part, title in ((1, "panel_view.elevation"), (0, "panel_view.plan")):
        view, end = _place_view(drawn, part, bottom, scale)
        sketch.words((6.0, bottom - 10.0), words(title), bold=True)
        _draw_view(sketch, view, drawn, per_kn, words)
        bottom = end + _GAP
    height = _draw_tensions(sketch, panel, drawn, bottom, words)
    return sketch.write(height, words("panel_view.drawing"))


def _is_whole(drawn: PanelDrawing) -> bool:
    """Each place has its points and tensions, and the panel a width."""
    places, ropes = drawn.places_m, drawn.rope_places_m
    points = (drawn.lower_m, drawn.upper_m)
    tensions = (drawn.lower_tensions_kN, drawn.upper_tensions_kN)
    return (
        bool(places and ropes)
        and all(len(one) == len(places) for one in points)
        and all(len(one) == len(ropes) for one in tensions)
        and places[-1] > 0.0
    )


def _place_view(
    drawn: PanelDrawing, part: int, top: float, scale: float
) -> tuple[_View, float]:
    """View below a line of the page, and where it ends [pt]."""
    points = (*drawn.lower_m, *drawn.upper_m, drawn.post_head_m, (0.0, 0.0))
    values = [one[part] for one in points]
    low, high = min(values), max(values)
    sign, origin = (-1.0, high) if part == 1 else (1.0, low)
    view = _View(top=top + 24.0, part=part, origin=origin, sign=sign, scale=scale)
    return view, view.top + (high - low) * scale + 30.0


def _mirror(
    places: Sequence[float], values: Sequence[float]
) -> list[tuple[float, float]]:
    """Values over the whole panel from those of its half, post to mid-panel."""
    width = 2.0 * places[-1]
    half = list(zip(places, values, strict=True))
    return [*half, *((width - place, value) for place, value in half[-2::-1])]


def _draw_view(
    sketch: Sketch, view: _View, drawn: PanelDrawing, per_kn: float, words: Words
) -> None:
    """Net and ropes of the panel, its supports, and the forces on the last of them."""
    part, spacing = view.part, 2.0 * drawn.places_m[-1]
    head = drawn.post_head_m[part]
    for place in (0.0, spacing):
        sketch.line([view.at(place, 0.0), view.at(place, head)], stroke=GREY, width=2.0)
    lower = _mirror(drawn.places_m, [one[part] for one in drawn.lower_m])
    upper = _mirror(drawn.places_m, [one[part] for one in drawn.upper_m])
    for (z, foot), (_, top) in zip(lower, upper, strict=True):
        sketch.line([view.at(z, foot), view.at(z, top)], stroke=PALE, width=0.6)
    for rope, level in ((lower, 0.0), (upper, head)):
        straight = [(0.0, level), (spacing, level)]
        sketch.line([view.at(*p) for p in straight], stroke=GREY, width=0.5, dash="2 2")
        whole = [straight[0], *rope, straight[1]]
        sketch.line([view.at(*p) for p in whole], stroke=INK, width=1.3)
    _draw_forces(sketch, view, drawn, per_kn, words)


def _draw_forces(
    sketch: Sketch, view: _View, drawn: PanelDrawing, per_kn: float, words: Words
) -> None:
    """Half a bay and the ropes' pull on the last support, a bay on the inner one."""
    part, spacing = view.part, 2.0 * drawn.places_m[-1]
    head = drawn.post_head_m[part]
    for place, share, along in ((0.0, 0.5, 1.0), (spacing, 1.0, 0.0)):
        for at, force, rope in (
            (0.0, drawn.foot_kN, drawn.lower_along_kN),
            (head, drawn.head_kN, drawn.upper_along_kN),
        ):
            start = view.at(place, at)
            across = view.sign * share * force[part]
            tip = (start[0] + along * rope * per_kn, start[1] + across * per_kn)
            sketch.arrow(start, tip)
            size = math.hypot(along * rope, share * math.hypot(*force))
            name = words.show_with_unit("size_kN", size)
            side = "end" if place == 0.0 else "start"
            label = (start[0] + (-6.0 if place == 0.0 else 6.0), start[1] - 3.0)
            sketch.words(label, name, anchor=side, fill=ACCENT)
    below = view.at(0.0, min(0.0, head))[1] + 26.0
    if part == 1:
        names = (words("panel_view.row_end"), words("panel_view.inner_post"))
        for place, name in zip((0.0, spacing), names, strict=True):
            sketch.words((view.at(place, 0.0)[0], below), name, anchor="middle")


def _draw_tensions(
    sketch: Sketch, panel: PanelRecord, drawn: PanelDrawing, top: float, words: Words
) -> float:
    """Tension of both ropes over the panel; height of the whole drawing [pt]."""
    sketch.words((6.0, top - 10.0), words("panel_view.tensions"), bold=True)
    spacing = 2.0 * drawn.places_m[-1]
    series = (
        ("lower", drawn.lower_tensions_kN, ""),
        ("upper", drawn.upper_tensions_kN, "4 2"),
    )
    most = max(max(values) for _, values, _ in series)
    frame = Frame(
        left=_LEFT,
        top=top + 4.0,
        width=_SPAN,
        height=_CHART,
        x_low=0.0,
        x_high=spacing,
        y_low=0.0,
        y_high=1.1 * most,
    )
    sketch.axes(frame)
    for name, values, dash in series:
        half = list(zip(drawn.rope_places_m, values, strict=True))
        whole = [*half, *((spacing - z, value) for z, value in half[::-1])]
        points = [(frame.x(z), frame.y(value)) for z, value in whole]
        sketch.line(points, stroke=INK, width=1.1, dash=dash)
        at = (points[-1][0] + 6.0, points[-1][1] + TEXT_PT / 3)
        for rope in panel.ropes:
            if rope.rope == name:
                sketch.words(at, f"{name_rope(rope, words)} {rope.type}".strip())
    sketch.words(
        (_LEFT + _SPAN / 2.0, top + _CHART + 26.0),
        words("panel_view.axis_along"),
        anchor="middle",
    )
    sketch.words((_LEFT - 24.0, top + 2.0), "kN", anchor="end")
    return min(top + _CHART + 34.0, 10.0 * WIDTH)
