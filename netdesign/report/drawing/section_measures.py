"""Paper of the section drawing, and its measures: heights, angles, distances."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from netdesign.report.drawing.label_board import Label, LabelBoard, write_label
from netdesign.report.drawing.plain_svg import GREY, WIDTH, Chart, Point
from netdesign.report.words import Words
from netdesign.study.support_records import Drawing

# Symbols are measured in heights of the net's head, room for labels in points.
MEASURES = 0.2  # room that heights take beside the snow
LONGEST_ARROW, ROD = 0.46, 0.16
_LEFT, _RIGHT = 74.0, 198.0  # room for labels, and right for the pressure, too
_TOP, _BOTTOM = 9.0, 30.0
_TALLEST = 152.0


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
        return min(self.drawing.uphill_anchor_m[0], 0.0) - 0.3 * self.unit

    @property
    def low_end(self) -> float:
        """Place at which the ground ends downhill [m along the slope]."""
        drawing = self.drawing
        lowest = max(drawing.downhill_anchor_m[0], drawing.head_m[0], 0.0)
        return lowest + 0.36 * self.unit

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


def fit_paper(frame: Section, least: float) -> Paper:
    """Fit paper and drawing to each other; the paper is ``least`` high [pt]."""
    drawing, unit = frame.drawing, frame.unit
    corners = [
        (frame.top_end, 0.0),
        (frame.top_end, drawing.snow_thickness_m),
        (frame.top_end - MEASURES * unit, drawing.head_m[1]),
        (frame.low_end, 0.0),
        (drawing.head_m[0], drawing.head_m[1] + 0.1 * unit),
        (drawing.post_base_m[0], -(LONGEST_ARROW + 0.1) * unit),
        (drawing.downhill_anchor_m[0], -(ROD + 0.1) * unit),
    ]
    turned = [frame.turn(corner) for corner in corners]
    xs, ys = [x for x, _ in turned], [y for _, y in turned]
    wide, tall = max(xs) - min(xs), max(ys) - min(ys)
    room_x = WIDTH - _LEFT - _RIGHT
    room_y = _TALLEST - _TOP - _BOTTOM
    scale = min(room_x / wide, room_y / tall)
    return Paper(
        frame=frame,
        scale=scale,
        height=max(least, tall * scale + _TOP + _BOTTOM),
        left=min(xs) - (_LEFT + (room_x - wide * scale) / 2) / scale,
        top=max(ys) + _TOP / scale,
    )


# All in heights of the head.
_CHAIN = 0.21  # depth of the distances below the ground
_TICK = 0.03
_OUTSIDE = 0.07  # between the snow's cut end and the first of the two heights
_BETWEEN = 0.10  # from it to the second
_ARC_NET, _ARC_POST = 0.62, 0.42  # radius of the angles
_LEAST_LENGTH = 0.05  # distance that is worth a measure [m]
_SAME = 0.005  # heights that agree to the centimetre are one


def draw_measures(
    sketch: Chart, paper: Paper, words: Words, board: LabelBoard
) -> list[Label]:
    """Draw the lines of all measures; their labels, the most confined first."""
    return [
        *_draw_tilts(sketch, paper, words),
        *_draw_distances(sketch, paper, words, board),
        *_draw_heights(sketch, paper, words, board),
        _draw_slope(sketch, paper, words),
    ]


def show_heights(paper: Paper, words: Words) -> tuple[str, str]:
    """Height of the net and thickness of the snow, across the slope and vertical.

    Whoever typed one for the other sees it.
    """
    frame, drawing = paper.frame, paper.frame.drawing

    def show(across: str, upright: str, size: float) -> str:
        vertical = size / math.cos(frame.slope)
        sizes = [words.show_with_unit("snow_thickness_m", x) for x in (size, vertical)]
        return f"{across} = {sizes[0]} ({upright} = {sizes[1]})"

    return show("Dk", "Hk", drawing.head_m[1]), show("d", "H", drawing.snow_thickness_m)


def find_post_tilt(paper: Paper) -> float:
    """Angle of the post from the slope's normal, head downslope positive [degree]."""
    drawing = paper.frame.drawing
    across = drawing.head_m[0] - drawing.post_base_m[0]
    return math.degrees(math.atan2(across, drawing.head_m[1]))


def list_distances(paper: Paper) -> list[tuple[float, float]]:
    """Neighbours among anchors, net foot and post base [m along the slope]."""
    drawing = paper.frame.drawing
    points = (drawing.uphill_anchor_m, drawing.downhill_anchor_m, drawing.post_base_m)
    places = sorted({0.0, *(x for x, _ in points)})
    return [pair for pair in pairwise(places) if pair[1] - pair[0] > _LEAST_LENGTH]


def _draw_heights(
    sketch: Chart, paper: Paper, words: Words, board: LabelBoard
) -> list[Label]:
    """Thickness of the snow at its cut end, the height of the net outside of it."""
    frame, drawing = paper.frame, paper.frame.drawing
    net, snow = show_heights(paper, words)
    heights = [(drawing.snow_thickness_m, snow), (drawing.head_m[1], net)]
    if abs(heights[0][0] - heights[1][0]) < _SAME:
        heights = [(drawing.head_m[1], net.replace(" ", " = d ", 1))]
    labels = []
    for place, (height, text) in enumerate(heights):
        x = frame.top_end - (_OUTSIDE + place * _BETWEEN) * frame.unit
        _draw_span(sketch, paper, (x, 0.0), (x, height))
        board.avoid(paper.all_at([(x, 0.0), (x, height)]))
        at = paper.at((x, height * (0.4 + 0.35 * place)))
        labels.append(write_label(text, at, (-1.0, 0.0)))
    if len(heights) > 1:
        ends = [(x, drawing.head_m[1]), drawing.head_m]
        sketch.line(paper.all_at(ends), stroke=GREY, width=0.4, dash="1 2")
    return labels


def _draw_distances(
    sketch: Chart, paper: Paper, words: Words, board: LabelBoard
) -> list[Label]:
    """Chain of distances along the slope, below the ground."""
    y = -_CHAIN * paper.frame.unit
    below = _turn_down(paper)
    labels = []
    for left, right in list_distances(paper):
        _draw_span(sketch, paper, (left, y), (right, y))
        board.avoid(paper.all_at([(left, y), (right, y)]))
        at = paper.at(((left + right) / 2, y))
        text = words.show_with_unit("snow_thickness_m", right - left)
        labels.append(write_label(text, at, below))
    return labels


def _draw_span(sketch: Chart, paper: Paper, start: Point, end: Point) -> None:
    """Line of a measure with a tick across each end."""
    sketch.line(paper.all_at([start, end]), stroke=GREY, width=0.5)
    reach = _TICK * paper.frame.unit
    is_along = start[1] == end[1]
    dx, dy = (0.0, reach) if is_along else (reach, 0.0)
    for x, y in (start, end):
        tick = paper.all_at([(x - dx, y - dy), (x + dx, y + dy)])
        sketch.line(tick, stroke=GREY, width=0.5)


def _turn_down(paper: Paper) -> Point:
    """Direction on paper that leads away from the ground."""
    slope = paper.frame.slope
    return -math.sin(slope), math.cos(slope)


def _draw_tilts(sketch: Chart, paper: Paper, words: Words) -> list[Label]:
    """Inclinations of net and post, each from the slope's normal."""
    drawing = paper.frame.drawing
    net = math.atan2(*drawing.head_m)
    post = math.radians(find_post_tilt(paper))
    shown = words.show_with_unit("inclination_deg", drawing.case.inclination_deg)
    labels = [_draw_angle(sketch, paper, (0.0, net), _ARC_NET, f"θ = {shown}")]
    if abs(post) > 1e-3:
        angle = words.show_with_unit("slope_deg", math.degrees(post))
        text = words("drawing.post_angle", angle=angle)
        base = (drawing.post_base_m[0], post)
        labels.append(_draw_angle(sketch, paper, base, _ARC_POST, text))
    return labels


def _draw_angle(
    sketch: Chart, paper: Paper, of: tuple[float, float], share: float, text: str
) -> Label:
    """Angle (place along the slope, angle) between the normal there and a member."""
    x, angle = of
    radius = share * paper.frame.unit
    steps = [angle * k / 8 for k in range(9)]
    arc = [(x + radius * math.sin(a), radius * math.cos(a)) for a in steps]
    normal = [(x, 0.0), (x, 1.12 * radius)]
    sketch.line(paper.all_at(normal), stroke=GREY, width=0.5, dash="2 2")
    sketch.line(paper.all_at(arc), stroke=GREY, width=0.5)
    at = paper.at(normal[1])
    up = _turn_down(paper)
    return write_label(text, at, (-up[0] - 0.6, -up[1]))


def _draw_slope(sketch: Chart, paper: Paper, words: Words) -> Label:
    """Angle of the slope at its low end."""
    frame = paper.frame
    x, y = paper.at((frame.low_end - 0.36 * frame.unit, 0.0))
    radius = 0.28 * frame.unit * paper.scale
    sketch.line([(x, y), (x + 1.15 * radius, y)], stroke=GREY, width=0.5)
    steps = [frame.slope * k / 12 for k in range(13)]
    arc = [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in steps]
    sketch.line(arc, stroke=GREY, width=0.5)
    half = frame.slope / 2
    at = (x + radius * math.cos(half), y + radius * math.sin(half))
    text = f"ψ = {words.show_with_unit('slope_deg', frame.drawing.slope_deg)}"
    return write_label(text, at, (1.0, 0.0))


def describe_measures(paper: Paper, words: Words) -> list[str]:
    """All measures in words, for those who cannot see them."""
    drawing = paper.frame.drawing
    angle = words.show_with_unit("slope_deg", find_post_tilt(paper))
    inclination = words.show_with_unit("inclination_deg", drawing.case.inclination_deg)
    lengths = [
        words.show_with_unit("snow_thickness_m", right - left)
        for left, right in list_distances(paper)
    ]
    return [
        f"ψ = {words.show_with_unit('slope_deg', drawing.slope_deg)}",
        *show_heights(paper, words),
        f"θ = {inclination}",
        words("drawing.post_angle", angle=angle),
        words("drawing.distances", lengths=tuple(lengths)),
    ]
