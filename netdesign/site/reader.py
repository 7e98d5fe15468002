"""Reads a site workbook: every input with its cell, or every fault at once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache, partial
from pathlib import Path
from types import MappingProxyType

from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import UNDECLARED, Answers, TextFormat, Workbook
from netdesign.site.cells.findings import Finding, fold_findings, note_file
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.all_tables import (
    ANCHORS,
    DECLARED,
    ENDS,
    MONITORING,
    NETS,
    POSTS,
    PROJECT,
    QUIET_SHEETS,
    RANGES,
    RANGES_AS_TYPED,
    ROPES,
    SHEETS,
    SNOW,
    WINTER,
)
from netdesign.site.columns.fields import split_heading
from netdesign.site.declared_sheet import read_declared
from netdesign.site.headings import Table
from netdesign.site.lines import (
    TYPE_SHEETS,
    Lines,
    index_lines,
    refuse_unknown_ids,
)
from netdesign.site.mapping import (
    give_answers,
    is_meant,
    judge_answers,
    read_answers,
)
from netdesign.site.model import NetRow, Project, Site
from netdesign.site.monitoring_sheet import read_monitoring
from netdesign.site.net_rows import build_net_rows
from netdesign.site.plausible import ask
from netdesign.site.ranges import (
    RangesSheet,
    build_ranges,
    free_columns,
    refuse_large_grid,
)
from netdesign.site.readings import Row, refuse
from netdesign.site.replaced import mark_replaced, replace_cells
from netdesign.site.snow_layers import check_layers, read_layers
from netdesign.site.support_types import list_catalogue
from netdesign.site.tables import (
    find_table,
    is_absent,
    is_near,
    match_item,
    read_rows,
    refuse_unused_answers,
)
from netdesign.site.type_resistances import (
    check_support_types,
    check_tests,
    fill_in_resistances,
)
from netdesign.site.winter_sheet import read_winter
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.words.message import say

_LAWS = tuple(CREEP_LAWS)
_TYPE_PLANS = (ANCHORS, ROPES, POSTS)


def read_site(
    path: Path,
    text_format: TextFormat = UNDECLARED,
    instead: Mapping[str, str] = MappingProxyType({}),
) -> Site:
    """Read a site workbook.

    Parameters
    ----------
    path : Path
        An xlsx, xlsm, ods or csv file, or a folder of csv files, laid out as
        `netdesign.site.columns.all_tables` says.
    text_format : TextFormat
        What is declared of the file's text.
    instead : mapping of str to str
        Texts that are read in the place of those of some cells (``Nets!P8``).

    Returns
    -------
    Site
        SI values; the inputs as typed and as understood, with their cells; notes
        on what was not read.

    Raises
    ------
    SiteDataError
        With all findings of all sheets, if any of them is an error.
    """
    workbook, replaced = replace_cells(read_cells(path, text_format), instead)
    findings = [*workbook.remarks, *judge_answers(workbook)]
    tables, ranges = _find_tables(workbook, findings)
    project, project_cells = _read_project(tables[PROJECT.name], findings)
    lines = _read_lines(workbook, tables, ranges, findings)
    net_rows = _build_rows(tables, lines, findings)
    monitoring = read_monitoring(tables[MONITORING.name], lines.places, findings)
    winter = read_winter(tables[WINTER.name], lines.places, findings)
    said = tables[DECLARED.name]
    declared, confirmed = read_declared(said, workbook, lines.places, findings)
    findings.extend(_note_unread(workbook, findings))
    if ranges.ranges is None or any(one.severity == "error" for one in findings):
        raise SiteDataError(findings, fold_findings(findings))
    notes = fold_findings(list(map(_shorten, findings)))
    questions = ask(lines, confirmed, findings)
    rows = tuple(
        replace(
            mark_replaced(row, replaced),
            unsaid=row.unsaid + ranges.unsaid,
            questions=questions.get(row.id, ()),
        )
        for row in net_rows
    )
    return Site(
        project=project,
        ranges=ranges.ranges,
        rows=rows,
        file_name=workbook.file,
        sha256=workbook.sha256,
        notes=(*notes, *(one.message for one in confirmed)),
        findings=tuple(findings),
        range_inputs=ranges.inputs,
        project_cells=project_cells,
        monitoring=monitoring,
        winter=winter,
        declared=declared,
        map_file=workbook.answers.file,
        map_sha256=workbook.answers.sha256,
        catalogue=list_catalogue(lines.types),
        what_if=replaced,
    )


def _find_tables(
    workbook: Workbook, findings: list[Finding]
) -> tuple[Mapping[str, Table | None], RangesSheet]:
    """Tables by the name of their sheet, and what ranges: other sheets need it less."""
    told: list[Finding] = []
    table = find_table(workbook, RANGES_AS_TYPED, told)
    ranges = replace(build_ranges(table, told), findings=told)
    nets = free_columns(NETS, ranges.ends)
    plans = [nets if one is NETS else one for one in SHEETS if one is not RANGES]
    tables = {plan.name: find_table(workbook, plan, findings) for plan in plans}
    return {RANGES.name: table, **tables}, ranges


def _read_lines(
    workbook: Workbook,
    tables: Mapping[str, Table | None],
    ranges: RangesSheet,
    findings: list[Finding],
) -> Lines:
    types = {sheet: _read_types(tables[sheet], findings) for sheet in TYPE_SHEETS}
    snow = read_layers(tables[SNOW.name], findings)
    ends, nets = (
        list(read_rows(table, findings)) if (table := tables[one.name]) else []
        for one in (ENDS, NETS)
    )
    lines = Lines(
        nets=nets,
        ends=index_lines(ends, "row", say("ends.one_line"), findings),
        snow=snow,
        types={sheet: found or {} for sheet, found in types.items()},
        absent=[plan.name for plan in _TYPE_PLANS if is_absent(workbook, plan)],
        unreadable=[sheet for sheet, found in types.items() if found is None],
        ranges=ranges,
    )
    if tables[NETS.name]:
        for lines_of in snow.values():
            refuse_unknown_ids([lines_of[0]["row"]], lines.places, findings)
        named = (one["row"] for one in lines.ends.values())
        refuse_unknown_ids(named, lines.places, findings)
    return lines


def _build_rows(
    tables: Mapping[str, Table | None], lines: Lines, findings: list[Finding]
) -> tuple[NetRow, ...]:
    """Net rows without a fault, held against what ranges over the whole site."""
    nets, ranged, ranges = tables[NETS.name], tables[RANGES.name], lines.ranges
    rows = build_net_rows(nets, lines, findings) if nets else ()
    findings.extend(ranges.findings)
    if ranged and ranges.ranges:
        refuse_large_grid(ranged, ranges.ranges, len(rows), findings)
        check_layers(rows, lines.snow, ranges.ranges, findings)
    return rows


def read_cells(path: Path, text_format: TextFormat = UNDECLARED) -> Workbook:
    """Cells of the sheets that a site workbook has; nothing is understood yet."""
    answers = read_answers(path)
    if not text_format.decimal_mark:
        text_format = replace(text_format, decimal_mark=answers.decimal_mark)
    is_wanted = partial(_is_wanted, answers=answers)
    is_name = partial(_is_name, answers=answers)
    workbook = read_workbook(path, is_wanted, is_name, is_heading, text_format)
    return give_answers(workbook, answers)


def is_heading(text: str) -> bool:
    """A text is a heading of some sheet."""
    return split_heading(text)[0] in _known_headings()


@lru_cache(maxsize=1)
def _known_headings() -> frozenset[str]:
    fields = (field for plan in SHEETS for field in plan.fields)
    return frozenset(name for field in fields for name in field.names)


def _shorten(finding: Finding) -> Finding:
    """Remark without the list of headings, which helps only where one is sought."""
    is_long = finding.rule.key == "heading.unknown"
    return replace(finding, accepted="") if is_long else finding


def _is_wanted(sheet_name: str, answers: Answers) -> bool:
    return any(is_meant(sheet_name, plan, answers) for plan in SHEETS)


def _is_name(text: str, answers: Answers) -> bool:
    return _is_wanted(text, answers) or any(is_near(text, plan) for plan in SHEETS)


def _note_unread(workbook: Workbook, findings: list[Finding]) -> list[Finding]:
    rule = say("table.not_read")
    told = {finding.sheet for finding in findings}
    return [
        note_file(workbook.file, rule, name)
        for name in workbook.unread
        if name not in QUIET_SHEETS and name not in told
    ]


def _read_project(
    table: Table | None, findings: list[Finding]
) -> tuple[Project, dict[str, str]]:
    """Project and the cell of each of its values."""
    values: dict[str, str] = {}
    cells: dict[str, str] = {}
    if table is None:
        return Project(), cells
    for row in read_rows(table, findings):
        item, value = row["item"], row["value"]
        if not item.word:
            continue
        field = match_item(item, table, "item", findings).field
        if field is None or value.state != "given":
            continue
        if field.key in values:
            rule = say("item.twice", place=cells[field.key])
            refuse(item, rule, say("item.one_line"), findings)
        elif field.key == "accepted_law" and value.word not in CREEP_LAWS:
            refuse(
                value, say("item.no_law"), say("accepted.words", words=_LAWS), findings
            )
        else:
            values[field.key], cells[field.key] = value.word, value.place
    refuse_unused_answers(table, "item", findings)
    return Project(**values), cells


def _read_types(table: Table | None, findings: list[Finding]) -> dict[str, Row] | None:
    """Lines of a type sheet by id; a faulty line keeps its id known.

    None without the sheet, its headings or its column of ids.
    """
    if table is None:
        return None
    rows = list(read_rows(table, findings))
    for row in rows:
        basis = row.get("basis")
        if basis and basis.state == "blank" and row["pull_out"].state == "given":
            rule = say("type.basis_empty", place=row["pull_out"].place)
            refuse(basis, rule, basis.field.accepted, findings)
        check_support_types(row, findings)
    filled = [fill_in_resistances(row, findings) for row in rows]
    for row in filled:  # a computed resistance beside tests is one too many, too
        check_tests(row, findings)
    by_id = index_lines(filled, "id", say("nets.ids_once"), findings)
    return by_id if "id" in table.columns else None
