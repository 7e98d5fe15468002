"""Rows in plan as they are read, and files that are refused."""

import json

import pytest

from netdesign.addons.terrain.geojson import read_places
from netdesign.outcome import TerrainError
from tests.addons.terrain.map_files import collect, feature

ZONE = [[0, 0], [90, 0], [90, 60], [0, 60], [0, 0]]


def row(name, posts=4, **special):
    points = [[10.0 + 3.5 * k, 20.0, 1700.0] for k in range(posts)]
    properties = {
        "kind": "net row",
        "id": name,
        "aspect_deg": 181.3,
        "slope_mean_deg": 38.2,
        "grid": "slope.asc",
        "grid_sha256": "cd" * 32,
    }
    return feature(points, **properties | special)


def zone(ring):
    return feature([ring], "Polygon", kind="starting zone")


def write(folder, *features):
    path = folder / "rows.geojson"
    path.write_text(json.dumps(collect(*features)))
    return path


@pytest.mark.parametrize(
    "features",
    [
        (),
        (zone(ZONE),),
        (row("A", aspect_deg="steep"),),
        (row("A"), {"type": "Feature", "properties": None, "geometry": None}),
    ],
)
def test_what_is_no_map_of_ours_is_refused(tmp_path, features):
    with pytest.raises(TerrainError, match=r"rows\.geojson"):
        read_places(write(tmp_path, *features))
