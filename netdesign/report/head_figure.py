"""Force polygon of the post head: a head in equilibrium closes it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from netdesign.report.figures import (
    ACCENT,
    INK,
    TEXT_PT,
    WIDTH_IN,
    use_style,
    write_svg,
)
from netdesign.report.words import name_member, show_with_unit
from netdesign.study import HeadForce

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HEIGHT_IN = 2.4
_MARGIN = 0.15  # of the polygon's size


def draw_head(forces: Sequence[HeadForce], name: str) -> str:
    """SVG of the polygon, each force starting where the one before ends.

    Parameters
    ----------
    forces : sequence of HeadForce
        On the post head; at least two.
    name : str
        Of the drawing, for ids.
    """
    from matplotlib.figure import Figure

    with use_style(name):
        figure = Figure(figsize=(WIDTH_IN, _HEIGHT_IN), layout="constrained")
        axes = figure.add_subplot()
        axes.set_aspect("equal")
        axes.axis("off")
        xs, ys = [0.0], [0.0]
        for force in forces:
            xs.append(xs[-1] + force.x_kN)
            ys.append(ys[-1] + force.y_kN)
            _draw_force(axes, (xs[-2], ys[-2]), (xs[-1], ys[-1]), force)
        margin = _MARGIN * max(max(xs) - min(xs), max(ys) - min(ys))
        axes.set_xlim(min(xs) - 6.0 * margin, max(xs) + 6.0 * margin)
        axes.set_ylim(min(ys) - margin, max(ys) + margin)
    return write_svg(figure, name, "Force polygon of the post head")


def _draw_force(
    axes: Axes,
    start: tuple[float, float],
    end: tuple[float, float],
    force: HeadForce,
) -> None:
    is_net = force.member == "net"  # its text stands to the left, the others' right
    colour = ACCENT if is_net else INK
    axes.annotate(
        "", xy=end, xytext=start, arrowprops={"arrowstyle": "->", "color": colour}
    )
    size = show_with_unit("size_kN", math.hypot(force.x_kN, force.y_kN))
    axes.text(
        0.5 * (start[0] + end[0]),
        0.5 * (start[1] + end[1]),
        f"  {name_member(force.member)} {size}  ",
        fontsize=TEXT_PT,
        color=colour,
        horizontalalignment="right" if is_net else "left",
    )
