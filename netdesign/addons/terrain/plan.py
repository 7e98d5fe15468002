"""Net rows as lines on a map, in the coordinates of the grid."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import shapely

from netdesign.addons.terrain.grid import (
    DAMAGE,
    keep_quiet,
    read_file,
    require_plane,
    require_same,
)
from netdesign.edge.input_files import make_printable
from netdesign.numerics.arrays import Floats
from netdesign.outcome import TerrainError
from netdesign.site.columns.fields import (
    convert_unit,
    normalise,
    split_heading,
)
from netdesign.site.columns.office import list_choices
from netdesign.site.lists.targets import Target, list_targets

# Of a column with several measures a key for each.
_MEASURED = {
    "snow.vertical": "snow_height",
    "snow.normal": "snow_thickness",
    "slack.slack": "slack",
    "slack.sag": "sag",
}


Cells = dict[str, float | str]  # by column, in its first unit


def read_typed_cells(
    properties: Mapping[str, object], faults: list[str], unread: dict[str, None]
) -> Cells:
    """Cells of a line of sheet Rows, and of its net type, from values by headings.

    Parameters
    ----------
    properties : mapping of str to object
        Headings in any language, perhaps with a unit; None of an empty cell.
    faults : list of str
        Gets what is given twice, or not understood.
    unread : dict
        Gets the names that are no columns.
    """
    cells: Cells = {}
    for heading, value in properties.items():
        if value is None or value == "":
            continue
        bracket = split_heading(heading)[1]
        unit, measure = list_choices().get(normalise(bracket), (bracket, ""))
        targets = _find_targets(heading, measure)
        if len(targets) > 1:
            readings = ", ".join(target.title("en") for target in targets)
            fault = f"property {heading!r:.60} may mean: {readings}"
            faults.append(f"{fault}; name it as the workbook does")
        elif not targets:
            unread[f"{heading!r:.60}"] = None
        else:
            (target,) = targets
            key = _MEASURED.get(target.name, target.name)
            converted = _convert(value, unit, target.field.unit)
            if converted is None or key in cells:
                fault = f"property {heading!r:.60} is given twice, or its value or unit"
                faults.append(f"{fault} is not understood")
            else:
                cells[key] = converted
    return cells


def _find_targets(heading: str, measure: str) -> list[Target]:
    """Columns of rows and net types that have the name."""
    names = {normalise(heading), split_heading(heading)[0]}
    return [
        target
        for target in list_targets("rows")
        if not names.isdisjoint(target.field.names)
        and (not measure or target.measure == measure)
    ]


def _convert(value: object, own: str, unit: str) -> float | str | None:
    """Number in the column's first unit, or a text; None for any other value."""
    if isinstance(value, str):
        return value.strip() or None
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    if not math.isfinite(value):
        return None
    try:
        return convert_unit(float(value), own, unit) if own and unit else float(value)
    except KeyError:
        return None


ZONE = "starting zone"
_MOST_BYTES = 20_000_000
_CLOSED = 2.0 + 1e-6  # a gap between two rows up to it holds as they do [m]
_FARTHEST = 1e8  # of a coordinate [m]
# That the terrain cannot be asked, and what a refusal calls it.
_OPEN = {"id": "id", "net_height": "net height", "post_spacing": "post spacing"}
# What a file begins with, by the end of its name; all others are GeoJSON.
_STARTS = {".shp": b"\x00\x00\x27\x0a", ".gpkg": b"SQLite format 3\x00"}
_GEOJSON = "GeoJSON:"  # before a name: read so, or not at all


@dataclass(frozen=True, slots=True, kw_only=True)
class NetLine:
    """One net row as it is drawn.

    Attributes
    ----------
    id : str
        Its name.
    points : ndarray, shape (n, 2)
        Feet of the net along the row, east and north [m].
    cells : mapping of str to float or str
        Columns that its properties give, in their first units.
    """

    id: str
    points: Floats
    cells: Mapping[str, float | str]

    @property
    def net_height(self) -> float:
        """D_K, normal to the slope [m]."""
        return float(self.cells["net_height"])

    @property
    def post_spacing(self) -> float:
        """Along the row [m]."""
        return float(self.cells["post_spacing"])


@dataclass(frozen=True, slots=True, kw_only=True)
class ClosedGap:
    """A gap so narrow that the two rows beside it hold what lies above it.

    Attributes
    ----------
    rows : tuple of str
        Their names.
    ends : tuple of int
        Of each row's points: 0 the first, -1 the last.
    points : ndarray, shape (2, 2)
        Where the gap begins and ends [m].
    """

    rows: tuple[str, str]
    ends: tuple[int, int]
    points: Floats


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """Rows and starting zones of a file.

    Attributes
    ----------
    lines : tuple of NetLine
        In the order of the file.
    zones : tuple of Polygon
        Starting zones [m].
    crs : str
        Reference system, as ``EPSG:2056`` or as WKT; empty where not known.
    unread : tuple of str
        Properties of rows that are no columns of theirs.
    closed_gaps : tuple of ClosedGap
        Between its rows.
    """

    lines: tuple[NetLine, ...]
    zones: tuple[shapely.Polygon, ...] = ()
    crs: str = ""
    unread: tuple[str, ...] = ()
    closed_gaps: tuple[ClosedGap, ...] = field(init=False)

    def __post_init__(self) -> None:
        """Find the gaps once: each line of fall is held against them."""
        object.__setattr__(self, "closed_gaps", tuple(_list_closed_gaps(self.lines)))


def _list_closed_gaps(lines: Sequence[NetLine]) -> Iterator[ClosedGap]:
    """Gaps between two rows that hold the snow as the rows do."""
    ends = [(line, end) for line in lines for end in (0, -1)]
    places = np.array([line.points[end] for line, end in ends]).reshape(-1, 2)
    apart = np.hypot(*(places[:, None] - places[None]).transpose(2, 0, 1))
    for k, other_k in np.argwhere(np.triu(apart <= _CLOSED, 1)):
        (line, end), (other, of_other) = ends[k], ends[other_k]
        if line is not other:
            yield ClosedGap(
                rows=(line.id, other.id),
                ends=(end, of_other),
                points=places[[k, other_k]],
            )


def read_plan(path: Path) -> Plan:
    """Read rows and zones from GeoJSON, a shapefile or a GeoPackage.

    Raises
    ------
    TerrainError
        With all faults of the file at once.
    """
    start = _STARTS.get(path.suffix.lower())
    content = read_file(path, _MOST_BYTES)
    try:
        if start and not content.startswith(start):
            raise ValueError(path)
        with keep_quiet():
            source = f"{'' if start else _GEOJSON}{path.absolute()}"
            features, crs = _list_features(source)
    except TerrainError as error:
        raise TerrainError(f"{path.name}: {error}") from None
    except DAMAGE:
        reason = "no GeoJSON, shapefile (.shp) or GeoPackage (.gpkg), or damaged"
        raise TerrainError(f"{path.name}: {reason}") from None
    faults: list[str] = []
    plan = _build_plan(features, crs, faults)
    if faults:
        raise TerrainError("\n".join(f"{path.name}: {fault}" for fault in faults))
    return plan


@dataclass(frozen=True, slots=True)
class _Feature:
    """A line of a layer: its place in the file, its shape and its properties."""

    place: str
    shape: Any
    properties: Mapping[str, object]

    @property
    def name(self) -> str:
        """Its place, and its id where it has one."""
        row_id = make_printable(str(self.properties.get("id") or ""))[:60]
        return f"{self.place} ({row_id})" if row_id else self.place


def _list_features(source: str) -> tuple[list[_Feature], str]:
    """Features of all layers that have geometries, and their reference system."""
    from pyogrio import list_layers, raw

    features: list[_Feature] = []
    crs = ""
    layers = [str(name) for name, kind in list_layers(source) if kind is not None]
    for layer in layers:
        meta, _, content, columns = raw.read(source, layer)
        shapes = shapely.from_wkb(list(content), on_invalid="ignore")
        shapes = shapely.force_2d(shapes)
        own = _find_system(source, meta["crs"] or "", shapes)
        require_same(crs, own)
        crs = crs or own
        place = f"layer {make_printable(layer)[:60]}, " if len(layers) > 1 else ""
        for number, shape in enumerate(shapes):
            values = (_take(column[number]) for column in columns)
            properties = dict(zip(map(str, meta["fields"]), values, strict=True))
            features.append(_Feature(f"{place}feature {number + 1}", shape, properties))
    return features, crs


def _find_system(source: str, crs: str, shapes: Any) -> str:
    """System of a layer; GDAL gives degrees to GeoJSON that names none."""
    ends = shapely.total_bounds(shapes)
    if source.startswith(_GEOJSON) and crs == "EPSG:4326":
        is_far = not (np.abs(ends) <= (180.0, 90.0, 180.0, 90.0)).all()
        return "" if is_far else require_plane(crs)
    return require_plane(crs)


def _take(value: Any) -> object:
    """Plain value of a cell; None of an empty one, which is NaN in a column."""
    plain = value.item() if hasattr(value, "item") else value
    return None if plain != plain else plain


def _build_plan(features: Sequence[_Feature], crs: str, faults: list[str]) -> Plan:
    lines: list[NetLine] = []
    zones: list[shapely.Polygon] = []
    unread: dict[str, None] = {}
    for feature in features:
        try:
            if feature.properties.get("kind") == ZONE:
                zones += _read_zones(feature.shape)
                continue
            line = _read_line(feature, unread)
            lines += [line] if line else []
        except TerrainError as error:
            faults += [f"{feature.name}: {fault}" for fault in str(error).split("\n")]
    names = Counter(line.id for line in lines)
    faults += [f"two rows are named {name}" for name, n in names.items() if n > 1]
    if not lines and not faults:
        faults.append("no line with the properties of a net row")
    return Plan(lines=tuple(lines), zones=tuple(zones), crs=crs, unread=tuple(unread))


def _read_zones(shape: Any) -> list[shapely.Polygon]:
    """Polygons of a starting zone."""
    zones = list(shapely.get_parts(shape)) if shape is not None else []
    if not zones or not all(isinstance(zone, shapely.Polygon) for zone in zones):
        raise TerrainError("a starting zone is a polygon of finite coordinates")
    _require_finite(shape)
    if any(zone.interiors for zone in zones):
        raise TerrainError("a starting zone with a hole: draw zones without holes")
    if not all(zone.is_valid for zone in zones):
        refusal = "the outline of a starting zone crosses itself: draw its corners one"
        raise TerrainError(f"{refusal} after the other")
    return zones


def _require_finite(shape: Any) -> None:
    if not (np.abs(shapely.get_coordinates(shape)) < _FARTHEST).all():
        raise TerrainError("its coordinates are no finite numbers")


def _read_line(feature: _Feature, unread: dict[str, None]) -> NetLine | None:
    """Net row of a feature; None of a point or an area that is none."""
    faults, names = list[str](), dict[str, None]()
    cells = read_typed_cells(feature.properties, faults, names)
    parts = shapely.get_parts(feature.shape).tolist() if feature.shape else []
    is_line = bool(parts) and all(
        isinstance(part, shapely.LineString) for part in parts
    )
    if not is_line:
        if feature.shape is not None and len(_OPEN.keys() & cells) < len(_OPEN):
            return None
        raise TerrainError("a net row without a line that can be read: draw it")
    if len(parts) > 1:
        fault = "lines in one feature: draw a feature for each row"
        raise TerrainError(f"{len(parts)} {fault}")
    _require_finite(feature.shape)
    for key, name in _OPEN.items():
        value = cells.get(key)
        if not value or (key != "id" and not (isinstance(value, float) and value > 0)):
            fault = f"the property {name!r} is missing, or is no number above 0"
            faults.append(f"{fault}; names in a shapefile end after ten letters")
    if faults:
        raise TerrainError("\n".join(faults))
    unread |= names
    points = shapely.get_coordinates(shapely.remove_repeated_points(feature.shape))
    id_cell = cells["id"]
    name = f"{id_cell:.15g}" if isinstance(id_cell, float) else id_cell
    return NetLine(id=name, points=points, cells=cells)
