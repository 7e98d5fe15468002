"""Reads a site workbook: every input with its cell, or every fault at once."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from netdesign.addon_table import SHEETS, is_there, load
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import (
    UNDECLARED,
    TextFormat,
    Workbook,
    doubt_results,
    find_followers,
)
from netdesign.site.cells.findings import Finding, fold_findings, note_file
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.all_tables import (
    QUIET_SHEETS,
    load_old_plans,
)
from netdesign.site.columns.office import is_heading, load_plan
from netdesign.site.declared_sheet import read_declared, replace_cells
from netdesign.site.frames import Change, Frames, build_workbook, change_values
from netdesign.site.headings import find_columns, find_headings, list_meant
from netdesign.site.lines import Lines
from netdesign.site.lists.join import join_list
from netdesign.site.lists.list_map import (
    read_answered_list,
    read_list_map,
)
from netdesign.site.model import NetRow, ReplacedCell, Site
from netdesign.site.net_rows import build_net_rows
from netdesign.site.office.join import read_library, read_office
from netdesign.site.office.sheets import find_office_tables, is_old, is_read
from netdesign.site.plausible import ask_about_numbers
from netdesign.site.snow_sheets import check_layers
from netdesign.site.support_types import list_catalogue
from netdesign.site.type_lines import read_links
from netdesign.words.message import say

# Headings of sheet Rows, at least, on a sheet that holds net rows.
_LEAST_KNOWN = 4


def read_site(
    path: str | Path,
    text_format: TextFormat = UNDECLARED,
    instead: Mapping[str, str] = MappingProxyType({}),
    net_types: Path | None = None,
    change: Change = MappingProxyType({}),
) -> Site:
    """Read a site workbook.

    Parameters
    ----------
    path : str or Path
        An xlsx, xlsm or csv file, or a folder of csv files, laid out as
        `netdesign.site.columns.office` says, or an own list with its answers.
    text_format : TextFormat
        What is declared of the file's text.
    instead : mapping of str to str
        Texts that are read in the place of those of some cells (``Rows!C8``).
    net_types : Path, optional
        Workbook whose net types and parts count beside those of the site.
    change : mapping of str to mapping of str to object
        Other values of net rows, as of `change_values`.

    Returns
    -------
    Site
        SI values; the inputs as typed and as understood, with their cells; notes
        on what was not read.

    Raises
    ------
    SiteDataError
        With all findings of all sheets, if any of them is an error; of a workbook of
        version 0.1 with the command that writes it again, alone.
    """
    path = Path(path)
    answers = read_list_map(path)
    if answers:
        cells = read_answered_list(path, answers, text_format)
    else:
        cells = read_cells(path, text_format)
    workbook, replaced = replace_cells(cells, instead)
    workbook = doubt_results(workbook, [change.cell for change in replaced])
    findings = [*workbook.remarks]
    if answers:
        note = say("map.used", file=answers.file)
        findings.append(note_file(workbook.file, note))
        workbook, tables = join_list(workbook, answers, findings)
    else:
        findings += _refuse_rows_elsewhere(path, workbook, text_format)
        elsewhere = ("net_types",) if net_types else ()
        tables = find_office_tables(workbook, findings, elsewhere=elsewhere)
    tables, changed = change_values(tables, change, workbook.file, findings)
    if changed:
        places = [change.cell for change in changed]
        tables = tables.doubt_formulas(find_followers(workbook, places))
    replaced += changed
    library = read_library(net_types, text_format, findings) if net_types else None
    lines = read_office(workbook, tables, findings, library)
    site = _build_site(lines, replaced, findings)
    if answers:
        site = replace(site, map_file=answers.file, map_sha256=answers.sha256)
    return replace(site, text_format=text_format)


def read_frames(frames: Frames, change: Change = MappingProxyType({})) -> Site:
    """Site of some frames, as `build_workbook` takes them; see `read_site`.

    Raises
    ------
    SiteDataError
        With all findings, if any of them is an error.
    """
    workbook, findings = build_workbook(frames), list[Finding]()
    tables = find_office_tables(workbook, findings)
    tables, replaced = change_values(tables, change, workbook.file, findings)
    return _build_site(read_office(workbook, tables, findings), replaced, findings)


def _build_site(
    lines: Lines,
    replaced: tuple[ReplacedCell, ...],
    findings: list[Finding],
) -> Site:
    workbook, ranges = lines.workbook, lines.ranges
    net_rows = build_net_rows(lines, findings)
    if ranges.ranges:
        check_layers(net_rows, lines.snow, ranges.ranges, findings)
    of_addons = _read_further(lines, findings)
    links = read_links(lines.typed["links"], lines.types, findings)
    declared, confirmed = read_declared(
        lines.typed["declared"], workbook, lines.places, findings
    )
    findings.extend(_note_unread(workbook, findings))
    if ranges.ranges is None or any(
        finding.severity == "error" for finding in findings
    ):
        raise SiteDataError(findings, fold_findings(findings, workbook.file))
    notes = fold_findings(findings)
    questions = ask_about_numbers(lines, confirmed, findings)
    return Site(
        project=lines.project,
        ranges=_widen_density(ranges.ranges, net_rows),
        rows=tuple(replace(row, questions=questions[row.id]) for row in net_rows),
        file_name=workbook.file,
        sha256=workbook.sha256,
        notes=(*notes, *confirmed.values()),
        findings=tuple(findings),
        range_inputs=ranges.inputs,
        project_cells=lines.project_cells,
        declared=declared,
        confirmed=tuple(sorted(confirmed)),
        library_file=lines.library[0],
        library_sha256=lines.library[1],
        catalogue=list_catalogue(lines.types),
        links=links,
        what_if=replaced,
        of_addons=of_addons,
    )


def _read_further(lines: Lines, findings: list[Finding]) -> dict[str, Any]:
    """What add-ons read of their sheets; a sheet whose add-on is gone gets a note."""
    values = {}
    for name, table in lines.further.items():
        if table is not None and is_there(SHEETS[name]):
            read = load(name, SHEETS[name])
            values[name] = read(table, lines.places, findings)
        elif table is not None:
            file = lines.workbook.file
            findings.append(note_file(file, say("table.not_read"), name))
    return {name: value for name, value in values.items() if value}


def _widen_density(ranges: Ranges, rows: Sequence[NetRow]) -> Ranges:
    """Ranges of a site, the density over all rows where each has its own."""
    own = [dict(row.ranges.intervals).get("density") for row in rows]
    spans = [interval for interval in own if interval]
    if not spans:
        return ranges
    low, high = (
        min(interval.low for interval in spans),
        max(interval.high for interval in spans),
    )
    return ranges.replaced_by(Ranges.of(density=Interval(low=low, high=high)))


def _refuse_rows_elsewhere(
    path: Path, workbook: Workbook, text_format: TextFormat
) -> Iterator[Finding]:
    """Sheets with net rows under another name: half a site must not vanish."""
    plan, names = load_plan("rows"), {*workbook.unread} - {*QUIET_SHEETS}
    if not names or not list_meant(workbook, plan):
        return
    try:
        unread = read_workbook(path, names.__contains__, is_heading, text_format)
    except SiteDataError:  # what has no part in the check may be damaged
        return
    for sheet in unread.sheets:
        table = find_headings(sheet, plan, [])
        if table and len(find_columns(table, [])) >= _LEAST_KNOWN:
            accepted = say("table.other_file_accepted", name=plan.title)
            yield workbook.finding(say("table.net_rows"), accepted, sheet.name)


def read_cells(path: Path, text_format: TextFormat = UNDECLARED) -> Workbook:
    """Cells of the sheets that an input workbook has; nothing is understood yet.

    Raises
    ------
    SiteDataError
        Of a workbook of version 0.1, and of what cannot be read at all.
    """

    def is_wanted(name: str) -> bool:
        return is_read(name) or load_old_plans()["Nets"].matches(name)

    workbook = read_workbook(path, is_wanted, is_heading, text_format)
    if is_old(workbook):
        new = path.with_name(f"{path.stem}-new.xlsx")
        rule = say("office.old", old=shlex.quote(str(path)), new=shlex.quote(str(new)))
        raise SiteDataError([workbook.finding(rule)])
    kept = tuple(sheet for sheet in workbook.sheets if is_read(sheet.name))
    unread = tuple(sheet.name for sheet in workbook.sheets if sheet not in kept)
    return replace(workbook, sheets=kept, unread=(*workbook.unread, *unread))


def _note_unread(workbook: Workbook, findings: list[Finding]) -> list[Finding]:
    rule = say("table.not_read")
    reported = {finding.sheet for finding in findings}
    return [
        note_file(workbook.file, rule, name)
        for name in workbook.unread
        if name not in QUIET_SHEETS and name not in reported
    ]
