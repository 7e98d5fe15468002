"""``netdesign layout``: rows proposed for a starting zone, checked, with their cost."""

from __future__ import annotations

import json
import math
import os
import shlex
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
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
from netdesign.outcome import TerrainError, Verdict
from netdesign.words.catalogue import Language, render
from netdesign.words.message import say

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from netdesign.checks import Standard
    from netdesign.numerics.arrays import Floats
    from netdesign.site.model import Site
    from netdesign.study.cost import Prices
    from netdesign.study.records import Study
    from netdesign.study.sizing import SizedCell
    from netdesign.terrain.constructions import Catalogue
    from netdesign.terrain.coverage import Coverage
    from netdesign.terrain.grid import Grid
    from netdesign.terrain.measure import MeasuredRow
    from netdesign.terrain.plan import Plan
    from netdesign.terrain.site_lines import Lines
    from netdesign.terrain.surface import Surface

DEFAULT_FOLDER = "netdesign-layout"
_GUIDELINE = "swiss-guideline-2007"
_SITE, _DRAWN, _PLAN = "site.xlsx", "plan.geojson", "plan.json"
_ENDS = "Ends"  # sheet of the lines on the ends of rows
_LEFT_OPEN = 0.1  # of the steep ground; a plan that leaves more is not whole [-]
_EXAMPLE_SNOW = 3.2  # vertical [m]
_LOOKED_FOR = 50.0  # of snow above a row, as `terrain` does [m]
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

    folder: Path = asked["out"] or Path(DEFAULT_FOLDER)
    names = (_SITE, ROWS_FILE, _DRAWN, _PLAN, STUDY_FILE, PAGE_FILE)
    require_places(folder, names, asked)
    if asked["example"]:
        if grid is not None or asked["types"] or asked["prices"]:
            raise UsageRefusal(say("layout.example_alone"))
        from netdesign.terrain.example import write_example

        files = write_example(folder, overwrite=asked["force"])
        asked |= dict(zip(("grid", "zone", "types", "prices"), files, strict=True))
        if asked["snow"] is None and asked["snow_grid"] is None:
            asked["snow"] = _EXAMPLE_SNOW
        grid, zone = asked["grid"], asked["zone"]
    if grid is None or zone is None or asked["types"] is None:
        raise UsageRefusal(say("layout.no_input"))
    task = _read(grid, zone, asked)
    proposed = _propose(task, asked)
    workbook, study, failed = _check(task, proposed, asked)
    document = _describe(task, proposed, study)
    contents = _render(task, proposed, study, document)
    write_outputs(folder, {_SITE: workbook, **contents}, asked)
    if asked["as_json"]:
        print_document(document)
    else:
        _tell_plan(document, study, proposed)
    raise SystemExit(failed or EXIT_CODES[Verdict(document["verdict"])])


@dataclass(frozen=True, slots=True, kw_only=True)
class _Given:
    """Inputs of a plan: ground, zones, nets and types, prices, limit profiles."""

    grid: Grid
    grid_file: Path
    zones: Plan
    catalogue: Catalogue
    types: Path
    prices: Prices | None
    standard: Standard
    friction: float  # of the ground, tan phi [-]
    cap: float | None  # on the distance over the net height [-]
    find_snow: Callable[[Floats], Floats]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Proposed:
    """Rows as proposed and as measured, and what of the zones they hold."""

    plan: Plan
    built: Mapping[str, str]  # construction of each row
    surface: Surface
    rows: Sequence[MeasuredRow]
    coverage: Coverage


def _read(grid: Path, zone: Path, asked: Mapping[str, Any]) -> _Given:
    from netdesign.checks import load_standard
    from netdesign.checks.schema import GROUND_FRICTION, SPACING_CAP
    from netdesign.terrain.constructions import read_catalogue
    from netdesign.terrain.plan import read_zones

    spacing = load_standard(asked["spacing_standard"])
    friction, cap = spacing.find(GROUND_FRICTION), spacing.find(SPACING_CAP)
    if friction is None:
        raise UsageRefusal(say("terrain.no_friction", profile=spacing.id))
    zones = read_zones(zone)
    ground = read_ground(grid, zones)
    return _Given(
        grid=ground,
        grid_file=grid,
        zones=zones,
        catalogue=read_catalogue(asked["types"]),
        types=asked["types"],
        prices=_read_prices(asked),
        standard=load_standard(asked["standard"]),
        friction=friction.value,
        cap=cap.value if cap else None,
        find_snow=_choose_snow(ground, asked),
    )


def _read_prices(asked: Mapping[str, Any]) -> Prices | None:
    from netdesign.files.prices import read_prices
    from netdesign.terrain.constructions import list_types

    if asked["prices"] is None:
        return None
    return read_prices(asked["prices"], list_types(asked["types"]))


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


def _propose(given: _Given, asked: Mapping[str, Any]) -> _Proposed:
    """Rows for the zones, and the same rows as ``netdesign terrain`` measures them."""
    from netdesign.checks.geometry import compute_largest_row_spacing
    from netdesign.terrain.coverage import find_coverage
    from netdesign.terrain.layout import Task, choose_surface, propose_rows
    from netdesign.terrain.measure import measure_plan

    def find_reach(slope: float, net_height: float) -> float:
        cap = (
            math.inf if given.cap is None else given.cap * net_height / math.cos(slope)
        )
        return min(cap, compute_largest_row_spacing(slope, net_height, given.friction))

    zones = given.zones.zones
    task = Task(
        surface=choose_surface(given.grid, zones),
        zones=zones,
        constructions=given.catalogue.constructions,
        find_snow=given.find_snow,
        find_reach=find_reach,
    )
    rows = propose_rows(task)
    if not rows:
        raise TerrainError(say("layout.no_room"))
    named = {f"R{number}": row for number, row in enumerate(rows, 1)}
    lines = tuple(given.catalogue.draw(row, name) for name, row in named.items())
    plan = replace(given.zones, lines=lines)
    with follow(len(lines), "rows", asked) as on_row:
        surface, measured = measure_plan(
            given.grid, plan, most=max(_LOOKED_FOR, task.farthest), on_row=on_row
        )
    reach = {
        row.line.id: find_reach(row.slope.high, row.line.net_height) for row in measured
    }
    return _Proposed(
        plan=plan,
        built={name: row.construction.id for name, row in named.items()},
        surface=surface,
        rows=measured,
        coverage=find_coverage(surface, plan, measured, reach),
    )


def _check(
    given: _Given, proposed: _Proposed, asked: Mapping[str, Any]
) -> tuple[bytes, Study, int]:
    """Workbook of the rows with the types that pass, its study, exit code of faults."""
    from netdesign.coupling.scene import SolverSettings
    from netdesign.study.check_run import CheckRun
    from netdesign.study.check_site import judge_solved, solve_rows
    from netdesign.study.sizing import size_site
    from netdesign.terrain.constructions import put_types
    from netdesign.terrain.site_lines import read_other_sheets, write_workbook

    others, _ = read_other_sheets(given.types, ())
    ends = [*others.get(_ENDS, ()), *given.catalogue.list_ends(proposed.built)]
    lines: Lines = {**others, _ENDS: ends}
    name, language = given.grid_file.name, asked["language"]
    run = CheckRun(
        settings=SolverSettings(accuracy=asked["accuracy"]),
        jobs=asked["jobs"] or os.cpu_count() or 1,
        command=_name_check(asked),
        started=format_time(),
    )
    workbook = write_workbook(proposed.rows, name, lines, language)
    site = _read_site(workbook, {})
    with open_run(site, run, asked, 2) as (runner, watch):
        solved = solve_rows(site, run, runner, watch)
        (study,) = judge_solved(solved, [given.standard], run, runner, watch)
        read = partial(_read_site, workbook)
        cells = size_site(solved, study, given.standard, run, read, given.prices)
        rows, lines = put_types(proposed.rows, lines, *_sort_types(cells, language))
        workbook = write_workbook(rows, name, lines, language)
        again = solve_rows(_read_site(workbook, {}), run, runner, watch, solved)
        (study,) = judge_solved(again, [given.standard], run, runner, watch)
    return workbook, study, print_faults(runner.faults)


def _name_check(asked: Mapping[str, Any]) -> str:
    """Command that makes the plan's study again, from its workbook."""
    words = ["netdesign", "check", _SITE, "--standard", asked["standard"]]
    return shlex.join([*words, "--accuracy", f"{asked['accuracy']:g}"])


def _sort_types(
    cells: Sequence[SizedCell], language: Language
) -> tuple[dict[str, dict[str, str]], dict[str, dict[str, str]]]:
    """Types by row and column, of sheet Nets and of sheet Ends."""
    of_nets: dict[str, dict[str, str]] = {}
    of_ends: dict[str, dict[str, str]] = {}
    nets = render(say("sheet.Nets"), language)
    for one in cells:
        if one.now:
            found = of_nets if one.cell.startswith(f"{nets}!") else of_ends
            found.setdefault(one.row_id, {})[one.column] = one.now
    return of_nets, of_ends


def _read_site(workbook: bytes, instead: Mapping[str, str]) -> Site:
    from netdesign.site.reader import read_site

    with TemporaryDirectory() as folder:
        place = Path(folder) / _SITE
        place.write_bytes(workbook)
        return read_site(place, instead=instead)


def _describe(given: _Given, proposed: _Proposed, study: Study) -> dict[str, Any]:
    """The plan as a document: its rows with their verdicts, its sums, its cost."""
    from netdesign.study.cost import add_costs

    rows, costs, unknown = [], [], dict[str, None]()
    for row, checked in zip(proposed.rows, study.rows, strict=True):
        one = {
            "id": row.line.id,
            "net": proposed.built[row.line.id],
            "length_m": round(row.length, 2),
            "posts": len(row.posts),
            "post_spacing_m": round(row.line.post_spacing, 3),
            "snow_height_m": round(float(row.line.cells["snow_height"]), 3),
            "upslope_length_m": round(row.upslope.length.high, 2),
            "verdict": str(checked.verdict),
        }
        if given.prices is not None:
            cost, left_out = add_costs(checked.parts, given.prices)
            costs.append(cost)
            unknown |= dict.fromkeys(left_out)
            one["cost"] = round(cost, 2)
        rows.append(one)
    is_covered = proposed.coverage.share <= _LEFT_OPEN
    is_open = not is_covered and study.verdict is not Verdict.FAIL
    found: dict[str, Any] = {
        "schema": "netdesign.layout/1",
        "verdict": str(Verdict.NOT_PROVEN if is_open else study.verdict),
        "is_covered": is_covered,
        "length_m": round(sum(row.length for row in proposed.rows), 2),
        "posts": sum(len(row.posts) for row in proposed.rows),
        "zone_m2": proposed.coverage.area,
        "uncovered_m2": proposed.coverage.uncovered,
        "rows": rows,
    }
    if given.prices is not None:
        found["cost"] = round(sum(costs), 2)
        found["without_cost"] = list(unknown)
    return found


def _render(
    given: _Given, proposed: _Proposed, study: Study, document: Mapping[str, Any]
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


def _tell_plan(document: Mapping[str, Any], study: Study, proposed: _Proposed) -> None:
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
    print_summary(study, open_console(), speak())
