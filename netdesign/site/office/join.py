"""The input workbook as lines of a site, each reading with the cell it came from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from netdesign.site.cells.cells import Workbook
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import ROPES, SNOW, TESTS
from netdesign.site.content import Content
from netdesign.site.lines import (
    Lines,
    index_lines,
    refuse_unknown_ids,
)
from netdesign.site.office.declared import list_declared
from netdesign.site.office.library import Library, add_lines
from netdesign.site.office.project import (
    build_project,
    build_site_ranges,
    read_lines,
)
from netdesign.site.office.rows import (
    join_ends,
    join_net,
    join_rows,
    read_approval,
)
from netdesign.site.office.sheets import (
    OfficeTables,
    find_further,
    find_office_tables,
)
from netdesign.site.office.types import (
    fill_in_anchor,
    find_field,
    join_anchors,
    join_links,
    join_posts,
    list_dips,
    list_end_types,
    list_ids,
    rename,
    settle_ids,
    take,
)
from netdesign.site.readings import Row, refuse, refuse_misfits
from netdesign.site.snow_sheets import LayersByRow, order_layers
from netdesign.site.type_lines import count_in_tests, name_by_ground, place_in_ground
from netdesign.site.type_resistances import check_ends, check_tests
from netdesign.words.message import say

# Columns of net rows and of their ends that name a type, by the sheet of the types.
_NAMING = {
    "Anchors": ("foot_anchor", "uphill_anchor", "downhill_anchor", "end_anchor"),
    "Ropes": ("ridge_rope", "lower_rope", "uphill_guy", "downhill_guy", "end_guy"),
    "Posts": ("post",),
}
_NOT_OF_ROWS = ("project", "declared")
_BLOCKS = {"Anchors": "anchor_types", "Ropes": "ropes", "Posts": "posts"}


def read_office(
    workbook: Workbook, findings: list[Finding], library: Library | None = None
) -> Content:
    """Read all sheets and join them to lines of a site; faults go to ``findings``.

    Parameters
    ----------
    workbook : Workbook
        As read.
    findings : list of Finding
        Appended to.
    library : Library, optional
        Net types and parts of another workbook.
    """
    elsewhere = ("net_types",) if library else ()
    tables = find_office_tables(workbook, findings, elsewhere=elsewhere)
    lines = _join_nets(tables, findings)
    if library:
        others = _join_nets(library.found, findings)
        lines = add_lines(lines, others, findings)
        tables = _fill_in(tables, library.found)
    lines = _settle_all(lines)
    project = read_lines(tables.tables["project"], lines["project"], findings)
    accepted = say("nets.ids_once")
    nets = index_lines(lines["net_types"], "id", accepted, findings)
    _refuse_unknown_nets(lines["rows"], nets, findings)
    named, cells = build_project(project)
    of_rows = {line["id"].word: line["net_type"].word for line in lines["rows"]}
    approvals = {
        row: approval
        for row, net in of_rows.items()
        if net in nets and (approval := read_approval(nets[net]))
    }
    return Content(
        workbook=workbook,
        project=named,
        project_cells=cells,
        lines=_join(tables, lines, project, nets, findings),
        nets=tables.tables["rows"],
        declared=settle_ids(
            list_declared(lines["declared"]), list_ids(lines["rows"]), "row"
        ),
        further=find_further(workbook, findings),
        approvals=approvals,
        library=(library.file, library.sha256) if library else ("", ""),
    )


def _join_nets(tables: OfficeTables, findings: list[Finding]) -> dict[str, list[Row]]:
    """Lines by table, those of net types with the slack that their sag makes."""
    lines = {key: list(of) for key, of in tables.lines.items()}
    measure = tables.measures.get(("net_types", "slack"), "")
    lines["net_types"] = [
        join_net(one, measure, findings) for one in lines["net_types"]
    ]
    return lines


def _fill_in(tables: OfficeTables, library: OfficeTables) -> OfficeTables:
    """Tables of the workbook, or those of its library where it has none."""
    found = {
        name: one or library.tables.get(name) for name, one in tables.tables.items()
    }
    return replace(tables, tables=found)


def _join(
    tables: OfficeTables,
    lines: Mapping[str, Sequence[Row]],
    project: Row,
    nets: Mapping[str, Row],
    findings: list[Finding],
) -> Lines:
    snow = _join_layers(tables, lines["layers"], findings)
    dips = list_dips(lines["anchor_types"])
    measure = tables.measures.get(("rows", "snow"), "")
    rows = join_rows(lines["rows"], nets, snow, project, dips, measure, findings)
    at_end = {
        name: one
        for block in _BLOCKS.values()
        for name, one in list_end_types(lines[block]).items()
    }
    ends = join_ends(lines["rows"], rows, nets, at_end, dips)
    return _collect(tables, lines, project, rows, ends, snow, findings)


def _settle_all(lines: dict[str, list[Row]]) -> dict[str, list[Row]]:
    """Lines whose ids are spelt as their own sheet has them."""
    ids = {name: list(list_ids(lines[name])) for name in ("rows", "net_types")}
    ids |= {sheet: list(list_ids(lines[block])) for sheet, block in _BLOCKS.items()}
    lines["rows"] = settle_ids(lines["rows"], ids["net_types"], "net_type")
    for sheet, keys in _NAMING.items():
        for key in keys:
            table = "net_types" if sheet != "Anchors" else "rows"
            lines[table] = settle_ids(lines[table], ids[sheet], key)
        block = _BLOCKS[sheet]
        lines[block] = settle_ids(lines[block], ids[sheet], "at_end")
    lines["tests"] = settle_ids(lines["tests"], ids["Anchors"], "type")
    both = [*ids["Anchors"], *ids["Ropes"]]
    lines["links"] = settle_ids(lines["links"], both, "type")
    lines["layers"] = settle_ids(lines["layers"], ids["rows"], "row")
    return lines


def _refuse_unknown_nets(
    rows: Sequence[Row], nets: Mapping[str, Row], findings: list[Finding]
) -> None:
    places = {name: one["id"].place for name, one in nets.items()}
    refuse_unknown_ids((row["net_type"] for row in rows), places, findings)


def _join_layers(
    tables: OfficeTables, lines: Sequence[Row], findings: list[Finding]
) -> LayersByRow:
    """Lines of sheet Snow by net row, vertical or normal as their unit cell says."""
    measure = tables.measures.get(("layers", "thickness"), "")
    key = "height" if measure == "vertical" else "thickness"
    joined = []
    for line in lines:
        size = rename(line["thickness"], find_field(SNOW, key))
        bare = {one: reading for one, reading in line.items() if one != "thickness"}
        joined.append(take(SNOW, bare, **{key: size}))
    if lines and not measure:
        refuse(lines[0]["thickness"], say("office.no_measure"), "", findings)
    return order_layers(joined, findings)


def _collect(
    tables: OfficeTables,
    lines: Mapping[str, Sequence[Row]],
    project: Row,
    rows: list[Row],
    ends: list[Row],
    snow: LayersByRow,
    findings: list[Finding],
) -> Lines:
    tests = [take(TESTS, one) for one in lines["tests"]]
    anchors = join_anchors(lines["anchor_types"], tests, lines["soils"], project)
    if tests:
        anchors = count_in_tests(anchors, tests, findings)
    grounds = {
        row["id"].word: row["ground"] for row in rows if row["ground"].state == "given"
    }
    rows = place_in_ground(rows, anchors, grounds, findings)
    ends = place_in_ground(ends, anchors, grounds, findings)
    of_types = {
        "Anchors": _check_anchors(name_by_ground(anchors), findings),
        "Ropes": _check_ropes(lines["ropes"], findings),
        "Posts": join_posts(lines["posts"], project, lines["net_types"], findings),
    }
    found = {sheet: tables.tables[block] for sheet, block in _BLOCKS.items()}
    joined = Lines(
        nets=rows,
        ends={end["row"].word: end for end in ends},
        snow=snow,
        types={
            sheet: _index_types(of, findings) if found[sheet] else {}
            for sheet, of in of_types.items()
        },
        absent=[
            x for x, of in found.items() if not of and _BLOCKS[x] not in tables.unread
        ],
        unreadable=[x for x, of in found.items() if not of or "id" not in of.columns],
        ranges=build_site_ranges(project),
        links=join_links(lines["links"]),
        tests=tests,
        typed={one: lines[one] for one in lines if one not in _NOT_OF_ROWS},
    )
    for of_row in snow.values():
        refuse_unknown_ids([of_row[0]["row"]], joined.places, findings)
    return joined


def _index_types(lines: Sequence[Row], findings: list[Finding]) -> Mapping[str, Row]:
    return index_lines(lines, "id", say("nets.ids_once"), findings)


def _check_anchors(lines: Sequence[Row], findings: list[Finding]) -> list[Row]:
    """Lines of the anchor types with their steel; what they lack is told."""
    for line in lines:
        refuse_misfits(line, findings)
    filled = [fill_in_anchor(line, findings) for line in lines]
    for line in filled:
        check_tests(line, findings)
    return filled


def _check_ropes(lines: Sequence[Row], findings: list[Finding]) -> Sequence[Row]:
    ropes = [take(ROPES, line) for line in lines]
    for rope in ropes:
        check_ends(rope, findings)
    return ropes
