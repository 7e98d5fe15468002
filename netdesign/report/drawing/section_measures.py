"""Paper of the section drawing, and its measures: heights, slope, distances."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from netdesign.report.drawing.label_board import Label, LabelBoard, write_label
from netdesign.report.drawing.plain_svg import GREY, SOFT, Chart, Point
from netdesign.report.words import Words
from netdesign.study.case_records import Drawing

PAPER = 336.0  # width of the drawing [pt]
_TALLEST = 168.0
_SIDE, _ABOVE, _BELOW = 8.0, 6.0, 24.0  # room for labels and scales [pt]
_LABELS = 62.0  # left of the ground, beside the bores [pt]
# Symbols are measured in heights of the net's head.
LONGEST_ARROW, BORE = 0.44, 0.40


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """The slope's axes turned so that gravity points down, and what is shown."""

    slope: float  # [rad]
    drawing: Drawing

    @property
    def unit(self) -> float:
        """Height of the head [m]: the measure of all symbols."""
        return max(self.drawing.head_m[1], 0.1)

    @property
    def top_end(self) -> float:
        """Place at which the snow is cut off uphill [m along the slope]."""
        return min(self.drawing.uphill_anchor_m[0], 0.0) - 0.4 * self.unit

    @property
    def snow_foot(self) -> float:
        """Foot of the snow's cut, which is upright where there is room for it [m]."""
        foot = self.top_end + self.drawing.snow_thickness_m * math.tan(self.slope)
        return foot if foot < -0.5 * self.unit else self.top_end

    @property
    def low_end(self) -> float:
        """Place at which the ground ends downhill [m along the slope]."""
        drawing = self.drawing
        lowest = max(drawing.downhill_anchor_m[0], drawing.head_m[0], 0.0)
        return lowest + 0.5 * self.unit

    def turn(self, point: Point) -> Point:
        """Point of the slope's axes in upright axes [m]."""
        x, y = point
        sin, cos = math.sin(self.slope), math.cos(self.slope)
        return x * cos + y * sin, y * cos - x * sin


@dataclass(frozen=True, slots=True, kw_only=True)
class Paper:
    """A frame on paper: metres of the slope become points, y downwards."""

    frame: Section
    scale: float  # points per metre
    height: float  # of the paper [pt]
    left: float  # upright x at the left edge [m]
    top: float  # upright y at the upper edge [m]

    def at(self, point: Point) -> Point:
        """Place of a point of the slope's axes."""
        x, y = self.frame.turn(point)
        return (x - self.left) * self.scale, (self.top - y) * self.scale

    def all_at(self, points: Sequence[Point]) -> list[Point]:
        """Places of several points."""
        return [self.at(point) for point in points]


def move(start: Point, along: Point, length: float) -> Point:
    """Point at ``length`` from ``start`` in the direction ``along``."""
    return start[0] + along[0] * length, start[1] + along[1] * length


def fit_paper(frame: Section) -> Paper:
    """Fit paper and drawing to each other."""
    drawing, unit = frame.drawing, frame.unit
    corners = [
        (frame.top_end, 0.0),
        (frame.top_end, drawing.snow_thickness_m),
        (frame.low_end, 0.0),
        (frame.low_end, drawing.head_m[1]),
        (drawing.head_m[0], drawing.head_m[1] + 0.1 * unit),
        (drawing.post_base_m[0], -LONGEST_ARROW * unit),
        (drawing.downhill_anchor_m[0], -BORE * unit),
    ]
    turned = [frame.turn(corner) for corner in corners]
    xs, ys = [x for x, _ in turned], [y for _, y in turned]
    wide, tall = max(xs) - min(xs), max(ys) - min(ys)
    room_x = PAPER - _LABELS - _SIDE
    scale = min(room_x / wide, (_TALLEST - _ABOVE - _BELOW) / tall)
    return Paper(
        frame=frame,
        scale=scale,
        height=tall * scale + _ABOVE + _BELOW,
        left=min(xs) - (_LABELS + (room_x - wide * scale) / 2) / scale,
        top=max(ys) + _ABOVE / scale,
    )


_TICK = 2.2  # half the length of a tick [pt]
_BELOW_GROUND = 9.0  # depth of the distances [pt]
_LEAST_LENGTH = 0.05  # distance that is worth a measure [m]


def draw_measures(
    sketch: Chart, paper: Paper, words: Words, board: LabelBoard
) -> list[Label]:
    """Draw the lines of all measures; their labels, the most confined first."""
    return [
        *_draw_distances(sketch, paper, words, board),
        *_draw_heights(sketch, paper, words, board),
        _draw_slope(sketch, paper, words),
    ]


def show_heights(paper: Paper, words: Words) -> tuple[str, str]:
    """Height of the net across the slope, and height of the snow, vertical."""
    drawing = paper.frame.drawing
    vertical = drawing.snow_thickness_m / math.cos(paper.frame.slope)
    net = words.show_with_unit("snow_thickness_m", drawing.head_m[1])
    snow = words.show_with_unit("snow_thickness_m", vertical)
    return words("drawing.net_height", height=net), words(
        "drawing.snow_height", height=snow
    )


def list_distances(paper: Paper) -> list[tuple[float, float]]:
    """Neighbours among anchors, net foot and post base [m along the slope]."""
    drawing = paper.frame.drawing
    points = (drawing.uphill_anchor_m, drawing.downhill_anchor_m, drawing.post_base_m)
    places = sorted({0.0, *(x for x, _ in points)})
    return [pair for pair in pairwise(places) if pair[1] - pair[0] > _LEAST_LENGTH]


def _draw_heights(
    sketch: Chart, paper: Paper, words: Words, board: LabelBoard
) -> list[Label]:
    """Height of the net downhill, that of the snow upright at its cut end."""
    frame, drawing = paper.frame, paper.frame.drawing
    net, snow = show_heights(paper, words)
    x = frame.low_end - 0.12 * frame.unit
    _draw_span(sketch, paper, ((x, 0.0), (x, drawing.head_m[1])), board)
    level = paper.all_at([drawing.head_m, (x, drawing.head_m[1])])
    sketch.line(level, stroke=GREY, width=0.4, dash="1 2")
    upright = [(frame.snow_foot, 0.0), (frame.top_end, drawing.snow_thickness_m)]
    sketch.line(paper.all_at(upright), stroke=GREY, width=0.5)
    surface = [upright[1], drawing.head_m]
    board.avoid(paper.all_at(upright))
    board.avoid(paper.all_at(surface))
    middle = (
        (frame.snow_foot + 2 * frame.top_end) / 3,
        0.62 * drawing.snow_thickness_m,
    )
    return [
        write_label(net, paper.at((x, 0.6 * drawing.head_m[1])), (1.0, 0.0), SOFT),
        write_label(snow, paper.at(middle), (1.0, 0.0), SOFT),
    ]


def _draw_distances(
    sketch: Chart, paper: Paper, words: Words, board: LabelBoard
) -> list[Label]:
    """Chain of distances along the slope, below the ground."""
    y = -_BELOW_GROUND / paper.scale
    labels = []
    for left, right in list_distances(paper):
        _draw_span(sketch, paper, ((left, y), (right, y)), board)
        at = paper.at(((left + right) / 2, y))
        text = words.show_with_unit("snow_thickness_m", right - left)
        labels.append(write_label(text, at, _turn_down(paper), SOFT))
    return labels


def _draw_span(
    sketch: Chart, paper: Paper, ends: tuple[Point, Point], board: LabelBoard
) -> None:
    """Line of a measure with a tick across each end."""
    sketch.line(paper.all_at(ends), stroke=GREY, width=0.4)
    board.avoid(paper.all_at(ends))
    is_along = ends[0][1] == ends[1][1]
    reach = _TICK / paper.scale
    dx, dy = (0.0, reach) if is_along else (reach, 0.0)
    for x, y in ends:
        tick = paper.all_at([(x - dx, y - dy), (x + dx, y + dy)])
        sketch.line(tick, stroke=GREY, width=0.4)


def _turn_down(paper: Paper) -> Point:
    """Direction on paper that leads away from the ground."""
    slope = paper.frame.slope
    return -math.sin(slope), math.cos(slope)


def _draw_slope(sketch: Chart, paper: Paper, words: Words) -> Label:
    """Angle of the slope at its low end."""
    frame = paper.frame
    x, y = paper.at((frame.low_end, 0.0))
    radius = 0.34 * frame.unit * paper.scale
    sketch.line([(x, y), (x - 1.15 * radius, y)], stroke=GREY, width=0.5)
    steps = [frame.slope * k / 12 for k in range(13)]
    arc = [(x - radius * math.cos(a), y - radius * math.sin(a)) for a in steps]
    sketch.line(arc, stroke=GREY, width=0.5)
    half = frame.slope / 2
    at = (x - radius * math.cos(half), y - radius * math.sin(half))
    text = f"{words.show_given(round(frame.drawing.slope_deg, 1))}°"
    return write_label(text, at, (-1.0, 0.0), SOFT)
