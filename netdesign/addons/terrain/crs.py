"""Files of other programs as GDAL reads them, and their reference systems.

Files are bounded, local, quiet; grids and rows have metres on the same plane.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from netdesign.edge.given_files import make_printable, read_bounded
from netdesign.outcome import TerrainError

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
        Code where it has one. Nothing of a local system: its coordinates are metres,
        and nobody knows where.

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
        found = CRS.from_user_input(crs)
        system: Mapping[str, Any] = found.to_dict(projjson=True)
        if system["type"] == "CompoundCRS":  # a plane with a system of heights
            system = system["components"][0]
            found = CRS.from_dict(system)
        name, code = _name(found), found.to_epsg()
        system = system.get("source_crs", system)
        if system["type"] not in ("ProjectedCRS", "EngineeringCRS"):
            told = "which is no map plane: project them in metres, to the national grid"
            raise TerrainError(f"coordinates in {name}, {told} or UTM")
        unit = system["coordinate_system"]["axis"][0]["unit"]
        if unit != "metre":
            unit = unit["name"] if isinstance(unit, Mapping) else unit
            told = f"in the unit {unit}: give them in metres"
            raise TerrainError(f"coordinates in {name}, {told}")
        if system["type"] == "EngineeringCRS":
            return ""
        if system["conversion"]["method"]["name"].startswith(_MERCATOR):
            told = "whose metres are no metres on the ground: project them to the"
            raise TerrainError(f"coordinates in {name}, {told} national grid or UTM")
        return f"EPSG:{code}" if code else str(found.to_wkt())


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
        one, other = CRS.from_user_input(grid), CRS.from_user_input(rows)
        if one != other:
            told = "are two reference systems: give the grid and all rows in one"
            raise TerrainError(f"{_name(one)} and {_name(other)} {told}")


def _name(crs: Any) -> str:
    """Name as people know it, with its code."""
    name = make_printable(str(crs.to_dict(projjson=True)["name"]))[:60]
    code = crs.to_epsg()
    return f"{name} (EPSG:{code})" if code else name
