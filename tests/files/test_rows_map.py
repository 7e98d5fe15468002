"""Rows of the report's map as they are read, and maps that are refused."""

import json
from types import SimpleNamespace

import pytest

from netdesign.files.rows_map import read_rows_map, require_rows
from netdesign.outcome import StudyError, TerrainError

ZONE = [[0, 0], [90, 0], [90, 60], [0, 60], [0, 0]]


def row(name, posts=4, **special):
    properties = {
        "kind": "net row",
        "id": name,
        "aspect_deg": 181.3,
        "slope_mean_deg": 38.2,
        "grid": "slope.asc",
        "grid_sha256": "cd" * 32,
        **special,
    }
    points = [[10.0 + 3.5 * k, 20.0, 1700.0] for k in range(posts)]
    geometry = {"type": "LineString", "coordinates": points}
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def zone(ring):
    geometry = {"type": "Polygon", "coordinates": [ring]}
    properties = {"kind": "starting zone"}
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def write(folder, *features):
    path = folder / "rows.geojson"
    document = {"type": "FeatureCollection", "features": list(features)}
    path.write_text(json.dumps(document))
    return path


def test_rows_zones_and_grid_are_read(tmp_path):
    found = read_rows_map(write(tmp_path, row("A"), row("7", posts=9), zone(ZONE)))
    assert list(found.rows) == ["A", "7"]
    assert (found.grid, found.sha256) == ("slope.asc", "cd" * 32)
    assert found.zones == (tuple((float(x), float(y)) for x, y in ZONE),)


@pytest.mark.parametrize(
    "features",
    [
        (),
        (zone(ZONE),),
        (row("A"), zone("a ring")),
        (row("A"), zone([[0, 0], [float("nan"), 0], [1, 1], [0, 0]])),
        (row("A"), zone([[0, 0], [1e300, 0], [1, 1], [0, 0]])),
        (row("A"), row("B", grid="other.asc")),
        (row("A", aspect_deg="steep"),),
        (row("A"), {"type": "Feature", "properties": None, "geometry": None}),
    ],
)
def test_what_is_no_map_of_ours_is_refused(tmp_path, features):
    with pytest.raises(TerrainError, match=r"rows\.geojson"):
        read_rows_map(write(tmp_path, *features))


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ([("A", 4), ("C", None)], "C"),  # not drawn
        ([("A", 4), ("B", 8)], "B"),  # other posts
        ([("A", 4), ("B", None)], ""),
        ([("B", 9)], ""),  # more rows on the map than in the site
    ],
)
def test_a_map_has_all_rows_of_the_site_with_their_posts(tmp_path, given, named):
    places = read_rows_map(write(tmp_path, row("A"), row("B", posts=9)))
    site = SimpleNamespace(
        rows=[SimpleNamespace(id=name, post_count=count) for name, count in given]
    )
    if not named:
        require_rows(places, site)
        return
    with pytest.raises(StudyError) as refused:
        require_rows(places, site)
    assert refused.value.message.arguments["rows"] == (named,)
