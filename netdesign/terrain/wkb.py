"""Geometries as bytes (WKB, of ISO and of OGC with heights) and as GeoJSON has them."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

_KINDS = {
    1: "Point",
    2: "LineString",
    3: "Polygon",
    4: "MultiPoint",
    5: "MultiLineString",
    6: "MultiPolygon",
}
_WITH_Z, _WITH_M = 0x80000000, 0x40000000  # as OGC's older form has it


def decode_wkb(wkb: bytes) -> dict[str, Any]:
    """Geometry of GeoJSON, its points without heights.

    Raises
    ------
    ValueError
        If the bytes are none, or of a kind that GeoJSON lacks.
    """
    try:
        return _read(wkb, 0, set(_KINDS))[0]
    except (struct.error, IndexError, KeyError) as error:
        raise ValueError(error) from None


def encode_wkb(geometry: Mapping[str, Any]) -> bytes:
    """Bytes of a point or a line with heights [m]."""
    points = geometry["coordinates"]
    if geometry["type"] == "Point":
        return struct.pack("<BI3d", 1, _WITH_Z | 1, *points)
    flat = [one for point in points for one in point]
    return struct.pack(f"<BII{len(flat)}d", 1, _WITH_Z | 2, len(points), *flat)


def _read(wkb: bytes, at: int, allowed: set[int]) -> tuple[dict[str, Any], int]:
    """Geometry at a place, and where it ends."""
    order = "<" if wkb[at] == 1 else ">"
    (code,) = struct.unpack_from(f"{order}I", wkb, at + 1)
    more, kind = divmod(code & ~(_WITH_Z | _WITH_M), 1000)
    size = 2 + (more in (1, 3)) + (more in (2, 3))
    size += bool(code & _WITH_Z) + bool(code & _WITH_M)
    if kind not in allowed:
        raise ValueError(kind)
    at += 5
    if kind == 1:
        points, at = _read_points(wkb, at, order, size, 1)
        return {"type": _KINDS[kind], "coordinates": points[0]}, at
    (count,) = struct.unpack_from(f"{order}I", wkb, at)
    at += 4
    if kind == 2:
        found, at = _read_points(wkb, at, order, size, count)
    else:
        found, at = _read_parts(wkb, at, order, size, kind, count)
    return {"type": _KINDS[kind], "coordinates": found}, at


def _read_parts(
    wkb: bytes, at: int, order: str, size: int, kind: int, count: int
) -> tuple[list[Any], int]:
    """Rings of a polygon, or members of a collection of one kind."""
    found: list[Any] = []
    for _ in range(count):  # a count that lies ends with the bytes
        if kind == 3:
            (length,) = struct.unpack_from(f"{order}I", wkb, at)
            part, at = _read_points(wkb, at + 4, order, size, length)
        else:
            member, at = _read(wkb, at, {kind - 3})
            part = member["coordinates"]
        found.append(part)
    return found, at


def _read_points(
    wkb: bytes, at: int, order: str, size: int, count: int
) -> tuple[Sequence[Any], int]:
    end = at + 8 * size * count
    if end > len(wkb):
        raise ValueError(count)
    numbers = np.frombuffer(wkb, f"{order}f8", size * count, at)
    return numbers.reshape(count, size)[:, :2].tolist(), end
