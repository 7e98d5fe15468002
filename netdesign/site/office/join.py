"""The input workbook as lines of a site, each reading with the cell it came from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from netdesign.site.cells.cells import Workbook
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import FURTHER
from netdesign.site.columns.office import load_plan
from netdesign.site.lines import (
    TYPES,
    Lines,
    index_lines,
    refuse_unknown_ids,
    settle_ids,
)
from netdesign.site.office.library import Library, add_lines
from netdesign.site.office.project import build_project, build_ranges, read_lines
from netdesign.site.office.rows import join_rows, measure_layers, measure_slack
from netdesign.site.office.sheets import OfficeTables
from netdesign.site.office.types import (
    complete_anchors,
    join_anchors,
    join_posts,
    list_end_types,
    measure_links,
)
from netdesign.site.readings import Row
from netdesign.site.snow_sheets import order_layers
from netdesign.site.support_types import TYPE_COLUMNS
from netdesign.site.tables import find_table
from netdesign.site.type_lines import name_by_ground, place_in_ground
from netdesign.site.type_resistances import check_ends
from netdesign.words.message import say


def read_office(
    workbook: Workbook,
    tables: OfficeTables,
    findings: list[Finding],
    library: Library | None = None,
) -> Lines:
    """Join all tables to lines of a site; faults go to ``findings``.

    Parameters
    ----------
    workbook : Workbook
        As read.
    tables : OfficeTables
        Of the workbook.
    findings : list of Finding
        Appended to.
    library : Library, optional
        Net types and parts of another workbook.
    """
    typed = _read_typed(tables, findings)
    by_key = dict(tables.tables)
    if library:
        typed = add_lines(typed, _read_typed(library.tables, findings), findings)
        others = library.tables.tables
        by_key |= {key: table or others.get(key) for key, table in by_key.items()}
        tables = replace(tables, tables=by_key)
    typed = _settle_all(typed)
    project = read_lines(by_key["project"], typed["project"], findings)
    lines = _join(workbook, tables, typed, project, findings)
    return replace(
        lines, library=(library.file, library.sha256) if library else ("", "")
    )


def _read_typed(tables: OfficeTables, findings: list[Finding]) -> dict[str, list[Row]]:
    """Lines by table, each number as what its unit cell says that it measures."""
    lines = {key: list(rows) for key, rows in tables.lines.items()}
    measure = tables.find_measure("net_types", "slack")
    lines["net_types"] = [
        measure_slack(net, measure, findings) for net in lines["net_types"]
    ]
    measure = tables.find_measure("layers", "thickness")
    lines["layers"] = measure_layers(lines.get("layers", ()), measure, findings)
    lines["links"] = measure_links(lines["links"])
    return lines


def _settle_all(lines: Mapping[str, list[Row]]) -> dict[str, list[Row]]:
    """Lines whose ids are spelt as their own sheet has them."""
    settled = dict(lines)
    ids = {
        table: [word for line in lines[table] if (word := line["id"].word)]
        for table in ("rows", "net_types", *TYPES)
    }
    for table in lines:
        for field in load_plan(table).fields:
            spellings = ids.get(field.refers_to, ())
            settled[table] = settle_ids(settled[table], spellings, field.key)
    anchors_and_ropes = [*ids["anchor_types"], *ids["ropes"]]  # at whose end a link is
    settled["links"] = settle_ids(settled["links"], anchors_and_ropes, "type")
    return settled


def _join(
    workbook: Workbook,
    tables: OfficeTables,
    typed: Mapping[str, Sequence[Row]],
    project: Row,
    findings: list[Finding],
) -> Lines:
    """Lines of net rows and their types, of the lines of all sheets."""
    by_key = tables.tables
    rows = _join_net_types(tables, typed, project, findings)
    layers = order_layers(typed["layers"], findings)
    anchors = join_anchors(typed, project, findings)
    placed = place_in_ground(rows, anchors, findings)
    ends = place_in_ground(_find_end_types(rows, typed), anchors, findings)
    for rope in typed["ropes"]:
        check_ends(rope, findings)
    joined = _join_types(typed, anchors, project, findings)
    types = {
        key: _index(joined[key], findings) if by_key[key] else {} for key in joined
    }
    named, cells = build_project(project)
    lines = Lines(
        workbook=workbook,
        project=named,
        project_cells=cells,
        table=by_key["rows"],
        rows=placed,
        ends={row["id"].word: end for row, end in zip(rows, ends, strict=True)},
        snow=layers,
        types=types,
        ranges=build_ranges(project),
        further={plan.name: find_table(workbook, plan, findings) for plan in FURTHER},
        typed=typed,
    )
    named_rows = (of_row[0]["row"] for of_row in layers.values())
    refuse_unknown_ids(named_rows, lines.places, findings)
    return lines


def _join_types(
    typed: Mapping[str, Sequence[Row]],
    anchors: Sequence[Row],
    project: Row,
    findings: list[Finding],
) -> dict[str, Sequence[Row]]:
    """Lines of types by their sheets, each complete."""
    return {
        "anchor_types": complete_anchors(name_by_ground(anchors), findings),
        "ropes": typed["ropes"],
        "posts": join_posts(typed["posts"], project, typed["net_types"]),
    }


def _join_net_types(
    tables: OfficeTables,
    typed: Mapping[str, Sequence[Row]],
    project: Row,
    findings: list[Finding],
) -> list[Row]:
    """Rows with their net types; a net type without a line is refused."""
    nets = _index(typed["net_types"], findings)
    places = {name: net["id"].place for name, net in nets.items()}
    refuse_unknown_ids((row["net_type"] for row in typed["rows"]), places, findings)
    measure = tables.find_measure("rows", "snow")
    return join_rows(typed["rows"], nets, project, measure, findings)


def _index(lines: Sequence[Row], findings: list[Finding]) -> dict[str, Row]:
    return index_lines(lines, "id", say("nets.ids_once"), findings)


def _find_end_types(
    rows: Sequence[Row], typed: Mapping[str, Sequence[Row]]
) -> list[Row]:
    """Cells that name the types at the end of each row, with the row's ground."""
    at_end = {
        name: other
        for table in TYPES
        for name, other in list_end_types(typed[table]).items()
    }
    return [
        {key: at_end[row[key].word] for key in TYPE_COLUMNS if row[key].word in at_end}
        | {"ground": row["ground"]}
        for row in rows
    ]
