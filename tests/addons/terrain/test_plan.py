"""Rows as GeoJSON: headings of any language, all faults at once."""

import json
import math
import random

import pytest

from netdesign.addons.terrain.plan import read_plan
from netdesign.outcome import TerrainError
from tests.addons.terrain.map_files import collect, feature


@pytest.fixture
def read(tmp_path):
    """Plan of a document."""

    def parse(document):
        path = tmp_path / "rows.geojson"
        path.write_text(json.dumps(document))
        return read_plan(path)

    return parse


LINE = [[700.0, 200.0], [730.0, 201.0, 1500.0], [760.0, 203.0]]
GIVEN = {"id": "A", "net height [m]": 3.5, "post spacing": 3.0}


@pytest.mark.parametrize(
    "properties",
    [
        GIVEN,
        {"Werkreihe": "A", "Netzhöhe": 3.5, "Stützenabstand [cm]": 300},
        {"ligne": "A", "hauteur du filet [cm]": 350.0, "entraxe des montants": 3},
    ],
)
def test_properties_are_the_workbooks_columns_in_any_language(read, properties):
    plan = read(collect(feature(LINE, **properties)))
    (line,) = plan.lines
    assert (line.id, line.net_height, line.post_spacing) == ("A", 3.5, 3.0)
    assert line.points.tolist() == [[700, 200], [730, 201], [760, 203]]


def test_zones_other_columns_and_what_is_no_matter_are_read(read):
    ring = [[0, 0], [9, 0], [9, 9], [0, 0]]
    plan = read(
        collect(
            feature(LINE, **GIVEN, **{"ground of the anchors": "till"}, colour="red"),
            feature([ring], "Polygon", kind="starting zone"),
            feature([[ring], [ring]], "MultiPolygon", kind="starting zone"),
            feature([ring], "Polygon", kind="house"),
            feature([1, 2], "Point", kind="station"),
        )
    )
    assert len(plan.zones) == 3
    assert plan.lines[0].cells["ground"] == "till"
    assert plan.unread == ("'colour'",)


def test_a_zone_whose_outline_crosses_itself_is_refused(read):
    """Corners on a circle in turn, then two neighbours exchanged."""
    draws = random.Random(51)
    for count in (4, 7, 12):
        angles = sorted(draws.uniform(0.0, 2.0 * math.pi) for _ in range(count))
        ring = [
            [700.0 + 90.0 * math.cos(one), 300.0 + 90.0 * math.sin(one)]
            for one in angles
        ]
        crossed = [ring[1], ring[0], *ring[2:]]
        for points, kind, crosses in (
            (ring, "starting zone", False),
            (crossed, "starting zone", True),
            (crossed, "house", False),
        ):
            closed = [*points, points[0]]
            lines = feature(LINE, **GIVEN), feature([closed], "Polygon", kind=kind)
            if not crosses:
                read(collect(*lines))
                continue
            with pytest.raises(TerrainError) as refused:
                read(collect(*lines))
            assert "feature 2" in str(refused.value)
            assert "crosses itself" in str(refused.value)


def test_all_faults_are_told_at_once(read):
    bad = collect(
        feature(LINE, **GIVEN),
        feature(LINE, **GIVEN),
        feature([[1.0, math.nan], [2.0, 3.0]], **GIVEN),
        feature([[1.0, 2.0]], **GIVEN),
        feature(LINE, id="B", net_height=-3.0),
        feature(LINE, **{**GIVEN, "id": "C", "net height": 4.0}),
        {**feature(LINE, **{**GIVEN, "id": "D"}), "geometry": None},
        feature([LINE], "Polygon", **{**GIVEN, "id": "E"}),
    )
    with pytest.raises(TerrainError) as caught:
        read(bad)
    told = str(caught.value).splitlines()
    assert len(told) == 8
    assert all(line.startswith("rows.geojson") for line in told)
    for part in (
        "two rows are named A",
        "feature 3",
        "feature 7",
        "feature 8",
        "'net height'",
    ):
        assert [line for line in told if part in line]


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", '{"features": "x"}', '{"features": []}', "[" * 100_000, "NaN"],
)
def test_what_is_no_geojson_is_refused_in_words(tmp_path, text):
    path = tmp_path / "rows.geojson"
    path.write_text(text)
    with pytest.raises(TerrainError, match=r"rows\.geojson"):
        read_plan(path)


def test_degrees_are_refused_and_a_byte_order_mark_is_none(tmp_path):
    path = tmp_path / "rows.geojson"
    degrees = [[9.81, 46.81], [9.82, 46.81]]
    path.write_text(json.dumps(collect(feature(degrees, **GIVEN))))
    with pytest.raises(TerrainError, match="no map plane"):
        read_plan(path)
    path.write_text(json.dumps(collect(feature(LINE, **GIVEN))), encoding="utf-8-sig")
    assert read_plan(path).lines[0].id == "A"
