"""Net rows in plan as the report's map shows them, from ``rows.geojson``."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from netdesign.edge.causes import explain
from netdesign.edge.given_files import decode_utf8, read_bounded
from netdesign.outcome import StudyError, TerrainError
from netdesign.site.model import Site
from netdesign.words.message import say

Feature = dict[str, Any]
_ZONE = "starting zone"
_MOST_BYTES = 20_000_000
_FAR = 1e8  # beyond it nothing lies on a map in metres [m]
Ring = Sequence[tuple[float, float]]


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredPlace:
    """A row as ``netdesign terrain`` wrote it.

    Attributes
    ----------
    feature : mapping
        Its GeoJSON.
    aspect, slope : float
        Direction in which the ground falls, and its angle [rad].
    posts : list of tuple of float
        East, north, height [m].
    """

    feature: Feature
    aspect: float
    slope: float
    posts: list[tuple[float, float, float]]


def read_places(path: Path) -> tuple[dict[str, MeasuredPlace], Any]:
    """Rows of ``rows.geojson`` by name, and the whole document.

    Raises
    ------
    TerrainError
        If the file is not one that ``netdesign terrain`` wrote.
    """
    try:
        text = decode_utf8(read_bounded(path, _MOST_BYTES))
    except (OSError, ValueError) as error:
        told = say("rows_map.unreadable", file=path.name, cause=explain(error))
        raise TerrainError(told) from None
    try:
        document = json.loads(text)
        rows = document["features"]
        rows = [one for one in rows if one["properties"]["kind"] == "net row"]
        found = {str(one["properties"]["id"]): _read_place(one) for one in rows}
    except (ValueError, KeyError, TypeError, RecursionError):
        raise TerrainError(say("rows_map.no_places", file=path.name)) from None
    if not found:
        raise TerrainError(say("rows_map.no_places", file=path.name))
    return found, document


def _read_place(feature: Feature) -> MeasuredPlace:
    properties, points = feature["properties"], feature["geometry"]["coordinates"]
    posts = [(float(x), float(y), float(z)) for x, y, z in points]
    aspect, slope = properties["aspect_deg"], properties["slope_mean_deg"]
    if not all(math.isfinite(one) for post in posts for one in post):
        raise ValueError(feature)
    return MeasuredPlace(
        feature=feature,
        aspect=math.radians(float(aspect)),
        slope=math.radians(float(slope)),
        posts=posts,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class RowsMap:
    """Rows and zones that a map is drawn from; nothing of them enters a check.

    Attributes
    ----------
    file : str
        Name of the GeoJSON.
    grid, sha256 : str
        File that the rows were measured on, and its digest.
    rows : mapping of str to MeasuredPlace
        By their names.
    zones : tuple of sequence of tuple of float
        Outlines of the starting zones, east and north [m].
    """

    file: str
    grid: str
    sha256: str
    rows: Mapping[str, MeasuredPlace]
    zones: tuple[Ring, ...] = ()


def read_rows_map(path: Path) -> RowsMap:
    """Read ``rows.geojson``.

    Raises
    ------
    TerrainError
        If ``netdesign terrain`` did not write it, or its rows come from two grids.
    """
    rows, document = read_places(path)
    own = [one.feature["properties"] for one in rows.values()]
    grids = {(str(one.get("grid")), str(one.get("grid_sha256"))) for one in own}
    if len(grids) > 1:
        raise TerrainError(say("rows_map.two_grids", file=path.name))
    ((grid, sha256),) = grids
    zones = _read_zones(document, path.name)
    points = [point for place in rows.values() for point in place.posts]
    corners = [point for zone in zones for point in zone]
    if not all(abs(part) < _FAR for point in (*points, *corners) for part in point):
        raise TerrainError(say("rows_map.no_places", file=path.name))
    return RowsMap(file=path.name, grid=grid, sha256=sha256, rows=rows, zones=zones)


def _read_zones(document: Any, file: str) -> tuple[Ring, ...]:
    """Outlines of the starting zones; none in a file that has none."""
    try:
        rings = [
            one["geometry"]["coordinates"][0]
            for one in document["features"]
            if one["properties"]["kind"] == _ZONE
        ]
        return tuple(tuple((float(x), float(y)) for x, y in ring) for ring in rings)
    except (ValueError, KeyError, TypeError, IndexError):
        raise TerrainError(say("rows_map.no_places", file=file)) from None


def require_rows(places: RowsMap, site: Site) -> None:
    """Refuse a map that lacks rows of a site, or shows them with other posts.

    Raises
    ------
    StudyError
        That names the rows.
    """
    require_named(places, [row.id for row in site.rows])
    others = tuple(
        row.id
        for row in site.rows
        if row.post_count not in (None, len(places.rows[row.id].posts))
    )
    if others:
        raise StudyError(say("rows_map.other_posts", file=places.file, rows=others))


def require_named(places: RowsMap, rows: Sequence[str]) -> None:
    """Refuse a map that lacks some rows.

    Raises
    ------
    StudyError
        That names them.
    """
    missing = tuple(one for one in rows if one not in places.rows)
    if missing:
        raise StudyError(say("rows_map.not_drawn", file=places.file, rows=missing))
