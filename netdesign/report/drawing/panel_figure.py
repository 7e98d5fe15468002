"""The last panel of a row: elevation and plan.

They stand side by side. In each the row's end is at the left, an inner post at the
right. Forces are to one scale.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from netdesign.report.drawing.label_board import (
    LINE_PT,
    Box,
    LabelBoard,
    write_label,
)
from netdesign.report.drawing.plain_svg import (
    ACCENT,
    GREY,
    INK,
    PALE,
    TEXT_PT,
    Chart,
    Point,
    wrap_words,
)
from netdesign.report.words import ENGLISH, Words
from netdesign.study.support_records import PanelDrawing, PanelRecord

SPAN, LEFT = 56.0, 42.0  # of a panel on paper, room at its left [pt]
LONGEST = 22.0  # arrow [pt]
_SHORTEST = 0.02  # none of a force that would be shorter [pt]
_PLACE = 140.0  # from one picture to the next
_TOP = 3 * LINE_PT  # below titles of two lines
_AROUND = 4.0  # an arrow above and below a view
_WIDTH = 2 * _PLACE
_ROPE_NAMES = {"lower": "panel_view.lower", "upper": "panel_view.upper"}
_TITLES = ("panel_view.elevation", "panel_view.plan")


@dataclass(frozen=True, slots=True, kw_only=True)
class _View:
    """One of the two views: its place, and which part of the section it shows."""

    left: float
    top: float
    part: int  # 0: downslope, 1: out of the ground
    origin: float  # value at its top [m]
    sign: float
    scale: float  # [pt/m]

    def at(self, along: float, value: float) -> Point:
        """Point on paper."""
        y = self.top + self.sign * (value - self.origin) * self.scale
        return self.left + along * self.scale, y


def draw_panel(panel: PanelRecord, words: Words = ENGLISH) -> str:
    """SVG of the drawn case's panel at a row's end; "" without one."""
    drawn = panel.drawing
    if drawn is None or not _is_whole(drawn):
        return ""
    sketch = Chart(language=words.language)
    views = [_place_view(drawn, part, place) for place, part in enumerate((1, 0))]
    height = max(bottom for _, bottom in views)
    board = LabelBoard(width=_WIDTH, height=height)
    for place, title in enumerate(_TITLES):
        _write_title(sketch, board, words(title), place * _PLACE)
    _name_supports(sketch, board, views[0][1], words)
    for view, _ in views:
        _draw_view(sketch, view, drawn)
        _draw_forces(sketch, board, view, drawn, words)
    return sketch.write(height, _describe(panel, drawn, words), _WIDTH)


def _write_title(sketch: Chart, board: LabelBoard, text: str, left: float) -> None:
    width = _PLACE - 10.0
    for line, part in enumerate(wrap_words(text, 1.08 * TEXT_PT, width)):
        base = (line + 1) * LINE_PT
        sketch.text(left + 2.0, base, part, bold=True)
    board.reserve(Box(left, 0.0, left + width, 2.3 * LINE_PT))


def _name_supports(
    sketch: Chart, board: LabelBoard, bottom: float, words: Words
) -> None:
    """Row's end at the left, inner post at the right, side by side."""
    right = LEFT + SPAN + 28.0
    width = 0.5 * right - 4.0
    row_end, inner = words("panel_view.row_end"), words("panel_view.inner_post")
    for name, x, anchor in ((row_end, 2.0, "start"), (inner, right, "end")):
        for line, part in enumerate(wrap_words(name, TEXT_PT, width)):
            y = bottom - (1.6 - 1.1 * line) * LINE_PT
            sketch.text(x, y, part, anchor=anchor)
    board.reserve(Box(0.0, bottom - 2.5 * LINE_PT, right, bottom))


def _describe(panel: PanelRecord, drawn: PanelDrawing, words: Words) -> str:
    """Words for what the drawing says, with the largest tension of each rope."""
    tensions = {"lower": drawn.lower_tensions_kN, "upper": drawn.upper_tensions_kN}
    values = [
        words(
            "show.force_of",
            member=words(_ROPE_NAMES[rope.rope]),
            force=words.show_with_unit("size_kN", max(tensions[rope.rope])),
        )
        for rope in panel.ropes
        if rope.rope in tensions
    ]
    what = words("panel_view.drawing")
    return words("drawing.with_values", what=what, values=tuple(values))


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


def _place_view(drawn: PanelDrawing, part: int, place: int) -> tuple[_View, float]:
    """View at a place along the page, and where it ends [pt]."""
    points = (*drawn.lower_m, *drawn.upper_m, drawn.post_head_m, (0.0, 0.0))
    values = [one[part] for one in points]
    low, high = min(values), max(values)
    sign, origin = (-1.0, high) if part == 1 else (1.0, low)
    scale = SPAN / (2.0 * drawn.places_m[-1])
    reach = max(abs(one[part]) for one in (drawn.foot_kN, drawn.head_kN))
    around = _AROUND + max(LINE_PT, min(reach * _scale_forces(drawn), LONGEST))
    view = _View(
        left=place * _PLACE + LEFT,
        top=_TOP + around,
        part=part,
        origin=origin,
        sign=sign,
        scale=scale,
    )
    names = 2.5 * LINE_PT if part == 1 else 0.0
    return view, view.top + (high - low) * scale + around + names


def _scale_forces(drawn: PanelDrawing) -> float:
    """Length of an arrow for 1 kN [pt]."""
    return LONGEST / max(drawn.lower_along_kN, drawn.upper_along_kN, 1e-9)


def _mirror(
    places: Sequence[float], values: Sequence[float]
) -> list[tuple[float, float]]:
    """Values over the whole panel from those of its half, post to mid-panel."""
    width = 2.0 * places[-1]
    half = list(zip(places, values, strict=True))
    return [*half, *((width - place, value) for place, value in half[-2::-1])]


def _draw_view(sketch: Chart, view: _View, drawn: PanelDrawing) -> None:
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


def _draw_forces(
    sketch: Chart, board: LabelBoard, view: _View, drawn: PanelDrawing, words: Words
) -> None:
    """Half a bay and the ropes' pull on the last support, a bay on the inner one."""
    part, spacing = view.part, 2.0 * drawn.places_m[-1]
    per_kn = _scale_forces(drawn)
    head = drawn.post_head_m[part]
    labels = []
    for place, share, along in ((0.0, 0.5, 1.0), (spacing, 1.0, 0.0)):
        for at, force, rope in (
            (0.0, drawn.foot_kN, drawn.lower_along_kN),
            (head, drawn.head_kN, drawn.upper_along_kN),
        ):
            size = math.hypot(along * rope, share * math.hypot(*force))
            if size * per_kn < _SHORTEST:
                continue
            start = view.at(place, at)
            across = view.sign * share * force[part] * per_kn
            reach = math.copysign(min(abs(across), LONGEST), across)
            tip = (start[0] + along * rope * per_kn, start[1] + reach)
            sketch.arrow(start, tip)
            board.avoid([start, tip])
            name = words.show_with_unit("size_kN", size)
            side = (-1.0 if place == 0.0 else 1.0, 0.0)
            labels.append(write_label(name, start, side, ACCENT))
    for label in labels:
        board.draw(sketch, label)
