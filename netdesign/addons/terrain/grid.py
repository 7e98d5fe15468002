"""Elevation grid: heights of the ground at square cells, in metres on a map plane."""

from __future__ import annotations

import codecs
import math
import re
import sys
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from netdesign.edge.input_files import make_printable, read_bounded
from netdesign.numerics.arrays import Floats
from netdesign.outcome import TerrainError

if TYPE_CHECKING:
    from rasterio.io import DatasetReader

# What rasterio and pyogrio raise on a damaged file, faults of their own among it.
DAMAGE = (
    *(ArithmeticError, AttributeError, LookupError, OSError, RuntimeError),
    *(MemoryError, NameError, TypeError, ValueError),
)


def read_file(path: Path, most: int) -> bytes:
    """Content of a file of at most ``most`` bytes.

    Raises
    ------
    TerrainError
        If it cannot be read, or is larger.
    """
    try:
        return read_bounded(path, most)
    except (OSError, ValueError) as error:
        cause = getattr(error, "strerror", None) or error
        raise TerrainError(f"{path.name}: cannot be read: {cause}") from None


@contextmanager
def keep_quiet() -> Iterator[None]:
    """Neither warnings, nor what the libraries print where they cannot raise.

    A message about a damaged file may itself be no text.
    """
    before = sys.excepthook, sys.unraisablehook
    sys.excepthook, sys.unraisablehook = lambda *_: None, lambda _: None
    try:
        with warnings.catch_warnings(action="ignore"):
            yield
    finally:
        sys.excepthook, sys.unraisablehook = before


_MERCATOR = ("Mercator", "Popular Visualisation")  # its metres grow with latitude


def require_plane(crs: str) -> str:
    """Refuse what is not in metres on a plane; the system's code, or its text.

    Parameters
    ----------
    crs : str
        Code or WKT, as GDAL gives it; empty where the file names none.

    Returns
    -------
    str
        Code where it has one. Empty for a local system: its coordinates are metres
        from an unknown origin.

    Raises
    ------
    TerrainError
        Naming the system.
    """
    if not crs:
        return ""
    import rasterio
    from rasterio.crs import CRS

    with rasterio.Env():
        plane = CRS.from_user_input(crs)
        system: Mapping[str, Any] = plane.to_dict(projjson=True)
        if system["type"] == "CompoundCRS":  # a plane with a system of heights
            system = system["components"][0]
            plane = CRS.from_dict(system)
        name, code = _name(plane), plane.to_epsg()
        system = system.get("source_crs", system)
        if system["type"] not in ("ProjectedCRS", "EngineeringCRS"):
            advice = (
                "which is no map plane: project them in metres, to the national grid"
            )
            raise TerrainError(f"coordinates in {name}, {advice} or UTM")
        unit = system["coordinate_system"]["axis"][0]["unit"]
        if unit != "metre":
            unit = unit["name"] if isinstance(unit, Mapping) else unit
            advice = f"in the unit {unit}: give them in metres"
            raise TerrainError(f"coordinates in {name}, {advice}")
        if system["type"] == "EngineeringCRS":
            return ""
        if system["conversion"]["method"]["name"].startswith(_MERCATOR):
            advice = "whose metres are no metres on the ground: project them to the"
            raise TerrainError(f"coordinates in {name}, {advice} national grid or UTM")
        return f"EPSG:{code}" if code else str(plane.to_wkt())


def require_same(grid: str, rows: str) -> None:
    """Refuse rows in another system than the grid, where both have one.

    Parameters
    ----------
    grid, rows : str
        As ``require_plane`` gives them.

    Raises
    ------
    TerrainError
        Naming both.
    """
    if not (grid and rows) or grid == rows:
        return
    import rasterio
    from rasterio.crs import CRS

    with rasterio.Env():
        of_grid, other = CRS.from_user_input(grid), CRS.from_user_input(rows)
        if of_grid != other:
            advice = "are two reference systems: give the grid and all rows in one"
            raise TerrainError(f"{_name(of_grid)} and {_name(other)} {advice}")


def _name(crs: Any) -> str:
    """Name of a reference system with its EPSG code."""
    name = make_printable(str(crs.to_dict(projjson=True)["name"]))[:60]
    code = crs.to_epsg()
    return f"{name} (EPSG:{code})" if code else name


MOST_CELLS = 16_000_000  # 4,000 x 4,000
MOST_BYTES = 400_000_000
LOWEST, HIGHEST = -500.0, 9000.0  # of any ground [m]
_GEOTIFF = (".tif", ".tiff")
_LEAST_CELL, _LARGEST_CELL = 0.1, 100.0  # [m]
_DEGREES = 0.05  # a cell smaller than this near small coordinates is one of degrees
_NO_HEIGHT = -9999.0  # of an ASCII grid that does not say
_ALIKE = 1e-6  # of the sides of a cell
_METRES = ("", "m", "metre", "meter", "metres", "meters", "unknown")
_HEADER = re.compile(rb"(?:\s*[A-Za-z_]{2,}[ \t]+\S+[ \t]*[\r\n]+)*")
_HEADER_BYTES = 1024  # in which it ends
_DIGITS = b"0123456789+-.,eE \t\r\n\v\f\x1a"
# Nothing beside the file is looked for or written.
_SETTINGS = {"GDAL_PAM_ENABLED": "NO", "GDAL_DISABLE_READDIR_ON_OPEN": "EMPTY_DIR"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Grid:
    """Heights of the ground on a regular grid, X east, Y north.

    Attributes
    ----------
    west, south : float
        Middle of the first cell [m].
    cell : float
        Side of a cell [m].
    heights : ndarray, shape (n_y, n_x)
        From south to north and west to east [m]; NaN where not known.
    crs : str
        Reference system, as ``EPSG:2056`` or as WKT; empty where not known.
    bands : int
        Of its file; the first one is read as heights.
    """

    west: float
    south: float
    cell: float
    heights: Floats
    crs: str = ""
    bands: int = 1


def read_grid(path: Path) -> Grid:
    """Read an ESRI ASCII grid or a GeoTIFF, in metres.

    GDAL sees the bytes of this file and no other one.

    Raises
    ------
    TerrainError
        If the file is none; names what is accepted.
    """
    from rasterio.errors import RasterioError

    content = read_file(path, MOST_BYTES)
    is_geotiff = path.suffix.lower() in _GEOTIFF
    if not is_geotiff:
        content = _clean(content)
    try:
        with keep_quiet():
            return parse_grid(content, is_geotiff=is_geotiff)
    except TerrainError as error:
        reason = str(error)
    except (*DAMAGE, RasterioError):
        reason = (
            "no ESRI ASCII grid (.asc) or GeoTIFF (.tif), or damaged: save it again"
        )
    raise TerrainError(f"{path.name}: {reason}")


def parse_grid(content: bytes, *, is_geotiff: bool) -> Grid:
    """Grid of the bytes of a file; what is none ends in an error of any kind."""
    import rasterio

    driver, options = "GTiff", {}
    if not is_geotiff:
        driver, options = "AAIGrid", {"DATATYPE": "Float64"}
    with (
        rasterio.Env(**_SETTINGS),
        rasterio.MemoryFile(content) as file,
        file.open(driver=driver, **options) as dataset,
    ):
        require_size(dataset.width, dataset.height)
        if is_geotiff:
            _require_memory(dataset)
            _require_whole(dataset)
        else:
            _require_numbers(content, dataset.width * dataset.height)
        return _read_dataset(dataset)


def _clean(content: bytes) -> bytes:
    """ASCII grid without byte order mark, and blanks before the words of its header."""
    plain = content.removeprefix(codecs.BOM_UTF8)
    start = re.sub(rb"(?m)^\s+", b"", plain[:_HEADER_BYTES])
    return start + plain[_HEADER_BYTES:]


def _read_dataset(dataset: DatasetReader) -> Grid:
    """Heights of the first band; everything that the header says is judged before."""
    cell, west, north = _read_place(dataset)
    crs = require_plane(dataset.crs.to_wkt() if dataset.crs else "")
    unit = (dataset.units[0] or "").strip()
    if unit.casefold() not in _METRES:
        unit = make_printable(unit)[:40]
        raise TerrainError(f"heights in the unit {unit}: give them in metres")
    require_metres(cell, west, north)
    heights = _read_heights(dataset)
    require_ground(heights, cell)
    return Grid(
        west=west + 0.5 * cell,
        south=north - (dataset.height - 0.5) * cell,
        cell=cell,
        heights=heights[::-1].copy(),
        crs=crs,
        bands=dataset.count,
    )


def require_size(columns: int, lines: int) -> None:
    """Refuse a number of cells that is too small or too large.

    Raises
    ------
    TerrainError
        Naming it.
    """
    if not (min(columns, lines) >= 3 and columns * lines <= MOST_CELLS):
        size = f"{columns} x {lines} cells: 3 x 3 to {MOST_CELLS} cells are read"
        raise TerrainError(size)


def _require_numbers(content: bytes, cells: int) -> None:
    """Refuse words among the heights of an ASCII grid, and another number of them.

    GDAL takes a word for 0, and leaves out what is too much.
    """
    match = _HEADER.match(content)
    start = match.end() if match else 0
    words = content[start:].translate(None, _DIGITS).lower()
    if re.sub(rb"nan|null", b"", words):
        raise TerrainError("a height is no number")
    is_sign = np.frombuffer(content, dtype=np.uint8, offset=start) > ord(" ")
    count = int(is_sign[:1].sum()) + np.count_nonzero(is_sign[1:] > is_sign[:-1])
    if count != cells:
        raise TerrainError(f"{count} heights, where the header says {cells}")


def _require_memory(dataset: DatasetReader) -> None:
    """Refuse numbers that are no heights, and blocks that take too much memory.

    A block is opened as a whole, with all bands that may lie in it.
    """
    kinds = [np.dtype(kind) for kind in dataset.dtypes]
    if kinds[0].kind not in "iuf":
        raise ValueError(kinds)
    lines, columns = dataset.block_shapes[0]
    size = lines * columns * sum(kind.itemsize for kind in kinds)
    if size > MOST_BYTES:
        refusal = f"a block of {size / 1e6:.0f} MB: save the grid in tiles of 256 x 256"
        raise TerrainError(f"{refusal} cells, with one band")


def _require_whole(dataset: DatasetReader) -> None:
    """Refuse blocks that are not there: where no value says so, they would be zeros."""
    lines, columns = dataset.block_shapes[0]
    across, down = -(-dataset.width // columns), -(-dataset.height // lines)
    if dataset.nodata is None and not all(
        dataset.get_tag_item(f"BLOCK_OFFSET_{x}_{y}", "TIFF", bidx=1)
        for y in range(down)
        for x in range(across)
    ):
        raise ValueError(dataset.nodata)


def _read_place(dataset: DatasetReader) -> tuple[float, float, float]:
    """Side of the cells, west and north edge [m]."""
    place = dataset.transform
    is_nowhere = place.c == place.f == 0.0  # as GDAL has it of a header without corner
    if is_nowhere or not all(map(math.isfinite, place)):
        raise TerrainError("the file does not say where its cells lie")
    if place.b or place.d or not place.a >= 0.0 >= place.e:
        reason = (
            "the grid is rotated or upside down: save it with its lines running east"
        )
        raise TerrainError(f"{reason}, the first one in the north")
    if abs(place.a + place.e) > _ALIKE * place.a:
        sides = f"{place.a:g} x {-place.e:g} m"
        raise TerrainError(f"cells of {sides}: save the grid with square cells")
    return float(place.a), float(place.c), float(place.f)


def require_metres(cell: float, west: float, north: float) -> None:
    """Refuse cells of degrees, or of a size that no grid of a slope has.

    Parameters
    ----------
    cell : float
        Its side [m].
    west, north : float
        A corner of the grid [m].

    Raises
    ------
    TerrainError
        Naming it.
    """
    if 0.0 < cell < _DEGREES and abs(west) <= 360.0 and abs(north) <= 90.0:
        reason = (
            f"a cell of {cell:g} degrees: give the grid in metres, projected to the"
        )
        raise TerrainError(f"{reason} national grid or UTM")
    if not _LEAST_CELL <= cell <= _LARGEST_CELL:
        ends = f"{_LEAST_CELL:g} to {_LARGEST_CELL:g} m"
        raise TerrainError(f"a cell of {cell:g} m: {ends} are read")


def _read_heights(dataset: DatasetReader) -> Floats:
    """Heights from north to south [m], NaN where none is known."""
    band = dataset.read(1, masked=True, out_dtype="float64")
    values: Floats = band.data * dataset.scales[0] + dataset.offsets[0]
    values[np.ma.getmaskarray(band) | (band.data == _NO_HEIGHT)] = math.nan
    wrong = values[(values < LOWEST) | (values > HIGHEST)]
    if wrong.size:
        reason = (
            f"a height of {wrong[0]:g} m: {LOWEST:g} to {HIGHEST:g} m are read, and"
        )
        raise TerrainError(f"{reason} the no-data value that the file declares")
    return values


_HIGHEST_STEP, _STEEPEST_STEP = 100.0, 10.0  # within a cell [m]; over the cell [-]


def require_ground(heights: Floats, cell: float) -> None:
    """Refuse falls within a cell that no ground has: heights that stand for no data.

    Parameters
    ----------
    heights : ndarray, shape (lines, columns)
        NaN without data [m].
    cell : float
        [m].

    Raises
    ------
    TerrainError
        With both heights of the largest fall, and what to do.
    """
    most = max(_HIGHEST_STEP, _STEEPEST_STEP * cell)
    worst = (most, 0.0, 0.0)
    for axis in (0, 1):
        falls = np.abs(np.diff(heights, axis=axis))
        if not np.isfinite(falls).any():
            continue
        at = np.unravel_index(int(np.nanargmax(falls)), falls.shape)
        other = (at[0] + 1 - axis, at[1] + axis)
        ends = sorted((float(heights[at]), float(heights[other])))
        worst = max(worst, (float(falls[at]), ends[0], ends[1]))
    fall, low, high = worst
    if fall > most:
        reason = f"the ground falls from {high:.6g} to {low:.6g} m within a cell"
        asked = f"does {low:.6g} stand for no data? Declare it in the header"
        raise TerrainError(f"{reason}: {asked}, or correct the heights")
