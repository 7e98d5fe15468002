"""Verdicts and anchors of a study as a drawing (DXF), in metres."""

from __future__ import annotations

import io
import math
import re
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from netdesign.words.catalogue import Language, render
from netdesign.words.message import say

if TYPE_CHECKING:
    from ezdxf.document import Drawing

    from netdesign.terrain.geojson import Feature

    Point = tuple[float, float, float]

_METRES = 6  # of $INSUNITS
_TEXT_HEIGHT = 0.25  # [m]
_AWAY = (0.2, 0.2, 0.0)  # of a label from its point [m]
_NO_NAME = re.compile(r'[<>/\\":;?*|=`,\x00-\x1f]')  # signs that no layer may have


def draw_verdicts(
    features: Iterable[Feature], shades: Mapping[str, str], language: Language
) -> bytes:
    """Drawing of rows, posts and anchors; a layer for each part and verdict.

    Parameters
    ----------
    features : iterable of dict
        As ``map_verdicts`` gives them.
    shades : mapping of str to str
        Red, green, blue of each verdict.
    language : str
        Of layers and labels.

    Returns
    -------
    bytes
        The same each time.
    """
    from ezdxf._options import options
    from ezdxf.filemanagement import new

    before = options.write_fixed_meta_data_for_testing  # no time, no name by chance
    options.write_fixed_meta_data_for_testing = True
    try:
        drawing, text = new("R2010", units=_METRES), io.StringIO()
        for one in features:
            _draw(drawing, one, shades, language)
        drawing.write(text)
        return drawing.encode(text.getvalue())
    finally:
        options.write_fixed_meta_data_for_testing = before


def _draw(
    drawing: Drawing, feature: Feature, shades: Mapping[str, str], language: Language
) -> None:
    """A row with its name; or a point with its label, and the axis of an anchor."""
    properties, places = feature["properties"], feature["geometry"]["coordinates"]
    layer = _find_layer(drawing, properties, shades, language)
    space, on_layer = drawing.modelspace(), {"layer": layer}
    if feature["geometry"]["type"] == "LineString":
        space.add_polyline3d(places, dxfattribs=on_layer)
        _add_label(drawing, places[0], layer, properties["id"])
        return
    space.add_point(places, dxfattribs=on_layer)
    name = f"{properties['row']}-{properties['post']}"
    _add_label(drawing, places, layer, f"{name} {_describe(properties)}")
    if properties.get("length_m"):
        space.add_line(places, _find_end(places, properties), dxfattribs=on_layer)


def _find_layer(
    drawing: Drawing,
    properties: Mapping[str, Any],
    shades: Mapping[str, str],
    language: Language,
) -> str:
    """Layer of a part and its verdict, in plain words."""
    from ezdxf.colors import rgb2int

    verdict = properties["verdict"]
    part = properties.get("part") or render(say("terrain.part_row"), language)
    word = render(say(f"verdict.{verdict}"), language)
    name = _NO_NAME.sub(" ", f"{part} - {word}")
    if name not in drawing.layers:
        red, green, blue, _ = map(int, shades[verdict].split(","))
        layer = drawing.layers.add(name)
        layer.dxf.true_color = rgb2int((red, green, blue))
    return name


def _describe(properties: Mapping[str, Any]) -> str:
    """Part, type and force of a label."""
    design = properties.get("design_kN")
    told = (
        properties["part"],
        properties.get("type"),
        None if design is None else f"{design:g} kN",
    )
    return ", ".join(one for one in told if one)


def _add_label(drawing: Drawing, place: Point, layer: str, text: str) -> None:
    """Text beside a point; a line break in it would end the entity."""
    plain = " ".join(str(text).split()).replace("%%", "% %")
    label = drawing.modelspace().add_text(
        plain, height=_TEXT_HEIGHT, dxfattribs={"layer": layer}
    )
    x, y, z = (a + b for a, b in zip(place, _AWAY, strict=True))
    label.set_placement((x, y, z))


def _find_end(head: Point, properties: Mapping[str, Any]) -> Point:
    """End of an anchor's axis, by the direction that the table tells."""
    azimuth = math.radians(properties["azimuth_deg"])
    dip, length = math.radians(properties["dip_deg"]), properties["length_m"]
    flat = length * math.cos(dip)
    return (
        head[0] + flat * math.sin(azimuth),
        head[1] + flat * math.cos(azimuth),
        head[2] - length * math.sin(dip),
    )
