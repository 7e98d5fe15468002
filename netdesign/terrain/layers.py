"""Layers of a shapefile or a GeoPackage as features of GeoJSON."""

from __future__ import annotations

import io
import math
import tempfile
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from netdesign.edge.causes import explain
from netdesign.edge.given_files import make_printable, read_bounded
from netdesign.outcome import TerrainError
from netdesign.terrain.crs import require_plane, require_same
from netdesign.terrain.cut_names import CutNames, read_cut_names
from netdesign.terrain.libraries import DAMAGE, keep_quiet, require_extra
from netdesign.terrain.wkb import decode_wkb, encode_wkb
from netdesign.words.message import Message, say

Feature = tuple[Message, Mapping[str, object]]

SHAPEFILE, GEOPACKAGE = ".shp", ".gpkg"
_MOST_BYTES = 20_000_000
_PARTS = (SHAPEFILE, ".shx", ".dbf")  # of a shapefile, and what may be beside it
_BESIDE = (".prj", ".cpg")
_SHAPES = b"\x00\x00\x27\x0a"  # what a shapefile begins with
_SQLITE, _NAMES = b"SQLite format 3\x00", (b"GPKG", b"GP10", b"GP11")
# The same bytes each time.
_TIME, _NO_TIME = "OGR_CURRENT_DATE", "2000-01-01T00:00:00.000Z"


@dataclass(frozen=True, slots=True, kw_only=True)
class Layers:
    """Features of a file.

    Attributes
    ----------
    features : list of tuple of Message and mapping
        Place and GeoJSON of each that has a geometry.
    crs : str
        Reference system, as ``EPSG:2056`` or as WKT; empty where nobody knows.
    faults, notes : tuple of Message
        Cut names that may stand for several columns, and those that were read.
    """

    features: list[Feature]
    crs: str
    faults: tuple[Message, ...]
    notes: tuple[Message, ...]


def read_layers(path: Path) -> Layers:
    """Read all layers with geometries.

    pyogrio sees bytes that were read here: no name is an address, no other file is
    opened, none is written.

    Raises
    ------
    TerrainError
        If the file cannot be read, or is not in metres on a plane.
    """
    require_extra(path.name)
    try:
        content, is_shapefile = _read_bytes(path), path.suffix.lower() == SHAPEFILE
    except (OSError, ValueError) as error:
        raise TerrainError(
            say("terrain.unreadable", file=path.name, cause=explain(error))
        ) from None
    try:
        return _list_layers(content, is_shapefile=is_shapefile)
    except TerrainError as error:
        told = error.message
    except DAMAGE:
        told = say("terrain.no_layers")
    raise TerrainError(say("text.at_place", place=path.name, text=told))


def _read_bytes(path: Path) -> bytes:
    """A GeoPackage, or the files of a shapefile packed as one."""
    if path.suffix.lower() == GEOPACKAGE:
        log = path.with_name(f"{path.name}-wal")
        if log.is_file() and log.stat().st_size:
            raise TerrainError(say("terrain.open_elsewhere", file=path.name))
        return _require_geopackage(read_bounded(path, _MOST_BYTES), path.name)
    beside = {one.suffix.lower(): one for one in path.parent.glob(f"{path.stem}.*")}
    beside[SHAPEFILE] = path
    files = {
        suffix: read_bounded(beside[suffix], _MOST_BYTES)
        for suffix in (*_PARTS, *_BESIDE)
        if suffix in beside
    }
    lacking = tuple(f"{path.stem}{one}" for one in _PARTS if one not in files)
    if lacking:
        raise TerrainError(say("terrain.beside", file=path.name, files=lacking))
    if not files[SHAPEFILE].startswith(_SHAPES):
        raise _refuse(path.name)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for suffix, content in files.items():
            archive.writestr(f"rows{suffix}", content)
    return packed.getvalue()


def _require_geopackage(content: bytes, name: str) -> bytes:
    """The same bytes, in the mode of SQLite that needs no file beside."""
    if not content.startswith(_SQLITE) or content[68:72] not in _NAMES:
        raise _refuse(name)
    return content[:18] + b"\x01\x01" + content[20:]


def _refuse(name: str) -> TerrainError:
    told = say("terrain.no_layers")
    return TerrainError(say("text.at_place", place=name, text=told))


def _list_layers(content: bytes, *, is_shapefile: bool) -> Layers:
    from pyogrio import list_layers

    features: list[Feature] = []
    crs, cut = "", CutNames()
    with keep_quiet():
        layers = [str(name) for name, kind in list_layers(content) if kind is not None]
        for layer in layers:
            meta, geometries, columns = _read_layer(content, layer, is_shapefile)
            own = require_plane(meta["crs"] or "")
            require_same(crs, own)
            crs = crs or own
            names = [str(one) for one in meta["fields"]]
            if is_shapefile:
                cut = read_cut_names(names)
                names = [cut.full.get(one, one) for one in names]
            place = "" if is_shapefile else make_printable(layer)[:60]
            features += _list_features(place, geometries, names, columns)
    return Layers(features=features, crs=crs, faults=cut.unclear, notes=cut.notes)


def _read_layer(
    content: bytes, layer: str, is_shapefile: bool
) -> tuple[dict[str, Any], Sequence[bytes | None], Sequence[Any]]:
    """Meta, geometries and columns; a shapefile that names no signs is tried in UTF-8.

    Text in another code is hardly ever UTF-8 by chance.
    """
    from pyogrio import raw

    if is_shapefile and not _has_code(content):
        try:
            meta, _, geometries, columns = raw.read(content, layer, encoding="UTF-8")
        except UnicodeDecodeError:
            pass
        else:
            return meta, geometries, columns
    meta, _, geometries, columns = raw.read(content, layer)
    return meta, geometries, columns


def _has_code(content: bytes) -> bool:
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return "rows.cpg" in archive.namelist()


def _list_features(
    layer: str,
    geometries: Sequence[bytes | None],
    names: Sequence[str],
    columns: Sequence[Any],
) -> Iterator[Feature]:
    """Features with lines or areas; a plan asks nothing of a point."""
    for number, wkb in enumerate(geometries, 1):
        geometry = _read_geometry(wkb)
        if geometry is None:
            continue
        place = say("terrain.feature", number=number)
        if layer:
            place = say("terrain.in_layer", layer=layer, feature=place)
        values = (_read_value(column[number - 1]) for column in columns)
        properties = dict(zip(names, values, strict=True))
        yield place, {"geometry": geometry, "properties": properties}


def _read_geometry(wkb: bytes | None) -> dict[str, Any] | None:
    """Geometry of GeoJSON; a line without points, which is a fault, where none is read.

    A damaged record comes without a geometry: left out, a row would be missing.
    """
    try:
        found = decode_wkb(wkb or b"")
    except ValueError:
        return {"type": "LineString"}
    return None if found["type"] in ("Point", "MultiPoint") else found


def _read_value(value: Any) -> object:
    """Plain value of a column; None of an empty cell."""
    plain = value.item() if hasattr(value, "item") else value
    is_empty = isinstance(plain, float) and math.isnan(plain)
    return None if is_empty else plain


def write_geopackage(features: Sequence[Mapping[str, Any]], crs: str) -> bytes:
    """GeoPackage of lines and points with heights: a layer of each ``kind``.

    Parameters
    ----------
    features : sequence of dict
        GeoJSON; those of a kind have one type of geometry.
    crs : str
        Reference system, as ``EPSG:2056`` or as WKT; empty where nobody knows.
    """
    import pyogrio

    system = require_plane(crs) or None
    kinds = dict.fromkeys(one["properties"]["kind"] for one in features)
    before = pyogrio.get_gdal_config_option(_TIME)
    pyogrio.set_gdal_config_options({_TIME: _NO_TIME})
    try:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "map.gpkg")
            for kind in kinds:
                own = [one for one in features if one["properties"]["kind"] == kind]
                _append_layer(path, kind.replace("_", " "), own, system)
            return path.read_bytes()
    finally:
        pyogrio.set_gdal_config_options({_TIME: before})


def _append_layer(
    path: Path, name: str, features: Sequence[Mapping[str, Any]], crs: str | None
) -> None:
    from pyogrio import raw

    shapes = _stack([encode_wkb(one["geometry"]) for one in features])
    names, columns, masks = _list_columns(features)
    with keep_quiet():  # a system may be unknown
        raw.write(
            *(path, shapes, columns, names, masks),
            layer=name,
            driver="GPKG",
            geometry_type=f"{features[0]['geometry']['type']} Z",
            crs=crs,
            append=path.exists(),
        )


def _list_columns(
    features: Sequence[Mapping[str, Any]],
) -> tuple[list[str], list[Any], list[Any]]:
    """Names, values and empty cells of the columns; a list stands as text."""
    names = list(dict.fromkeys(k for one in features for k in one["properties"]))
    columns, masks = [], []
    for name in names:
        values = [one["properties"].get(name) for one in features]
        if not all(one is None or isinstance(one, int | float) for one in values):
            values = [one if one is None else _write_text(one) for one in values]
            columns.append(_stack(values))
        else:
            columns.append(np.array([0.0 if one is None else one for one in values]))
        masks.append(np.array([one is None for one in values]))
    return names, columns, masks


def _write_text(value: object) -> str:
    return ", ".join(map(str, value)) if isinstance(value, list) else str(value)


def _stack(values: Sequence[object]) -> Any:
    found = np.empty(len(values), dtype=object)
    found[:] = values
    return found
