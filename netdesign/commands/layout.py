"""``netdesign layout``: rows proposed for a starting zone, checked, with their cost."""

from __future__ import annotations

import json
import math
import os
import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import (
    take_options,
)
from netdesign.commands.running import (
    EXIT_CODES,
    follow,
    format_time,
    open_run,
    print_document,
    print_faults,
    require_places,
    write_outputs,
)
from netdesign.commands.terrain import ROWS_FILE, read_ground, render_measured
from netdesign.commands.usage import UsageRefusal, speak, tell
from netdesign.edge.output import STUDY_FILE
from netdesign.outcome import Verdict
from netdesign.words.message import say

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from netdesign.numerics.arrays import Floats
    from netdesign.study.layout import GivenZone, Proposed
    from netdesign.study.records import Study
    from netdesign.terrain.grid import Grid

DEFAULT_FOLDER = "netdesign-layout"
_SITE, _DRAWN, _PLAN = "site.xlsx", "plan.geojson", "plan.json"
_EXAMPLE_SNOW = 3.2  # vertical [m]
_FILE = click.Path(path_type=Path, dir_okay=False)


@click.command()
@click.argument("grid", required=False, type=_FILE)
@click.argument("zone", required=False, type=_FILE)
@take_options("layout")
def layout(grid: Path | None, zone: Path | None, **asked: Any) -> None:
    """Propose net rows for a starting zone, and check each of them.

    \b
    netdesign layout --example
    netdesign layout grid.asc zone.geojson --types types.xlsx --snow 3.8
    netdesign layout grid.asc zone.geojson --types types.xlsx --snow-grid snow.tif
    netdesign layout grid.asc zone.geojson --types types.xlsx --prices prices.csv

    Rows of 12 to 60 m follow the contours, as far apart as the guideline allows on the
    steepest slope between them. Each has the lowest net of sheet Nets that is as high
    as its snow, and the smallest or cheapest types of the workbook that pass.
    """
    from netdesign.report.page.terrain_page import PAGE_FILE
    from netdesign.study.layout import describe_layout, propose_layout

    folder: Path = asked["out"] or Path(DEFAULT_FOLDER)
    names = (_SITE, ROWS_FILE, _DRAWN, _PLAN, STUDY_FILE, PAGE_FILE)
    require_places(folder, names, asked)
    if asked["example"]:
        if grid is not None or asked["types"] or asked["prices"]:
            raise UsageRefusal(say("layout.example_alone"))
        from netdesign.terrain.example import write_example

        files = write_example(folder, overwrite=asked["force"])
        grid, zone, asked["types"], asked["prices"] = files
        if asked["snow"] is None and asked["snow_grid"] is None:
            asked["snow"] = _EXAMPLE_SNOW
    if grid is None or zone is None or asked["types"] is None:
        raise UsageRefusal(say("layout.no_input"))
    task = _read(grid, zone, asked)
    proposed = propose_layout(task, lambda count: follow(count, "rows", asked))
    workbook, study, failed = _check(task, proposed, asked)
    document = describe_layout(task, proposed, study)
    contents = _render(task, proposed, study, document)
    write_outputs(folder, {_SITE: workbook, **contents}, asked)
    if asked["as_json"]:
        print_document(document)
    else:
        _tell_plan(document, study, proposed, folder / _SITE)
    raise SystemExit(failed or EXIT_CODES[Verdict(document["verdict"])])


def _read(grid: Path, zone: Path, asked: Mapping[str, Any]) -> GivenZone:
    from netdesign.checks import load_standard
    from netdesign.checks.geometry import read_reach
    from netdesign.files.prices import read_prices
    from netdesign.study.layout import GivenZone
    from netdesign.terrain.constructions import list_types, read_catalogue
    from netdesign.terrain.plan import read_zones

    spacing = load_standard(asked["spacing_standard"])
    find_reach = read_reach(spacing)
    if find_reach is None:
        raise UsageRefusal(say("terrain.no_friction", profile=spacing.id))
    zones = read_zones(zone)
    ground = read_ground(grid, zones)
    return GivenZone(
        grid=ground,
        grid_file=grid,
        zones=zones,
        catalogue=read_catalogue(asked["types"]),
        types=asked["types"],
        prices=asked["prices"]
        and read_prices(asked["prices"], list_types(asked["types"])),
        standard=load_standard(asked["standard"]),
        find_snow=_choose_snow(ground, asked),
        find_reach=find_reach,
    )


def _choose_snow(ground: Grid, asked: Mapping[str, Any]) -> Callable[[Floats], Floats]:
    """Vertical snow height at places, by a grid, or by a height at an altitude."""
    from netdesign.terrain.crs import require_same
    from netdesign.terrain.grid import read_grid
    from netdesign.terrain.snow_height import follow_altitude, read_heights

    height, altitude = asked["snow"], asked["snow_altitude"]
    gradient = asked["snow_gradient"]
    if (height is None) is (asked["snow_grid"] is None):
        raise UsageRefusal(say("layout.snow"))
    if (altitude is None) is not (gradient is None) or (height is None and gradient):
        raise UsageRefusal(say("layout.gradient"))
    given = [one for one in (height, altitude, gradient) if one is not None]
    if not all(map(math.isfinite, given)):
        raise UsageRefusal(say("layout.no_number"))
    if height is None:
        snow = read_grid(asked["snow_grid"])
        require_same(ground.crs, snow.crs)
        return read_heights(snow, asked["snow_grid"].name)
    if gradient is None:
        return follow_altitude(ground, height, 0.0, 0.0)
    return follow_altitude(ground, height, altitude, gradient / 100.0)


def _check(
    given: GivenZone, proposed: Proposed, asked: Mapping[str, Any]
) -> tuple[bytes, Study, int]:
    """Workbook of the rows with the types that pass, its study, exit code of faults."""
    from netdesign.coupling.scene import SolverSettings
    from netdesign.study.check_run import CheckRun
    from netdesign.study.layout import check_layout, read_workbook, write_proposed

    run = CheckRun(
        settings=SolverSettings(accuracy=asked["accuracy"]),
        jobs=asked["jobs"] or os.cpu_count() or 1,
        command=_name_check(asked),
        started=format_time(),
    )
    language = asked["language"]
    bare = write_proposed(given, proposed, language)
    with open_run(read_workbook(bare), run, asked, 2) as (runner, watch):
        workbook, study = check_layout(
            *(given, proposed, bare, run), *(language, runner, watch)
        )
    return workbook, study, print_faults(runner.faults)


def _name_check(asked: Mapping[str, Any]) -> str:
    """Command that makes the plan's study again, from its workbook."""
    words = ["netdesign", "check", _SITE, "--standard", asked["standard"]]
    return shlex.join([*words, "--accuracy", f"{asked['accuracy']:g}"])


def _render(
    given: GivenZone, proposed: Proposed, study: Study, document: Mapping[str, Any]
) -> dict[str, bytes]:
    """Contents of all files but the workbook, by their names."""
    from netdesign.study.document import write_document
    from netdesign.terrain.geojson import list_drawn_features, write_features

    crs = given.grid.crs or given.zones.crs
    drawn = list_drawn_features(proposed.plan, speak())
    return {
        _DRAWN: write_features(drawn, crs),
        _PLAN: (json.dumps(document, indent=1) + "\n").encode(),
        STUDY_FILE: write_document(study).encode(),
        **render_measured(
            *(given.grid_file, crs, proposed.surface, proposed.plan),
            *(proposed.rows, proposed.coverage),
        ),
    }


def _tell_plan(
    document: Mapping[str, Any], study: Study, proposed: Proposed, site: Path
) -> None:
    from netdesign.report.terminal import open_console, print_summary
    from netdesign.terrain.measure import describe_kinks, describe_steep_above

    for row in document["rows"]:
        keys = ("length_m", "posts", "upslope_length_m")
        shown = {key: row[key] for key in keys}
        tell(say("layout.row", row=row["id"], net=row["net"], **shown))
    for one in proposed.rows:
        for told in filter(None, (describe_kinks(one), describe_steep_above(one))):
            tell(told)
    of_sums = ("length_m", "posts", "zone_m2", "uncovered_m2")
    sums = {key: document[key] for key in of_sums}
    tell(say("layout.sums", rows=len(document["rows"]), **sums))
    if "cost" in document:
        tell(say("layout.cost", cost=document["cost"]))
    if document.get("without_cost"):
        types = tuple(document["without_cost"])
        tell(say("layout.without_cost", types=types))
    if not document["is_covered"]:
        tell(say("layout.not_covered"))
    print_summary(study, open_console(), speak(), check_of=str(site))
