"""Elevation grid: heights of the ground at the middles of square cells."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from netdesign.edge.causes import explain
from netdesign.edge.given_files import read_bounded
from netdesign.numerics.arrays import Floats
from netdesign.outcome import TerrainError
from netdesign.terrain.libraries import require_extra
from netdesign.words.message import Message, say

GEOTIFF = (".tif", ".tiff")
MOST_CELLS = 16_000_000  # 4,000 x 4,000
MOST_BYTES = 400_000_000
LOWEST, HIGHEST = -500.0, 9000.0  # of any ground [m]
_LEAST_CELL, _LARGEST_CELL = 0.1, 100.0  # [m]
_DEGREES = 0.05  # a cell smaller than this near small coordinates is one of degrees
_NUMBERS = ("ncols", "nrows", "cellsize", "nodata_value")
_CORNERS = ("xllcorner", "yllcorner")
_CENTRES = ("xllcenter", "yllcenter")


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
        From south to north and west to east [m]; NaN where nobody knows.
    crs : str
        Reference system, as ``EPSG:2056`` or as WKT; empty where nobody knows.
    notes : tuple of Message
        What its reader has to be told.
    """

    west: float
    south: float
    cell: float
    heights: Floats
    crs: str = ""
    notes: tuple[Message, ...] = ()

    @property
    def east(self) -> float:
        """Middle of the last cell of a line [m]."""
        return self.west + self.cell * (int(self.heights.shape[1]) - 1)

    @property
    def north(self) -> float:
        """Middle of the last cell of a column [m]."""
        return self.south + self.cell * (len(self.heights) - 1)


def read_grid(path: Path) -> Grid:
    """Read an ESRI ASCII grid or a GeoTIFF, in metres.

    Raises
    ------
    TerrainError
        If the file is none; names what is accepted.
    """
    is_geotiff = path.suffix.lower() in GEOTIFF
    if is_geotiff:
        require_extra(path.name)
    try:
        content = read_bounded(path, MOST_BYTES)
    except (OSError, ValueError) as error:
        raise TerrainError(
            say("terrain.unreadable", file=path.name, cause=explain(error))
        ) from None
    try:
        return _parse_geotiff(content) if is_geotiff else parse_grid(content)
    except TerrainError as error:
        told = say("text.at_place", place=path.name, text=error.message)
        raise TerrainError(told) from None


def _parse_geotiff(content: bytes) -> Grid:
    from netdesign.terrain.geotiff import parse_geotiff  # which makes grids, too

    return parse_geotiff(content)


def parse_grid(content: bytes) -> Grid:
    """Grid of the bytes of an ESRI ASCII grid.

    Raises
    ------
    TerrainError
        If they are none.
    """
    header, rest = _read_header(content)
    columns, lines = int(header["ncols"]), int(header["nrows"])
    cell = header["cellsize"]
    places = _CENTRES if _CENTRES[0] in header else _CORNERS
    west, south = (header[one] for one in places)
    require_metres(cell, west, south)
    if places == _CORNERS:
        west, south = west + 0.5 * cell, south + 0.5 * cell
    values = _read_numbers(rest, columns * lines)
    nodata = header.get("nodata_value", -9999.0)
    is_known = values != nodata
    require_heights(values[is_known])
    heights = np.where(is_known, values, math.nan).reshape(lines, columns)
    return Grid(west=west, south=south, cell=cell, heights=heights[::-1].copy())


def _read_header(content: bytes) -> tuple[dict[str, float], bytes]:
    """Lines of a word and a number that a grid begins with, and what follows them."""
    found: dict[str, float] = {}
    rest = content
    while True:
        line, _, after = rest.partition(b"\n")
        words = line.decode("latin-1").split()
        if not words or not words[0][0].isalpha() or words[0].lower() == "nan":
            break
        if len(words) != 2 or words[0].lower() in found:
            raise _refuse_header(line.decode("latin-1"))
        found[words[0].lower()] = _read_number(words)
        rest = after
    for needed in ("ncols", "nrows", "cellsize"):
        if needed not in found:
            raise TerrainError(say("terrain.no_header", key=needed))
    if not any(all(one in found for one in pair) for pair in (_CORNERS, _CENTRES)):
        raise TerrainError(say("terrain.no_header", key=_CORNERS[0]))
    unknown = set(found) - {*_NUMBERS, *_CORNERS, *_CENTRES}
    if unknown:
        raise _refuse_header(min(unknown))
    require_size(found["ncols"], found["nrows"])
    return found, rest


def _read_number(words: list[str]) -> float:
    try:
        number = float(words[1])
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise _refuse_header(" ".join(words))
    return number


def _refuse_header(line: str) -> TerrainError:
    if not line.strip().isprintable():
        return TerrainError(say("terrain.no_text"))
    return TerrainError(say("terrain.header", line=f"{line.strip()!r:.60}"))


def require_heights(values: Floats) -> None:
    """Refuse what no ground has.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Heights that are said to be known [m].

    Raises
    ------
    TerrainError
        Naming the first that is none.
    """
    wrong = values[~((values >= LOWEST) & (values <= HIGHEST))]
    if wrong.size:
        ends = {"low": LOWEST, "high": HIGHEST}
        raise TerrainError(say("terrain.no_height", value=f"{wrong[0]:g}", **ends))


def require_size(columns: float, lines: float) -> None:
    """Refuse a number of cells that is none, or too large.

    Raises
    ------
    TerrainError
        Naming it.
    """
    is_whole = float(columns).is_integer() and float(lines).is_integer()
    if not is_whole or not (min(columns, lines) >= 3 and columns * lines <= MOST_CELLS):
        size = {"columns": f"{columns:g}", "lines": f"{lines:g}"}
        raise TerrainError(say("terrain.size", **size, most=MOST_CELLS))


def require_metres(cell: float, west: float, south: float) -> None:
    """Refuse cells of degrees, or of a size that no grid of a slope has.

    Parameters
    ----------
    cell : float
        Its side [m].
    west, south : float
        A corner of the grid [m].

    Raises
    ------
    TerrainError
        Naming it.
    """
    if 0.0 < cell < _DEGREES and abs(west) <= 360.0 and abs(south) <= 90.0:
        raise TerrainError(say("terrain.degrees", cell=f"{cell:g}"))
    if not _LEAST_CELL <= cell <= _LARGEST_CELL:
        ends = {"least": _LEAST_CELL, "most": _LARGEST_CELL}
        raise TerrainError(say("terrain.cell", cell=f"{cell:g}", **ends))


def _read_numbers(text: bytes, count: int) -> Floats:
    """Heights of the cells; the file must have as many as it says.

    A count that does not fit is refused before memory is asked for.
    """
    if len(text) < 2 * count - 1:
        given = len(text.split())
        raise TerrainError(say("terrain.count", given=given, wanted=count))
    values = _parse(text)
    if values.size != count:
        raise TerrainError(say("terrain.count", given=values.size, wanted=count))
    return values


def _parse(text: bytes) -> Floats:
    """Numbers of a text; a warning of NumPy tells that something else is among them."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return np.fromstring(text.decode("latin-1"), dtype=np.float64, sep=" ")
        except (ValueError, DeprecationWarning):
            raise TerrainError(say("terrain.no_number")) from None
