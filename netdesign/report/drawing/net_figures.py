"""Drawings of one solution: forces along the net, stick and slip, deformed mesh."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from netdesign.coupling.face import Face
from netdesign.coupling.solution import Solution, WallSolution
from netdesign.numerics.arrays import Floats, Ints
from netdesign.report.drawing.charts import dress
from netdesign.report.drawing.style import (
    ACCENT,
    GREY,
    INK,
    TEXT_PT,
    WIDTH_IN,
    use_style,
    write_svg,
)
from netdesign.report.words import ENGLISH, Words

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_DARK = "#4d5761"  # of the densest snow; text stays readable beside it
_LONGEST_ARROW = 0.42  # heights of the net
_STACKED = 0.84  # width of meshes below each other, so that five fit on a page
_STEPS = 24  # of the density scale
_ONE_DENSITY = 0.5  # [kg/m3] below which snow counts as uniform
# Share of the snow's area, at each end, that the colours need not tell apart: one that
# is all but empty at the overhanging surface would flatten all others.
_OUTLIERS = 0.005
_NO_FORCE = 1e-9  # of the largest pressure: below it a ratio means nothing


def draw_node_forces(face: Face, name: str, words: Words = ENGLISH) -> str:
    """SVG: the snow's forces on the nodes to scale, beside pressure and shear."""
    from matplotlib.figure import Figure

    with use_style(name):
        figure = Figure(figsize=(WIDTH_IN, 2.9))
        left = figure.add_axes((0.01, 0.02, 0.44, 0.88))
        right = figure.add_axes((0.55, 0.14, 0.44, 0.76))
        _draw_arrows(left, face, words)
        _draw_tractions(right, face, words)
        pressure, _ = face.tractions
        values = (
            words("net_drawing.longest", force=_find_largest(face) / 1e3),
            _show_range("drawing.pressure", pressure[face.inner] / 1e3, words),
        )
        what = words("net_drawing.forces")
        title = words("drawing.with_values", what=what, values=values)
        return write_svg(figure, name, title, language=words.language)


def draw_stick_slip(face: Face, name: str, words: Words = ENGLISH) -> str:
    """SVG: shear over its friction limit along the height, slipping nodes hollow.

    Empty text where there is no limit: the snow adheres, or there is no friction.
    """
    from matplotlib.figure import Figure

    if not face.friction:
        return ""
    pressure, shear = face.tractions
    limit = face.friction * pressure
    known = limit > _NO_FORCE * max(float(np.abs(limit).max()), 1.0)
    known[[0, -1]] = False  # corners belong to the ends
    used = np.abs(shear[known]) / limit[known]
    heights, slides = face.points[1, known], face.slides[known]
    with use_style(name):
        figure = Figure(figsize=(WIDTH_IN, 1.9))
        axes = figure.add_axes((0.08, 0.2, 0.6, 0.66))
        dress(axes, words("net_drawing.over_limit"))
        axes.axhline(1.0, color=GREY, linewidth=0.6, linestyle=(0, (1, 2)))
        axes.plot(heights, used, color=GREY, linewidth=0.6, zorder=2)
        for mask, fill, rim, key in (
            (~slides, INK, INK, "net_drawing.sticks"),
            (slides, "white", ACCENT, "net_drawing.slips"),
        ):
            axes.plot(
                heights[mask],
                used[mask],
                "o",
                color=fill,
                mec=rim,
                mew=1.0,
                ms=4.2,
                label=words(key, count=int(mask.sum()), all=int(mask.size)),
                zorder=3,
                clip_on=False,
            )
        axes.set_ylim(0.0, 1.12)
        axes.set_xlabel(words("net_drawing.height_normal"))
        figure.legend(
            loc="center left", bbox_to_anchor=(0.7, 0.55), frameon=False, numpoints=1
        )
        what = words("net_drawing.stick_slip")
        values = (_show_range("net_drawing.over_limit", used, words),)
        title = words("drawing.with_values", what=what, values=values)
        return write_svg(figure, name, title, language=words.language)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MeshPicture:
    """A snow mesh to draw: nodes (2, n) [m], triangles (3, m), density (m,) [kg/m3]."""

    title: str
    nodes: Floats
    triangles: Ints
    density: Floats
    face: Floats  # net or wall, shape (2, k) [m]


def draw_meshes(
    pictures: Sequence[MeshPicture], name: str, words: Words = ENGLISH
) -> str:
    """SVG of deformed meshes below each other, to one scale of length and density."""
    from matplotlib.figure import Figure

    spans = [np.ptp(picture.nodes, axis=1) for picture in pictures]
    wide = max(float(span[0]) for span in spans)
    tall = max(float(picture.nodes[1].max()) for picture in pictures)
    shown = 1.0 if len(pictures) == 1 else _STACKED
    scale = shown * (WIDTH_IN - 0.3) / (1.02 * wide)
    each = scale * tall * 1.06 + 0.3
    height = each * len(pictures) + 0.5
    quantiles = [_find_ends(picture) for picture in pictures]
    low, high = (
        float(min(low for low, _ in quantiles)),
        float(max(high for _, high in quantiles)),
    )
    right = max(float(picture.face[0].max()) for picture in pictures)
    with use_style(name):
        figure = Figure(figsize=(WIDTH_IN, height))
        for place, picture in enumerate(pictures):
            bottom = (height - each * (place + 1)) / height
            axes = figure.add_axes((0.0, bottom, 1.0, (each - 0.26) / height))
            _draw_mesh(axes, picture, (low, high))
            edge = right - wide * 1.03
            axes.set_xlim(edge, edge + WIDTH_IN / scale)
            axes.set_ylim(-0.05 * tall, 1.02 * tall)
        _draw_scale(figure, (low, high), height, words)
        what = words("net_drawing.mesh")
        values = (_show_range("net_drawing.density", np.array([low, high]), words),)
        title = words("drawing.with_values", what=what, values=values)
        return write_svg(figure, name, title, language=words.language)


def _show_range(key: str, values: Floats, words: Words) -> str:
    """Least and largest of some values under their name."""
    low, high = (
        words.show_share(float(values.min())),
        words.show_share(float(values.max())),
    )
    text = words("show.band", low=low, high=high)
    return words("show.label", label=words(key), text=text)


def _find_largest(face: Face) -> float:
    """Largest force on a node [N/m]."""
    return float(np.hypot(*face.forces).max())


def _find_ends(picture: MeshPicture) -> tuple[float, float]:
    """Low and high density; nearly all of the snow's area lies between them."""
    first, second, third = picture.nodes[:, picture.triangles].transpose(1, 0, 2)
    one, other = second - first, third - first
    areas = np.abs(one[0] * other[1] - one[1] * other[0])
    order = np.argsort(picture.density)
    shares = np.cumsum(areas[order]) / areas.sum()
    low, high = np.searchsorted(shares, [_OUTLIERS, 1.0 - _OUTLIERS])
    return float(picture.density[order[low]]), float(picture.density[order[high]])


def picture_mesh(solution: Solution | WallSolution, title: str) -> MeshPicture:
    """Mesh of a solution at its end."""
    return MeshPicture(
        title=title,
        nodes=solution.mesh_nodes,
        triangles=solution.mesh_triangles,
        density=solution.mesh_density,
        face=solution.wall_nodes
        if isinstance(solution, WallSolution)
        else solution.net_curve,
    )


def _draw_arrows(axes: Axes, face: Face, words: Words) -> None:
    axes.set_axis_off()
    axes.set_aspect("equal")
    dress(axes, words("net_drawing.on_nodes"))
    x, y = face.points
    unit = float(y[-1])
    largest = _find_largest(face) or 1.0
    axes.plot([x[0], x[-1]], [y[0], y[-1]], color=GREY, linewidth=0.5)
    axes.plot(x, y, color=INK, linewidth=1.4, zorder=3)
    tips = face.points + face.forces * (_LONGEST_ARROW * unit / largest)
    for start, tip in zip(face.points.T, tips.T, strict=True):
        axes.annotate(
            "",
            xy=(tip[0], tip[1]),
            xytext=(start[0], start[1]),
            arrowprops={
                "arrowstyle": "-|>,head_length=0.3,head_width=0.12",
                "color": ACCENT,
                "linewidth": 0.8,
                "shrinkA": 0,
                "shrinkB": 0,
            },
        )
    axes.plot(x, y, "o", color=INK, ms=2.0, zorder=4)
    left = min(float(x.min()), 0.0) - 0.25 * unit
    right = max(float(x.max()), float(tips[0].max())) + 0.2 * unit
    axes.plot([left, right], [0, 0], color=INK, linewidth=1.0)
    axes.set_xlim(left, right)
    axes.set_ylim(-0.12 * unit, 1.06 * unit)
    axes.text(
        left,
        0.97 * unit,
        words("net_drawing.longest", force=largest / 1e3),
        va="top",
        color=ACCENT,
    )


def _draw_tractions(axes: Axes, face: Face, words: Words) -> None:
    dress(axes, words("net_drawing.tractions"))
    pressure, shear = (part[face.inner] / 1e3 for part in face.tractions)
    heights = face.points[1, face.inner]
    axes.axhline(0.0, color=GREY, linewidth=0.5)
    for values, shade, dashes, word in (
        (pressure, INK, "-", words("net_drawing.pressure")),
        (shear, "#555b63", (0, (4, 1.5)), words("net_drawing.shear")),
    ):
        axes.plot(heights, values, color=shade, linestyle=dashes, lw=1.1, label=word)
        axes.plot(heights, values, "o", color=shade, ms=2.0)
    axes.set_xlabel(words("net_drawing.height"))
    axes.margins(y=0.1)
    axes.legend(frameon=False, fontsize=TEXT_PT, loc="best", handlelength=2.4)


def _draw_mesh(axes: Axes, picture: MeshPicture, limits: tuple[float, float]) -> None:
    from matplotlib.collections import PolyCollection

    axes.set_axis_off()
    axes.set_aspect("equal", adjustable="box", anchor="SW")
    axes.set_title(picture.title, loc="left", fontsize=TEXT_PT, fontweight="bold")
    corners = list(picture.nodes[:, picture.triangles].transpose(2, 1, 0))
    mesh = PolyCollection(
        corners, cmap=_colours(), edgecolors="white", linewidths=0.25, zorder=1
    )
    mesh.set_array(picture.density)
    mesh.set_clim(*_widen(limits))
    axes.add_collection(mesh)
    left = float(picture.nodes[0].min())
    right = float(picture.face[0].max())
    axes.plot([left, right], [0, 0], color=INK, linewidth=1.0, zorder=3)
    axes.plot(*picture.face, color=ACCENT, linewidth=1.5, zorder=4)
    for place in (0, -1):
        axes.plot(*picture.face[:, place], "o", color=ACCENT, ms=3, zorder=5)


def _draw_scale(
    figure: Figure, limits: tuple[float, float], height: float, words: Words
) -> None:
    """Density scale made of rectangles: a drawing without an embedded picture."""
    low, high = limits
    if high - low < _ONE_DENSITY:
        figure.text(0.015, 0.12 / height, words("net_drawing.one_density", density=low))
        return
    axes = figure.add_axes((0.015, 0.27 / height, 0.3, 0.09 / height))
    for step in range(_STEPS):
        left, right = step / _STEPS, (step + 1.1) / _STEPS
        axes.axvspan(left, min(right, 1.0), color=_colours()((step + 0.5) / _STEPS))
    axes.set_xlim(0, 1)
    axes.set_yticks([])
    middle = (low + high) / 2
    axes.set_xticks([0, 0.5, 1], [f"{value:.0f}" for value in (low, middle, high)])
    axes.spines[:].set_visible(False)
    figure.text(0.335, 0.27 / height, words("net_drawing.density"), va="bottom")


def _widen(limits: tuple[float, float]) -> tuple[float, float]:
    low, high = limits
    return (low, high) if high - low >= _ONE_DENSITY else (low - 50.0, low + 50.0)


def _colours() -> Any:
    from matplotlib.colors import LinearSegmentedColormap

    return LinearSegmentedColormap.from_list("snow", ["#e3e8ec", _DARK])
