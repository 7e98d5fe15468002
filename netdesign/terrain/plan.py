"""Net rows as lines on a map: GeoJSON in the coordinates of the grid."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from netdesign.edge.causes import explain
from netdesign.edge.given_files import decode_utf8, list_faults, read_bounded
from netdesign.numerics.arrays import Floats
from netdesign.outcome import TerrainError
from netdesign.site.columns.all_tables import NETS
from netdesign.site.columns.fields import convert_unit, normalise_unit, split_heading
from netdesign.site.columns.lexicon import Lexicon
from netdesign.terrain.crossings import crosses_itself
from netdesign.terrain.crs import read_member
from netdesign.terrain.layers import GEOPACKAGE, SHAPEFILE, Feature, read_layers
from netdesign.words.message import Message, say

MOST_BYTES = 20_000_000
ZONE = "starting zone"
CLOSED = 2.0 + 1e-6  # a gap between two rows up to it holds as they do [m]
_OPEN = ("id", "post_spacing", "net_height")  # that the terrain cannot be asked


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
        Columns of sheet Nets that its properties give, in their first units.
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
    zones : tuple of ndarray, shape (n, 2)
        Outer rings of the starting zones [m].
    crs : str
        Reference system, as ``EPSG:2056`` or as WKT; empty where nobody knows.
    notes : tuple of Message
        What the reader of the file has to be told.
    closed_gaps : tuple of ClosedGap
        Between its rows.
    """

    lines: tuple[NetLine, ...]
    zones: tuple[Floats, ...] = ()
    crs: str = ""
    notes: tuple[Message, ...] = ()
    closed_gaps: tuple[ClosedGap, ...] = field(init=False)

    def __post_init__(self) -> None:
        """Find the gaps once: each line of fall is held against them."""
        object.__setattr__(self, "closed_gaps", tuple(_list_closed_gaps(self.lines)))

    def cut_to(self, places: Floats) -> Plan:
        """Plan with the rows alone that the rectangle around places may meet.

        Parameters
        ----------
        places : ndarray, shape (..., 2)
            [m]; NaN does not count.
        """
        known = places[np.isfinite(places).all(axis=-1)]
        low, high = known.min(axis=0) - CLOSED, known.max(axis=0) + CLOSED
        near = (
            one
            for one in self.lines
            if (one.points.max(axis=0) >= low).all()
            and (one.points.min(axis=0) <= high).all()
        )
        return replace(self, lines=tuple(near))


def _list_closed_gaps(lines: Sequence[NetLine]) -> Iterator[ClosedGap]:
    """Gaps between two rows that hold the snow as the rows do."""
    ends = [(one, end) for one in lines for end in (0, -1)]
    places = np.array([one.points[end] for one, end in ends]).reshape(-1, 2)
    apart = np.hypot(*(places[:, None] - places[None]).transpose(2, 0, 1))
    for k, other_k in np.argwhere(np.triu(apart <= CLOSED, 1)):
        (one, end), (other, of_other) = ends[k], ends[other_k]
        if one is not other:
            yield ClosedGap(
                rows=(one.id, other.id),
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
    if path.suffix.lower() in (SHAPEFILE, GEOPACKAGE):
        layers = read_layers(path)
        plan = _build_plan(layers.features, path.name, list(layers.faults))
        return replace(plan, crs=layers.crs, notes=layers.notes)
    text = read_text(path)
    try:
        document = json.loads(text, parse_constant=_refuse_constant)
    except (ValueError, RecursionError):
        raise TerrainError(say("terrain.no_json", file=path.name)) from None
    return parse_plan(document, path.name)


def read_text(path: Path) -> str:
    """Text of a GeoJSON file.

    Raises
    ------
    TerrainError
        If it cannot be read.
    """
    try:
        return decode_utf8(read_bounded(path, MOST_BYTES))
    except (OSError, ValueError) as error:
        raise TerrainError(
            say("terrain.unreadable", file=path.name, cause=explain(error))
        ) from None


def _refuse_constant(text: str) -> float:
    raise ValueError(text)


def parse_plan(document: object, file: str) -> Plan:
    """Rows and zones of a GeoJSON document.

    Raises
    ------
    TerrainError
        With all faults at once.
    """
    faults: list[Message] = []
    plan = _build_plan(_list_features(document, faults), file, faults)
    return replace(plan, crs=read_member(document))


def _build_plan(features: Iterable[Feature], file: str, faults: list[Message]) -> Plan:
    """Rows and zones of some features, each with its place."""
    lines: list[NetLine] = []
    zones: list[Floats] = []
    for place, feature in features:
        kind, parts = _read_geometry(feature, place, faults)
        properties = feature.get("properties")
        given = properties if isinstance(properties, Mapping) else {}
        if kind == "line":
            line = _read_line(parts[0], given, place, faults)
            lines += [line] if line else []
        elif kind == "zone" and given.get("kind") == ZONE:
            zones += parts
            if any(crosses_itself(one) for one in parts):
                crosses = say("terrain.zone_crosses")
                faults.append(say("text.at_place", place=place, text=crosses))
    names = Counter(one.id for one in lines)
    faults += [say("terrain.twice", row=one) for one, n in names.items() if n > 1]
    if not lines and not faults:
        faults.append(say("terrain.no_rows"))
    if faults:
        told = [say("text.at_place", place=file, text=one) for one in faults]
        raise TerrainError(list_faults(told))
    return Plan(lines=tuple(lines), zones=tuple(zones))


def _list_features(document: object, faults: list[Message]) -> Iterator[Feature]:
    features = document.get("features") if isinstance(document, Mapping) else None
    if not isinstance(features, Sequence) or isinstance(features, str):
        faults.append(say("terrain.no_features"))
        return
    for number, feature in enumerate(features, 1):
        place = say("terrain.feature", number=number)
        if isinstance(feature, Mapping):
            yield place, feature
        else:
            faults.append(say("text.at_place", place=place, text=say("terrain.shape")))


def _read_geometry(
    feature: Mapping[str, object], place: Message, faults: list[Message]
) -> tuple[str, list[Floats]]:
    """Kind of a feature that counts here, and its points; "" of any other one."""
    geometry = feature.get("geometry")
    given = geometry if isinstance(geometry, Mapping) else {}
    kind, points = given.get("type"), given.get("coordinates")
    if kind == "MultiLineString" and isinstance(points, Sequence) and len(points) > 1:
        told = say("terrain.parts", count=len(points))
        faults.append(say("text.at_place", place=place, text=told))
        return "", []
    if kind == "MultiLineString":
        found, least, named = [_read_points(_first(points))], 2, "line"
    elif kind == "LineString":
        found, least, named = [_read_points(points)], 2, "line"
    elif kind == "Polygon":
        found, least, named = [_read_points(_first(points))], 4, "zone"
    elif kind == "MultiPolygon" and isinstance(points, Sequence):
        found, least, named = [_read_points(_first(one)) for one in points], 4, "zone"
    else:
        return "", []
    if named == "zone" and _has_hole(kind, points):
        faults.append(say("text.at_place", place=place, text=say("terrain.zone_hole")))
        return "", []
    known = [one for one in found if one is not None and len(one) >= least]
    if len(known) < len(found) or not found:
        faults.append(say("text.at_place", place=place, text=say("terrain.points")))
        return "", []
    return named, known


def _has_hole(kind: object, points: object) -> bool:
    polygons = points if kind == "MultiPolygon" else [points]
    return isinstance(polygons, Sequence) and any(
        isinstance(one, Sequence) and len(one) > 1 for one in polygons
    )


def _first(rings: object) -> object:
    is_list = isinstance(rings, Sequence) and len(rings) > 0
    return rings[0] if is_list and isinstance(rings, Sequence) else None


def _read_points(points: object) -> Floats | None:
    """Points that are finite numbers, each once; None of anything else."""
    if not isinstance(points, Sequence) or isinstance(points, str):
        return None
    try:
        found = np.array([(float(one[0]), float(one[1])) for one in points])
    except (TypeError, ValueError, IndexError, KeyError, OverflowError):
        return None
    if found.size == 0 or not (np.abs(found) < 1e8).all():
        return None
    moves = np.ones(len(found), dtype=bool)
    moves[1:] = (np.diff(found, axis=0) != 0.0).any(axis=1)
    return found[moves]


def _read_line(
    points: Floats,
    properties: Mapping[str, object],
    place: Message,
    faults: list[Message],
) -> NetLine | None:
    cells: dict[str, float | str] = {}
    lexicon, count = Lexicon.of(NETS.fields, NETS), len(faults)
    for heading, value in properties.items():
        meaning = lexicon.match(str(heading))
        field = meaning.field
        if meaning.is_unclear:
            readings = tuple(one.name for one in meaning.readings)
            told = say("terrain.unclear", name=f"{heading!r:.60}", readings=readings)
            faults.append(say("text.at_place", place=place, text=told))
        if field is None or value is None:
            continue
        found = _read_value(str(heading), value, field.unit)
        if found is None or field.key in cells:
            told = say("terrain.property", name=f"{heading!r:.60}")
            faults.append(say("text.at_place", place=place, text=told))
        else:
            cells[field.key] = found
    for key in _OPEN:
        is_number = isinstance(cells.get(key), float) and float(cells[key]) > 0.0
        if not (cells.get(key) if key == "id" else is_number):
            told = say("terrain.no_property", name=say(f"column.Nets.{key}"))
            faults.append(say("text.at_place", place=place, text=told))
    if len(faults) > count:
        return None
    name = cells["id"]
    return NetLine(
        id=f"{name:g}" if isinstance(name, float) else name, points=points, cells=cells
    )


def _read_value(heading: str, value: object, unit: str) -> float | str | None:
    """Number in the column's first unit, or words; None of what is neither."""
    if isinstance(value, str):
        return value.strip() or None
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    own = normalise_unit(split_heading(heading)[1])
    if not math.isfinite(value):
        return None
    try:
        return convert_unit(float(value), own, unit) if own and unit else float(value)
    except KeyError:
        return None
