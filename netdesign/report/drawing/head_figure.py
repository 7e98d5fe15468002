"""Force polygon of the post head: a head in equilibrium closes it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate, pairwise

from netdesign.report.drawing.figures import ACCENT, INK
from netdesign.report.drawing.label_board import LabelBoard, write_label
from netdesign.report.drawing.plain_svg import WIDTH
from netdesign.report.drawing.sketch import Point, Sketch
from netdesign.report.words import ENGLISH, Words, show_member
from netdesign.structure.members import Member
from netdesign.study.support_records import HeadForce

_TALLEST, _WIDEST, _EDGE = 72.0, 90.0, 12.0  # of the polygon on paper [pt]
_WIDTH = WIDTH / 2  # half a page: a table stands beside it
_LEAST = 60.0  # height: room for four names below each other [pt]


def draw_head(forces: Sequence[HeadForce], words: Words = ENGLISH) -> str:
    """SVG of the polygon of at least two forces, each starting where one ends."""
    corners, height = _place_corners(forces)
    count = len(forces)
    middle = (
        sum(x for x, _ in corners[:count]) / count,
        sum(y for _, y in corners[:count]) / count,
    )
    sketch, values = Sketch(language=words.language), []
    board = LabelBoard(width=_WIDTH, height=height)
    for start, end in pairwise(corners):
        board.avoid([start, end])
    for force, (start, end) in zip(forces, pairwise(corners), strict=True):
        colour = ACCENT if force.member == Member.NET else INK
        sketch.arrow(start, end, stroke=colour, width=1.2)
        at, outward = _point_outward(start, end, middle)
        size = words.show_with_unit("size_kN", math.hypot(force.x_kN, force.y_kN))
        member = show_member(words, force.member)
        text = words("show.force_of", member=member, force=size)
        values.append(text)
        board.draw(sketch, write_label(text, at, outward, colour))
    what = words("drawing.polygon")
    title = words("drawing.with_values", what=what, values=tuple(values))
    return sketch.write(height, title, _WIDTH)


def _place_corners(forces: Sequence[HeadForce]) -> tuple[list[Point], float]:
    """Corners on paper, and its height [pt]."""
    xs = list(accumulate((force.x_kN for force in forces), initial=0.0))
    ys = list(accumulate((force.y_kN for force in forces), initial=0.0))
    wide, tall = max(xs) - min(xs), max(ys) - min(ys)
    scale = min(_TALLEST / max(tall, 1e-9), _WIDEST / max(wide, 1e-9))
    left = (_WIDTH - wide * scale) / 2
    corners = [
        (left + (x - min(xs)) * scale, _EDGE + (max(ys) - y) * scale)
        for x, y in zip(xs, ys, strict=True)
    ]
    return corners, max(_LEAST, tall * scale + 2 * _EDGE)


def _point_outward(start: Point, end: Point, middle: Point) -> tuple[Point, Point]:
    """Middle of a force, and the direction from it out of the polygon."""
    x, y = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    length = math.dist(start, end) or 1.0
    nx, ny = (end[1] - start[1]) / length, (start[0] - end[0]) / length
    if nx * (x - middle[0]) + ny * (y - middle[1]) < 0:
        nx, ny = -nx, -ny
    return (x, y), (nx, ny)
