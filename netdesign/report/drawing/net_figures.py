"""Drawings of one solution: forces along the net, stick and slip, deformed mesh."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from netdesign.coupling.face import Face
from netdesign.coupling.solution import Solution, WallSolution
from netdesign.numerics.arrays import Floats, Ints
from netdesign.report.drawing.label_board import LINE_PT
from netdesign.report.drawing.plain_svg import (
    ACCENT,
    GREY,
    INK,
    SHADES,
    TEXT_PT,
    WIDTH,
    Chart,
    Frame,
    Point,
    shade,
    show_place,
)
from netdesign.report.words import ENGLISH, Words

_FORCES_PT, _SLIP_PT = 208.0, 136.0  # heights of the drawings [pt]
_TOP, _BELOW = 38.0, 32.0  # above and below a chart [pt]
_CHART = 0.55 * WIDTH  # where the chart beside the net begins [pt]
_LONGEST_ARROW = 0.42  # heights of the net
_STACKED = 0.84  # width of meshes below each other, so that five fit on a page
_SCALE_PT = 150.0  # width of the density scale [pt]
_ONE_DENSITY = 0.5  # [kg/m3] below which snow counts as uniform
# Share of the snow's area, at each end, that the shades need not tell apart: one that
# is all but empty at the overhanging surface would flatten all others.
_OUTLIERS = 0.005
_NO_FORCE = 1e-9  # of the largest pressure: below it a ratio means nothing


def draw_node_forces(face: Face, words: Words = ENGLISH) -> str:
    """SVG: the snow's forces on the nodes to scale, beside pressure and shear."""
    sketch = Chart(language=words.language)
    _draw_arrows(sketch, face, words)
    _draw_tractions(sketch, face, words)
    pressure, _ = face.tractions
    values = (
        words("net_drawing.longest", force=_find_largest(face) / 1e3),
        _show_range("drawing.pressure", pressure[face.inner] / 1e3, words),
    )
    what = words("net_drawing.forces")
    title = words("drawing.with_values", what=what, values=values)
    return sketch.write(_FORCES_PT, title)


def draw_stick_slip(face: Face, words: Words = ENGLISH) -> str:
    """SVG: shear over its friction limit along the height, slipping nodes hollow.

    Empty text where there is no limit: the snow adheres, or there is no friction.
    """
    if not face.friction:
        return ""
    pressure, shear = face.tractions
    limit = face.friction * pressure
    known = limit > _NO_FORCE * max(float(np.abs(limit).max()), 1.0)
    known[[0, -1]] = False  # corners belong to the ends
    used = np.abs(shear[known]) / limit[known]
    heights, slides = face.points[1, known], face.slides[known]
    sketch = Chart(language=words.language)
    size = (0.6 * WIDTH, _SLIP_PT - _TOP - _BELOW)
    frame = _draw_frame(sketch, 34.0, size, (heights, np.array([0.0, 1.12])))
    sketch.text(frame.left, TEXT_PT + 2.0, words("net_drawing.over_limit"), bold=True)
    _name_across(sketch, frame, words("net_drawing.height_normal"))
    ends = [(frame.left, frame.y(1.0)), (frame.left + frame.width, frame.y(1.0))]
    sketch.line(ends, stroke=GREY, width=0.6, dash="1 2")
    sketch.line(frame.place(zip(heights, used, strict=True)), stroke=GREY, width=0.6)
    looks = (
        (~slides, INK, INK, "net_drawing.sticks"),
        (slides, "#fff", ACCENT, "net_drawing.slips"),
    )
    for place, (mask, fill, rim, key) in enumerate(looks):
        for at in frame.place(zip(heights[mask], used[mask], strict=True)):
            sketch.dot(at, 2.1, fill=fill, stroke=rim)
        at = (0.72 * WIDTH, _TOP + 12.0 + 14.0 * place)
        sketch.dot(at, 2.1, fill=fill, stroke=rim)
        told = words(key, count=int(mask.sum()), all=int(mask.size))
        sketch.text(at[0] + 8.0, at[1] + TEXT_PT / 3, told)
    values = (_show_range("net_drawing.over_limit", used, words),)
    what = words("net_drawing.stick_slip")
    title = words("drawing.with_values", what=what, values=values)
    return sketch.write(_SLIP_PT, title)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MeshPicture:
    """A snow mesh to draw: nodes (2, n) [m], triangles (3, m), density (m,) [kg/m3]."""

    title: str
    nodes: Floats
    triangles: Ints
    density: Floats
    face: Floats  # net or wall, shape (2, k) [m]


def draw_meshes(pictures: Sequence[MeshPicture], words: Words = ENGLISH) -> str:
    """SVG of deformed meshes below each other, to one scale of length and density."""
    wide = max(float(np.ptp(picture.nodes[0])) for picture in pictures)
    tall = max(float(picture.nodes[1].max()) for picture in pictures)
    right = max(float(picture.face[0].max()) for picture in pictures)
    shown = 1.0 if len(pictures) == 1 else _STACKED
    scale = shown * (WIDTH - 22.0) / (1.02 * wide)
    each = scale * tall * 1.06 + 22.0
    quantiles = [_find_ends(picture) for picture in pictures]
    limits = (min(low for low, _ in quantiles), max(high for _, high in quantiles))
    sketch = Chart(language=words.language)
    for place, picture in enumerate(pictures):
        base = np.array([(wide * 1.03 - right) * scale, each * (place + 1) - 6.0])
        sketch.text(2.0, each * place + TEXT_PT + 2.0, picture.title, bold=True)
        _draw_mesh(sketch, picture, base, scale, limits)
    height = each * len(pictures) + 36.0
    _draw_scale(sketch, limits, height, words)
    values = (_show_range("net_drawing.density", np.array(limits), words),)
    what = words("net_drawing.mesh")
    title = words("drawing.with_values", what=what, values=values)
    return sketch.write(height, title)


def _show_range(key: str, values: Floats, words: Words) -> str:
    """Least and largest of some values under their name."""
    text = words.show_range([float(values.min()), float(values.max())])
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


def _place_points(points: Floats, base: Floats, scale: float) -> list[Point]:
    """Points (2, n) [m] on paper; y upwards from the base [pt]."""
    across, down = base[0] + scale * points[0], base[1] - scale * points[1]
    return [(float(x), float(y)) for x, y in zip(across, down, strict=True)]


def _draw_arrows(sketch: Chart, face: Face, words: Words) -> None:
    """Net with the force on each node, the largest of a fixed length."""
    unit, largest = float(face.points[1, -1]), _find_largest(face) or 1.0
    tips = face.points + face.forces * (_LONGEST_ARROW * unit / largest)
    left = min(float(face.points[0].min()), 0.0) - 0.25 * unit
    right = max(float(face.points[0].max()), float(tips[0].max())) + 0.2 * unit
    scale = min(0.47 * WIDTH / (right - left), (_FORCES_PT - _TOP) / (1.12 * unit))
    base = np.array([-left * scale, _FORCES_PT - 0.06 * unit * scale])
    ground = np.array([[left, right], [0.0, 0.0]])
    nodes = _place_points(face.points, base, scale)
    sketch.line(_place_points(ground, base, scale), width=1.0)
    sketch.line([nodes[0], nodes[-1]], stroke=GREY, width=0.5)
    sketch.line(nodes, width=1.4)
    for start, tip in zip(nodes, _place_points(tips, base, scale), strict=True):
        sketch.arrow(start, tip, width=0.8)
        sketch.dot(start, 1.0)
    sketch.text(2.0, TEXT_PT + 2.0, words("net_drawing.on_nodes"), bold=True)
    longest = words("net_drawing.longest", force=largest / 1e3)
    for place, line in enumerate(longest.split("\n")):
        sketch.text(2.0, (2.5 + 1.2 * place) * TEXT_PT + 2.0, line, fill=ACCENT)


def _draw_tractions(sketch: Chart, face: Face, words: Words) -> None:
    """Pressure and shear over the height, their names above."""
    pressure, shear = (part[face.inner] / 1e3 for part in face.tractions)
    heights = face.points[1, face.inner]
    values = np.concatenate((pressure, shear, [0.0]))
    reach = 0.1 * (float(np.ptp(values)) or 1.0)
    ends = np.array([values.min() - reach, values.max() + reach])
    size = (WIDTH - _CHART - 42.0, _FORCES_PT - _TOP - _BELOW)
    frame = _draw_frame(sketch, _CHART + 34.0, size, (heights, ends))
    sketch.text(frame.left, TEXT_PT + 2.0, words("net_drawing.tractions"), bold=True)
    _name_across(sketch, frame, words("net_drawing.height"))
    zero = [(frame.left, frame.y(0.0)), (frame.left + frame.width, frame.y(0.0))]
    sketch.line(zero, stroke=GREY, width=0.5)
    left, y = frame.left, 2.5 * TEXT_PT + 2.0
    for part, stroke, dash, key in (
        (pressure, INK, "", "net_drawing.pressure"),
        (shear, "#555b63", "4 1.5", "net_drawing.shear"),
    ):
        points = frame.place(zip(heights, part, strict=True))
        sketch.line(points, stroke=stroke, width=1.1, dash=dash)
        for at in points:
            sketch.dot(at, 0.9, fill=stroke, stroke=stroke)
        sketch.line([(left, y - 2.6), (left + 18.0, y - 2.6)], stroke=stroke, dash=dash)
        sketch.text(left + 22.0, y, words(key))
        y += LINE_PT


def _draw_frame(
    sketch: Chart,
    left: float,
    size: tuple[float, float],
    ranges: tuple[Floats, Floats],
) -> Frame:
    """Axes of a chart below its title; ``ranges`` are values along both."""
    across, up = ranges
    frame = Frame(
        left=left,
        top=_TOP,
        width=size[0],
        height=size[1],
        x_low=float(across.min()),
        x_high=float(across.max()),
        y_low=float(up.min()),
        y_high=float(up.max()),
    )
    sketch.axes(frame)
    return frame


def _name_across(sketch: Chart, frame: Frame, text: str) -> None:
    base = frame.top + frame.height + 2.3 * TEXT_PT + 4.5
    sketch.text(frame.left + frame.width / 2, base, text, anchor="middle")


def _draw_mesh(
    sketch: Chart,
    picture: MeshPicture,
    base: Floats,
    scale: float,
    limits: tuple[float, float],
) -> None:
    """Triangles, those of one shade in one path, with ground and net."""
    corners = _place_points(picture.nodes, base, scale)
    paths: dict[str, str] = {}
    for triangle, density in zip(picture.triangles.T, picture.density, strict=True):
        fill = _shade(float(density), limits)
        path = "L".join(
            f"{show_place(corners[k][0])} {show_place(corners[k][1])}" for k in triangle
        )
        paths[fill] = f"{paths.get(fill, '')}M{path}z"
    for fill, path in paths.items():
        sketch.shapes.append(
            f'<path d="{path}" fill="{fill}" stroke="#fff" stroke-width="0.25"/>'
        )
    ends = [float(picture.nodes[0].min()), float(picture.face[0].max())]
    sketch.line(_place_points(np.array([ends, [0.0, 0.0]]), base, scale), width=1.0)
    face = _place_points(picture.face, base, scale)
    sketch.line(face, stroke=ACCENT, width=1.5)
    for at in (face[0], face[-1]):
        sketch.dot(at, 1.5, fill=ACCENT, stroke=ACCENT)


def _shade(density: float, limits: tuple[float, float]) -> str:
    """Grey of a density, of the loosest snow still darker than paper."""
    low, high = limits
    if high - low < _ONE_DENSITY:
        low, high = low - 50.0, low + 50.0
    return shade(density, low - 0.15 * (high - low), high)


def _draw_scale(
    sketch: Chart, limits: tuple[float, float], height: float, words: Words
) -> None:
    """Shades of the densities, three of them named."""
    low, high = limits
    if high - low < _ONE_DENSITY:
        told = words("net_drawing.one_density", density=low)
        sketch.text(6.0, height - 9.0, told)
        return
    step = _SCALE_PT / SHADES
    for place in range(SHADES):
        fill = _shade(low + (place + 0.5) / SHADES * (high - low), limits)
        sketch.rectangle(10.0 + place * step, height - 22.0, step + 0.2, 7.0, fill)
    for share in (0.0, 0.5, 1.0):
        at, shown = 10.0 + share * _SCALE_PT, f"{low + share * (high - low):.0f}"
        sketch.text(at, height - 4.0, shown, anchor="middle")
    sketch.text(24.0 + _SCALE_PT, height - 15.5, words("net_drawing.density"))
