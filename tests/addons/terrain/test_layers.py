"""Rows of shapefiles and GeoPackages: those of GeoJSON; what is none is refused."""

import contextlib

import numpy as np
import pytest

from netdesign.addons.terrain.grid import require_plane, require_same
from netdesign.addons.terrain.plan import read_plan
from netdesign.outcome import TerrainError
from tests.addons.terrain.map_files import GIVEN, SWISS, watch, write_rows
from tests.peak_memory import needs_peak

DRAW = np.random.default_rng(4)


def draw_rows(**given):
    """Three rows of drawn points."""
    found = []
    for number in range(3):
        start = DRAW.uniform((2_600_000, 1_100_000), (2_800_000, 1_200_000))
        steps = np.cumsum(DRAW.uniform(2.0, 9.0, (4 + number, 2)), axis=0)
        points = [tuple(map(float, one)) for one in start + steps]
        own = {key: text_of(value, number) for key, value in (given or GIVEN).items()}
        found.append((points, own))
    return found


def text_of(value, number):
    return f"{value}{number}" if isinstance(value, str) else value + 0.1 * number


@pytest.mark.parametrize("end", [".gpkg", ".shp"])
@pytest.mark.parametrize("size", [2, 3])
def test_rows_are_those_of_geojson(tmp_path, end, size):
    rows = draw_rows()
    plain = read_plan(write_rows(tmp_path / "rows.geojson", rows))
    found = read_plan(write_rows(tmp_path / f"rows{end}", rows, size=size))
    assert [one.id for one in found.lines] == ["A0", "A1", "A2"]
    for one, other in zip(plain.lines, found.lines, strict=True):
        assert dict(one.cells) == pytest.approx(dict(other.cells))
        assert one.points == pytest.approx(other.points, abs=1e-9)
    assert found.crs == SWISS


def test_faults_name_the_layer_and_come_all_at_once(tmp_path):
    rows = draw_rows()
    path = write_rows(tmp_path / "rows.gpkg", rows, layer="one")
    write_rows(
        path, [(rows[0][0], {"id": "C"}), (rows[1][0], {"id": "D"})], layer="two"
    )
    with pytest.raises(TerrainError) as caught:
        read_plan(path)
    told = str(caught.value).splitlines()
    assert len(told) == 4
    assert all(one.startswith("rows.gpkg: layer two, feature ") for one in told)


# --- reference systems ----------------------------------------------------------------


@pytest.mark.parametrize("end", [".gpkg", ".shp"])
@pytest.mark.parametrize(
    ("crs", "said"),
    [
        ("EPSG:4326", "no map plane"),
        ("EPSG:2227", "US survey foot"),
        ("EPSG:3857", "no metres on the ground"),
    ],
)
def test_rows_that_are_not_in_metres_on_a_plane_are_refused(tmp_path, end, crs, said):
    path = write_rows(tmp_path / f"rows{end}", draw_rows(), crs=crs)
    with pytest.raises(TerrainError, match=said) as caught:
        read_plan(path)
    assert str(caught.value).startswith(path.name)


def test_the_system_of_a_shapefile_is_that_of_its_grid(tmp_path):
    """Its text has other names than the code's."""
    path = write_rows(tmp_path / "rows.shp", draw_rows())
    assert "CH1903+_LV95" in path.with_suffix(".prj").read_text()
    require_same(require_plane(SWISS), read_plan(path).crs)
    require_same(require_plane("EPSG:2056+5728"), SWISS)  # with heights
    require_same("", SWISS)
    with pytest.raises(TerrainError) as caught:
        require_same(SWISS, require_plane("EPSG:25832"))
    for part in ("CH1903+ / LV95 (EPSG:2056)", "UTM zone 32N (EPSG:25832)"):
        assert part in str(caught.value)


def test_layers_in_two_systems_are_refused(tmp_path):
    path = write_rows(tmp_path / "rows.gpkg", draw_rows(), layer="a")
    write_rows(path, draw_rows(), layer="b", crs="EPSG:31254")
    with pytest.raises(TerrainError, match="two reference systems"):
        read_plan(path)


# --- hostile files --------------------------------------------------------------------


def spoil(path, seed, tmp_path, *, suffixes):
    """Copies that are cut, or have other bytes, at drawn places of one file."""
    draw = np.random.default_rng(seed)
    for number in range(40):
        folder = tmp_path / f"{seed}-{number}"
        folder.mkdir()
        chosen = str(draw.choice(suffixes))
        for one in path.parent.glob(f"{path.stem}.*"):
            content = bytearray(one.read_bytes())
            if one.suffix == chosen and number % 2:
                content = content[: draw.integers(0, len(content))]
            elif one.suffix == chosen:
                for place in draw.integers(0, min(len(content), 900), 4):
                    content[place] = draw.integers(0, 256)
            (folder / one.name).write_bytes(content)
        yield folder / path.name


PARTS = {".gpkg": [".gpkg"], ".shp": [".shp", ".shx", ".dbf", ".prj", ".cpg"]}


@pytest.mark.parametrize("end", PARTS)
def test_files_cut_or_with_other_bytes_are_rows_or_refused(tmp_path, capfd, end):
    whole = write_rows(tmp_path / f"rows{end}", draw_rows())
    read = count = 0
    for path in spoil(whole, 3, tmp_path, suffixes=PARTS[end]):
        before = sorted(one.name for one in path.parent.iterdir())
        count += 1
        with contextlib.suppress(TerrainError):
            plan = read_plan(path)
            assert all((np.abs(one.points) < 1e8).all() for one in plan.lines)
            read += 1
        assert sorted(one.name for one in path.parent.iterdir()) == before
    assert 0 < read < count
    assert capfd.readouterr() == ("", "")


# Counts of records, of points, sizes of fields: place in its file, and bytes there.
LIES = {
    "records": (".dbf", 4, b"\xff\xff\xff\x7f"),
    "width": (".dbf", 10, b"\xff\xff"),
    "length": (".shp", 24, b"\x7f\xff\xff\xff"),
    "record": (".shp", 104, b"\x7f\xff\xff\xff"),
    "points": (".shp", 148, b"\xff\xff\xff\x7f"),
    "parts": (".shp", 144, b"\xff\xff\xff\x7f"),
    "index": (".shx", 24, b"\x7f\xff\xff\xff"),
    "place": (".shx", 100, b"\x7f\xff\xff\xf0"),
}


@needs_peak
def test_counts_that_lie_are_refused_without_their_memory(tmp_path):
    names = [f"{name}.shp" for name in LIES]
    for name, (suffix, at, lie) in LIES.items():
        path = write_rows(tmp_path / f"{name}.shp", draw_rows()).with_suffix(suffix)
        content = bytearray(path.read_bytes())
        content[at : at + len(lie)] = lie
        path.write_bytes(content)
    told, _, most = watch("plan", "read_plan", names, tmp_path)
    assert [one.partition(".shp")[0] for one in told] == list(LIES)
    assert all(" read " not in one or one.endswith("read 3") for one in told), told
    assert sum(" read " not in one for one in told) >= 4, told
    assert most < 500  # [MiB]
