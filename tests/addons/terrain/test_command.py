"""``netdesign terrain``: from a grid and lines to a workbook that is checked."""

import json
from dataclasses import replace

import numpy as np
import openpyxl
import pytest

from netdesign.addons.terrain.grid import Grid, read_grid
from netdesign.site.reader import read_site
from netdesign.site.template.office_workbook import write_site_workbook
from tests.addons.terrain.map_files import collect, feature, write_asc, write_tif
from tests.addons.terrain.map_files import write_rows as write_layer

EAST, NORTH = 2_700_300.0, 1_180_200.0
ROWS = (("A", 40, 40, 79), ("B", 62, 40, 79), ("C", 62, 80.5, 115))


@pytest.fixture(scope="module")
def slope(tmp_path_factory):
    """Folder with a grid of 38 degrees or so, three rows, and types."""
    folder = tmp_path_factory.mktemp("slope")
    x, y = np.meshgrid(np.arange(160.0), np.arange(160.0))
    noise = np.random.default_rng(11).normal(0.0, 0.04, x.shape)
    z = 1800.0 + 0.78 * y + 1.5 * np.sin(x / 31.0) + noise
    grid = Grid(west=EAST + 0.5, south=NORTH + 0.5, cell=1.0, heights=np.round(z, 3))
    (folder / "slope.asc").write_bytes(write_asc(grid))
    (folder / "rows.json").write_text(json.dumps(write_rows()))
    write_site_workbook(folder / "types.xlsx", example=True)
    (folder / "slope.tif").write_bytes(write_tif(grid, count=3, compress="deflate"))
    *rows, zone = (
        (one["geometry"]["coordinates"], one["properties"])
        for one in write_rows()["features"]
    )
    write_layer(folder / "rows.gpkg", rows)
    zones = [(zone[0][0], zone[1])]
    write_layer(folder / "rows.gpkg", zones, kind=3, layer="zone")
    return folder


def write_rows(**special):
    given = {
        "net height [m]": 3.0,
        "post spacing [m]": 3.0,
        "snow thickness [m]": 2.8,
        "glide factor N": 1.7,
        "net stiffness [kN/m]": 12000,
        "slack": 0.05,
    }
    rows = [
        feature(
            [[EAST + a, NORTH + y], [EAST + b, NORTH + y]],
            **{"id": name} | given | special,
        )
        for name, y, a, b in ROWS
    ]
    zone = [(35, 35), (120, 35), (120, 90), (35, 90), (35, 35)]
    ring = [[EAST + x, NORTH + y] for x, y in zone]
    return collect(*rows, feature([ring], "Polygon", kind="starting zone"))


@pytest.mark.parametrize(
    ("grid", "drawn", "language", "sheet", "heading"),
    [
        ("slope.asc", "rows.json", "en", "Rows", "slope ψ"),
        ("slope.tif", "rows.gpkg", "de", "Reihen", "Hangneigung ψ"),
    ],
)
def test_rows_become_lines_of_a_workbook_with_notes(
    slope, tmp_path, call, grid, drawn, language, sheet, heading
):
    out = tmp_path / "site.xlsx"
    options = ("--out", out, "--types", slope / "types.xlsx", "--language", language)
    ended = call("terrain", slope / grid, slope / drawn, *options)
    assert ended.code == 0, ended.err
    assert ("3 bands: the first one is read" in ended.err) == (grid == "slope.tif")
    rows = openpyxl.load_workbook(out)[sheet]
    cell = rows.cell(6, find_column(rows, heading))
    assert 37.5 < cell.value < 39.0
    assert "line of fall of each post" in cell.comment.text
    assert grid in cell.comment.text
    page = (tmp_path / "terrain.html").read_text()
    assert page.count("<svg") == 2 + len(ROWS)
    assert "<script" not in page
    rows = json.loads((tmp_path / "rows.geojson").read_text())["features"]
    named = {one["properties"]["id"]: one for one in rows if "id" in one["properties"]}
    a = named["A"]["properties"]
    assert (a["row_above"], a["upslope_end"], a["exposure"]) == ("B", "row", "S")
    assert a["row_below"] is None
    assert named["B"]["properties"]["row_below"] == "A"
    posts = [one for one in rows if one["properties"]["kind"] == "post"]
    places = [named[one]["geometry"]["coordinates"] for one in named]
    assert len(posts) == sum(map(len, places))


def test_a_grid_and_rows_in_two_systems_are_refused(slope, tmp_path, call):
    rows = tmp_path / "rows.geojson"
    name = {"name": "urn:ogc:def:crs:EPSG::25832"}
    named = {"crs": {"type": "name", "properties": name}}
    rows.write_text(json.dumps(write_rows() | named))
    ended = call("terrain", slope / "slope.tif", rows, "--json")
    assert ended.code == 3
    assert "(EPSG:2056) and ETRS89 / UTM zone 32N (EPSG:25832)" in ended.err


def test_a_row_on_flat_ground_gets_no_length(slope, tmp_path, call):
    grid = read_grid(slope / "slope.asc")
    flat = replace(grid, heights=np.full_like(grid.heights, 1800.0))
    (tmp_path / "flat.asc").write_bytes(write_asc(flat))
    out = tmp_path / "site.xlsx"
    ended = call("terrain", tmp_path / "flat.asc", slope / "rows.json", "--out", out)
    assert ended.code == 0, ended.err
    assert "stands on ground flatter than 25°" in ended.out
    rows = openpyxl.load_workbook(out)["Rows"]
    assert rows.cell(6, find_column(rows, "upslope length L")).value is None


def find_column(sheet, heading):
    return next(x.column for x in sheet[3] if x.value.replace("-\n", "") == heading)


def list_nets(path):
    sheet = openpyxl.load_workbook(path)["Net types"]
    lines = [[x.value for x in row[:2]] for row in sheet.iter_rows(min_row=6)]
    return {name: height for name, height in lines if name}


def test_rows_with_the_same_net_share_a_net_type(slope, tmp_path, call):
    rows = write_rows()
    for number, height in enumerate((3.0, 2.5, 3.0)):
        rows["features"][number]["properties"]["net height [m]"] = height
    rows["features"][2]["properties"]["slack"] = 0.06
    rows["features"][0]["properties"]["paint"] = "red"
    rows["features"].pop()  # no zone, whose cover would be told
    (tmp_path / "rows.json").write_text(json.dumps(rows))
    out = tmp_path / "site.xlsx"
    ended = call("terrain", slope / "slope.asc", tmp_path / "rows.json", "--out", out)
    assert ended.code == 0, ended.err
    assert "left out: 'paint'" in ended.err
    assert call("check", out, "--dry-run").code in (0, 4)  # a workbook as any other
    assert list_nets(out) == {"D_K 3": 3.0, "D_K 2.5": 2.5, "D_K 3 2": 3.0}
    site = read_site(out)
    assert [(row.net_height, row.slack) for row in site.rows] == [
        (3.0, pytest.approx(0.05)),
        (2.5, pytest.approx(0.05)),
        (3.0, pytest.approx(0.06)),
    ]


def test_a_row_takes_its_net_type_from_the_other_workbook(slope, tmp_path, call):
    kept = ("id", "net height [m]", "post spacing [m]", "net type")
    rows = write_rows(**{"net type": "SN 3.0"})
    for one in rows["features"][: len(ROWS)]:
        given = one["properties"]
        one["properties"] = {key: given[key] for key in kept}
        one["properties"]["snow height [m vertical]"] = 3.3
    (tmp_path / "rows.json").write_text(json.dumps(rows))
    out = tmp_path / "site.xlsx"
    asked = ("terrain", slope / "slope.asc", tmp_path / "rows.json", "--out", out)
    ended = call(*asked, "--types", slope / "types.xlsx")
    assert ended.code == 0, ended.err
    for row in read_site(out).rows:
        assert row.approval.document == "EX-TA 12-3"
        assert 3.3 * 0.75 < row.snow_thickness < 3.3 * 0.81  # of 38 degrees or so
    rows["features"][1]["properties"]["net height [m]"] = 3.2
    (tmp_path / "rows.json").write_text(json.dumps(rows))
    ended = call(*asked, "--types", slope / "types.xlsx", "--force")
    assert ended.code == 3
    assert "row B: net_height is 3.2, and 3.0 of net type 'SN 3.0'" in ended.err
