"""The input workbook as lines of a site, each reading with the cell it came from."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from netdesign.resistance.products import find_bar
from netdesign.site.cells.cells import TextFormat, Workbook
from netdesign.site.cells.findings import Finding
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.all_tables import FURTHER, find_quantity
from netdesign.site.columns.fields import to_si
from netdesign.site.columns.office import is_heading, load_plan
from netdesign.site.lines import (
    TYPES,
    Lines,
    index_lines,
    refuse_unknown_ids,
    settle_ids,
)
from netdesign.site.office.project import build_project, build_ranges, read_lines
from netdesign.site.office.rows import join_rows, measure_lines
from netdesign.site.office.sheets import OfficeTables, find_office_tables
from netdesign.site.readings import (
    Reading,
    Row,
    read_nothing,
    refuse,
    refuse_misfits,
    rename,
    work_out,
)
from netdesign.site.snow_sheets import order_layers
from netdesign.site.support_types import TYPE_COLUMNS
from netdesign.site.tables import find_table
from netdesign.site.type_lines import (
    count_in_tests,
    fill_in_section,
    name_by_ground,
    name_values,
    place_in_ground,
)
from netdesign.site.type_resistances import (
    SECTION,
    check_ends,
    check_tests,
    describe_steel,
    find_steel,
    resist_buckling,
)
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message, say


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
    if library:
        typed = add_lines(typed, _read_typed(library.tables, findings), findings)
    typed = _settle_all(typed)
    project = read_lines(tables.tables["project"], typed["project"], findings)
    lines = _join(workbook, tables, typed, project, findings)
    return replace(
        lines, library=(library.file, library.sha256) if library else ("", "")
    )


def _read_typed(tables: OfficeTables, findings: list[Finding]) -> dict[str, list[Row]]:
    """Lines by table, each number as what its unit cell says that it measures."""
    lines = {
        key: measure_lines(key, rows, tables, findings)
        for key, rows in tables.lines.items()
    }
    lines["links"] = measure_links(lines["links"])
    return lines


def _settle_all(lines: Mapping[str, list[Row]]) -> dict[str, list[Row]]:
    """Lines whose ids are spelt as their own sheet has them."""
    settled = dict(lines)
    ids = {
        table: [word for line in lines[table] if (word := line["id"].word)]
        for table in ("rows", "net_types", *TYPES)
    }
    for table, of_table in lines.items():
        for key, reading in (of_table[0] if of_table else {}).items():
            spellings = ids.get(reading.field.refers_to, ())
            settled[table] = settle_ids(settled[table], spellings, key)
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
    rows = _join_net_types(typed, project, findings)
    layers = order_layers(typed["layers"], findings)
    anchors = join_anchors(typed, project, findings)
    placed = place_in_ground(rows, anchors, findings)
    ends = place_in_ground(_find_end_types(rows, typed), anchors, findings)
    for rope in typed["ropes"]:
        check_ends(rope, findings)
    joined = _join_types(typed, rows, anchors, project, findings)
    types = {key: _index(of_sheet, findings) for key, of_sheet in joined.items()}
    named, cells = build_project(project)
    lines = Lines(
        workbook=workbook,
        project=named,
        project_cells=cells,
        table=tables.tables["rows"],
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
    rows: Sequence[Row],
    anchors: Sequence[Row],
    project: Row,
    findings: list[Finding],
) -> dict[str, Sequence[Row]]:
    """Lines of types by their sheets, each complete."""
    return {
        "anchor_types": complete_anchors(name_by_ground(anchors), findings),
        "ropes": typed["ropes"],
        "posts": join_posts(typed["posts"], project, [*typed["net_types"], *rows]),
    }


def _join_net_types(
    typed: Mapping[str, Sequence[Row]],
    project: Row,
    findings: list[Finding],
) -> list[Row]:
    """Rows with their net types; a net type without a line is refused."""
    nets = _index(typed["net_types"] or _list_own_nets(typed["rows"]), findings)
    places = {name: net["id"].place for name, net in nets.items()}
    refuse_unknown_ids((row["net_type"] for row in typed["rows"]), places, findings)
    return join_rows(typed["rows"], nets, project)


def _list_own_nets(rows: Sequence[Row]) -> list[Row]:
    """Named nets of rows that have the columns of a net, each once."""
    nets: list[Row] = []
    for line in rows:
        net = {
            key: reading
            for key, reading in line.items()
            if reading.field.table == "net_types"
        }
        named = {**net, "id": line["net_type"]}
        if net and line["net_type"].word and _bare(named) not in map(_bare, nets):
            nets.append(named)
    return nets


def _index(lines: Sequence[Row], findings: list[Finding]) -> dict[str, Row]:
    return index_lines(lines, "id", say("nets.ids_once"), findings)


def _find_end_types(
    rows: Sequence[Row], typed: Mapping[str, Sequence[Row]]
) -> list[Row]:
    """Cells that name the types at the end of each row, with the row's ground."""
    at_end: dict[tuple[str, str], Reading] = {}
    for table in TYPES:
        for line in typed[table]:
            if line["at_end"].word:
                at_end.setdefault((table, line["id"].word), line["at_end"])
    return [
        {
            key: at_end[cell.field.refers_to, cell.word]
            for key, cell in ((key, row[key]) for key in TYPE_COLUMNS)
            if (cell.field.refers_to, cell.word) in at_end
        }
        | {"ground": row["ground"]}
        for row in rows
    ]


_GRADE = 235.0  # least grade of rolled sections [MPa]
_ABOVE_NET = 0.3  # of a post beyond the net's head, our judgement [m]
_STEEPEST = 20.0  # largest tilt of a post whose cell is empty [deg]


def join_anchors(
    typed: Mapping[str, Sequence[Row]], project: Row, findings: list[Finding]
) -> list[Row]:
    """Anchor types with the results of their tests and the strengths of their ground.

    Parameters
    ----------
    typed : mapping of str to sequence of Row
        Lines of all sheets by table.
    project : Row
        Lines of sheet Project by key.
    findings : list of Finding
        Appended to.
    """
    unknown = {
        field.key: read_nothing(field, None) for field in load_plan("soils").fields
    }
    by_ground = {
        soil["ground"].word: soil for soil in typed["soils"] if soil["ground"].word
    }
    anchors: list[Row] = []
    for line in typed["anchor_types"]:
        soil = by_ground.get(line["ground"].word, unknown)
        row = {**soil, **line, "soil": project["soil"]}
        anchors.append(row)
    return count_in_tests(anchors, typed["tests"], findings)


def complete_anchors(lines: Sequence[Row], findings: list[Finding]) -> list[Row]:
    """Anchor types with their steel; what contradicts itself is refused."""
    anchors: list[Row] = []
    for line in lines:
        refuse_misfits(line, findings)
        check_tests(line, findings)
        anchors.append(_fill_in_steel(line))
    return anchors


def _fill_in_steel(line: Row) -> Row:
    """Line of an anchor with the bar that its name means, and the tendon it makes."""
    product, force = find_bar(line["id"].word), line["tendon"]
    if product is None or line["kind"].word == "rope anchor":
        return line
    if line["bar_diameter"].state == "blank":
        how = say("derivation.named_bar", product=product.id, sources=product.sources)
        line = {**line, **name_values(line, ("bar_diameter",), product, (), how)}
    steel = find_steel(line)
    if steel is None or force.state != "blank":
        return line
    tendon = replace(
        force,
        state="given",
        value=kilonewton_from_newton(steel.axial_resistance),
        derivation=describe_steel(steel),
        cell=line["bar_diameter"].cell,
    )
    return {**line, "tendon": tendon}


def join_posts(
    lines: Sequence[Row],
    project: Row,
    nets: Sequence[Row],
) -> list[Row]:
    """Posts, as long as the net types that name them ask for."""
    joined: list[Row] = []
    for line in lines:
        row = {**line, "base_friction": project["base_friction"]}
        if row["yield_strength"].state == "blank":
            how = say("office.least_grade")
            row["yield_strength"] = _assume(row, "yield_strength", _GRADE, how)
        length = _find_length(row["id"].word, nets)
        if row["buckling_length"].state == "blank" and length is not None:
            how = say("office.length_of_post", above=_ABOVE_NET)
            row["buckling_length"] = _assume(row, "buckling_length", length, how)
        joined.append(_add_compression(fill_in_section(row)))
    return joined


def _add_compression(row: Row) -> Row:
    """Post with the compression that its section bears; blank without all of it."""
    compression = read_nothing(find_quantity("Posts", "compression"), None)
    if all(row[key].state == "given" for key in SECTION):
        force, how = resist_buckling(row)
        value = kilonewton_from_newton(force)
        compression = work_out(row["area"], compression.field, value, how)
    return {**row, "compression": compression}


def _assume(row: Row, key: str, value: float, how: Message) -> Reading:
    return replace(row[key], state="given", value=value, derivation=how)


def _find_length(post: str, nets: Sequence[Row]) -> float | None:
    """Longest post of a type [m]: D_K / cos(tilt), and its head above the net."""
    lengths = []
    for net in nets:
        height, tilt = net["net_height"], net["post_tilt"]
        if net["post"].word == post and height.state == "given":
            ends = tilt.span or (
                (tilt.number,) if tilt.state == "given" else (_STEEPEST,)
            )
            most = max(abs(to_si(end, "deg")) for end in ends)
            lengths.append(height.si / math.cos(most) + _ABOVE_NET)
    return max(lengths, default=None)


def measure_links(lines: Iterable[Row]) -> list[Row]:
    """Links; bounds and usual values of a force are those of its kind."""
    limit = find_quantity("Links", "working_limit")
    return [
        {**line, "force": rename(line["force"], limit)}
        if line["meaning"].word == "limit"
        else line
        for line in lines
    ]


_TABLES = ("net_types", "ropes", "posts", "links")
_KEYS = {"links": "type"}  # that names a line; else its id


@dataclass(frozen=True, slots=True, kw_only=True)
class Library:
    """Lines of a library, whose cells name its file.

    Attributes
    ----------
    file, sha256 : str
        Of the workbook.
    tables : OfficeTables
        Its sheets Net types and Parts.
    """

    file: str
    sha256: str
    tables: OfficeTables


def read_library(
    path: Path, text_format: TextFormat, findings: list[Finding]
) -> Library:
    """Sheets Net types and Parts of a workbook; faults go to ``findings``."""
    plans = tuple(map(load_plan, _TABLES))

    def is_wanted(name: str) -> bool:
        return any(plan.matches(name) for plan in plans)

    workbook = read_workbook(path, is_wanted, is_heading, text_format)
    tables = find_office_tables(workbook, findings, ("net_types",))
    lines = {
        name: [_place(line, workbook.file) for line in tables.lines[name]]
        for name in _TABLES
    }
    return Library(
        file=workbook.file, sha256=workbook.sha256, tables=replace(tables, lines=lines)
    )


def _place(line: Row, file: str) -> dict[str, Reading]:
    """Line whose cells name the file that they stand in."""
    return {
        key: replace(
            reading,
            cell=reading.cell
            and replace(reading.cell, sheet=f"[{file}]{reading.cell.sheet}"),
        )
        for key, reading in line.items()
    }


def add_lines(
    own: Mapping[str, list[Row]],
    others: Mapping[str, Sequence[Row]],
    findings: list[Finding],
) -> dict[str, list[Row]]:
    """Lines by table, with the lines of a library whose ids are new.

    Parameters
    ----------
    own, others : mapping of str to sequence of Row
        Lines of the workbook, and of the library.
    findings : list of Finding
        Appended to: an id that means one thing here and another there.
    """
    joined = {table: list(lines) for table, lines in own.items()}
    for table in _TABLES:
        key = _KEYS.get(table, "id")
        here, there = _group(own[table], key), _group(others[table], key)
        for name, lines in there.items():
            if name not in here:
                joined[table] += lines
            elif list(map(_bare, here[name])) != list(map(_bare, lines)):
                rule = say("nets.used_twice", place=lines[0][key].place)
                refuse(here[name][0][key], rule, say("office.once"), findings)
    return joined


def _group(lines: Sequence[Row], key: str) -> dict[str, list[Row]]:
    by_name: dict[str, list[Row]] = {}
    for line in lines:
        if line[key].word:
            by_name.setdefault(line[key].word, []).append(line)
    return by_name


def _bare(line: Row) -> dict[str, object]:
    """Values and ranges of a line by key, without its place."""
    return {
        key: (reading.value, reading.span)
        for key, reading in line.items()
        if reading.state == "given"
    }
