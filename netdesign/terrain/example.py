"""Synthetic starting zone with a gully, a rib and an edge, and rows in it."""

from __future__ import annotations

import json
import math

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.site.columns.all_tables import NETS
from netdesign.site.template.workbook import load_example
from netdesign.terrain.contour import follow_contour
from netdesign.terrain.grid import Grid
from netdesign.terrain.surface import Surface

GRID_FILE, ROWS_FILE = "starting-zone.asc", "rows-drawn.geojson"
_EAST, _NORTH, _CELL, _SIZE = 2_700_000.0, 1_180_000.0, 1.0, 200  # nobody's place
_SEED, _NOISE = 20_261_126, 0.05  # of the heights [m]
_EDGE = 150.0  # north of it the ground is flatter [m]
_ZONE = ((18.0, 45.0), (178.0, 45.0), (178.0, 158.0), (18.0, 158.0))
# Start of each row, west of the gully and east of it; length along the contour [m].
_ROWS = tuple(
    (f"{letter}{side}", (east, 52.0 + 19.0 * step), 39.0)
    for step, letter in enumerate("ABCDE")
    for side, east in ((1, 24.0), (2, 112.0))
)
_MODEL = 1  # line of the example site whose columns the rows have
_DERIVED = ("id", "slope_angle", "upslope_length", "altitude", "gap", "neighbour")


def build_example() -> Grid:
    """Grid of the made-up starting zone."""
    x, y = np.meshgrid(*(_CELL * (np.arange(_SIZE) + 0.5),) * 2)
    steep = np.minimum(y, _EDGE) * math.tan(math.radians(39.0))
    flat = np.maximum(y - _EDGE, 0.0) * math.tan(math.radians(18.0))
    gully = -7.0 * np.exp(-(((x - 88.0) / 18.0) ** 2))
    rib = 4.0 * np.exp(-(((x - 150.0) / 22.0) ** 2))
    noise = np.random.default_rng(_SEED).normal(0.0, _NOISE, x.shape)
    heights = np.round(1850.0 + steep + flat + gully + rib + noise, 2)
    west, south = _EAST + 0.5 * _CELL, _NORTH + 0.5 * _CELL
    return Grid(west=west, south=south, cell=_CELL, heights=heights)


def write_grid(grid: Grid) -> bytes:
    """ESRI ASCII grid of a grid without holes."""
    lines, columns = grid.heights.shape
    corner = (grid.west - 0.5 * grid.cell, grid.south - 0.5 * grid.cell)
    head = (
        f"ncols {columns}\nnrows {lines}\nxllcorner {corner[0]:.2f}\n"
        f"yllcorner {corner[1]:.2f}\ncellsize {grid.cell:g}\nNODATA_value -9999\n"
    )
    rows = (" ".join(f"{one:.2f}" for one in row) for row in grid.heights[::-1])
    return (head + "\n".join(rows) + "\n").encode()


def write_rows(grid: Grid) -> bytes:
    """Rows of the made-up zone along its contours, as GeoJSON."""
    surface = Surface(grid, 7, _NOISE)
    origin = np.array((_EAST, _NORTH))
    features = [
        {
            "type": "Feature",
            "properties": {"id": name, **_list_properties()},
            "geometry": {
                "type": "LineString",
                "coordinates": _list_points(
                    follow_contour(surface, origin + np.array(start), length)
                ),
            },
        }
        for name, start, length in _ROWS
    ]
    zone = origin + np.array((*_ZONE, _ZONE[0]))
    features.append(
        {
            "type": "Feature",
            "properties": {"kind": "starting zone"},
            "geometry": {"type": "Polygon", "coordinates": [_list_points(zone)]},
        }
    )
    document = {"type": "FeatureCollection", "features": features}
    return json.dumps(document, indent=1).encode()


def _list_properties() -> dict[str, object]:
    """Columns of a row of the example site, but those of its ground and its ends."""
    model = load_example()["Nets"][_MODEL]
    headings = {field.key: field.heading_for("en") for field in NETS.fields}
    kept = {key: value for key, value in model.items() if key not in _DERIVED}
    return {headings[key]: value for key, value in kept.items()}


def _list_points(points: Floats) -> list[list[float]]:
    return [[round(float(one), 2) for one in point] for point in points]
