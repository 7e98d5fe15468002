"""GeoTIFF: the same rows as from ASCII; what is none is refused in words."""

import contextlib
import math
import struct

import numpy as np
import pytest
from rasterio.transform import Affine

from netdesign.addons.terrain.grid import Grid, read_grid
from netdesign.outcome import TerrainError
from tests.addons.terrain.map_files import find_north, watch, write_asc, write_tif
from tests.each import each
from tests.peak_memory import needs_peak

DRAW = np.random.default_rng(20_261_126)
HEIGHTS = np.round(1500.0 + DRAW.normal(0.0, 30.0, (5, 7)), 3)
GRID = Grid(west=2_700_300.25, south=1_180_200.75, cell=0.5, heights=HEIGHTS)


@pytest.fixture
def parse_geotiff(tmp_path):
    """Grid of the bytes of a GeoTIFF."""

    def parse(content):
        path = tmp_path / "grid.tif"
        path.write_bytes(content)
        return read_grid(path)

    return parse


@each("seed", range(4))
def test_a_grid_is_that_of_ascii(tmp_path, parse_geotiff, seed):
    draw = np.random.default_rng(seed)
    heights = np.round(1500.0 + draw.normal(0.0, 0.3, (43, 61)), 3)
    heights[:2, :3] = math.nan
    west, south = draw.uniform((2_600_000, 1_100_000), (2_800_000, 1_200_000))
    cell = float(draw.choice([0.5, 1.0, 2.0]))
    grid = Grid(west=west, south=south, cell=cell, heights=heights)
    compress = str(draw.choice(["deflate", "lzw", "none"]))
    (tmp_path / "grid.asc").write_bytes(write_asc(grid))
    text = read_grid(tmp_path / "grid.asc")
    tif = parse_geotiff(write_tif(grid, compress=compress))
    assert tif.heights == pytest.approx(text.heights, abs=0.0, nan_ok=True)
    assert (tif.west, tif.south) == pytest.approx((text.west, text.south), rel=1e-12)
    assert (tif.cell, tif.crs) == (text.cell, "EPSG:2056")


@each("nodata", [-9999.0, math.nan, -3.4028234663852886e38])
@each("kind", ["float32", "float64"])
def test_cells_without_data_are_not_known(parse_geotiff, nodata, kind):
    heights = HEIGHTS.copy()
    heights[1, 2] = nodata
    grid = Grid(west=0.0, south=0.0, cell=1.0, heights=heights)
    lines = heights[::-1].astype(kind)
    found = parse_geotiff(write_raw(grid, lines, nodata=nodata))
    assert np.argwhere(np.isnan(found.heights)).tolist() == [[1, 2]]


def write_raw(grid, lines, *, scale=1.0, offset=0.0, **special):
    """The lines as they are, NaN among them."""
    import rasterio

    transform = Affine(grid.cell, 0, grid.west, 0, -grid.cell, find_north(grid))
    with rasterio.MemoryFile() as file:
        with file.open(
            driver="GTiff", width=lines.shape[1], height=len(lines), count=1,
            dtype=lines.dtype, transform=transform, crs="EPSG:2056", **special,
        ) as dataset:  # fmt: skip
            dataset.write(lines, 1)
            dataset.scales, dataset.offsets = (scale,), (offset,)
        return file.read()


def test_whole_numbers_with_scale_and_offset_are_heights(parse_geotiff):
    centimetres = np.round(100.0 * (HEIGHTS[::-1] - 1500.0)).astype("int16")
    found = parse_geotiff(write_raw(GRID, centimetres, scale=0.01, offset=1500.0))
    assert found.heights == pytest.approx(1500.0 + centimetres[::-1] / 100.0)


HALF, NORTH = 0.5, find_north(GRID) + 0.25
REFUSED = {
    "is no map plane": {"crs": "EPSG:4326"},
    "WGS 84 (EPSG:4978), which is no map": {"crs": "EPSG:4978"},
    "US survey foot: give them": {"crs": "EPSG:2227"},
    "heights in the unit US survey foot": {"crs": "EPSG:2056+6360"},
    "no metres on the ground": {"crs": "EPSG:3857"},
    "does not say where": {"place": False},
    "is rotated": {"transform": Affine(HALF, 0.1, 7e5, 0.1, -HALF, NORTH)},
    "upside down": {"transform": Affine(HALF, 0.0, 7e5, 0.0, HALF, NORTH)},
    "cells of 0.5 x 0.6 m": {"transform": Affine(HALF, 0.0, 7e5, 0.0, -0.6, NORTH)},
    "a cell of 5000 m": {"transform": Affine(5e3, 0.0, 7e5, 0.0, -5e3, NORTH)},
    "a cell of 1e-05 degrees": {
        "crs": None, "transform": Affine(1e-5, 0.0, 9.8, 0.0, -1e-5, 46.8)
    },
    "or damaged": {"dtype": "complex64"},
}  # fmt: skip


@each("said", REFUSED)
def test_what_is_not_in_metres_on_a_plane_is_refused(parse_geotiff, said):
    special = REFUSED[said]
    if special.get("dtype"):
        special = special | {"nodata": None}
    with pytest.raises(TerrainError) as caught:
        parse_geotiff(write_tif(GRID, **special))
    assert said in str(caught.value)


# --- hostile files --------------------------------------------------------------------


def find_tag(content, tag):
    """Place of a tag's value in the first directory of a little-endian TIFF."""
    (start,) = struct.unpack_from("<I", content, 4)
    (count,) = struct.unpack_from("<H", content, start)
    entries = (start + 2 + 12 * one for one in range(count))
    return next(
        at + 8 for at in entries if struct.unpack_from("<H", content, at)[0] == tag
    )


def lie(content, **values):
    """The same file with other numbers in its header."""
    tags = {"width": 256, "length": 257, "samples": 277, "rows": 278, "tile": 322}
    found = bytearray(content)
    for name, value in values.items():
        at = find_tag(content, tags[name])
        struct.pack_into("<HII", found, at - 6, 4, 1, value)  # as a long number
    return bytes(found)


def build_bomb():
    """Two thousand million cells of nothing in some kilobytes."""
    import rasterio

    with rasterio.MemoryFile() as file:
        with file.open(
            driver="GTiff", width=50_000, height=40_000, count=1, dtype="uint8",
            compress="deflate", tiled=True, blockxsize=4096, blockysize=4096,
            sparse_ok=True, transform=Affine(1, 0, 7e5, 0, -1, 2e5),
        ):  # fmt: skip
            pass
        return file.read()


TILED = {"tiled": True, "blockxsize": 16, "blockysize": 16}
HOSTILE = {
    "bomb": build_bomb(),
    "width": lie(write_tif(GRID), width=60_000, length=60_000),
    "length": lie(write_tif(GRID, nodata=None), length=16_000_000 // 7),
    "samples": lie(write_tif(GRID), samples=60_000),
    "tile": lie(write_tif(GRID, **TILED), tile=65_520),
    "text": b"ncols 3\nnrows 4\n",
    "empty": b"",
    "vrt": b'<VRTDataset rasterXSize="5" rasterYSize="5"></VRTDataset>',
    "png": b"\x89PNG\r\n\x1a\n" + bytes(64),
}


@needs_peak
def test_hostile_headers_are_refused_without_their_memory(tmp_path):
    for name, content in HOSTILE.items():
        (tmp_path / f"{name}.tif").write_bytes(content)
    assert len(HOSTILE["bomb"]) < 100_000
    names = [f"{name}.tif" for name in HOSTILE]
    told, before, most = watch("grid", "read_grid", names, tmp_path)
    assert [one.partition(":")[0] for one in told] == names, told
    assert "50000 x 40000 cells" in told[0]
    assert most - before < 300  # [MiB], of these a third is for the library itself
    assert sorted(one.name for one in tmp_path.iterdir()) == sorted(names)


def test_a_file_cut_anywhere_or_with_other_bytes_is_a_grid_or_refused(
    parse_geotiff, capfd
):
    draw = np.random.default_rng(11)
    read = 0
    for whole in (write_tif(GRID, compress="deflate"), write_tif(GRID, **TILED)):
        for place in draw.integers(0, len(whole) - 1, 60):
            spoilt = bytearray(whole)
            for other in draw.integers(0, min(len(whole), 1200), 2):
                spoilt[other] = draw.integers(0, 256)
            for content in (whole[:place], bytes(spoilt)):
                with contextlib.suppress(TerrainError):
                    grid = parse_geotiff(content)
                    known = grid.heights[np.isfinite(grid.heights)]
                    assert (np.abs(known) <= 9000.0).all()
                    read += 1
    assert 0 < read < 200
    assert capfd.readouterr() == ("", "")
