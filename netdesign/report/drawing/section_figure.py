"""Section of a net row to scale, with its measures and the largest design forces."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from netdesign.numerics.curve import trace_curve
from netdesign.report.drawing.label_board import Box, Label, LabelBoard, write_label
from netdesign.report.drawing.plain_svg import (
    BLUE,
    GREY,
    INK,
    SNOW,
    SOFT,
    TEXT_PT,
    Chart,
    Point,
    drop_straight,
)
from netdesign.report.words import ENGLISH, Words, show_member
from netdesign.study.case_records import Drawing, PullRecord

# Design force [kN] and utilisation in words, by member.
Forces = Mapping[str, tuple[float, str]]
_PAPER = 336.0  # width of the drawing [pt]
_TALLEST = 168.0
_SIDE, _ABOVE, _BELOW = 8.0, 6.0, 24.0  # room for labels and scales [pt]
_LABELS = 62.0  # left of the ground, beside the bores [pt]
# Symbols are measured in heights of the net's head.
_LONGEST_ARROW, _BORE = 0.44, 0.40
_SHORTEST_ARROW = 6.0  # [pt]
_CHORDS = 6  # straight pieces that are drawn between two nodes of the net
_DOT = 2.0  # radius of a point on the ground [pt]
_FROM_DOT = 2.4  # between a point on the ground and the start of its arrow [pt]
_LENGTHS = (0.5, 1.0, 2.0, 5.0, 10.0)  # of the scale bar [m]
_ROUND = (1.0, 2.0, 5.0)  # first digits of the force that its arrow measures
_TICK = 2.2  # half the length of a tick [pt]
_BELOW_GROUND = 9.0  # depth of the distances [pt]
_LEAST_LENGTH = 0.05  # distance that is worth a measure [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Section:
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
class _Plate:
    """A section on paper, on which metres of the slope become points, y downwards."""

    frame: _Section
    scale: float  # points per metre
    left: float  # upright x at the left edge [m]
    top: float  # upright y at the upper edge [m]
    sketch: Chart
    board: LabelBoard
    forces: Forces
    words: Words

    @property
    def drawing(self) -> Drawing:
        """Net and points of the support."""
        return self.frame.drawing

    @property
    def most(self) -> float:
        """Largest force [kN]."""
        return max((force for force, _ in self.forces.values()), default=0.0)

    def at(self, point: Point) -> Point:
        """Place of a point of the slope's axes."""
        x, y = self.frame.turn(point)
        return (x - self.left) * self.scale, (self.top - y) * self.scale

    def all_at(self, points: Sequence[Point]) -> list[Point]:
        """Places of several points."""
        return [self.at(point) for point in points]


def _move(start: Point, along: Point, length: float) -> Point:
    """Point at ``length`` from ``start`` in the direction ``along``."""
    return start[0] + along[0] * length, start[1] + along[1] * length


def _fit_paper(frame: _Section, forces: Forces, words: Words) -> _Plate:
    """Fit paper and drawing to each other."""
    drawing, unit = frame.drawing, frame.unit
    corners = [
        (frame.top_end, 0.0),
        (frame.top_end, drawing.snow_thickness_m),
        (frame.low_end, 0.0),
        (frame.low_end, drawing.head_m[1]),
        (drawing.head_m[0], drawing.head_m[1] + 0.1 * unit),
        (drawing.post_base_m[0], -_LONGEST_ARROW * unit),
        (drawing.downhill_anchor_m[0], -_BORE * unit),
    ]
    turned = [frame.turn(corner) for corner in corners]
    xs, ys = [x for x, _ in turned], [y for _, y in turned]
    wide, tall = max(xs) - min(xs), max(ys) - min(ys)
    room_x = _PAPER - _LABELS - _SIDE
    scale = min(room_x / wide, (_TALLEST - _ABOVE - _BELOW) / tall)
    height = tall * scale + _ABOVE + _BELOW
    return _Plate(
        frame=frame,
        scale=scale,
        left=min(xs) - (_LABELS + (room_x - wide * scale) / 2) / scale,
        top=max(ys) + _ABOVE / scale,
        sketch=Chart(language=words.language),
        board=LabelBoard(width=_PAPER, height=height),
        forces=forces,
        words=words,
    )


def draw_section(
    drawing: Drawing,
    pulls: Sequence[PullRecord],
    forces: Forces,
    words: Words = ENGLISH,
) -> str:
    """SVG of the section.

    Parameters
    ----------
    drawing : Drawing
        Net under load in the governing case, and the points of the support.
    pulls : sequence of PullRecord
        Directions of pulls and bores of the anchors.
    forces : mapping
        Largest design force of each member [kN], over all cases and supports, with its
        utilisation as text.
    words : Words
        Of the language.
    """
    frame = _Section(slope=math.radians(drawing.slope_deg), drawing=drawing)
    plate = _fit_paper(frame, forces, words)
    _draw_ground(plate)
    measures = _draw_measures(plate)
    _draw_support(plate)
    labels = list(_draw_forces(plate, pulls))
    _draw_scales(plate)
    for label in (*labels, *measures):
        plate.board.draw(plate.sketch, label)
    return plate.sketch.write(plate.board.height, _describe(plate), _PAPER)


def _describe(plate: _Plate) -> str:
    """Words for what the drawing says, with its numbers."""
    words = plate.words
    lengths = [
        words.show_with_unit("snow_thickness_m", right - left)
        for left, right in _list_distances(plate)
    ]
    values = [
        words.show_with_unit("slope_deg", plate.drawing.slope_deg),
        *_show_heights(plate),
        words("drawing.distances", lengths=tuple(lengths)),
        *(
            words("show.label", label=show_member(words, member), text=text)
            for member, (_, text) in plate.forces.items()
        ),
    ]
    what = words("drawing.section")
    return words("drawing.with_values", what=what, values=tuple(values))


def _draw_ground(plate: _Plate) -> None:
    """Snow behind the net, and the line of the ground."""
    sketch = plate.sketch
    frame, drawing = plate.frame, plate.drawing
    thickness, top = drawing.snow_thickness_m, frame.top_end
    net = [point for piece in trace_curve(drawing.net_m, _CHORDS) for point in piece]
    covered = [(x, y) for x, y in net if y <= thickness]
    surface = [(covered[-1][0], thickness), (top, thickness)]
    curve = drop_straight(plate.all_at(covered))
    sketch.area(
        [plate.at((frame.snow_foot, 0.0)), *curve, *plate.all_at(surface)], SNOW
    )
    sketch.line(plate.all_at(surface), stroke=GREY, width=0.6, dash="3 2")
    start, end = top, frame.low_end
    step, depth = 0.16 * frame.unit, 0.05 * frame.unit
    ticks = (
        (plate.at((start + (i + 1) * step, 0.0)), plate.at((start + i * step, -depth)))
        for i in range(int((end - start) / step))
    )
    sketch.segments(ticks, stroke=GREY, width=0.4)
    sketch.line(plate.all_at([(start, 0.0), (end, 0.0)]), width=1.1)
    sketch.line(drop_straight(plate.all_at(net)), width=1.3)


def _draw_support(plate: _Plate) -> None:
    """Guys and post; labels keep off the lines that matter."""
    board = plate.board
    drawing, frame = plate.drawing, plate.frame
    post = plate.all_at([drawing.post_base_m, drawing.head_m])
    for anchor in (drawing.uphill_anchor_m, drawing.downhill_anchor_m):
        guy = plate.all_at([anchor, drawing.head_m])
        plate.sketch.line(guy, width=0.7)
        board.avoid(guy)
    plate.sketch.line(post, width=3.2)
    plate.sketch.line(post, width=1.8, stroke="#ffffff")
    board.avoid(post)
    board.avoid(plate.all_at(drawing.net_m))
    board.avoid(plate.all_at([(frame.top_end, 0.0), (frame.low_end, 0.0)]))


def _draw_forces(plate: _Plate, pulls: Sequence[PullRecord]) -> Iterator[Label]:
    """Arrows and bores at the points of the ground; their labels."""
    drawing = plate.drawing
    places = {
        "foot_anchor": (drawing.net_m[0], 1.0),
        "uphill_anchor": (drawing.uphill_anchor_m, 1.0),
        "downhill_anchor": (drawing.downhill_anchor_m, -1.0),
    }
    for pull in pulls:
        if pull.anchor not in places:
            continue
        start, side = places.pop(pull.anchor)
        axis = (-side * math.cos(pull.axis), -math.sin(pull.axis))
        _draw_bore(plate, start, axis)
        angle = math.radians((pull.least_deg + pull.largest_deg) / 2.0)
        along = (side * math.cos(angle), math.sin(angle))
        yield from _draw_force(plate, start, along, pull.anchor)
    base, head = drawing.post_base_m, drawing.head_m
    length = math.dist(base, head) or 1.0
    along = ((base[0] - head[0]) / length, (base[1] - head[1]) / length)
    yield from _draw_force(plate, base, along, "post_base")
    for start, _ in places.values():
        plate.sketch.dot(plate.at(start), _DOT, fill="#ffffff")


def _draw_bore(plate: _Plate, start: Point, axis: Point) -> None:
    """Rod in the ground along its axis, cut short."""
    reach = _BORE * plate.frame.unit
    ends = plate.all_at([_move(start, axis, share * reach) for share in (0.0, 0.75, 1)])
    plate.sketch.line(ends[:2], width=1.8)
    plate.sketch.line(ends[1:], width=1.8, dash="2 2")
    plate.board.avoid([ends[0], ends[2]])


def _draw_force(
    plate: _Plate, start: Point, along: Point, member: str
) -> Iterator[Label]:
    """Arrow of a design force; its label hangs at the point on the ground."""
    force, text = plate.forces.get(member, (0.0, ""))
    if force > 0.0:
        longest = _LONGEST_ARROW * plate.frame.unit
        length = max(longest * force / plate.most, _SHORTEST_ARROW / plate.scale)
        gap = _FROM_DOT / plate.scale
        ends = [plate.at(_move(start, along, x)) for x in (gap, gap + length)]
        plate.sketch.arrow(ends[0], ends[1], stroke=BLUE, width=1.7)
        plate.board.avoid(ends)
    plate.sketch.dot(plate.at(start), _DOT, fill="#ffffff")
    if text:
        lines = ((show_member(plate.words, member), INK), (text, BLUE))
        toward = (0.6, -1.0) if member == "uphill_anchor" else (-1.0, 0.25)
        yield Label(lines=lines, at=plate.at(start), toward=toward)


def _draw_scales(plate: _Plate) -> None:
    """Bars of a round length and of a round force, at the lower left."""
    sketch = plate.sketch
    bottom = plate.board.height - 5.0
    inch = 72.0 / plate.scale
    length = max(step for step in _LENGTHS if step <= max(0.5, 0.8 * inch))
    end = 4.0 + length * plate.scale
    sketch.line([(4.0, bottom), (end, bottom)], width=1.6)
    sketch.text(end + 4.0, bottom + 2.8, f"{sketch.write_tick(length)} m", fill=SOFT)
    if plate.most > 0.0:
        power = 10.0 ** math.floor(math.log10(plate.most))
        force = max(x * power for x in _ROUND if x * power <= plate.most)
        start = end + 34.0
        share = _LONGEST_ARROW * force / plate.most
        end = start + share * plate.frame.unit * plate.scale
        sketch.arrow((start, bottom), (end, bottom), stroke=BLUE, width=1.7)
        shown = f"{sketch.write_tick(force)} kN"
        sketch.text(end + 4.0, bottom + 2.8, shown, fill=SOFT)
    plate.board.reserve(Box(0.0, bottom - TEXT_PT, end + 40.0, plate.board.height))


def _draw_measures(plate: _Plate) -> list[Label]:
    """Draw the lines of all measures; their labels, the most confined first."""
    return [
        *_draw_distances(plate),
        *_draw_heights(plate),
        _draw_slope(plate),
    ]


def _show_heights(plate: _Plate) -> tuple[str, str]:
    """Height of the net across the slope, and height of the snow, vertical."""
    drawing = plate.drawing
    vertical = drawing.snow_thickness_m / math.cos(plate.frame.slope)
    words = plate.words
    net = words.show_with_unit("snow_thickness_m", drawing.head_m[1])
    snow = words.show_with_unit("snow_thickness_m", vertical)
    return words("drawing.net_height", height=net), words(
        "drawing.snow_height", height=snow
    )


def _list_distances(plate: _Plate) -> list[tuple[float, float]]:
    """Neighbours among anchors, net foot and post base [m along the slope]."""
    drawing = plate.drawing
    points = (drawing.uphill_anchor_m, drawing.downhill_anchor_m, drawing.post_base_m)
    places = sorted({0.0, *(x for x, _ in points)})
    return [pair for pair in pairwise(places) if pair[1] - pair[0] > _LEAST_LENGTH]


def _draw_heights(plate: _Plate) -> list[Label]:
    """Height of the net downhill, that of the snow upright at its cut end."""
    frame, drawing = plate.frame, plate.drawing
    net, snow = _show_heights(plate)
    x = frame.low_end - 0.12 * frame.unit
    _draw_span(plate, ((x, 0.0), (x, drawing.head_m[1])))
    level = plate.all_at([drawing.head_m, (x, drawing.head_m[1])])
    plate.sketch.line(level, stroke=GREY, width=0.4, dash="1 2")
    upright = [(frame.snow_foot, 0.0), (frame.top_end, drawing.snow_thickness_m)]
    plate.sketch.line(plate.all_at(upright), stroke=GREY, width=0.5)
    surface = [upright[1], drawing.head_m]
    plate.board.avoid(plate.all_at(upright))
    plate.board.avoid(plate.all_at(surface))
    middle = (
        (frame.snow_foot + 2 * frame.top_end) / 3,
        0.62 * drawing.snow_thickness_m,
    )
    return [
        write_label(net, plate.at((x, 0.6 * drawing.head_m[1])), (1.0, 0.0), SOFT),
        write_label(snow, plate.at(middle), (1.0, 0.0), SOFT),
    ]


def _draw_distances(plate: _Plate) -> list[Label]:
    """Chain of distances along the slope, below the ground."""
    y = -_BELOW_GROUND / plate.scale
    labels = []
    for left, right in _list_distances(plate):
        _draw_span(plate, ((left, y), (right, y)))
        at = plate.at(((left + right) / 2, y))
        text = plate.words.show_with_unit("snow_thickness_m", right - left)
        labels.append(write_label(text, at, _turn_down(plate), SOFT))
    return labels


def _draw_span(plate: _Plate, ends: tuple[Point, Point]) -> None:
    """Line of a measure with a tick across each end."""
    plate.sketch.line(plate.all_at(ends), stroke=GREY, width=0.4)
    plate.board.avoid(plate.all_at(ends))
    is_along = ends[0][1] == ends[1][1]
    reach = _TICK / plate.scale
    dx, dy = (0.0, reach) if is_along else (reach, 0.0)
    for x, y in ends:
        tick = plate.all_at([(x - dx, y - dy), (x + dx, y + dy)])
        plate.sketch.line(tick, stroke=GREY, width=0.4)


def _turn_down(plate: _Plate) -> Point:
    """Direction on paper that leads away from the ground."""
    slope = plate.frame.slope
    return -math.sin(slope), math.cos(slope)


def _draw_slope(plate: _Plate) -> Label:
    """Angle of the slope at its low end."""
    frame = plate.frame
    x, y = plate.at((frame.low_end, 0.0))
    radius = 0.34 * frame.unit * plate.scale
    plate.sketch.line([(x, y), (x - 1.15 * radius, y)], stroke=GREY, width=0.5)
    steps = [frame.slope * k / 12 for k in range(13)]
    arc = [(x - radius * math.cos(a), y - radius * math.sin(a)) for a in steps]
    plate.sketch.line(arc, stroke=GREY, width=0.5)
    half = frame.slope / 2
    at = (x - radius * math.cos(half), y - radius * math.sin(half))
    text = f"{plate.words.show_given(round(frame.drawing.slope_deg, 1))}°"
    return write_label(text, at, (-1.0, 0.0), SOFT)
