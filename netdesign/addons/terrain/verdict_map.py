"""Verdicts and anchors of a study on the map, in any of its formats; setting out."""

from __future__ import annotations

import csv
import io
import json
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any
from xml.etree.ElementTree import Element, SubElement, tostring

import numpy as np

from netdesign.addons.terrain.geojson import Feature, MeasuredPlace
from netdesign.checks import Standard
from netdesign.checks.check import Check
from netdesign.checks.schema import ACCEPTANCE_TEST
from netdesign.outcome import StudyError, merge_verdicts
from netdesign.site.model import NetRow, Site
from netdesign.structure.layout import SupportPoints
from netdesign.structure.members import Member
from netdesign.structure.row_position import Bore, Position
from netdesign.study.anchor_ground import place_anchors, place_end_anchors
from netdesign.study.load_along_row import place_row
from netdesign.study.records import RowStudy, Study
from netdesign.words.catalogue import Language, name_check, name_member, render
from netdesign.words.message import say

if TYPE_CHECKING:
    from ezdxf.document import Drawing

    Point = tuple[float, float, float]

SETTING_OUT = (
    *("row", "post", "part", "support", "type", "east_m", "north_m", "height_m"),
    *("azimuth_deg", "dip_deg", "length_m", "design_kN", "proof_kN", "verdict"),
)
FORMATS = (".geojson", ".dxf")
# Whose check gives force and verdict: of an anchor between two posts the one nearer to
# the row's end.
_SUPPORTS: Mapping[Position, str] = {
    "edge": "end",
    "second": "second",
    "intermediate": "inside",
}
_SHADES = {
    "pass": "44,122,75,255",
    "fail": "178,48,30,255",
    "not_proven": "214,150,20,255",
    "declared": "70,95,160,255",
}


def map_verdicts(
    study: Study,
    site: Site,
    standard: Standard,
    places: Mapping[str, MeasuredPlace],
    language: Language,
) -> list[Feature]:
    """Rows, posts and anchors of a study, with their verdicts.

    Parameters
    ----------
    study, site : Study and Site
        Of one workbook.
    standard : Standard
        Profile of the study, for the loads of acceptance tests.
    places : mapping of str to MeasuredPlace
        Rows by their names.
    language : str
        Of the names of checks and parts.

    Raises
    ------
    StudyError
        If it is a what-if, or a row of the study has no place.
    """
    if study.what_if:
        raise StudyError(
            "the study is a what-if, not the site: check the workbook as it is"
        )
    by_id = {row.id: row for row in site.rows}
    missing = [row.id for row in study.rows if row.id not in places]
    if missing:
        raise StudyError(f"not on the map: {', '.join(missing)}")
    features = []
    for row in study.rows:
        place, net_row = places[row.id], by_id[row.id]
        points = place_row(net_row, _find_inclination(row))
        features.append(_map_row(row, place, language))
        features += _map_posts(row, points, place)
        features += _map_anchors(row, net_row, points, standard, place, language)
    return features


def _map_row(row: RowStudy, place: MeasuredPlace, language: Language) -> Feature:
    rated = [check for check in row.checks if check.utilisation is not None]
    worst = max(rated, key=lambda check: check.utilisation or 0.0, default=None)
    verdict: dict[str, Any] = {"verdict": row.verdict.value}
    if worst is not None:
        title = name_check(worst.member, worst.mode, worst.position)
        verdict["governing_check"] = render(title, language)
        verdict["utilisation"] = round(worst.utilisation or 0.0, 3)
    properties = {**place.feature["properties"], **verdict}
    return {**place.feature, "properties": properties}


def _map_posts(
    row: RowStudy, points: SupportPoints, place: MeasuredPlace
) -> Iterator[Feature]:
    """Feet of the net and of the posts, with the verdict of each support."""
    last = len(place.posts)
    for number in range(1, last + 1):
        position = _find_position(number, last + 1 - number)
        checks = list_checks_at(row, position)
        verdict = merge_verdicts(check.verdict for check in checks).value
        for kind, part, x in (
            ("net_foot", "Foot of the net", 0.0),
            ("post", "Base of the post", points.post_base[0]),
        ):
            bore = Bore(start=(x, 0.0, 0.0), direction=(0.0, -1.0, 0.0), length=None)
            head, _, _ = turn_to_map(bore, place, number)
            yield _point(
                head,
                {
                    "kind": kind,
                    "row": row.id,
                    "post": number,
                    "part": part,
                    "support": _SUPPORTS[position],
                    "verdict": verdict,
                },
            )


def _find_position(*counts: int) -> Position:
    """Support by its count from either end of the row, 1 for the last one."""
    nearest = min(counts)
    if nearest > 2:
        return "intermediate"
    return "second" if nearest == 2 else "edge"


def list_checks_at(row: RowStudy, position: Position) -> list[Check]:
    """Checks of the members of a support.

    The study leaves one of the second support out where the one inside says as much, or
    the one of the end, of the same type, more: the larger of these then.

    Parameters
    ----------
    row : RowStudy
        Of any study.
    position : str
        "edge", "second" or "intermediate"; a row without an end has the last alone.

    Verified by
    -----------
    tests/addons/terrain/test_verdict_map.py
    """
    inside, second, at_end = (
        {
            (check.member, check.mode): check
            for check in row.checks
            if check.position == place
        }
        for place in ("intermediate", "second", "edge")
    )
    if position == "edge":
        return [*(at_end or inside).values()]
    if position == "intermediate":
        return [*inside.values()]
    larger = {
        name: _take_more(check, at_end.get(name)) for name, check in inside.items()
    }
    return [*(larger | second).values()]


def _take_more(inside: Check, at_end: Check | None) -> Check:
    """Check at the end if it has the same type and a larger force, else that inside."""
    if at_end is None or at_end.resistance_type != inside.resistance_type:
        return inside
    loads = [check.read_band("E_d")[1] or 0.0 for check in (inside, at_end)]
    return at_end if loads[1] > loads[0] else inside


def _map_anchors(
    row: RowStudy,
    net_row: NetRow,
    points: SupportPoints,
    standard: Standard,
    place: MeasuredPlace,
    language: Language,
) -> Iterator[Feature]:
    """Heads of all anchors of a row, with direction and design force."""
    inner = list(place_anchors(net_row, points, row.pulls))
    outer = list(place_end_anchors(net_row, points, row.pulls))
    last = len(place.posts)
    for number in range(1, last + 1):
        inside = (anchor for anchor in inner if not _is_beyond(*anchor, number, last))
        at_end = [*outer] if number == 1 else []
        if number == last:  # there the bay after the post is outside, too
            mirrored = ((part, _mirror(bore)) for part, bore in outer)
            at_end = [anchor for anchor in mirrored if anchor[0] not in tuple(Member)]
        for part, bore in (*inside, *at_end):
            is_of_bay = _is_of_bay(net_row, part, bore)
            position = _find_position(number, last - number + (not is_of_bay))
            yield _map_anchor(
                row, standard, place, language, number, (part, bore), position
            )


def _is_of_bay(row: NetRow, part: str, bore: Bore) -> bool:
    """An anchor of the bay behind a post: in mid-panel, or of two posts' guys."""
    is_shared = part == Member.FOOT_ANCHOR or bool(row.guys.are_shared)
    return is_shared and bore.start[2] > 0.0


def _is_beyond(part: str, bore: Bore, number: int, last: int) -> bool:
    """A foot anchor in mid-panel behind the last post, where no panel is."""
    is_mid = part == Member.FOOT_ANCHOR and bore.start[2] != 0.0
    return is_mid and number == last


def _mirror(bore: Bore) -> Bore:
    """Bore mirrored to the other end of the row."""
    x, y, z = bore.start
    along, out, aside = bore.direction
    return replace(bore, start=(x, y, -z), direction=(along, out, -aside))


def _map_anchor(
    row: RowStudy,
    standard: Standard,
    place: MeasuredPlace,
    language: Language,
    number: int,
    anchor: tuple[str, Bore],
    position: Position,
) -> Feature:
    part, bore = anchor
    checks = [check for check in list_checks_at(row, position) if check.member == part]
    forces = [check.read_band("E_d")[1] for check in checks if check.mode == "pull_out"]
    design = max((force for force in forces if force is not None), default=None)
    factor = standard.find(ACCEPTANCE_TEST)
    proof = None if design is None or factor is None else factor.value * design
    types = [check.resistance_type for check in checks if check.resistance_type]
    head, azimuth, dip = turn_to_map(bore, place, number)
    return _point(
        head,
        {
            "kind": "anchor",
            "row": row.id,
            "post": number,
            "part": render(name_member(part), language),
            "support": _SUPPORTS[position],
            "type": types[0] if types else "",
            "azimuth_deg": round(azimuth, 1),
            "dip_deg": round(dip, 1),
            "is_rising": dip < 0.0,
            "length_m": bore.length,
            "design_kN": None if design is None else round(design, 1),
            "proof_kN": None if proof is None else round(proof, 1),
            "verdict": merge_verdicts(check.verdict for check in checks).value,
        },
    )


def _find_inclination(row: RowStudy) -> float:
    """Inclination of the net in the middle of the cases [rad]."""
    inclinations = [math.radians(case.case.inclination_deg) for case in row.cases]
    return (
        0.5 * (min(inclinations) + max(inclinations))
        if inclinations
        else math.radians(30.0)
    )


def turn_to_map(
    bore: Bore, place: MeasuredPlace, number: int
) -> tuple[Sequence[float], float, float]:
    """Head of an anchor on the map [m], its azimuth and dip below horizontal [deg].

    Parameters
    ----------
    bore : Bore
        In the axes of the slope at the net's foot of a post.
    place : MeasuredPlace
        The row.
    number : int
        Of the post, from 1 on.

    Verified by
    -----------
    tests/addons/terrain/test_verdict_map.py
    """
    posts = np.array(place.posts)
    end = min(number, len(posts) - 1)  # of the bay after a post; the last has none
    along = posts[end] - posts[end - 1]
    down = np.array((math.sin(place.aspect), math.cos(place.aspect)))
    cosine, sine = math.cos(place.slope), math.sin(place.slope)
    axes = np.array(
        ((*down * cosine, -sine), (*down * sine, cosine), along / np.linalg.norm(along))
    )
    head, way = np.array((bore.start, bore.direction)) @ axes
    azimuth = math.degrees(math.atan2(way[0], way[1])) % 360.0
    dip = math.degrees(math.asin(max(-1.0, min(1.0, -way[2]))))
    return (posts[number - 1] + head).tolist(), azimuth, dip


def _point(place: Sequence[float], properties: dict[str, Any]) -> Feature:
    coordinates = [round(coordinate, 3) for coordinate in place]
    geometry = {"type": "Point", "coordinates": coordinates}
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def write_verdicts(
    document: Mapping[str, Any], name: str, language: Language
) -> dict[str, bytes]:
    """Contents by file: the map, its style for QGIS, setting-out table.

    Parameters
    ----------
    document : mapping
        GeoJSON with the features that ``map_verdicts`` gives.
    name : str
        Of the map; its end tells the format.
    language : str
        Of the layers of a drawing.
    """
    stem, _, end = name.rpartition(".")
    features: Sequence[Feature] = document["features"]
    table = {f"{stem}-setting-out.csv": _write_setting_out(features).encode()}
    if end.lower() == "dxf":
        return {name: _draw_all(features, language)} | table
    text = json.dumps(document, indent=1, allow_nan=False, ensure_ascii=False)
    return {name: text.encode(), f"{stem}.qml": _write_style().encode()} | table


def _write_setting_out(features: Sequence[Feature]) -> str:
    """Posts and anchor heads, a line each."""
    text = io.StringIO()
    table = csv.DictWriter(
        text, SETTING_OUT, extrasaction="ignore", lineterminator="\n"
    )
    table.writeheader()
    for feature in features:
        properties = feature["properties"]
        if properties["kind"] != "net row":
            east, north, height = feature["geometry"]["coordinates"]
            place = {"east_m": east, "north_m": north, "height_m": height}
            table.writerow({**properties, **place})
    return text.getvalue()


def _write_style() -> str:
    """Rules of QGIS that colour lines and points by their verdict."""
    style = Element("qgis", version="3.0", styleCategories="Symbology")
    renderer = SubElement(style, "renderer-v2", type="RuleRenderer")
    rules = SubElement(renderer, "rules", key="verdicts")
    symbols = SubElement(renderer, "symbols")
    for place, (verdict, colour) in enumerate(_SHADES.items()):
        names = {"key": verdict, "symbol": str(place), "label": verdict}
        SubElement(rules, "rule", names, filter=f"\"verdict\" = '{verdict}'")
        symbol = SubElement(symbols, "symbol", type="line", name=str(place))
        layer = SubElement(symbol, "layer", {"class": "SimpleLine"})
        SubElement(layer, "prop", k="line_color", v=colour)
        SubElement(layer, "prop", k="line_width", v="1")
    kind = "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>"
    return f"{kind}\n{tostring(style, encoding='unicode')}\n"


_METRES = 6  # of $INSUNITS
_TEXT_HEIGHT = 0.25  # [m]
_AWAY = (0.2, 0.2, 0.0)  # of a label from its point [m]
_NO_NAME = re.compile(r'[<>/\\":;?*|=`,\x00-\x1f]')  # signs that no layer may have


def _draw_all(features: Iterable[Feature], language: Language) -> bytes:
    """Drawing of rows, posts and anchors; a layer for each part and verdict.

    It has the same bytes each time.
    """
    import ezdxf

    # no time, no name by chance
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        drawing, text = ezdxf.new("R2010", units=_METRES), io.StringIO()
        for feature in features:
            _draw(drawing, feature, language)
        drawing.write(text)
        return drawing.encode(text.getvalue())
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


def _draw(drawing: Drawing, feature: Feature, language: Language) -> None:
    """A row with its name; or a point with its label, and the axis of an anchor."""
    properties, places = feature["properties"], feature["geometry"]["coordinates"]
    layer = _find_layer(drawing, properties, language)
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
    drawing: Drawing, properties: Mapping[str, Any], language: Language
) -> str:
    """Layer of a part and its verdict, in plain words."""
    from ezdxf.colors import rgb2int

    verdict = properties["verdict"]
    part = properties.get("part", "Net row")
    word = render(say(f"verdict.{verdict}"), language)
    name = _NO_NAME.sub(" ", f"{part} - {word}")
    if name not in drawing.layers:
        red, green, blue, _ = map(int, _SHADES[verdict].split(","))
        layer = drawing.layers.add(name)
        layer.dxf.true_color = rgb2int((red, green, blue))
    return name


def _describe(properties: Mapping[str, Any]) -> str:
    """Part, type and force of a label."""
    design = properties.get("design_kN")
    parts = (
        properties["part"],
        properties.get("type"),
        None if design is None else f"{design:g} kN",
    )
    return ", ".join(text for text in parts if text)


def _add_label(drawing: Drawing, place: Point, layer: str, text: str) -> None:
    """Text beside a point; a line break in it would end the entity."""
    plain = " ".join(str(text).split()).replace("%%", "% %")
    label = drawing.modelspace().add_text(
        plain, height=_TEXT_HEIGHT, dxfattribs={"layer": layer}
    )
    x, y, z = (a + b for a, b in zip(place, _AWAY, strict=True))
    label.set_placement((x, y, z))


def _find_end(head: Point, properties: Mapping[str, Any]) -> Point:
    """End of an anchor's axis, from its azimuth, dip and length."""
    azimuth = math.radians(properties["azimuth_deg"])
    dip, length = math.radians(properties["dip_deg"]), properties["length_m"]
    flat = length * math.cos(dip)
    return (
        head[0] + flat * math.sin(azimuth),
        head[1] + flat * math.cos(azimuth),
        head[2] - length * math.sin(dip),
    )
