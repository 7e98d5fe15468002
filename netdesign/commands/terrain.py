"""``netdesign terrain``: net rows on an elevation grid, as a site workbook."""

from __future__ import annotations

import hashlib
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import (
    refuse_without,
    take_options,
)
from netdesign.commands.running import (
    follow,
    print_document,
    require_places,
    write_outputs,
)
from netdesign.commands.usage import UsageRefusal, speak, tell
from netdesign.words.message import say

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from netdesign.terrain.coverage import Coverage
    from netdesign.terrain.geojson import Feature
    from netdesign.terrain.grid import Grid
    from netdesign.terrain.measure import MeasuredRow
    from netdesign.terrain.plan import Plan
    from netdesign.terrain.site_lines import Lines
    from netdesign.terrain.surface import Surface

_SITE = "site.xlsx"
ROWS_FILE = "rows.geojson"


@click.command()
@click.argument("grid", required=False, type=click.Path(path_type=Path, dir_okay=False))
@click.argument("rows", required=False, type=click.Path(path_type=Path, dir_okay=False))
@take_options("terrain")
def terrain(grid: Path | None, rows: Path | None, **asked: Any) -> None:
    """Read slope, length and posts of net rows off an elevation grid.

    \b
    netdesign terrain --example
    netdesign terrain grid.asc rows.geojson --out site.xlsx
    netdesign terrain grid.tif rows.gpkg --types types.xlsx --most 40
    netdesign terrain --verdicts study.json --rows rows.geojson --out checked.geojson
    netdesign terrain --verdicts study.json --rows rows.geojson --out drawing.dxf

    GRID is an ESRI ASCII grid or a GeoTIFF, in metres. ROWS are lines in its
    coordinates: GeoJSON, a shapefile (.shp) or a GeoPackage (.gpkg). Their properties
    are columns of sheet Nets: id, net height, post spacing and any other. Each derived
    cell has a note with its band and its stretch. The map of verdicts is GeoJSON, a
    GeoPackage or a drawing (.dxf). All but ASCII grid and GeoJSON need
    pip install "netdesign[terrain]".
    """
    if asked["study_file"] is not None:
        _map_study(asked["study_file"], asked["places_file"], asked)
        return
    refuse_without(("places_file",), "--verdicts")
    folder, site = _place(asked)
    if asked["example"]:
        if grid is not None or folder is None:
            raise UsageRefusal(say("terrain.example_alone"))
        from netdesign.terrain.example import write_example

        files = write_example(folder, overwrite=asked["force"])
        grid, rows, asked["types"] = files
    if grid is None or rows is None:
        raise UsageRefusal(say("terrain.no_input"))
    _measure(grid, rows, folder, site, asked)


def _map_study(
    study_file: Path, places_file: Path | None, asked: Mapping[str, Any]
) -> None:
    """Verdicts and anchors of a stored study on the map."""
    from netdesign.commands.stored_study import read_own_site, require_sound
    from netdesign.files.rows_map import read_places
    from netdesign.files.verdict_map import (
        map_verdicts,
        require_format,
        write_verdicts,
    )
    from netdesign.study.document import load_study
    from netdesign.study.record_provenance import load_own_profile
    from netdesign.terrain.crs import read_member

    out, language = asked["out"], speak()
    if places_file is None or out is None:
        raise UsageRefusal(say("terrain.verdicts_need"))
    require_format(out.name)
    study = load_study(study_file)
    require_sound(study, study_file)
    site = read_own_site(study, study_file, None)
    places, document = read_places(places_file)
    profile = load_own_profile(study.profile)
    features = map_verdicts(study, site, profile, places, language)
    crs = read_member(document)
    contents = write_verdicts(features, out.name, crs, language)
    require_places(out.parent, contents, asked)
    write_outputs(out.parent, contents, asked)


def _place(asked: Mapping[str, Any]) -> tuple[Path | None, str]:
    """Folder of the outputs, None of none, and the workbook's name."""
    from netdesign.report.page.terrain_page import PAGE_FILE

    if asked["as_json"] and asked["out"] is None:
        return None, ""
    site = asked["out"] or Path(_SITE)
    if site.suffix.lower() != ".xlsx":
        raise UsageRefusal(say("terrain.no_xlsx", file=site.name))
    require_places(site.parent, (site.name, ROWS_FILE, PAGE_FILE), asked)
    return site.parent, site.name


def _measure(
    grid: Path,
    rows: Path,
    folder: Path | None,
    name: str,
    asked: Mapping[str, Any],
) -> None:
    """Measure the rows, tell what was found, and write it."""
    from netdesign.terrain.geojson import list_row_features
    from netdesign.terrain.measure import measure_plan
    from netdesign.terrain.plan import read_plan
    from netdesign.terrain.site_lines import write_workbook

    plan = read_plan(rows)
    ground = read_ground(grid, plan)
    others = _read_types(asked["types"], plan)
    with follow(len(plan.lines), "rows", asked) as on_row:
        surface, measured = measure_plan(
            ground, plan, most=asked["most"], on_row=on_row
        )
    coverage = _cover(surface, plan, measured, asked["standard"])
    features = list_row_features(measured, plan.zones, grid.name, _hash_grid(grid))
    if asked["as_json"]:
        print_document(_describe(features, coverage, surface.noise))
    else:
        _tell_rows(measured, coverage, surface.noise)
    if folder is not None:
        workbook = write_workbook(measured, grid.name, others, speak())
        crs = ground.crs or plan.crs
        files = render_measured(grid, crs, surface, plan, measured, coverage)
        write_outputs(folder, {name: workbook, **files}, asked)


def read_ground(grid: Path, plan: Plan) -> Grid:
    """Elevation grid of a plan; what was noted in reading either is told.

    Raises
    ------
    TerrainError
        If it is none, or in another reference system.
    """
    from netdesign.terrain.crs import require_same
    from netdesign.terrain.grid import read_grid

    ground = read_grid(grid)
    require_same(ground.crs, plan.crs)
    for note in (*ground.notes, *plan.notes):
        tell(note, err=True)
    return ground


def _hash_grid(grid: Path) -> str:
    return hashlib.sha256(grid.read_bytes()).hexdigest()


def render_measured(
    grid: Path,
    crs: str,
    surface: Surface,
    plan: Plan,
    measured: Sequence[MeasuredRow],
    coverage: Coverage,
) -> dict[str, bytes]:
    """Map and page of rows measured on a grid, by the names of their files."""
    from netdesign.report.page.terrain_page import PAGE_FILE, render_terrain
    from netdesign.terrain.geojson import list_row_features, write_features

    origin = (grid.name, _hash_grid(grid))
    features = list_row_features(measured, plan.zones, *origin)
    shown = (surface, plan, measured, coverage, origin, speak())
    return {
        ROWS_FILE: write_features(features, crs),
        PAGE_FILE: render_terrain(*shown),
    }


def _read_types(path: Path | None, plan: Plan) -> Lines | None:
    """Lines of the other sheets; what names rows that the plan lacks is told."""
    from netdesign.terrain.site_lines import read_other_sheets

    if path is None:
        return None
    lines, left_out = read_other_sheets(path, [one.id for one in plan.lines])
    if left_out:
        told = say("terrain.ends_left", file=path.name, rows=left_out)
        tell(say("cli.note", text=told), err=True)
    return lines


def _cover(
    surface: Surface, plan: Plan, rows: Sequence[MeasuredRow], standard: str
) -> Coverage:
    """Coverage of the zones by the profile's distance of rows."""
    from netdesign.checks import load_standard
    from netdesign.checks.geometry import read_reach
    from netdesign.terrain.coverage import find_coverage

    find_reach = read_reach(load_standard(standard))
    if find_reach is None:
        raise UsageRefusal(say("terrain.no_friction", profile=standard))
    reach = {
        row.line.id: find_reach(row.slope.high, row.line.net_height) for row in rows
    }
    return find_coverage(surface, plan, rows, reach)


def _describe(
    features: Sequence[Feature], coverage: Coverage, noise: float
) -> dict[str, Any]:
    return {
        "schema": "netdesign.terrain/1",
        "noise_m": noise,
        "zone_m2": coverage.area,
        "uncovered_m2": coverage.uncovered,
        "rows": [
            one["properties"]
            for one in features
            if one["properties"]["kind"] == "net row"
        ],
    }


def _tell_rows(rows: Sequence[MeasuredRow], coverage: Coverage, noise: float) -> None:
    from netdesign.terrain.measure import (
        LEAST_LENGTH,
        describe_kinks,
        describe_steep_above,
    )

    tell(say("terrain.noise", noise=noise))
    for row in rows:
        end = say(f"terrain.end_{row.upslope.end}", row=row.upslope.row)
        tell(
            say(
                "terrain.row",
                row=row.line.id,
                slope=math.degrees(row.slope.value),
                spread=math.degrees(row.slope.high - row.slope.value),
                aspect=math.degrees(row.aspect),
                length=row.length,
                posts=len(row.posts),
                upslope=row.upslope.length.value,
                end=end,
            )
        )
        if row.upslope.length.value < LEAST_LENGTH:
            tell(say("terrain.flat_row", row=row.line.id))
        for told in filter(None, (describe_kinks(row), describe_steep_above(row))):
            tell(told)
    if coverage.area:
        tell(
            say(
                "terrain.coverage",
                area=coverage.area,
                uncovered=coverage.uncovered,
                share=100.0 * coverage.share,
            )
        )
