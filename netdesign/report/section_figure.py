"""Section of a net row to scale: slope, snow, net, support, forces."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from netdesign.report.figures import (
    ACCENT,
    GREY,
    INK,
    PALE,
    SNOW,
    TEXT_PT,
    WIDTH_IN,
    use_style,
    write_svg,
)
from netdesign.report.words import name_member, show_with_unit
from netdesign.study import Arrow, Drawing

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Point = tuple[float, float]

_LONGEST_ARROW, _SHORTEST_ARROW = 0.46, 0.14  # of the height of the head
_ROD = 0.16  # drawn length of an anchor in the ground, same unit
_LEFT_IN, _RIGHT_IN, _EDGE_IN = 1.25, 1.5, 0.12  # room for labels
_LINE_IN = 0.34  # height of a label of two lines
_TALLEST_IN = 4.3


@dataclass(frozen=True, slots=True, kw_only=True)
class _Frame:
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


@dataclass(frozen=True, slots=True)
class _Label:
    name: str
    force: str
    at: Point  # upright axes


def draw_section(drawing: Drawing, name: str) -> str:
    """SVG of the section in the case of ``drawing``."""
    from matplotlib.figure import Figure

    frame = _Frame(slope=math.radians(drawing.slope_deg), drawing=drawing)
    with use_style(name):
        figure = Figure(figsize=(WIDTH_IN, _TALLEST_IN))
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set_axis_off()
        _draw_snow(axes, frame)
        _draw_ground(axes, frame)
        _draw_support(axes, frame)
        _draw_net(axes, frame)
        labels = [_draw_arrow(axes, frame, arrow) for arrow in drawing.arrows]
        _draw_dimensions(axes, frame)
        metres_per_inch = _set_limits(axes, frame)
        _place_labels(axes, labels, metres_per_inch)
        _draw_scale_bar(axes, metres_per_inch)
        _draw_legend(axes)
        return write_svg(figure, name, "Section of the net row with anchor forces")


def _draw_snow(axes: Axes, frame: _Frame) -> None:
    from matplotlib.patches import Polygon
    from matplotlib.path import Path

    drawing, thickness = frame.drawing, frame.drawing.snow_thickness_m
    covered = [(x, y) for x, y in drawing.net_m if y <= thickness]
    outline = [
        (frame.top_end, 0.0),
        *covered,
        (max(x for x, _ in covered), thickness),
        (frame.top_end, thickness),
    ]
    turned = [frame.turn(point) for point in outline]
    snow = Polygon(turned, closed=True, facecolor=SNOW, edgecolor="none", zorder=0)
    axes.add_patch(snow)
    edges = [
        point
        for x1, y1, x2, y2 in drawing.mesh_edges_m
        if max(x1, x2) > frame.top_end
        for point in ((x1, y1), (x2, y2))
    ]
    if edges:
        codes = [Path.MOVETO, Path.LINETO] * (len(edges) // 2)
        _draw_path(axes, Path([frame.turn(point) for point in edges], codes), snow)
    surface = frame.turn_all([(frame.top_end, thickness), outline[-2]])
    axes.plot(*surface, color=GREY, linewidth=0.6, zorder=1)


def _draw_path(axes: Axes, path: Any, clip: Any) -> None:
    from matplotlib.patches import PathPatch

    mesh = PathPatch(path, facecolor="none", edgecolor=PALE, linewidth=0.3, zorder=0.5)
    axes.add_patch(mesh)
    mesh.set_clip_path(clip)


def _draw_ground(axes: Axes, frame: _Frame) -> None:
    from matplotlib.path import Path

    start, end = frame.top_end, frame.low_end
    axes.plot(*frame.turn_all([(start, 0), (end, 0)]), color=INK, linewidth=1.0)
    step, depth = 0.11 * frame.unit, 0.05 * frame.unit
    count = int((end - start) / step)
    ticks = [
        point
        for i in range(count)
        for point in ((start + (i + 1) * step, 0.0), (start + i * step, -depth))
    ]
    from matplotlib.patches import PathPatch

    path = Path(
        [frame.turn(point) for point in ticks], [Path.MOVETO, Path.LINETO] * count
    )
    axes.add_patch(PathPatch(path, edgecolor=PALE, linewidth=0.5, zorder=0.5))


def _draw_support(axes: Axes, frame: _Frame) -> None:
    drawing, size = frame.drawing, 0.03 * frame.unit
    for anchor in (drawing.uphill_anchor_m, drawing.downhill_anchor_m):
        guy = frame.turn_all([anchor, drawing.head_m])
        axes.plot(*guy, color=INK, linewidth=0.7, zorder=2)
    post = frame.turn_all([drawing.post_base_m, drawing.head_m])
    axes.plot(*post, color=INK, linewidth=2.6, zorder=2, solid_capstyle="butt")
    x, _ = drawing.post_base_m
    plate = frame.turn_all([(x - 3 * size, 0), (x + 3 * size, 0)])
    axes.plot(*plate, color=INK, linewidth=2.6, zorder=3, solid_capstyle="butt")
    hinge = frame.turn(drawing.head_m)
    axes.plot(*hinge, "o", color="white", mec=INK, mew=0.8, ms=3.6, zorder=5)


def _draw_net(axes: Axes, frame: _Frame) -> None:
    points = frame.drawing.net_m
    sticks = [a and b for a, b in pairwise(frame.drawing.sticks)]
    start = 0
    for i in range(1, len(sticks) + 1):
        if i == len(sticks) or sticks[i] != sticks[start]:
            run = frame.turn_all(points[start : i + 1])
            axes.plot(*run, **_net_line(sticks[start]), zorder=4)
            start = i


def _net_line(is_sticking: bool) -> dict[str, Any]:
    dashes = "solid" if is_sticking else (0, (1.1, 0.7))
    return {
        "color": INK,
        "linewidth": 1.8,
        "linestyle": dashes,
        "dash_capstyle": "butt",
        "solid_capstyle": "butt",
    }


def _draw_arrow(axes: Axes, frame: _Frame, arrow: Arrow) -> _Label:
    """Draw force and anchor; a force into the ground ends there, others pull up."""
    size = math.hypot(arrow.force_x_kN, arrow.force_y_kN)
    largest = max(math.hypot(a.force_x_kN, a.force_y_kN) for a in frame.drawing.arrows)
    start = (arrow.x_m, arrow.y_m)
    words = name_member(arrow.member), show_with_unit("max_kN", size)
    if size <= 1e-3 * largest:
        return _Label(*words, frame.turn((start[0], start[1] - 0.1 * frame.unit)))
    along = (arrow.force_x_kN / size, arrow.force_y_kN / size)
    tip = _step(
        start,
        along,
        frame.unit * max(_LONGEST_ARROW * size / largest, _SHORTEST_ARROW),
    )
    axes.annotate(
        "",
        xy=frame.turn(tip),
        xytext=frame.turn(start),
        arrowprops={
            "arrowstyle": "-|>,head_length=0.45,head_width=0.17",
            "color": ACCENT,
            "linewidth": 1.5,
            "shrinkA": 0,
            "shrinkB": 0,
        },
        zorder=6,
    )
    if along[1] < 0:
        return _Label(*words, frame.turn(tip))
    rod = _step(start, along, -_ROD * frame.unit)
    axes.plot(*frame.turn_all([start, rod]), color=INK, linewidth=1.8, zorder=3)
    axes.plot(*frame.turn(start), "o", color=INK, ms=3.4, zorder=7)
    return _Label(*words, frame.turn(rod))


def _step(start: Point, along: Point, length: float) -> Point:
    return start[0] + along[0] * length, start[1] + along[1] * length


def _draw_dimensions(axes: Axes, frame: _Frame) -> None:
    """Thickness of the snow at its cut end, angle of the slope at the low end."""
    from matplotlib.patches import Arc

    drawing, unit = frame.drawing, frame.unit
    x = frame.top_end - 0.08 * unit
    ends = [frame.turn((x, 0.0)), frame.turn((x, drawing.snow_thickness_m))]
    line = {"arrowstyle": "|-|,widthA=0.25,widthB=0.25", "color": GREY, "lw": 0.5}
    axes.annotate(
        "", xy=ends[0], xytext=ends[1], arrowprops={**line, "shrinkA": 0, "shrinkB": 0}
    )
    middle = frame.turn((x - 0.05 * unit, drawing.snow_thickness_m / 2))
    text = f"d = {show_with_unit('snow_thickness_m', drawing.snow_thickness_m)}"
    axes.text(*middle, text, ha="right", va="center")

    corner, radius = frame.turn((frame.low_end - 0.42 * unit, 0.0)), 0.34 * unit
    axes.plot(
        [corner[0], corner[0] + 1.15 * radius], [corner[1]] * 2, color=GREY, lw=0.5
    )
    arc = Arc(
        corner,
        2 * radius,
        2 * radius,
        theta1=-drawing.slope_deg,
        theta2=0,
        color=GREY,
        lw=0.5,
    )
    axes.add_patch(arc)
    half = -frame.slope / 2
    at = _step(corner, (math.cos(half), math.sin(half)), 1.15 * radius)
    text = f"ψ = {show_with_unit('slope_deg', drawing.slope_deg)}"
    axes.text(*at, text, ha="left", va="center")


def _set_limits(axes: Axes, frame: _Frame) -> float:
    """Fit the drawing; returns metres per inch."""
    drawing, unit = frame.drawing, frame.unit
    corners = [
        (frame.top_end, 0.0),
        (frame.top_end, drawing.snow_thickness_m),
        (frame.low_end, 0.0),
        (drawing.head_m[0], drawing.head_m[1] + 0.1 * unit),
        (drawing.post_base_m[0], -(_LONGEST_ARROW + 0.1) * unit),
        (drawing.downhill_anchor_m[0], -(_ROD + 0.1) * unit),
    ]
    xs, ys = frame.turn_all(corners)
    wide, tall = max(xs) - min(xs), max(ys) - min(ys)
    room_x = WIDTH_IN - _LEFT_IN - _RIGHT_IN
    room_y = _TALLEST_IN - 2 * _EDGE_IN - _LINE_IN
    scale = max(wide / room_x, tall / room_y)
    height = tall / scale + 2 * _EDGE_IN + _LINE_IN
    axes.figure.set_size_inches(WIDTH_IN, height)  # type: ignore[union-attr]
    left = min(xs) - (_LEFT_IN + (room_x - wide / scale) / 2) * scale
    bottom = min(ys) - (_EDGE_IN + _LINE_IN) * scale
    axes.set_xlim(left, left + WIDTH_IN * scale)
    axes.set_ylim(bottom, bottom + height * scale)
    return scale


def _place_labels(axes: Axes, labels: Sequence[_Label], scale: float) -> None:
    """Labels hang left below their anchors; those that would touch move down."""
    ceiling = math.inf
    gap = 0.07 * scale
    for label in sorted(labels, key=lambda label: -label.at[1]):
        x, y = label.at
        top = min(y, ceiling)
        if top < y:
            axes.plot([x, x], [y, top - 0.1 * scale], color=GREY, lw=0.4, zorder=1)
        for line, (text, colour) in enumerate(
            ((label.name, INK), (label.force, ACCENT))
        ):
            axes.text(
                x - gap,
                top - line * _LINE_IN / 2.2 * scale,
                text,
                color=colour,
                ha="right",
                va="top",
            )
        ceiling = top - _LINE_IN * scale


def _draw_scale_bar(axes: Axes, scale: float) -> None:
    length = max(step for step in (0.5, 1, 2, 5, 10) if step <= max(0.5, 0.9 * scale))
    right, bottom = axes.get_xlim()[1] - 0.15 * scale, axes.get_ylim()[0] + 0.2 * scale
    left = right - length
    axes.plot([left, right], [bottom] * 2, color=INK, lw=1.6, solid_capstyle="butt")
    text = f"{length:g} m"
    axes.text((left + right) / 2, bottom + 0.06 * scale, text, ha="center", va="bottom")


def _draw_legend(axes: Axes) -> None:
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], **_net_line(True), label="net, snow sticks"),
        Line2D([], [], **_net_line(False), label="net, snow slips"),
        Line2D([], [], color=ACCENT, lw=1.5, label="force on the ground"),
    ]
    axes.legend(
        handles=handles,
        loc="upper right",
        frameon=False,
        fontsize=TEXT_PT,
        handlelength=2.6,
        labelspacing=0.6,
        borderaxespad=0.8,
    )
