"""Reads a site workbook: every input with its cell, or every fault at once."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from netdesign.errors import SiteDataError
from netdesign.site.cells import UNDECLARED, TextFormat, Workbook
from netdesign.site.columns import (
    ANCHORS,
    MONITORING,
    NETS,
    POSTS,
    PROJECT,
    PROJECT_ITEMS,
    QUIET_SHEETS,
    RANGES,
    ROPES,
    SHEETS,
    SNOW,
)
from netdesign.site.diagnostics import Finding, add_nearest, note_file
from netdesign.site.fields import normalise, split_heading
from netdesign.site.model import Project, Site
from netdesign.site.monitoring import read_monitoring
from netdesign.site.net_rows import build_net_rows, index_by_id
from netdesign.site.ranges import build_ranges
from netdesign.site.readings import Row, refuse
from netdesign.site.snow_layers import check_densities, read_layers
from netdesign.site.spreadsheet import read_workbook
from netdesign.site.tables import Table, find_table, read_rows
from netdesign.site.type_resistances import check_tests, fill_in_resistances


def read_site(path: Path, text_format: TextFormat = UNDECLARED) -> Site:
    """Read a site workbook.

    Parameters
    ----------
    path : Path
        An xlsx, xlsm, ods or csv file, or a folder of csv files, laid out as
        `netdesign.site.columns` says.
    text_format : TextFormat
        What is declared of the file's text.

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
    workbook = read_cells(path, text_format)
    findings = list(workbook.remarks)
    tables = {plan.name: find_table(workbook, plan, findings) for plan in SHEETS}
    project, project_cells = _read_project(tables[PROJECT.name], findings)
    type_sheets = {
        plan.name: _read_types(tables[plan.name], findings)
        for plan in (ANCHORS, ROPES, POSTS)
    }
    snow = read_layers(tables[SNOW.name], findings)
    nets, ranges = tables[NETS.name], tables[RANGES.name]
    net_rows = build_net_rows(nets, type_sheets, snow, findings) if nets else ()
    built_ranges = build_ranges(ranges, findings) if ranges else None
    if built_ranges:
        density = built_ranges[0].density
        check_densities(net_rows, snow, density.low, density.high, findings)
    row_ids = {row.id for row in net_rows}
    monitoring = read_monitoring(tables[MONITORING.name], row_ids, findings)
    findings.extend(_note_unread(workbook))
    if built_ranges is None or any(finding.severity == "error" for finding in findings):
        raise SiteDataError(findings)
    return Site(
        project=project,
        ranges=built_ranges[0],
        rows=net_rows,
        file_name=workbook.file,
        sha256=workbook.sha256,
        notes=tuple(str(finding) for finding in findings),
        findings=tuple(findings),
        range_inputs=built_ranges[1],
        project_cells=project_cells,
        monitoring=monitoring,
    )


def read_cells(path: Path, text_format: TextFormat = UNDECLARED) -> Workbook:
    """Cells of the sheets that a site workbook has; nothing is understood yet."""
    return read_workbook(path, _is_wanted, is_heading, text_format)


def is_heading(text: str) -> bool:
    """Whether a text is a heading of some sheet."""
    return split_heading(text)[0] in _known_headings()


@lru_cache(maxsize=1)
def _known_headings() -> frozenset[str]:
    fields = (field for plan in SHEETS for field in plan.fields)
    return frozenset(name for field in fields for name in field.names)


def _is_wanted(sheet_name: str) -> bool:
    return any(plan.matches(sheet_name) for plan in SHEETS)


def _note_unread(workbook: Workbook) -> list[Finding]:
    rule = "has no part in the check: it is not read"
    return [
        note_file(workbook.file, rule, name)
        for name in workbook.unread
        if name not in QUIET_SHEETS
    ]


def _read_project(
    table: Table | None, findings: list[Finding]
) -> tuple[Project, dict[str, str]]:
    """Project and the cell of each of its values."""
    values: dict[str, str] = {}
    cells: dict[str, str] = {}
    for row in read_rows(table, findings) if table else ():
        item, value = row["item"], row["value"]
        if item.state != "given" or value.state != "given":
            continue
        name = normalise(item.word)
        key = next((field.key for field in PROJECT_ITEMS if name in field.names), None)
        if key is None:
            labels = [field.label for field in PROJECT_ITEMS]
            accepted = add_nearest(", ".join(labels), item.word, labels)
            refuse(item, "is no known item", accepted, findings, severity="note")
        elif key in values:
            rule = f"is given twice: also for {cells[key]}"
            refuse(item, rule, "one line for each item", findings)
        else:
            values[key], cells[key] = value.word, value.place
    return Project(**values), cells


def _read_types(table: Table | None, findings: list[Finding]) -> dict[str, Row]:
    """Lines of a type sheet by id; a faulty line keeps its id known."""
    rows = list(read_rows(table, findings)) if table else []
    for row in rows:
        basis = row.get("basis")
        if basis and basis.state == "blank" and row["pull_out"].state == "given":
            rule = f"is empty beside the pull-out resistance in {row['pull_out'].place}"
            refuse(basis, rule, basis.field.accepted, findings)
        check_tests(row, findings)
    filled = [fill_in_resistances(row, findings) for row in rows]
    return index_by_id(filled, findings)
