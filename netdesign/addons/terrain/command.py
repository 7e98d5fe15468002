"""``netdesign terrain``: net rows on an elevation grid, as a site workbook."""

from __future__ import annotations

import hashlib
import math
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import refuse_without, take_options
from netdesign.commands.running import (
    UsageRefusal,
    follow,
    print_document,
    require_places,
    speak,
    tell,
    write_outputs,
)
from netdesign.outcome import TerrainError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from netdesign.addons.terrain.coverage import Coverage
    from netdesign.addons.terrain.geojson import Feature
    from netdesign.addons.terrain.grid import Grid
    from netdesign.addons.terrain.measure import MeasuredRow
    from netdesign.addons.terrain.plan import Plan
    from netdesign.addons.terrain.surface import Surface

_SITE, _ROWS_FILE, _PAGE_FILE = "site.xlsx", "rows.geojson", "terrain.html"
_LIBRARIES = ("rasterio", "pyogrio", "shapely", "contourpy", "ezdxf")


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
    are columns of sheets Rows and Net types: id, net height, post spacing and any
    other. Each derived cell has a note with its band and its stretch. The map of
    verdicts is GeoJSON or a drawing (.dxf). It needs
    pip install "netdesign[terrain]".
    """
    if any(find_spec(library) is None for library in _LIBRARIES):
        message = 'terrain needs additional packages: pip install "netdesign[terrain]"'
        raise TerrainError(message)
    if asked["study_file"] is not None:
        _map_study(asked["study_file"], asked["places_file"], asked)
        return
    refuse_without(("places_file",), "--verdicts")
    folder, site = _place(asked)
    if asked["example"]:
        if grid is not None or folder is None:
            message = "--example has a grid and rows of its own, and writes files"
            raise UsageRefusal(message)
        from netdesign.addons.terrain.example import write_example

        grid, rows, asked["types"] = write_example(folder, overwrite=asked["force"])
    if grid is None or rows is None:
        raise UsageRefusal("give a grid and rows, or --example")
    _measure(grid, rows, folder, site, asked)


def _map_study(
    study_file: Path, places_file: Path | None, asked: Mapping[str, Any]
) -> None:
    """Verdicts and anchors of a stored study on the map."""
    from netdesign.addons.terrain.geojson import read_places
    from netdesign.addons.terrain.verdict_map import (
        FORMATS,
        map_verdicts,
        write_verdicts,
    )
    from netdesign.commands.report import require_inputs
    from netdesign.study.document import load_study

    out, language = asked["out"], speak()
    if places_file is None or out is None:
        message = "--verdicts needs --rows ROWS.geojson and --out OUT.geojson or .dxf"
        raise UsageRefusal(message)
    if out.suffix.lower() not in FORMATS:
        message = f"{out.name}: the map of verdicts ends in {' or '.join(FORMATS)}"
        raise UsageRefusal(message)
    study = load_study(study_file)
    inputs = require_inputs(study, study_file, {})
    tell("not verified: values as stored, not solved again")
    places, document = read_places(places_file)
    features = map_verdicts(study, inputs.site, inputs.profile, places, language)
    contents = write_verdicts({**document, "features": features}, out.name, language)
    require_places(out.parent, contents, asked)
    write_outputs(out.parent, contents, asked)


def _place(asked: Mapping[str, Any]) -> tuple[Path | None, str]:
    """Folder of the outputs, None of none, and the workbook's name."""
    if asked["as_json"] and asked["out"] is None:
        return None, ""
    site = asked["out"] or Path(_SITE)
    if site.suffix.lower() != ".xlsx":
        raise UsageRefusal(f"{site.name}: the site workbook is an xlsx file")
    require_places(site.parent, (site.name, _ROWS_FILE, _PAGE_FILE), asked)
    return site.parent, site.name


def _measure(
    grid: Path,
    rows: Path,
    folder: Path | None,
    name: str,
    asked: Mapping[str, Any],
) -> None:
    """Measure the rows, print the results, and write workbook, map and page."""
    from netdesign.addons.terrain.geojson import list_row_features, write_features
    from netdesign.addons.terrain.measure import measure_plan
    from netdesign.addons.terrain.page import render_terrain
    from netdesign.addons.terrain.plan import read_plan
    from netdesign.addons.terrain.site_lines import (
        TypedSheets,
        read_typed_sheets,
        write_workbook,
    )

    plan = read_plan(rows)
    ground = _read_ground(grid, plan)
    others = read_typed_sheets(asked["types"]) if asked["types"] else TypedSheets()
    with follow(len(plan.lines), "rows", asked) as on_row:
        surface, measured = measure_plan(
            ground, plan, most=asked["most"], on_row=on_row
        )
    coverage = _cover(surface, plan, measured, asked["standard"])
    origin = grid.name, hashlib.sha256(grid.read_bytes()).hexdigest()
    features = list_row_features(measured, plan.zones, *origin)
    if asked["as_json"]:
        print_document(_describe(features, coverage, surface.noise))
    else:
        _tell_rows(measured, coverage, surface.noise)
    if folder is not None:
        files = {
            name: write_workbook(measured, grid.name, others, speak()),
            _ROWS_FILE: write_features(features, ground.crs or plan.crs),
            _PAGE_FILE: render_terrain(surface, plan, measured, coverage, origin),
        }
        write_outputs(folder, files, asked)


def _read_ground(grid: Path, plan: Plan) -> Grid:
    """Elevation grid of a plan; remarks on both files are printed."""
    from netdesign.addons.terrain.grid import read_grid, require_same

    ground = read_grid(grid)
    require_same(ground.crs, plan.crs)
    if ground.bands > 1:
        message = f"The grid has {ground.bands} bands: the first one is read as heights"
        tell(message, err=True)
    if plan.unread:
        names = ", ".join(plan.unread)
        tell(f"No columns of Rows or Net types, left out: {names}", err=True)
    return ground


def _cover(
    surface: Surface, plan: Plan, rows: Sequence[MeasuredRow], standard: str
) -> Coverage:
    """Coverage of the zones by the profile's distance of rows."""
    from netdesign.addons.terrain.coverage import find_coverage
    from netdesign.checks import load_standard
    from netdesign.checks.geometry import read_reach

    find_reach = read_reach(load_standard(standard))
    if find_reach is None:
        message = f"profile {standard} does not say how far apart rows may stand"
        raise UsageRefusal(f"{message}: name another one with --standard")
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
            feature["properties"]
            for feature in features
            if feature["properties"]["kind"] == "net row"
        ],
    }


def _tell_rows(rows: Sequence[MeasuredRow], coverage: Coverage, noise: float) -> None:
    from netdesign.addons.terrain.measure import (
        LEAST_LENGTH,
        describe_end,
        describe_kinks,
        describe_steep_above,
    )

    tell(f"Noise of the grid: {noise:.2g} m")
    for row in rows:
        name, slope = row.line.id, math.degrees(row.slope.value)
        spread = math.degrees(row.slope.high) - slope
        length = row.upslope.length.value
        tell(
            f"{name}: slope {slope:.1f}° ± {spread:.1f}°, aspect "
            f"{math.degrees(row.aspect):.0f}°, {len(row.posts)} posts on "
            f"{row.length:.1f} m; upslope length {length:.1f} m, "
            f"{describe_end(row.upslope)}"
        )
        if length < LEAST_LENGTH:
            message = f"Row {name} stands on ground flatter than 25°: its cell of the"
            tell(f"{message} upslope length is left empty")
        for sentence in filter(None, (describe_kinks(row), describe_steep_above(row))):
            tell(sentence)
    if coverage.area:
        tell(coverage.sentence)
