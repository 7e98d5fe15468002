"""Grids and rows as the files that offices have, written by the libraries."""

import json
import subprocess
import sys
import warnings

import numpy as np
import pyogrio.raw
import rasterio
import shapely
from rasterio.transform import Affine

from tests.peak_memory import PEAK

SHORT = {"net height [m]": "net height", "post spacing [m]": "post c/c"}
SWISS = "EPSG:2056"
GIVEN = {"id": "A", "net height [m]": 3.5, "post spacing [m]": 3.0}


def write_asc(grid):
    lines, columns = grid.heights.shape
    west, south = float(grid.west), float(grid.south)
    head = (
        f"ncols {columns}\nnrows {lines}\nxllcenter {west!r}\nyllcenter {south!r}\n"
        f"cellsize {grid.cell}\nNODATA_value -9999\n"
    )
    heights = np.nan_to_num(grid.heights[::-1], nan=-9999.0)
    rows = (" ".join(map(repr, one)) for one in heights.tolist())
    return (head + "\n".join(rows)).encode()


def find_north(grid):
    """Middle of the last cell of a column."""
    return grid.south + grid.cell * (len(grid.heights) - 1)


def write_tif(grid, *, crs=SWISS, transform=None, tags=None, place=True, **special):
    """Bytes of a GeoTIFF of a grid; its first band holds the heights."""
    heights = np.nan_to_num(grid.heights[::-1], nan=-9999.0)
    profile = {
        "height": len(heights),
        "width": heights.shape[1],
        "count": 1,
        "dtype": "float64",
        "nodata": -9999.0,
        "crs": crs,
    } | special
    if place:
        west, north = grid.west - 0.5 * grid.cell, find_north(grid) + 0.5 * grid.cell
        profile["transform"] = transform or Affine(
            grid.cell, 0.0, west, 0.0, -grid.cell, north
        )
    with warnings.catch_warnings(action="ignore"), rasterio.MemoryFile() as file:
        with file.open(driver="GTiff", **profile) as dataset:
            dataset.write(heights.astype(profile["dtype"]), 1)
            dataset.update_tags(**(tags or {}))
        return file.read()


def pack_shapes(drawn, kind=2, size=3):
    """Lines, rings or points as WKB, with heights or without."""
    shape = {1: lambda one: shapely.Point(one[0]), 2: shapely.LineString}
    shapes = [shape.get(kind, shapely.Polygon)(one) for one in drawn]
    return shapely.to_wkb(
        shapely.force_3d(shapes, 1500.0) if size == 3 else shapely.force_2d(shapes)
    )


def write_rows(path, rows, *, kind=2, layer="rows", crs=SWISS, size=3, **special):
    """Rows of points and properties as the file that the name asks for."""
    if path.suffix == ".geojson":
        drawn = (feature(list(points), **given) for points, given in rows)
        path.write_text(json.dumps(collect(*drawn)), encoding="utf-8")
        return path
    names = list(rows[0][1])
    columns = [stack([given[name] for _, given in rows]) for name in names]
    if path.suffix == ".shp":
        names = [SHORT.get(one, one) for one in names]
    geometry = pack_shapes([points for points, _ in rows], kind, size)
    shape = {1: "Point", 2: "LineString", 3: "Polygon"}[kind]
    with warnings.catch_warnings(action="ignore"):  # of names that are cut
        pyogrio.raw.write(
            *(path, geometry, columns, names),
            driver="GPKG" if path.suffix == ".gpkg" else "ESRI Shapefile",
            layer=layer,
            geometry_type=f"{shape} Z" if size == 3 else shape,
            crs=crs,
            append=path.exists(),
            **special,
        )
    return path


def feature(points, shape="LineString", **properties):
    geometry = {"type": shape, "coordinates": points}
    return {"type": "Feature", "geometry": geometry, "properties": properties}


def collect(*features, **more):
    return {"type": "FeatureCollection", "features": list(features)} | more


def stack(values):
    if all(isinstance(one, int | float) for one in values):
        return np.array(values)
    found = np.empty(len(values), dtype=object)
    found[:] = values
    return found


WATCHED = f"""
import sys
from pathlib import Path
from netdesign.outcome import TerrainError
from netdesign.addons.terrain.MODULE import READER as read
{PEAK}
before = peak()
for name in sys.argv[1:]:
    try:
        print(name, "read", len(getattr(read(Path(name)), "lines", ())))
    except TerrainError as error:
        print(str(error).splitlines()[0])
print(before, peak())
"""


def watch(module, reader, names, folder):
    """What a reader says of files in a process of its own; memory before, and most."""
    ended = subprocess.run(
        [
            sys.executable,
            "-c",
            WATCHED.replace("MODULE", module).replace("READER", reader),
            *names,
        ],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
    )
    assert ended.stderr == ""
    *told, memory = ended.stdout.splitlines()
    return told, *map(int, memory.split())
