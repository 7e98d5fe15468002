"""Reference systems of grids and rows: metres on a plane, the same for both."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING

from netdesign.edge.given_files import make_printable
from netdesign.outcome import TerrainError
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from rasterio.crs import CRS

_CODE = re.compile(r"[A-Z]{2,10}:\w{1,20}")  # never a file or an address
_MEMBER = re.compile(r"(?:urn:ogc:def:crs:)?(EPSG|OGC):(?:[\d.]*:)?(\w{1,20})")
_MERCATOR = re.compile(r'PROJECTION\["(Popular_Visualisation_Pseudo_)?Mercator')
_LONGEST_NAME = 60


def read_member(document: object) -> str:
    """Code of the system that a GeoJSON document names, as QGIS does; "" of none."""
    for key in ("crs", "properties", "name"):
        document = document.get(key) if isinstance(document, Mapping) else None
    found = _MEMBER.fullmatch(document) if isinstance(document, str) else None
    return f"{found[1]}:{found[2]}" if found else ""


def write_member(crs: str) -> dict[str, object]:
    """The same member for a document; nothing of a system without a code."""
    if not crs.startswith("EPSG:"):
        return {}
    name = f"urn:ogc:def:crs:EPSG::{crs.removeprefix('EPSG:')}"
    return {"crs": {"type": "name", "properties": {"name": name}}}


def require_plane(crs: str) -> str:
    """Refuse what is not in metres on a plane; the system's code, or its text.

    Parameters
    ----------
    crs : str
        Code as ``EPSG:2056``, WKT, or nothing.

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
    import rasterio

    with rasterio.Env():
        found = _read(crs) if crs else None
        if found is None:
            return ""
        is_local = found.to_wkt().startswith("LOCAL_CS")
        if not (found.is_projected or is_local):
            raise TerrainError(say("terrain.unprojected", crs=_name(found)))
        unit, size = found.units_factor
        if size != 1.0:
            told = say("terrain.crs_unit", crs=_name(found), unit=make_printable(unit))
            raise TerrainError(told)
        if _MERCATOR.search(found.to_wkt()):
            raise TerrainError(say("terrain.mercator", crs=_name(found)))
        code = found.to_epsg()
        return "" if is_local else f"EPSG:{code}" if code else found.to_wkt()


def require_same(grid: str, rows: str) -> None:
    """Refuse rows in another system than the grid, where both have one.

    Parameters
    ----------
    grid, rows : str
        As ``require_plane`` gives them; of rows perhaps any code.

    Raises
    ------
    TerrainError
        Naming both.
    """
    if not (grid and rows) or grid == rows:
        return
    import rasterio

    with rasterio.Env():
        one, other = _read(grid), _read(rows)
        if one is not None and one == other:
            return
        names = {
            "grid": _name(one) if one else grid,
            "rows": _name(other) if other else rows,
        }
    raise TerrainError(say("terrain.crs_differ", **names))


def _read(crs: str) -> CRS | None:
    """System of a code or a WKT, without its heights; None of what is neither.

    Any other text might be taken for a file or an address.
    """
    from rasterio.crs import CRS
    from rasterio.errors import CRSError

    try:
        if _CODE.fullmatch(crs):
            crs = CRS.from_user_input(crs).to_wkt()
        return CRS.from_wkt(_cut_heights(crs))
    except CRSError:
        return None


def _cut_heights(wkt: str) -> str:
    """Map plane of a system that has heights, too."""
    start = wkt.find("PROJCS[")
    if not wkt.startswith("COMPD_CS") or start < 0:
        return wkt
    depth, is_quoted = 0, False
    for place in range(start, len(wkt)):
        sign = wkt[place]
        is_quoted ^= sign == '"'
        depth += 0 if is_quoted else {"[": 1, "]": -1}.get(sign, 0)
        if sign == "]" and depth == 0:
            return wkt[start : place + 1]
    return wkt


def _name(crs: CRS) -> Message | str:
    """Name as people know it, with its code."""
    _, _, rest = crs.to_wkt().partition('"')
    name = make_printable(rest.partition('"')[0])[:_LONGEST_NAME]
    code = crs.to_epsg()
    return say("terrain.crs_name", name=name, code=code) if code else name
