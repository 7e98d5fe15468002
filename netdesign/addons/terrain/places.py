"""Net rows in plan, from the ``rows.geojson`` that ``netdesign terrain`` wrote."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from netdesign.edge.causes import explain
from netdesign.edge.given_files import decode_utf8, read_bounded
from netdesign.outcome import TerrainError
from netdesign.words.message import say

Feature = dict[str, Any]
_MOST_BYTES = 20_000_000


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
