"""Small charts written as SVG directly: a page of twenty rows has a hundred of them.

A drawing library takes about a second for each such figure, this a millisecond. The
page is set in whatever sans-serif font the reader has. Widths of words are upper
estimates, by common ones (Arial, Helvetica, Liberation Sans, Source Sans), so that
labels that do not meet here do not meet there.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from html import escape
from itertools import pairwise

from netdesign.words.catalogue import Language, set_marks

_NARROW = frozenset("iljtfrI.,:;|'!()[]/ \u00a0\u202f-")
_WIDE = frozenset("mwMWÖÄÜŒœæ%−–—±≥≤→✓✗†")
_NARROW_EM, _LOWER_EM, _UPPER_EM, _WIDE_EM = 0.36, 0.58, 0.76, 0.92


def measure_words(text: str, size_pt: float) -> float:
    """Width of one line of text, at most [pt].

    >>> measure_words("mil", 10.0)
    16.4
    """
    return round(size_pt * sum(map(_measure_letter, text)), 1)


def _measure_letter(letter: str) -> float:
    if letter in _NARROW:
        return _NARROW_EM
    if letter in _WIDE:
        return _WIDE_EM
    return _UPPER_EM if letter.isupper() else _LOWER_EM


Point = tuple[float, float]

INK = "#1b1e22"
GREY = "#7d838b"  # of lines; words of that grey are too pale to read
SOFT = "#596069"
PALE = "#d3d7dc"
SNOW = "#f3f5f7"
ACCENT = "#b23a1e"  # what fails, and what governs; nothing else
BLUE = "#1d4f80"  # of the model: its forces and pressures
TEXT_PT = 8.0  # not less on paper, where a drawing is 180 mm wide
WIDTH = 72.0 * 6.9  # of every chart: the print area of A4 [pt]
_STRAIGHT = 0.15  # least bend that shows [pt]: a twentieth of a millimetre
_SHORTEST = 0.4  # of loose lines [pt]
_HEAD_LENGTH, _HEAD_HALF = 6.5, 2.3  # of an arrow [pt]
TICK = 2.5  # length of a tick [pt]
_APART = 3.0  # least space between the numbers of two ticks [pt]


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
    """A rectangle on the page and the values at its sides.

    ``left``, ``top``, ``width`` and ``height`` in points; x from left to right, y
    from bottom to top in the units of the data.
    """

    left: float
    top: float
    width: float
    height: float
    x_low: float
    x_high: float
    y_low: float
    y_high: float

    def x(self, value: float) -> float:
        """Place of a value along the page [pt]."""
        span = self.x_high - self.x_low
        share = (value - self.x_low) / span if span else 0.5
        return self.left + share * self.width

    def y(self, value: float) -> float:
        """Place of a value down the page [pt]."""
        span = self.y_high - self.y_low
        share = (value - self.y_low) / span if span else 0.5
        return self.top + (1.0 - share) * self.height

    def place(self, points: Iterable[Sequence[float]]) -> list[Point]:
        """Places of points, whatever else is known of them [pt]."""
        return [(self.x(float(point[0])), self.y(float(point[1]))) for point in points]


@dataclass(slots=True, kw_only=True)
class Chart:
    """Shapes of one chart, in the order in which they are painted; words above all."""

    shapes: list[str] = field(default_factory=list)
    labels: dict[str, list[str]] = field(default_factory=dict)  # by their attributes
    language: Language = "en"  # of its numbers

    def line(
        self,
        points: Iterable[tuple[float, float]],
        *,
        stroke: str = INK,
        width: float = 0.9,
        dash: str = "",
    ) -> None:
        """Open line through points [pt]."""
        path = _list_points(points)
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.shapes.append(
            f'<polyline points="{path}" fill="none" stroke="{stroke}" '
            f'stroke-width="{width}"{dashes}/>'
        )

    def area(self, points: Iterable[tuple[float, float]], fill: str) -> None:
        """Filled polygon [pt]."""
        path = _list_points(points)
        self.shapes.append(f'<polygon points="{path}" fill="{fill}"/>')

    def text(
        self,
        x: float,
        y: float,
        words: str,
        *,
        anchor: str = "start",
        fill: str = INK,
        bold: bool = False,
    ) -> None:
        """One line of text; y is its base line [pt]."""
        look = f'text-anchor="{anchor}"'
        look += "" if fill == INK else f' fill="{fill}"'
        look += ' font-weight="bold"' if bold else ""
        text = f'<text x="{show_place(x)}" y="{show_place(y)}">{escape(words)}</text>'
        self.labels.setdefault(look, []).append(text)

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
    ) -> None:
        """Loose lines in one path; those too short to be seen are left out."""
        path = "".join(
            _write_segment(a, b) for a, b in pairs if math.dist(a, b) > _SHORTEST
        )
        if path:
            self.shapes.append(
                f'<path d="{path}" fill="none" stroke="{stroke}" '
                f'stroke-width="{width}"/>'
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

    def write_tick(self, value: float) -> str:
        """Round number beside an axis or a dimension, with the language's mark."""
        return set_marks(f"{value:g}", self.language)

    def axes(self, frame: Frame, *, y_ticks: bool = True, x_ticks: bool = True) -> None:
        """Lines at the left and below, with few round ticks."""
        left, bottom = frame.left, frame.top + frame.height
        path = f"M{left:.1f} {frame.top:.1f}V{bottom:.1f}H{left + frame.width:.1f}"
        for value in list_loose_ticks(frame) if x_ticks else ():
            x = frame.x(value)
            path += f"M{show_place(x)} {show_place(bottom)}v{TICK}"
            self.text(
                x,
                bottom + TICK + TEXT_PT + 1.5,
                self.write_tick(value),
                anchor="middle",
            )
        most = max(2, min(5, int(frame.height / (1.4 * TEXT_PT))))
        for value in list_ticks(frame.y_low, frame.y_high, most) if y_ticks else ():
            y = frame.y(value)
            path += f"M{show_place(left)} {show_place(y)}h-{TICK}"
            self.text(
                left - TICK - 3.5,
                y + TEXT_PT / 3,
                self.write_tick(value),
                anchor="end",
            )
        self.shapes.append(
            f'<path d="{path}" fill="none" stroke="{GREY}" stroke-width="0.5"/>'
        )

    def write(self, height: float, title: str, width: float = WIDTH) -> str:
        """SVG element of the chart, the same bytes each time."""
        words = (
            f"<g {look}>{''.join(texts)}</g>" for look, texts in self.labels.items()
        )
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" role="img" '
            f'aria-label="{escape(title)}" width="{width:.0f}pt" '
            f'height="{height:.0f}pt" '
            f'viewBox="0 0 {width:.0f} {height:.0f}" font-size="{TEXT_PT}" '
            f'font-family="sans-serif" fill="{INK}">\n'
            + "\n".join((*self.shapes, *words))
            + "\n</svg>\n"
        )


def show_place(place: float) -> str:
    """Place on the page to a tenth of a point, without a zero that says nothing."""
    return f"{place:.1f}".removesuffix(".0")


def _write_segment(start: Point, end: Point) -> str:
    """Line of a path, its end counted from its start: fewer digits."""
    x, y = round(start[0], 1), round(start[1], 1)
    along, down = round(end[0], 1) - x, round(end[1], 1) - y
    line = f"{show_place(along)} {show_place(down)}"
    return f"M{show_place(x)} {show_place(y)}l{line}"


def _list_points(points: Iterable[tuple[float, float]]) -> str:
    return " ".join(f"{show_place(x)},{show_place(y)}" for x, y in points)


def drop_straight(points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Points without those that a straight line meets to a twentieth of a millimetre.

    Examples
    --------
    >>> drop_straight([(0.0, 0.0), (1.0, 1.01), (2.0, 2.0), (3.0, 5.0)])
    [(0.0, 0.0), (2.0, 2.0), (3.0, 5.0)]
    """
    kept, start = list(points[:1]), 0
    for end in range(2, len(points)):
        if _bends(points[start : end + 1]):
            start = end - 1
            kept.append(points[start])
    return [*kept, *points[1:][-1:]]


def _bends(points: Sequence[tuple[float, float]]) -> bool:
    """A point lies off the line from the first to the last one, so far that it shows.

    A page has a hundred thousand of these distances: they are worked out in place.
    """
    (x0, y0), (x1, y1) = points[0], points[-1]
    dx, dy = x1 - x0, y1 - y0
    length = math.hypot(dx, dy)
    if not length:
        return any(math.hypot(x - x0, y - y0) > _STRAIGHT for x, y in points)
    off = max([abs((x - x0) * dy - (y - y0) * dx) for x, y in points[1:-1]])
    return off / length > _STRAIGHT


def list_ticks(low: float, high: float, most: int = 5) -> list[float]:
    """Round numbers from low to high, a few of them.

    Examples
    --------
    >>> list_ticks(250.0, 450.0)
    [250.0, 300.0, 350.0, 400.0, 450.0]
    >>> list_ticks(3.0, 3.0)
    [3.0]
    """
    if not high > low:
        return [low]
    rough = (high - low) / (most - 1)
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(m * power for m in (1, 2, 2.5, 5, 10, 20) if m * power >= rough * 0.999)
    first = math.ceil(low / step - 1e-9)
    last = math.floor(high / step + 1e-9)
    return [round(k * step, 12) for k in range(first, last + 1)]


def list_loose_ticks(frame: Frame) -> list[float]:
    """Round numbers along the page, as many as stand apart; the first at least."""
    for most in (5, 4, 3, 2):
        ticks = list_ticks(frame.x_low, frame.x_high, most)
        wide = max((measure_words(f"{tick:g}", TEXT_PT) for tick in ticks), default=0.0)
        gaps = [frame.x(b) - frame.x(a) for a, b in pairwise(ticks)]
        if not gaps or min(gaps) > wide + _APART:
            return ticks
    return ticks[:1]


def bounds_of(values: Iterable[Sequence[float]]) -> tuple[float, float]:
    """Smallest and largest of several lists."""
    known = [value for part in values for value in part]
    return min(known), max(known)
