"""Elevation grid of a GeoTIFF, read from its bytes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from netdesign.edge.given_files import make_printable
from netdesign.outcome import TerrainError
from netdesign.terrain.crs import require_plane
from netdesign.terrain.grid import (
    MOST_BYTES,
    Grid,
    require_heights,
    require_metres,
    require_size,
)
from netdesign.terrain.libraries import DAMAGE, keep_quiet
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from rasterio.io import DatasetReader

    from netdesign.numerics.arrays import Floats

_ALIKE = 1e-6  # of the sides of a cell
_METRES = ("", "m", "metre", "meter", "metres", "meters", "unknown")
# Nothing beside the file is looked for or written.
_SETTINGS = {"GDAL_PAM_ENABLED": "NO", "GDAL_DISABLE_READDIR_ON_OPEN": "EMPTY_DIR"}


def parse_geotiff(content: bytes) -> Grid:
    """Grid of the bytes of a GeoTIFF; GDAL sees these bytes and no other file.

    Raises
    ------
    TerrainError
        If they are none.
    """
    import rasterio
    from rasterio._err import CPLE_BaseError
    from rasterio.errors import RasterioError

    try:
        with (
            keep_quiet(),
            rasterio.Env(**_SETTINGS),
            rasterio.MemoryFile(content) as file,
            file.open(driver="GTiff") as dataset,
        ):
            return _read_dataset(dataset)
    except (*DAMAGE, RasterioError, CPLE_BaseError):
        raise TerrainError(say("terrain.no_geotiff")) from None


def _read_dataset(dataset: DatasetReader) -> Grid:
    """Heights of the first band; everything that the header says is judged before."""
    require_size(dataset.width, dataset.height)
    _require_memory(dataset)
    cell, west, north = _read_place(dataset)
    wkt = dataset.crs.to_wkt() if dataset.crs else ""
    crs = require_plane(wkt)
    unit = (dataset.units[0] or "").strip()
    if unit.casefold() not in _METRES:
        raise TerrainError(say("terrain.height_unit", unit=make_printable(unit)[:40]))
    require_metres(cell, west, north)
    _require_whole(dataset)
    heights = _read_heights(dataset)
    notes: tuple[Message, ...] = ()
    if dataset.count > 1:
        notes = (say("terrain.bands", count=dataset.count),)
    return Grid(
        west=west + 0.5 * cell,
        south=north - (dataset.height - 0.5) * cell,
        cell=cell,
        heights=heights[::-1].copy(),
        crs=crs,
        notes=notes,
    )


def _require_memory(dataset: DatasetReader) -> None:
    """Refuse numbers that are no heights, and blocks that take too much memory.

    A block is opened as a whole, with all bands that may lie in it.
    """
    kinds = [np.dtype(one) for one in dataset.dtypes]
    if kinds[0].kind not in "iuf":
        raise ValueError(kinds)
    lines, columns = dataset.block_shapes[0]
    size = lines * columns * sum(one.itemsize for one in kinds)
    if size > MOST_BYTES:
        raise TerrainError(say("terrain.block", size=size / 1e6))


def _require_whole(dataset: DatasetReader) -> None:
    """Refuse blocks that are not there: where no value says so, they would be zeros."""
    lines, columns = dataset.block_shapes[0]
    across, down = -(-dataset.width // columns), -(-dataset.height // lines)
    if dataset.nodata is None and not all(
        dataset.get_tag_item(f"BLOCK_OFFSET_{x}_{y}", "TIFF", bidx=1)
        for y in range(down)
        for x in range(across)
    ):
        raise TerrainError(say("terrain.no_geotiff"))


def _read_place(dataset: DatasetReader) -> tuple[float, float, float]:
    """Side of the cells, west and north edge [m]."""
    place = dataset.transform
    if place.is_identity or not all(map(math.isfinite, place)):
        raise TerrainError(say("terrain.nowhere"))
    if place.b or place.d or not place.a > 0.0 > place.e:
        raise TerrainError(say("terrain.rotated"))
    if abs(place.a + place.e) > _ALIKE * place.a:
        sides = {"width": f"{place.a:g}", "height": f"{-place.e:g}"}
        raise TerrainError(say("terrain.no_square", **sides))
    return float(place.a), float(place.c), float(place.f)


def _read_heights(dataset: DatasetReader) -> Floats:
    """Heights from north to south [m], NaN where the file says that none is known."""
    found = dataset.read(1, masked=True, out_dtype="float64")
    values: Floats = found.data * dataset.scales[0] + dataset.offsets[0]
    hidden = np.ma.getmaskarray(found)
    require_heights(values[~hidden])
    values[hidden] = math.nan
    return values
