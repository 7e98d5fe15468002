"""Measured rows and their posts as GeoJSON, written and read again."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import shapely
from shapely import LineString, Point, Polygon
from shapely.geometry import mapping

from netdesign.addons.terrain.grid import read_file
from netdesign.addons.terrain.measure import MeasuredRow
from netdesign.addons.terrain.plan import ZONE
from netdesign.edge.input_files import decode_utf8
from netdesign.outcome import TerrainError

Feature = dict[str, Any]


def write_features(features: Iterable[Feature], crs: str = "") -> bytes:
    """GeoJSON of some features, the same bytes each time.

    Parameters
    ----------
    features : iterable of dict
        Their coordinates are those of the grid.
    crs : str
        Reference system, as ``EPSG:2056``: a map then finds the place.
    """
    document: dict[str, Any] = {"type": "FeatureCollection"}
    if crs.startswith("EPSG:"):
        name = f"urn:ogc:def:crs:EPSG::{crs.removeprefix('EPSG:')}"
        document["crs"] = {"type": "name", "properties": {"name": name}}
    document["features"] = list(features)
    return json.dumps(document, indent=1, allow_nan=False, ensure_ascii=False).encode()


def list_row_features(
    rows: Sequence[MeasuredRow], zones: Sequence[Polygon], grid: str, sha256: str
) -> list[Feature]:
    """Rows with what was measured, their posts with number and height, and the zones.

    Parameters
    ----------
    rows : sequence of MeasuredRow
        On the terrain.
    zones : sequence of Polygon
        Starting zones [m].
    grid, sha256 : str
        Name and digest of the grid's file.
    """
    features = []
    for row in rows:
        below = row.below_length
        properties = {
            "kind": "net row",
            "id": row.line.id,
            "net_height_m": row.line.net_height,
            "post_spacing_m": row.line.post_spacing,
            "slope_deg": _degrees(row.slope.value),
            "slope_low_deg": _degrees(row.slope.low),
            "slope_high_deg": _degrees(row.slope.high),
            "slope_mean_deg": _degrees(float(row.slopes.mean())),
            "aspect_deg": _degrees(row.aspect),
            "exposure": find_exposure(row.aspect),
            "altitude_m": round(float(row.posts[:, 2].max()), 2),
            "length_m": round(row.length, 3),
            "upslope_length_m": round(row.upslope.length.value, 3),
            "upslope_end": row.upslope.end,
            "row_above": row.upslope.row or None,
            "row_below": row.below_row or None,
            "row_below_m": None if below is None else round(below, 3),
            "kinks_at_posts": list(row.kinks),
            "grid": grid,
            "grid_sha256": sha256,
        }
        features.append(make_feature(LineString(row.posts), properties))
        for number, post in enumerate(row.posts, 1):
            marks = {"kind": "post", "row": row.line.id, "post": number}
            features.append(make_feature(Point(post), marks))
    return [*features, *(make_feature(zone, {"kind": ZONE}) for zone in zones)]


def find_exposure(aspect: float) -> str:
    """Class of exposure of the guideline's table of ground: "N" or "S".

    WNW over N to ENE is north, the rest south; as the ground's table has it.

    Parameters
    ----------
    aspect : float
        Direction in which the ground falls, clockwise from north [rad].
    """
    from_north = abs((math.degrees(aspect) + 180.0) % 360.0 - 180.0)
    return "N" if from_north <= 67.5 else "S"


def _degrees(angle: float) -> float:
    return round(math.degrees(angle), 3)


def make_feature(geometry: Any, properties: dict[str, Any]) -> Feature:
    """Feature of a shape, its coordinates to a millimetre."""
    rounded = shapely.transform(
        geometry, lambda coordinates: coordinates.round(3), include_z=None
    )
    return {"type": "Feature", "properties": properties, "geometry": mapping(rounded)}


_MOST_BYTES = 20_000_000
_NOT_OURS = "not the rows.geojson that 'netdesign terrain' wrote"


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
    content = read_file(path, _MOST_BYTES)
    try:
        document = json.loads(decode_utf8(content))
        rows = document["features"]
        rows = [
            feature for feature in rows if feature["properties"]["kind"] == "net row"
        ]
        places = {
            str(feature["properties"]["id"]): _read_place(feature) for feature in rows
        }
    except (ValueError, KeyError, TypeError, RecursionError):
        raise TerrainError(f"{path.name}: {_NOT_OURS}") from None
    if not places:
        raise TerrainError(f"{path.name}: {_NOT_OURS}")
    return places, document


def _read_place(feature: Feature) -> MeasuredPlace:
    properties, points = feature["properties"], feature["geometry"]["coordinates"]
    posts = [(float(x), float(y), float(z)) for x, y, z in points]
    aspect, slope = properties["aspect_deg"], properties["slope_mean_deg"]
    if not all(math.isfinite(coordinate) for post in posts for coordinate in post):
        raise ValueError(feature)
    return MeasuredPlace(
        feature=feature,
        aspect=math.radians(float(aspect)),
        slope=math.radians(float(slope)),
        posts=posts,
    )
