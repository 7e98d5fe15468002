"""Frame of the section drawing: the slope's axes turned upright, on paper."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from netdesign.report.drawing.plain_svg import WIDTH
from netdesign.study.support_records import Drawing

Point = tuple[float, float]

# Symbols are measured in heights of the net's head, room for labels in points.
MEASURES = 0.2  # room that heights take beside the snow
LONGEST_ARROW, ROD = 0.46, 0.16
_LEFT, _RIGHT = 74.0, 198.0  # room for labels, and right for the pressure, too
_TOP, _BOTTOM = 9.0, 30.0
_TALLEST = 170.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
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

    frame: Frame
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


def fit_paper(frame: Frame, least: float) -> Paper:
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
