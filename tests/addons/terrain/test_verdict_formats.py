"""The map of verdicts as GeoJSON and as drawing, read back by their libraries."""

import json
import math

import ezdxf
import numpy as np
import pyogrio.raw
import pytest

from netdesign.addons.terrain.verdict_map import write_verdicts

VERDICTS = ("pass", "fail", "not_proven", "declared")


def draw_features(seed=3, name="R1"):
    """A row with posts and anchors at drawn places, as ``map_verdicts`` gives them."""
    draw = np.random.default_rng(seed)
    start = np.array((2_700_000.0, 1_180_000.0, 1800.0))
    posts = np.round(start + np.cumsum(draw.uniform(1.0, 3.0, (5, 3)), axis=0), 3)
    row = {
        "kind": "net row", "id": name, "kinks_at_posts": [2, 3], "row_above": None,
        "utilisation": 0.873, "verdict": "fail",
    }  # fmt: skip
    found = [make(row, posts.tolist(), "LineString")]
    for number, place in enumerate(posts.tolist(), 1):
        told = {"row": name, "post": number, "verdict": VERDICTS[number % 4]}
        found.append(make({"kind": "post", "part": "Base of the post", **told}, place))
        axis = {
            "azimuth_deg": round(float(draw.uniform(0.0, 360.0)), 1),
            "dip_deg": round(float(draw.uniform(-30.0, 90.0)), 1),
            "length_m": None if number == 2 else round(float(draw.uniform(2, 6)), 2),
            "design_kN": None if number == 3 else 123.4,
            "type": "B40",
            "is_rising": False,
        }
        given = {"kind": "anchor", "part": "Net anchor (foot)", **told, **axis}
        found.append(make(given, place))
    return found


def make(properties, coordinates, kind="Point"):
    geometry = {"type": kind, "coordinates": coordinates}
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def write(tmp_path, name, features, language="en"):
    contents = write_verdicts({"features": features}, name, language)
    # no time in it
    assert contents == write_verdicts({"features": features}, name, language)
    for file, content in contents.items():
        (tmp_path / file).write_bytes(content)
    return tmp_path / name


@pytest.mark.parametrize(
    ("language", "layers"),
    [
        ("en", {"Net row - FAIL", "Net anchor (foot) - NOT PROVEN"}),
        ("fr", {"Net row - NON VÉRIFIÉ", "Net anchor (foot) - NON JUSTIFIÉ"}),
        ("de", {"Net row - NICHT ERFÜLLT", "Net anchor (foot) - NICHT NACHGEWIESEN"}),
    ],
)
def test_a_drawing_has_posts_heads_and_axes_in_metres(tmp_path, language, layers):
    features = draw_features()
    drawing = ezdxf.readfile(write(tmp_path, "m.dxf", features, language=language))
    assert not drawing.audit().has_errors
    assert drawing.header["$INSUNITS"] == 6
    assert layers <= {one.dxf.name for one in drawing.layers}
    space = drawing.modelspace()
    (row,) = space.query("POLYLINE")
    expected = features[0]["geometry"]["coordinates"]
    assert [tuple(one) for one in row.points()] == [tuple(one) for one in expected]
    points = [tuple(one.dxf.location) for one in space.query("POINT")]
    assert points == [tuple(one["geometry"]["coordinates"]) for one in features[1:]]
    anchors = [one for one in features if one["properties"].get("length_m")]
    for line, one in zip(space.query("LINE"), anchors, strict=True):
        given = one["properties"]
        assert tuple(line.dxf.start) == tuple(one["geometry"]["coordinates"])
        way = line.dxf.end - line.dxf.start
        assert way.magnitude == pytest.approx(given["length_m"])
        flat = math.hypot(way.x, way.y)
        azimuth = math.degrees(math.atan2(way.x, way.y)) % 360.0
        assert azimuth == pytest.approx(given["azimuth_deg"])
        assert math.degrees(math.atan2(-way.z, flat)) == pytest.approx(given["dip_deg"])
        assert drawing.layers.get(line.dxf.layer).dxf.true_color
    labels = [one.dxf.text for one in space.query("TEXT")]
    assert labels[:3] == [
        "R1",
        "R1-1 Base of the post",
        "R1-1 Net anchor (foot), B40, 123.4 kN",
    ]
    assert len(labels) == len(features)


def test_geojson_is_written_with_all_that_the_rows_had_and_read_again(tmp_path):
    name = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::2056"}}
    document = {"type": "FeatureCollection", "crs": name, "features": draw_features()}
    written = write_verdicts(document, "m.geojson", "en")
    assert set(written) == {"m.geojson", "m.qml", "m-setting-out.csv"}
    assert json.loads(written["m.geojson"]) == document
    (tmp_path / "m.geojson").write_bytes(written["m.geojson"])
    meta, _, shapes, _ = pyogrio.raw.read(tmp_path / "m.geojson")
    assert (meta["crs"], len(shapes)) == ("EPSG:2056", len(document["features"]))
