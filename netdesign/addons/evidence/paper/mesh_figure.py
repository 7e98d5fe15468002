"""Deformed meshes of snow against a net, shaded by density."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from netdesign.numerics.arrays import Floats, Ints
from netdesign.report.drawing.plain_svg import (
    ACCENT,
    SHADES,
    TEXT_PT,
    WIDTH,
    Chart,
    Point,
    shade,
    show_place,
)
from netdesign.report.words import ENGLISH

_STACKED = 0.84  # width of meshes below each other, so that five fit on a page
_SCALE_PT = 150.0  # width of the density scale [pt]
_ONE_DENSITY = 0.5  # [kg/m3] below which snow counts as uniform
# Share of the snow's area, at each end, that the shades need not tell apart: one that
# is all but empty at the overhanging surface would flatten all others.
_OUTLIERS = 0.005


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MeshPicture:
    """A snow mesh to draw: nodes (2, n) [m], triangles (3, m), density (m,) [kg/m3]."""

    title: str
    nodes: Floats
    triangles: Ints
    density: Floats
    face: Floats  # net or wall, shape (2, k) [m]


def draw_meshes(pictures: Sequence[MeshPicture]) -> str:
    """SVG of deformed meshes below each other, to one scale of length and density."""
    wide = max(float(np.ptp(picture.nodes[0])) for picture in pictures)
    tall = max(float(picture.nodes[1].max()) for picture in pictures)
    right = max(float(picture.face[0].max()) for picture in pictures)
    shown = 1.0 if len(pictures) == 1 else _STACKED
    scale = shown * (WIDTH - 22.0) / (1.02 * wide)
    each = scale * tall * 1.06 + 22.0
    quantiles = [_find_ends(picture) for picture in pictures]
    limits = (min(low for low, _ in quantiles), max(high for _, high in quantiles))
    sketch = Chart()
    for place, picture in enumerate(pictures):
        base = np.array([(wide * 1.03 - right) * scale, each * (place + 1) - 6.0])
        sketch.text(2.0, each * place + TEXT_PT + 2.0, picture.title, bold=True)
        _draw_mesh(sketch, picture, base, scale, limits)
    height = each * len(pictures) + 36.0
    _draw_scale(sketch, limits, height)
    density = ENGLISH("net_drawing.density")
    values = (ENGLISH("show.label", label=density, text=ENGLISH.show_range(limits)),)
    what = ENGLISH("net_drawing.mesh")
    title = ENGLISH("drawing.with_values", what=what, values=values)
    return sketch.write(height, title)


def _find_ends(picture: MeshPicture) -> tuple[float, float]:
    """Low and high density; nearly all of the snow's area lies between them."""
    first, second, third = picture.nodes[:, picture.triangles].transpose(1, 0, 2)
    one, other = second - first, third - first
    areas = np.abs(one[0] * other[1] - one[1] * other[0])
    order = np.argsort(picture.density)
    shares = np.cumsum(areas[order]) / areas.sum()
    low, high = np.searchsorted(shares, [_OUTLIERS, 1.0 - _OUTLIERS])
    return float(picture.density[order[low]]), float(picture.density[order[high]])


def _place_points(points: Floats, base: Floats, scale: float) -> list[Point]:
    """Points (2, n) [m] on paper; y upwards from the base [pt]."""
    across, down = base[0] + scale * points[0], base[1] - scale * points[1]
    return [(float(x), float(y)) for x, y in zip(across, down, strict=True)]


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


def _draw_scale(sketch: Chart, limits: tuple[float, float], height: float) -> None:
    """Shades of the densities, three of them named."""
    low, high = limits
    if high - low < _ONE_DENSITY:
        told = ENGLISH("net_drawing.one_density", density=low)
        sketch.text(6.0, height - 9.0, told)
        return
    step = _SCALE_PT / SHADES
    for place in range(SHADES):
        fill = _shade(low + (place + 0.5) / SHADES * (high - low), limits)
        sketch.rectangle(10.0 + place * step, height - 22.0, step + 0.2, 7.0, fill)
    for share in (0.0, 0.5, 1.0):
        at, shown = 10.0 + share * _SCALE_PT, f"{low + share * (high - low):.0f}"
        sketch.text(at, height - 4.0, shown, anchor="middle")
    sketch.text(24.0 + _SCALE_PT, height - 15.5, ENGLISH("net_drawing.density"))
