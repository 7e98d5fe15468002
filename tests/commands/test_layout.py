"""``netdesign layout``: from a zone to a plan whose verdicts are those of ``check``."""

import json

import numpy as np
import pytest

from netdesign.terrain.example import (
    build_example,
    write_grid,
    write_prices,
    write_rows,
    write_types,
)

PLANNED = []
FILES = {"grid.asc", "zone.geojson", "types.xlsx", "prices.csv"}


@pytest.fixture(scope="module")
def zone(tmp_path_factory):
    """Folder with the made-up zone, cut to its western part."""
    folder = tmp_path_factory.mktemp("zone")
    ground = build_example()
    (folder / "grid.asc").write_bytes(write_grid(ground))
    document = json.loads(write_rows(ground))
    (feature,) = [
        one for one in document["features"] if one["geometry"]["type"] == "Polygon"
    ]
    ring = np.array(feature["geometry"]["coordinates"][0])
    middle = ring[:, 0].min() + 0.5 * np.ptp(ring[:, 0])
    ring[:, 0] = np.minimum(ring[:, 0], middle)
    ring[:, 1] = np.maximum(ring[:, 1], ring[:, 1].min() + 0.45 * np.ptp(ring[:, 1]))
    feature["geometry"]["coordinates"] = [ring.tolist()]
    only = {"type": "FeatureCollection", "features": [feature]}
    (folder / "zone.geojson").write_text(json.dumps(only))
    (folder / "types.xlsx").write_bytes(write_types())
    (folder / "prices.csv").write_bytes(write_prices())
    assert {one.name for one in folder.iterdir()} == FILES
    return folder


def plan(call, zone, out, *more):
    return call(
        *("layout", zone / "grid.asc", zone / "zone.geojson"),
        *("--types", zone / "types.xlsx", "--out", out, "--accuracy", 0.05, *more),
    )


@pytest.fixture
def planned(zone, call):
    """Plan of the zone, made once."""
    out = zone.parent / f"{zone.name}-plan"
    if not PLANNED:
        prices = ("--prices", zone / "prices.csv")
        PLANNED.append(plan(call, zone, out, "--snow", 3.2, *prices))
    return PLANNED[0], out, json.loads((out / "plan.json").read_text())


def test_the_plan_has_rows_verdicts_sums_and_cost(planned):
    ended, out, document = planned
    assert ended.code in (0, 1, 4), ended.err
    assert document["schema"] == "netdesign.layout/1"
    rows = document["rows"]
    assert rows
    assert document["posts"] == sum(one["posts"] for one in rows)
    assert document["cost"] == pytest.approx(sum(one["cost"] for one in rows), abs=0.1)
    assert document["uncovered_m2"] < 0.25 * document["zone_m2"]
    for one in rows:
        assert one["id"] in ended.out
        assert 12.0 <= one["length_m"] <= 61.0
    assert "listed by 'netdesign check " in ended.out  # there is no report
    names = {one.name for one in out.iterdir()}
    assert names == {
        *("plan.geojson", "plan.json", "rows.geojson", "site.xlsx", "study.json"),
        "terrain.html",
    }


@pytest.mark.long
def test_a_plan_that_leaves_ground_open_is_not_proven(zone, call, tmp_path):
    """A wedge of a zone, which narrows to nothing: rows have no room in its tip."""
    document = json.loads((zone / "zone.geojson").read_text())
    ring = np.array(document["features"][0]["geometry"]["coordinates"][0])
    (west, south), (_, north) = ring.min(axis=0), ring.max(axis=0)
    wedge = [[west, north], [west + 40.0, north], [west + 20.0, south], [west, north]]
    document["features"][0]["geometry"]["coordinates"] = [wedge]
    (tmp_path / "wedge.json").write_text(json.dumps(document))
    ended = call(
        *("layout", zone / "grid.asc", tmp_path / "wedge.json", "--snow", 3.2),
        *("--types", zone / "types.xlsx", "--out", tmp_path / "out"),
        *("--accuracy", 0.05),
    )
    told = json.loads((tmp_path / "out" / "plan.json").read_text())
    assert told["uncovered_m2"] > 0.1 * told["zone_m2"]
    assert told["is_covered"] is False
    assert told["verdict"] in ("not_proven", "fail")
    assert ended.code in (1, 4)
    assert "held by no row" in ended.out


def test_each_row_checked_alone_has_the_verdict_of_the_plan(planned, call, tmp_path):
    _, out, document = planned
    for one in document["rows"]:
        place = tmp_path / one["id"]
        ended = call(
            *("check", out / "site.xlsx", "--row", one["id"], "--accuracy", 0.05),
            *("--out", place, "--quiet"),
        )
        assert ended.code in (0, 1, 4), ended.err
        (study,) = place.glob("*study.json")
        (row,) = json.loads(study.read_text())["rows"]
        assert row["verdict"] == one["verdict"], one["id"]


def test_the_drawn_plan_measured_again_gives_the_same_rows(
    planned, zone, call, tmp_path
):
    _, out, document = planned
    ended = call(
        *("terrain", zone / "grid.asc", out / "plan.geojson", "--json", "--quiet")
    )
    assert ended.code == 0, ended.err
    again = {one["id"]: one for one in json.loads(ended.out)["rows"]}
    for one in document["rows"]:
        assert again[one["id"]]["length_m"] == pytest.approx(one["length_m"], abs=0.05)
        assert again[one["id"]]["upslope_length_m"] == pytest.approx(
            one["upslope_length_m"], abs=0.3
        )


def test_the_study_of_the_plan_is_reported(planned, call, tmp_path):
    _, out, _ = planned
    ended = call("report", out / "study.json", "--out", tmp_path / "report")
    assert ended.code == 0, ended.err
    assert (tmp_path / "report" / "report.html").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ((), "--snow M"),
        (("--snow", 3.0, "--snow-altitude", 1900), "belong together"),
        (("--snow", 3.0, "--snow-gradient", 0.1), "belong together"),
        (("--snow", 3.0, "--snow-grid", "grid.asc"), "--snow M"),
        (("--snow", "nan"), "no number"),
        (
            ("--snow", 3.0, "--snow-altitude", "nan", "--snow-gradient", 0.1),
            "no number",
        ),
        (("--snow", 3.0, "--spacing-standard", "eurocode"), "how far apart"),
    ],
)
def test_what_is_missing_or_contradicts_is_told(zone, call, tmp_path, options, said):
    ended = plan(call, zone, tmp_path / "out", *options)
    assert ended.code == 2
    assert said in ended.err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("language", ["en", "fr", "de"])
def test_input_that_is_none_is_refused_in_words(zone, call, tmp_path, language):
    shown = ("--language", language)
    lines = json.loads((zone / "zone.geojson").read_text())
    lines["features"][0]["properties"] = {}
    (tmp_path / "no-zone.json").write_text(json.dumps(lines))
    none = call(
        *("layout", zone / "grid.asc", tmp_path / "no-zone.json", "--snow", 3.0),
        *("--types", zone / "types.xlsx", "--out", tmp_path / "out", *shown),
    )
    # heights of ground are no snow heights
    deep = plan(
        *(call, zone, tmp_path / "out", "--snow-grid", zone / "grid.asc", *shown)
    )
    (tmp_path / "bad.csv").write_text("type;price;per\nA99;1;m\n")
    prices = plan(
        *(call, zone, tmp_path / "out", "--snow", 3.0, *shown),
        *("--prices", tmp_path / "bad.csv"),
    )
    ring = lines["features"][0]["geometry"]["coordinates"][0]
    inner = [[0.5 * (x + ring[0][0]), 0.5 * (y + ring[0][1])] for x, y in ring]
    lines["features"][0]["geometry"]["coordinates"] = [ring, inner]
    (tmp_path / "hole.json").write_text(json.dumps(lines))
    hole = call(
        *("layout", zone / "grid.asc", tmp_path / "hole.json", "--snow", 3.0),
        *("--types", zone / "types.xlsx", "--out", tmp_path / "out", *shown),
    )
    low = plan(
        *(call, zone, tmp_path / "out", "--snow", 3.0, *shown),
        *("--snow-altitude", 5000, "--snow-gradient", 0.9),
    )
    hole_words = {"en": "hole", "fr": "trou", "de": "Loch"}[language]
    refused = ((none, "kind"), (deep, "20"), (prices, "A99"), (hole, hole_words))
    for ended, word in (*refused, (low, "20 m")):
        assert ended.code == 3, ended.err
        assert word in ended.err
        assert "Error" not in ended.err
    assert not (tmp_path / "out").exists()
