"""Shapes of the drawings of a net row: more than a chart has, still plain SVG."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from html import escape

from netdesign.report.drawing.plain_svg import Chart, show_place
from netdesign.report.drawing.style import ACCENT, INK

Point = tuple[float, float]

_SHORTEST = 0.4  # of loose lines [pt]
_HEAD_LENGTH, _HEAD_HALF = 6.5, 2.3  # of an arrow [pt]


class Sketch(Chart):
    """A chart that also has arrows, dots and many loose lines. All in points."""

    __slots__ = ()

    def dot(
        self, at: Point, radius: float, *, fill: str = INK, stroke: str = INK
    ) -> None:
        """Filled circle."""
        self.shapes.append(
            f'<circle cx="{at[0]:.2f}" cy="{at[1]:.2f}" r="{radius}" '
            f'fill="{fill}" stroke="{stroke}" stroke-width="0.8"/>'
        )

    def segments(
        self,
        pairs: Iterable[tuple[Point, Point]],
        *,
        stroke: str,
        width: float,
        clip: str = "",
    ) -> None:
        """Loose lines in one path; ``clip`` names an area that bounds them.

        Those too short to be seen are left out.
        """
        path = "".join(
            _write_segment(a, b) for a, b in pairs if math.dist(a, b) > _SHORTEST
        )
        within = f' clip-path="url(#{clip})"' if clip else ""
        if path:
            self.shapes.append(
                f'<path d="{path}" fill="none" stroke="{stroke}" '
                f'stroke-width="{width}"{within}/>'
            )

    def clip_area(self, name: str, points: Sequence[Point]) -> None:
        """Define an area that may bound other shapes."""
        path = " ".join(f"{show_place(x)},{show_place(y)}" for x, y in points)
        self.shapes.append(
            f'<clipPath id="{name}"><polygon points="{path}"/></clipPath>'
        )

    def arrow(
        self, start: Point, tip: Point, *, stroke: str = ACCENT, width: float = 1.5
    ) -> None:
        """Line with a filled head that ends at ``tip``."""
        length = math.dist(start, tip)
        if length == 0.0:
            return
        ux, uy = (tip[0] - start[0]) / length, (tip[1] - start[1]) / length
        head = min(_HEAD_LENGTH, 0.6 * length)
        half = _HEAD_HALF * head / _HEAD_LENGTH
        neck = (tip[0] - head * ux, tip[1] - head * uy)
        self.line([start, neck], stroke=stroke, width=width)
        left = (neck[0] - half * uy, neck[1] + half * ux)
        right = (neck[0] + half * uy, neck[1] - half * ux)
        self.area([tip, left, right], stroke)

    def words_of_size(
        self, at: Point, text: str, size: float, *, bold: bool = False
    ) -> None:
        """One line of text from a place on, in a size [pt]."""
        weight = ' font-weight="bold"' if bold else ""
        self.shapes.append(
            f'<text x="{at[0]:.2f}" y="{at[1]:.2f}" font-size="{size:.2f}"{weight}>'
            f"{escape(text)}</text>"
        )

    def words(
        self,
        at: Point,
        text: str,
        *,
        anchor: str = "start",
        fill: str = INK,
        bold: bool = False,
    ) -> None:
        """One line of text in a colour."""
        weight = ' font-weight="bold"' if bold else ""
        self.shapes.append(
            f'<text x="{at[0]:.2f}" y="{at[1]:.2f}" text-anchor="{anchor}" '
            f'fill="{fill}"{weight}>{escape(text)}</text>'
        )


def _write_segment(start: Point, end: Point) -> str:
    """Line of a path, its end counted from its start: fewer digits."""
    x, y = round(start[0], 1), round(start[1], 1)
    along, down = round(end[0], 1) - x, round(end[1], 1) - y
    line = f"{show_place(along)} {show_place(down)}"
    return f"M{show_place(x)} {show_place(y)}l{line}"
