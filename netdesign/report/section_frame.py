"""Frame of the section drawing: the slope's axes turned upright, and its limits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from netdesign.report.figures import WIDTH_IN
from netdesign.study import Drawing

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Point = tuple[float, float]

# Symbols are measured in heights of the net's head, room for labels in inches.
LONGEST_ARROW, ROD = 0.46, 0.16
LINE_IN = 0.34  # height of a label of two lines
_LEFT_IN, _RIGHT_IN, _EDGE_IN = 1.25, 1.5, 0.12
_TALLEST_IN = 3.8


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
        """Where the snow is cut off uphill [m along the slope]."""
        return min(self.drawing.uphill_anchor_m[0], 0.0) - 0.45 * self.unit

    @property
    def low_end(self) -> float:
        """Where the ground ends downhill [m along the slope]."""
        drawing = self.drawing
        lowest = max(drawing.downhill_anchor_m[0], drawing.head_m[0], 0.0)
        return lowest + 0.45 * self.unit

    def turn(self, point: Point) -> Point:
        """Point of the slope's axes in upright axes."""
        x, y = point
        sin, cos = math.sin(self.slope), math.cos(self.slope)
        return x * cos + y * sin, y * cos - x * sin

    def turn_all(self, points: Sequence[Point]) -> tuple[list[float], list[float]]:
        """Upright coordinates, all x and all y."""
        turned = [self.turn(point) for point in points]
        return [x for x, _ in turned], [y for _, y in turned]


def move(start: Point, along: Point, length: float) -> Point:
    """Point at ``length`` from ``start`` in the direction ``along``."""
    return start[0] + along[0] * length, start[1] + along[1] * length


def set_limits(figure: Figure, axes: Axes, frame: Frame) -> float:
    """Fit paper and drawing to each other; returns metres per inch."""
    drawing, unit = frame.drawing, frame.unit
    corners = [
        (frame.top_end, 0.0),
        (frame.top_end, drawing.snow_thickness_m),
        (frame.low_end, 0.0),
        (drawing.head_m[0], drawing.head_m[1] + 0.1 * unit),
        (drawing.post_base_m[0], -(LONGEST_ARROW + 0.1) * unit),
        (drawing.downhill_anchor_m[0], -(ROD + 0.1) * unit),
    ]
    xs, ys = frame.turn_all(corners)
    wide, tall = max(xs) - min(xs), max(ys) - min(ys)
    room_x = WIDTH_IN - _LEFT_IN - _RIGHT_IN
    room_y = _TALLEST_IN - 2 * _EDGE_IN - LINE_IN
    scale = max(wide / room_x, tall / room_y)
    height = tall / scale + 2 * _EDGE_IN + LINE_IN
    figure.set_size_inches(WIDTH_IN, height)
    left = min(xs) - (_LEFT_IN + (room_x - wide / scale) / 2) * scale
    bottom = min(ys) - (_EDGE_IN + LINE_IN) * scale
    axes.set_xlim(left, left + WIDTH_IN * scale)
    axes.set_ylim(bottom, bottom + height * scale)
    return scale
