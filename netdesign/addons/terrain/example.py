"""Synthetic starting zone with a gully, a rib and an edge, and rows in it."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from shapely import LineString, Polygon

from netdesign.addons.terrain.geojson import Feature, make_feature, write_features
from netdesign.addons.terrain.grid import Grid
from netdesign.addons.terrain.plan import ZONE
from netdesign.addons.terrain.surface import Surface
from netdesign.edge.output import write_files
from netdesign.numerics.arrays import Floats
from netdesign.site.lists.targets import list_targets
from netdesign.site.template.office_workbook import load_input_example, render_input

GRID_FILE, ROWS_FILE = "starting-zone.asc", "rows-drawn.geojson"
TYPES_FILE = "types.xlsx"
_STEP = 3.0  # along a contour: bends are those of the ground, not of the noise [m]
_EAST, _NORTH, _CELL, _SIZE = 2_700_000.0, 1_180_000.0, 1.0, 200  # no real place
_SEED, _NOISE = 20_261_126, 0.05  # of the heights [m]
_EDGE = 150.0  # north of it the ground is flatter [m]
_ZONE = (
    *((42.0, 94.0), (80.0, 94.0), (100.0, 89.0), (124.0, 88.0)),
    *((139.0, 91.0), (139.0, 153.0), (29.0, 153.0)),
)
# Name, western end, length along the contour [m]: across the gully, over the rib.
_ROWS = (
    *(("A1", (43.0, 95.0), 36.0), ("A2", (79.6, 95.8), 60.0)),
    *(("B1", (37.8, 109.5), 42.0), ("B2", (81.4, 110.3), 60.0)),
    *(("C1", (33.6, 124.0), 54.0), ("C2", (87.8, 123.6), 54.0)),
    *(("D1", (31.4, 138.5), 57.0), ("D2", (89.2, 138.8), 54.0)),
)
_OWN = {
    "glide_factor": 1.8,
    "snow.normal": 2.5,
    "net_type": "SN 3.0",
    "net_height": 3.0,
    "post_spacing": 3.5,
    "foot_anchor": "SRA 26",
    "uphill_anchor": "SRA 22",
    "downhill_anchor": "SRA 18",
    "end_anchor": "SRA 2x28",
    "ground": "till",
}
_TYPES = ("net_types", "anchor_types", "tests", "ropes", "posts", "links")


def build_example() -> Grid:
    """Grid of the made-up starting zone."""
    x, y = np.meshgrid(*(_CELL * (np.arange(_SIZE) + 0.5),) * 2)
    steep = np.minimum(y, _EDGE) * math.tan(math.radians(39.0))
    flat = np.maximum(y - _EDGE, 0.0) * math.tan(math.radians(18.0))
    gully = -4.0 * np.exp(-(((x - 64.0) / 24.0) ** 2))
    rib = 4.0 * np.exp(-(((x - 116.0) / 24.0) ** 2))
    noise = np.random.default_rng(_SEED).normal(0.0, _NOISE, x.shape)
    heights = np.round(1850.0 + steep + flat + gully + rib + noise, 2)
    west, south = _EAST + 0.5 * _CELL, _NORTH + 0.5 * _CELL
    return Grid(west=west, south=south, cell=_CELL, heights=heights)


def write_example(folder: Path, *, overwrite: bool) -> tuple[Path, Path, Path]:
    """Write grid, rows with their zone, and types to a folder; their places."""
    ground = build_example()
    contents = {
        folder / GRID_FILE: write_grid(ground),
        folder / ROWS_FILE: write_features(list_rows(ground)),
        folder / TYPES_FILE: write_types(),
    }
    write_files(contents, overwrite=overwrite)
    grid, rows, types = contents
    return grid, rows, types


def write_grid(grid: Grid) -> bytes:
    """ESRI ASCII grid of a grid without holes."""
    lines, columns = grid.heights.shape
    corner = (grid.west - 0.5 * grid.cell, grid.south - 0.5 * grid.cell)
    head = (
        f"ncols {columns}\nnrows {lines}\nxllcorner {corner[0]:.2f}\n"
        f"yllcorner {corner[1]:.2f}\ncellsize {grid.cell:g}\nNODATA_value -9999\n"
    )
    rows = (" ".join(f"{height:.2f}" for height in row) for row in grid.heights[::-1])
    return (head + "\n".join(rows) + "\n").encode()


def list_rows(grid: Grid) -> list[Feature]:
    """Rows of the made-up zone along its contours, and the zone."""
    surface = Surface(grid, 7, _NOISE)
    origin = np.array((_EAST, _NORTH))
    headings = {x.name: x.heading(x.field.unit) for x in list_targets("rows")}
    cells = {headings[key]: value for key, value in _OWN.items()}
    rows = [
        make_feature(
            LineString(follow_contour(surface, origin + np.array(start), length)),
            {"id": name, **cells},
        )
        for name, start, length in _ROWS
    ]
    zone = Polygon(origin + np.array(_ZONE))
    return [*rows, make_feature(zone, {"kind": ZONE})]


def follow_contour(surface: Surface, start: Floats, length: float) -> Floats:
    """Points along the contour through a point, the slope to the left, (n, 2) [m]."""
    points = [start]
    for _ in range(math.ceil(length / _STEP)):
        middle = points[-1] + 0.5 * _STEP * _turn(surface, points[-1])
        points.append(points[-1] + _STEP * _turn(surface, middle))
    return np.stack(points).round(2)


def _turn(surface: Surface, place: Floats) -> Floats:
    """Direction along the contour, uphill on its left."""
    ((east, north),) = surface.at(place[None]).gradient
    return np.array((north, -east)) / math.hypot(east, north)


def write_types() -> bytes:
    """Workbook of the net types and anchors of the example site."""
    example = load_input_example()
    (project,) = example["project"]
    named = {**project, "name": "Starting zone (example)"}
    tables = {"project": [named], **{name: example[name] for name in _TYPES}}
    return render_input(tables, measures={("rows", "snow"): "normal"})
