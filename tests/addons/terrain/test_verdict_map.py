"""Anchors of a study on the map: places and directions by hand, files read back."""

import csv
import json
import math
import random
from dataclasses import replace
from types import SimpleNamespace
from xml.etree import ElementTree

import ezdxf
import numpy as np
import pyogrio.raw
import pytest

from netdesign.addons.terrain.geojson import MeasuredPlace
from netdesign.addons.terrain.verdict_map import (
    list_checks_at,
    turn_to_map,
    write_verdicts,
)
from netdesign.checks import load_standard
from netdesign.structure.row_position import Bore
from tests.addons.terrain.map_files import feature
from tests.checks.entries import a_force, a_resistance
from tests.each import each
from tests.read_check import check_member

SLOPE = math.radians(37.0)
PROFILE = "swiss-guideline-2007"


def place(aspect):
    """Two posts 3 m apart along the contour, the ground falling to the aspect."""
    along = (math.cos(aspect), -math.sin(aspect))
    posts = [
        (500.0 + 3.0 * k * along[0], 300.0 + 3.0 * k * along[1], 1800.0) for k in (0, 1)
    ]
    return MeasuredPlace(feature={}, aspect=aspect, slope=SLOPE, posts=posts)


@pytest.mark.parametrize("aspect_deg", [0.0, 90.0, 180.0, 223.7])
def test_an_uphill_anchor_lies_up_the_slope_and_dips_into_it(aspect_deg):
    aspect, axis = math.radians(aspect_deg), math.radians(52.0)
    bore = Bore(
        start=(-4.0, 0.0, 0.0),
        direction=(-math.cos(axis), -math.sin(axis), 0.0),
        length=5.0,
    )
    where = place(aspect)
    head, azimuth, dip = turn_to_map(bore, where, 1)
    out = 4.0 * math.cos(SLOPE)
    assert head[0] == pytest.approx(500.0 - out * math.sin(aspect))
    assert head[1] == pytest.approx(300.0 - out * math.cos(aspect))
    assert head[2] == pytest.approx(1800.0 + 4.0 * math.sin(SLOPE))
    # 52 degrees into a slope that rises at 37: 15 below the horizontal, uphill
    assert dip == pytest.approx(15.0)
    assert math.cos(math.radians(azimuth - aspect_deg - 180.0)) == pytest.approx(1.0)


def test_an_anchor_of_the_bay_stands_half_way_to_the_next_post():
    where = place(math.radians(150.0))
    bore = Bore(start=(0.0, 0.0, 1.5), direction=(0.0, -1.0, 0.0), length=5.0)
    head, _, dip = turn_to_map(bore, where, 1)
    middle = [(a + b) / 2 for a, b in zip(*where.posts, strict=True)]
    assert head == pytest.approx(middle)
    assert dip == pytest.approx(90.0 - 37.0)  # square to the slope
    last, _, _ = turn_to_map(bore, where, 2)
    beyond = [b + (b - a) / 2 for a, b in zip(*where.posts, strict=True)]
    assert last == pytest.approx(beyond)


@pytest.mark.long
def test_verdicts_of_a_study_stand_on_the_map(tmp_path, call):
    site, study = tmp_path / "site.xlsx", tmp_path / "part-study.json"
    assert call("terrain", "--example", "--out", site, "--quiet").code == 0
    options = (
        "--row",
        "A1",
        "--accuracy",
        "0.05",
        "--no-html",
        "--no-excel",
        "--quiet",
    )
    checked = call("check", site, "--out", tmp_path, *options)
    assert checked.code == 4, checked.err  # no part of the structure is typed
    rows, out = tmp_path / "rows.geojson", tmp_path / "checked.geojson"
    ended = call("terrain", "--verdicts", study, "--rows", rows, "--out", out)
    assert ended.code == 0, ended.err
    features = json.loads(out.read_text())["features"]
    (row,) = (one for one in features if one["properties"]["kind"] == "net row")
    stored = json.loads(study.read_text())["rows"][0]
    assert row["properties"]["verdict"] == stored["verdict"]
    largest = max(one["utilisation"] or 0.0 for one in stored["checks"])
    assert row["properties"]["utilisation"] == pytest.approx(largest, abs=1e-3)
    with (tmp_path / "checked-setting-out.csv").open() as file:
        lines = list(csv.DictReader(file))
    feet = [one for one in lines if one["part"] == "Foot of the net"]
    bases = [one for one in lines if one["part"] == "Base of the post"]
    anchors = [one for one in lines if one["azimuth_deg"]]
    count = len(row["geometry"]["coordinates"])
    assert len(feet) == len(bases) == count
    # foot, and shared anchors of the guys up and down the slope: one more than posts
    sideways = [
        one for one in anchors if one["part"] in ("Lateral anchor", "End guy anchor")
    ]
    # no cell says where the lateral anchors stand: a condition of the report
    assert [one["part"] for one in sideways] == ["End guy anchor"] * 2
    of_guys = 2 * (count + 1)
    assert len(anchors) == count + of_guys + count_mid(anchors) + len(sideways)
    ordered = [one for one in stored["parts"] if one["part"] == "uphill_anchor"]
    assert sum(one["count"] for one in ordered) == count + 1
    assert len([one for one in anchors if one["part"] == "Uphill anchor"]) == count + 1
    compare_forces(anchors, stored["checks"], count)
    root = ElementTree.fromstring((tmp_path / "checked.qml").read_text())
    assert len(root.findall(".//rule")) == len(root.findall(".//symbol")) == 4
    again = call("terrain", "--verdicts", study, "--rows", rows, "--out", out)
    assert again.code == 2
    other = tmp_path / "other.dxf"
    ended = call("terrain", "--verdicts", study, "--rows", rows, "--out", other)
    assert ended.code == 0, ended.err
    space = ezdxf.readfile(other).modelspace()
    assert len(space.query("POINT POLYLINE")) == len(features)
    table = tmp_path / "other-setting-out.csv"
    assert table.read_text() == (tmp_path / "checked-setting-out.csv").read_text()


def compare_forces(anchors, checks, count):
    """Each anchor has the force of its support, the same from either end of the row."""
    beside = {"end": ".end", "second": ".second", "inside": ""}
    pulls = {
        one["id"]: step.get("high") or step["value"]
        for one in checks
        for step in one["steps"]
        if one["mode"] == "pull_out" and step["symbol"] == "E_d"
    }
    for part, member, is_of_bay in (
        ("Net anchor (foot)", "foot_anchor", False),
        ("Uphill anchor", "uphill_anchor", True),
        ("Downhill anchor", "downhill_anchor", True),
    ):
        of_part = [one for one in anchors if one["part"] == part]
        for one in of_part:
            mode = f"{member}.pull_out{beside[one['support']]}"
            assert float(one["design_kN"]) == pytest.approx(pulls[mode], abs=0.06)
        # of guys one stands in each bay, and one beyond each end
        ends = ["end"] * (2 if is_of_bay else 1)
        inside = ["inside"] * (count - 4 - is_of_bay)
        assert [one["support"] for one in of_part] == [
            *(*ends, "second", *inside, "second", *ends)
        ]


def check_at(position, force, kind):
    """A check of an anchor of some type, of a characteristic force [N]."""
    known, standard = a_resistance(1e6, type_id=kind), load_standard(PROFILE)
    found = check_member(a_force(force), known, standard)
    return replace(found, position=position)


@each("seed", range(20))
def test_an_anchor_beside_the_end_has_no_force_less_than_its_own(seed):
    """Its own check, or where the study leaves it out the one that covers it."""
    draw = random.Random(seed)
    forces = {
        place: draw.uniform(1e3, 9e5) for place in ("intermediate", "second", "edge")
    }
    is_alike, has_own = draw.random() < 0.5, draw.random() < 0.5
    kinds = {"edge": "A" if is_alike else "B"}
    checks = {
        place: check_at(place, force, kinds.get(place, "A"))
        for place, force in forces.items()
        if place != "second" or has_own
    }
    (found,) = list_checks_at(SimpleNamespace(checks=[*checks.values()]), "second")
    covered = max(forces["intermediate"], forces["edge"])
    without = covered if is_alike else forces["intermediate"]
    wanted = forces["second"] if has_own else without
    on_action = found.read("γ_E")
    assert found.read_band("E_d")[1] == pytest.approx(on_action * wanted / 1e3)


def count_mid(anchors):
    """Net anchors (foot) between two posts."""
    feet = [one for one in anchors if one["part"] == "Net anchor (foot)"]
    return len(feet) - len({one["post"] for one in feet})


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
    found = [feature(posts.tolist(), **row)]
    for number, place in enumerate(posts.tolist(), 1):
        told = {"row": name, "post": number, "verdict": VERDICTS[number % 4]}
        post = {"kind": "post", "part": "Base of the post"}
        found.append(feature(place, "Point", **post | told))
        axis = {
            "azimuth_deg": round(float(draw.uniform(0.0, 360.0)), 1),
            "dip_deg": round(float(draw.uniform(-30.0, 90.0)), 1),
            "length_m": None if number == 2 else round(float(draw.uniform(2, 6)), 2),
            "design_kN": None if number == 3 else 123.4,
            "type": "B40",
            "is_rising": False,
        }
        given = {"kind": "anchor", "part": "Net anchor (foot)", **told, **axis}
        found.append(feature(place, "Point", **given))
    return found


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
