"""The workbook with a sheet Nets that has a column for each input of a row."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from netdesign.site.cells.cells import Workbook
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import (
    ANCHORS,
    DECLARED,
    ENDS,
    LINKS,
    MONITORING,
    NETS,
    POSTS,
    PROJECT,
    RANGES,
    ROPES,
    SHEETS,
    SNOW,
    TESTS,
    UNCERTAINTY,
    WINTER,
)
from netdesign.site.content import Content
from netdesign.site.headings import Table
from netdesign.site.lines import (
    Lines,
    index_lines,
    refuse_unknown_ids,
    spread_over_rows,
)
from netdesign.site.project_sheet import read_project
from netdesign.site.ranges import (
    RangesSheet,
    add_answered_ranges,
    build_ranges,
    free_columns,
)
from netdesign.site.readings import Row
from netdesign.site.snow_sheets import read_layers
from netdesign.site.tables import find_table, find_tables, read_rows
from netdesign.site.titles import is_absent
from netdesign.site.type_lines import count_in_tests, name_by_ground, place_in_ground
from netdesign.site.type_sheets import read_types
from netdesign.words.message import say

_TYPE_PLANS = (ANCHORS, ROPES, POSTS)


def read_nets_workbook(workbook: Workbook, findings: list[Finding]) -> Content:
    """Read all sheets; faults go to ``findings``."""
    project, of_project = read_project(workbook, findings)
    workbook = add_answered_ranges(workbook)
    tables, nets, ranges = _find_tables(workbook, findings)
    typed = [line for table in nets for line in read_rows(table, findings)]
    lines = _read_lines(workbook, tables, typed, ranges, findings)
    further = (MONITORING.name, WINTER.name, UNCERTAINTY.name)
    return Content(
        workbook=workbook,
        project=project,
        project_cells=of_project,
        lines=lines,
        nets=nets[0] if nets else None,
        declared=read_rows(tables[DECLARED.name], findings),
        further={name: tables[name] for name in further},
    )


def _find_tables(
    workbook: Workbook, findings: list[Finding]
) -> tuple[Mapping[str, Table | None], tuple[Table, ...], RangesSheet]:
    """Tables by the name of their sheet, those of net rows, and what ranges.

    Sheet Nets needs less where something ranges.
    """
    told: list[Finding] = []
    table = find_table(workbook, RANGES, told)
    ranges = replace(build_ranges(table, told), findings=told)
    plan = free_columns(NETS, ranges.ends)
    others = [one for one in SHEETS if one not in (NETS, RANGES, PROJECT)]
    tables = {plan.name: find_table(workbook, plan, findings) for plan in others}
    nets = find_tables(workbook, plan, findings)
    return {RANGES.name: table, **tables}, nets, ranges


def _read_lines(
    workbook: Workbook,
    tables: Mapping[str, Table | None],
    nets: list[Row],
    ranges: RangesSheet,
    findings: list[Finding],
) -> Lines:
    snow = read_layers(tables[SNOW.name], findings)
    ends = read_rows(tables[ENDS.name], findings)
    ends = spread_over_rows(ends, [row["id"].word for row in nets])
    anchors = read_rows(tables[ANCHORS.name], findings)
    tests = read_rows(tables[TESTS.name], findings)
    if tests:
        anchors = count_in_tests(anchors, tests, findings)
    grounds = {
        row["id"].word: row["ground"] for row in nets if row["ground"].state == "given"
    }
    nets, made = place_in_ground(nets, anchors, grounds, findings)
    ends, more = place_in_ground(ends, anchors, grounds, findings)
    made += [one for one in more if one["id"].word not in {m["id"].word for m in made}]
    types = _read_all_types(tables, [*name_by_ground(anchors), *made], findings)
    lines = Lines(
        nets=nets,
        ends=index_lines(ends, "row", say("ends.one_line"), findings),
        snow=snow,
        types={sheet: found or {} for sheet, found in types.items()},
        absent=[plan.name for plan in _TYPE_PLANS if is_absent(workbook, plan)],
        unreadable=[sheet for sheet, found in types.items() if found is None],
        ranges=ranges,
        links=read_rows(tables[LINKS.name], findings),
        tests=tests,
    )
    if nets:
        for lines_of in snow.values():
            refuse_unknown_ids([lines_of[0]["row"]], lines.places, findings)
        named = (one["row"] for one in lines.ends.values())
        refuse_unknown_ids(named, lines.places, findings)
    return lines


def _read_all_types(
    tables: Mapping[str, Table | None], anchors: list[Row], findings: list[Finding]
) -> dict[str, dict[str, Row] | None]:
    """Lines of the sheets of types by id; None of a sheet whose ids cannot be read."""
    of_types = {
        ANCHORS.name: anchors,
        ROPES.name: read_rows(tables[ROPES.name], findings),
        POSTS.name: read_rows(tables[POSTS.name], findings),
    }
    return {
        sheet: read_types(tables[sheet], rows, findings)
        for sheet, rows in of_types.items()
    }
