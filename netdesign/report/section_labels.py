"""Words of the section drawing: labels of forces, dimensions, scale, legend."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from netdesign.report.figures import ACCENT, GREY, INK, TEXT_PT
from netdesign.report.section_frame import LINE_IN, Frame, Point, move
from netdesign.report.words import show_with_unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, slots=True)
class Label:
    """A force by name, and where on the drawing it belongs."""

    name: str
    force: str
    at: Point  # upright axes


def place_labels(axes: Axes, labels: Sequence[Label], scale: float) -> None:
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
                top - line * LINE_IN / 2.2 * scale,
                text,
                color=colour,
                ha="right",
                va="top",
            )
        ceiling = top - LINE_IN * scale


def draw_scale_bar(axes: Axes, scale: float) -> None:
    """Bar of a round length near one inch; ``scale`` in metres per inch."""
    length = max(step for step in (0.5, 1, 2, 5, 10) if step <= max(0.5, 0.9 * scale))
    right, bottom = axes.get_xlim()[1] - 0.15 * scale, axes.get_ylim()[0] + 0.2 * scale
    left = right - length
    axes.plot([left, right], [bottom] * 2, color=INK, lw=1.6, solid_capstyle="butt")
    text = f"{length:g} m"
    axes.text((left + right) / 2, bottom + 0.06 * scale, text, ha="center", va="bottom")


def draw_legend(axes: Axes) -> None:
    """Explain the lines."""
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], **style_net(True), label="net, snow sticks"),
        Line2D([], [], **style_net(False), label="net, snow slips"),
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


def draw_dimensions(axes: Axes, frame: Frame) -> None:
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
    at = move(corner, (math.cos(half), math.sin(half)), 1.15 * radius)
    text = f"ψ = {show_with_unit('slope_deg', drawing.slope_deg)}"
    axes.text(*at, text, ha="left", va="center")


def style_net(is_sticking: bool) -> dict[str, Any]:
    """Give the line of the net: broken where the snow slips."""
    dashes = "solid" if is_sticking else (0, (1.1, 0.7))
    return {
        "color": INK,
        "linewidth": 1.8,
        "linestyle": dashes,
        "dash_capstyle": "butt",
        "solid_capstyle": "butt",
    }
