"""Rows proposed for a starting zone: measured, sized, checked, priced.

The rows of ``terrain/layout.py`` become a workbook, as ``netdesign terrain`` writes
one, and its study.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType
from typing import Any

from netdesign.checks import Standard
from netdesign.edge.progress import RunProgress
from netdesign.numerics.arrays import Floats
from netdesign.outcome import TerrainError, Verdict
from netdesign.site.model import Site
from netdesign.site.reader import read_site
from netdesign.solving.runner import Runner
from netdesign.study.check_run import CheckRun
from netdesign.study.check_site import judge_solved, solve_rows
from netdesign.study.parts import Prices, add_costs
from netdesign.study.records import Study
from netdesign.study.sizing import SizedCell, size_site
from netdesign.terrain.constructions import Catalogue, put_types
from netdesign.terrain.coverage import Coverage, find_coverage
from netdesign.terrain.grid import Grid
from netdesign.terrain.layout import Task, choose_surface, propose_rows
from netdesign.terrain.measure import MeasuredRow, measure_plan
from netdesign.terrain.plan import Plan
from netdesign.terrain.site_lines import Lines, read_other_sheets, write_workbook
from netdesign.terrain.surface import Surface
from netdesign.words.catalogue import Language, render
from netdesign.words.message import say

SITE_FILE = "site.xlsx"
_ENDS = "Ends"  # sheet of the lines on the ends of rows
_LEFT_OPEN = 0.1  # of the steep ground; a plan that leaves more is not whole [-]
Followed = AbstractContextManager[Callable[[object], None] | None]
_LOOKED_FOR = 50.0  # of snow above a row, as `netdesign terrain` does [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class GivenZone:
    """Inputs of a plan: ground, zones, nets and types, prices, limit profiles."""

    grid: Grid
    grid_file: Path
    zones: Plan
    catalogue: Catalogue
    types: Path
    prices: Prices | None
    standard: Standard
    find_snow: Callable[[Floats], Floats]  # vertical height at places [m]
    find_reach: Callable[[float, float], float]  # by slope and net height [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Proposed:
    """Rows as proposed and as measured, and what of the zones they hold."""

    plan: Plan
    built: Mapping[str, str]  # construction of each row
    surface: Surface
    rows: Sequence[MeasuredRow]
    coverage: Coverage


def propose_layout(given: GivenZone, follow: Callable[[int], Followed]) -> Proposed:
    """Rows for the zones, and the same rows as ``netdesign terrain`` measures them.

    ``follow`` gets the number of rows, and gives what is called after each.

    Raises
    ------
    TerrainError
        If no row has room.
    """
    zones = given.zones.zones
    task = Task(
        surface=choose_surface(given.grid, zones),
        zones=zones,
        constructions=given.catalogue.constructions,
        find_snow=given.find_snow,
        find_reach=given.find_reach,
    )
    rows = propose_rows(task)
    if not rows:
        raise TerrainError(say("layout.no_room"))
    named = {f"R{number}": row for number, row in enumerate(rows, 1)}
    lines = tuple(given.catalogue.draw(row, name) for name, row in named.items())
    plan = replace(given.zones, lines=lines)
    most = max(_LOOKED_FOR, task.farthest)
    with follow(len(lines)) as on_row:
        surface, measured = measure_plan(given.grid, plan, most=most, on_row=on_row)
    reach = {
        row.line.id: given.find_reach(row.slope.high, row.line.net_height)
        for row in measured
    }
    return Proposed(
        plan=plan,
        built={name: row.construction.id for name, row in named.items()},
        surface=surface,
        rows=measured,
        coverage=find_coverage(surface, plan, measured, reach),
    )


def list_lines(given: GivenZone, proposed: Proposed) -> Lines:
    """Lines of the workbook's other sheets, with the ends of the rows."""
    others, _ = read_other_sheets(given.types, ())
    ends = [*others.get(_ENDS, ()), *given.catalogue.list_ends(proposed.built)]
    return {**others, _ENDS: ends}


def write_proposed(given: GivenZone, proposed: Proposed, language: Language) -> bytes:
    """Workbook of the rows, with the types of their constructions."""
    lines, name = list_lines(given, proposed), given.grid_file.name
    return write_workbook(proposed.rows, name, lines, language)


def check_layout(
    given: GivenZone,
    proposed: Proposed,
    workbook: bytes,
    run: CheckRun,
    language: Language,
    runner: Runner,
    watch: RunProgress,
) -> tuple[bytes, Study]:
    """Workbook of the rows with the smallest or cheapest types that pass, its study.

    ``workbook`` is that of `write_proposed`.
    """
    solved = solve_rows(read_workbook(workbook), run, runner, watch)
    (study,) = judge_solved(solved, [given.standard], run, runner, watch)
    read = partial(read_workbook, workbook)
    cells = size_site(solved, study, given.standard, run, read, given.prices)
    lines = list_lines(given, proposed)
    rows, lines = put_types(proposed.rows, lines, *_sort_types(cells, language))
    workbook = write_workbook(rows, given.grid_file.name, lines, language)
    again = solve_rows(read_workbook(workbook), run, runner, watch, solved)
    (study,) = judge_solved(again, [given.standard], run, runner, watch)
    return workbook, study


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


def read_workbook(
    workbook: bytes, instead: Mapping[str, str] = MappingProxyType({})
) -> Site:
    """Site of a workbook, with other texts in some of its cells."""
    with TemporaryDirectory() as folder:
        place = Path(folder) / SITE_FILE
        place.write_bytes(workbook)
        return read_site(place, instead=instead)


def describe_layout(
    given: GivenZone, proposed: Proposed, study: Study
) -> dict[str, Any]:
    """The plan as a document: its rows with their verdicts, its sums, its cost."""
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
