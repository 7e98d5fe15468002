"""The map of verdicts as GeoPackage and as drawing, read back by their libraries."""

import math
import subprocess
import sys

import ezdxf
import numpy as np
import pyogrio.raw
import pytest

from netdesign.files.verdict_map import require_format, write_verdicts
from netdesign.outcome import OutputError, TerrainError
from netdesign.terrain.crs import read_member
from netdesign.terrain.wkb import decode_wkb

VERDICTS = ("pass", "fail", "not_proven", "declared")
EVIL = "A|1;\n0\nSECTION %%u <>/"


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
        given = {"kind": "anchor", "part": "Foot anchor", **told, **axis}
        found.append(make(given, place))
    return found


def make(properties, coordinates, kind="Point"):
    geometry = {"type": kind, "coordinates": coordinates}
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def write(tmp_path, name, features, *, crs="EPSG:2056", language="en"):
    contents = write_verdicts(features, name, crs, language)
    assert contents == write_verdicts(features, name, crs, language)  # no time in it
    for file, content in contents.items():
        (tmp_path / file).write_bytes(content)
    return tmp_path / name


def test_a_geopackage_has_a_layer_of_each_kind_with_all_columns(tmp_path):
    features = draw_features()
    path = write(tmp_path, "m.gpkg", features)
    layers = dict(pyogrio.list_layers(path).tolist())
    assert layers == {"net row": "LineString Z", "post": "Point Z", "anchor": "Point Z"}
    for kind in layers:
        own = [one for one in features if one["properties"]["kind"] == kind]
        meta, _, shapes, columns = pyogrio.raw.read(path, layer=kind)
        assert meta["crs"] == "EPSG:2056"
        for one, shape in zip(own, shapes, strict=True):
            flat = np.array(one["geometry"]["coordinates"])
            read = decode_wkb(shape)["coordinates"]
            assert np.array(read) == pytest.approx(flat[..., :2], abs=0.0)
            heights = np.frombuffer(
                shape, "<f8", offset=len(shape) - 24 * flat[..., 0].size
            )
            assert heights[2::3] == pytest.approx(flat[..., 2].ravel(), abs=0.0)
        for name, column in zip(meta["fields"], columns, strict=True):
            for one, value in zip(own, column, strict=True):
                assert is_same(one["properties"].get(name), value), name
    assert (tmp_path / "m-setting-out.csv").exists()


def is_same(given, value):
    if given is None:
        return value is None or math.isnan(value)
    return value == (", ".join(map(str, given)) if isinstance(given, list) else given)


def test_a_geopackage_without_a_system_has_none_and_degrees_are_refused(tmp_path):
    path = write(tmp_path, "m.gpkg", draw_features(), crs="")
    named = pyogrio.raw.read(path, layer="post")[0]["crs"]
    assert named is None or "EPSG" not in named
    with pytest.raises(TerrainError, match="no map plane"):
        write_verdicts(draw_features(), "m.gpkg", "EPSG:4326", "en")


@pytest.mark.parametrize(
    ("language", "layers"),
    [
        ("en", {"Net row - FAIL", "Foot anchor - NOT PROVEN"}),
        ("fr", {"Ligne de filets - NON VÉRIFIÉ", "Foot anchor - NON JUSTIFIÉ"}),
        ("de", {"Werkreihe - NICHT ERFÜLLT", "Foot anchor - NICHT NACHGEWIESEN"}),
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
        "R1-1 Foot anchor, B40, 123.4 kN",
    ]
    assert len(labels) == len(features)


def test_names_that_would_break_a_drawing_do_not(tmp_path):
    features = draw_features(name=EVIL)
    for one in features[1:]:
        one["properties"]["part"] = EVIL
    drawing = ezdxf.readfile(write(tmp_path, "m.dxf", features))
    assert not drawing.audit().has_errors
    assert len(drawing.modelspace().query("POINT")) == len(features) - 1
    texts = [one.dxf.text for one in drawing.modelspace().query("TEXT")]
    assert all("SECTION" in one and "%%" not in one for one in texts)


def test_geojson_names_its_system_where_it_is_known():
    import json

    written = write_verdicts(draw_features(), "m.geojson", "EPSG:2056", "en")
    assert set(written) == {"m.geojson", "m.qml", "m-setting-out.csv"}
    assert read_member(json.loads(written["m.geojson"])) == "EPSG:2056"
    plain = write_verdicts(draw_features(), "m.geojson", "", "en")
    assert "crs" not in json.loads(plain["m.geojson"])


def test_a_format_is_refused_before_any_work(monkeypatch):
    from netdesign.terrain import libraries

    with pytest.raises(OutputError, match=r"ends in \.geojson, \.gpkg, \.dxf"):
        require_format("m.dwg")
    require_format("M.DXF")
    monkeypatch.setattr(libraries, "find_spec", lambda _: None)
    require_format("m.geojson")
    for name in ("m.dxf", "m.gpkg"):
        with pytest.raises(OutputError, match="pip install"):
            require_format(name)


def test_libraries_are_loaded_for_their_format_alone():
    program = """
import sys
from netdesign.files.verdict_map import write_verdicts
for name in (None, "m.geojson", "m.dxf"):
    if name:
        write_verdicts([], name, "", "en")
    print({"ezdxf", "pyogrio", "rasterio"} & set(sys.modules))
"""
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert ended.stdout.splitlines() == ["set()", "set()", "{'ezdxf'}"]
