"""Section of a net row to scale: slope, snow, net, support, forces."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from netdesign.report.figures import (
    ACCENT,
    GREY,
    INK,
    PALE,
    SNOW,
    WIDTH_IN,
    use_style,
    write_svg,
)
from netdesign.report.section_frame import (
    LONGEST_ARROW,
    ROD,
    Frame,
    Point,
    move,
    set_limits,
)
from netdesign.report.section_labels import (
    Label,
    draw_dimensions,
    draw_legend,
    draw_scale_bar,
    place_labels,
    style_net,
)
from netdesign.report.words import name_member, show_with_unit
from netdesign.study import Arrow, Drawing

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_SHORTEST_ARROW = 0.14  # heights of the head
_SLACK = 1e-3  # of the largest force; below it there is no arrow


def draw_section(drawing: Drawing, name: str) -> str:
    """SVG of the section in the case of ``drawing``."""
    from matplotlib.figure import Figure

    frame = Frame(slope=math.radians(drawing.slope_deg), drawing=drawing)
    with use_style(name):
        figure = Figure(figsize=(WIDTH_IN, WIDTH_IN))
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set_axis_off()
        _draw_snow(axes, frame)
        _draw_ground(axes, frame)
        _draw_support(axes, frame)
        _draw_net(axes, frame)
        labels = [_draw_arrow(axes, frame, arrow) for arrow in drawing.arrows]
        draw_dimensions(axes, frame)
        metres_per_inch = set_limits(figure, axes, frame)
        place_labels(axes, labels, metres_per_inch)
        draw_scale_bar(axes, metres_per_inch)
        draw_legend(axes)
        return write_svg(figure, name, "Section of the net row with anchor forces")


def _draw_snow(axes: Axes, frame: Frame) -> None:
    from matplotlib.patches import Polygon
    from matplotlib.path import Path

    drawing, thickness = frame.drawing, frame.drawing.snow_thickness_m
    covered = [(x, y) for x, y in drawing.net_m if y <= thickness]
    outline = [
        (frame.top_end, 0.0),
        *covered,
        (covered[-1][0], thickness),
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


def _draw_ground(axes: Axes, frame: Frame) -> None:
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


def _draw_support(axes: Axes, frame: Frame) -> None:
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


def _draw_net(axes: Axes, frame: Frame) -> None:
    points = frame.drawing.net_m
    sticks = [a and b for a, b in pairwise(frame.drawing.sticks)]
    start = 0
    for i in range(1, len(sticks) + 1):
        if i == len(sticks) or sticks[i] != sticks[start]:
            run = frame.turn_all(points[start : i + 1])
            axes.plot(*run, **style_net(sticks[start]), zorder=4)
            start = i


def _draw_arrow(axes: Axes, frame: Frame, arrow: Arrow) -> Label:
    """Draw force and anchor; a force into the ground ends there, others pull up."""
    size = math.hypot(arrow.force_x_kN, arrow.force_y_kN)
    largest = max(math.hypot(a.force_x_kN, a.force_y_kN) for a in frame.drawing.arrows)
    start = (arrow.x_m, arrow.y_m)
    words = name_member(arrow.member), show_with_unit("max_kN", size)
    if size <= _SLACK * largest:
        return _draw_anchor(
            axes, frame, start, _aim(start, frame.drawing.head_m), words
        )
    along = (arrow.force_x_kN / size, arrow.force_y_kN / size)
    tip = move(
        start,
        along,
        frame.unit * max(LONGEST_ARROW * size / largest, _SHORTEST_ARROW),
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
        return Label(*words, frame.turn(tip))
    return _draw_anchor(axes, frame, start, along, words)


def _aim(start: Point, target: Point) -> Point:
    length = math.dist(start, target)
    return (target[0] - start[0]) / length, (target[1] - start[1]) / length


def _draw_anchor(
    axes: Axes, frame: Frame, start: Point, along: Point, words: tuple[str, str]
) -> Label:
    """Rod in the ground, against the pull; its label hangs at its end."""
    rod = move(start, along, -ROD * frame.unit)
    axes.plot(*frame.turn_all([start, rod]), color=INK, linewidth=1.8, zorder=3)
    axes.plot(*frame.turn(start), "o", color=INK, ms=3.4, zorder=7)
    return Label(*words, frame.turn(rod))
