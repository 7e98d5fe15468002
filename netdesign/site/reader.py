"""Reads a site workbook: every input with its cell, or every fault at once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

from netdesign.checks import list_standards
from netdesign.edge.given_files import is_there
from netdesign.outcome import SiteDataError
from netdesign.resistance.steel import Link
from netdesign.site.cells.cells import (
    UNDECLARED,
    TextFormat,
    Workbook,
    doubt_results,
)
from netdesign.site.cells.findings import Finding, fold_findings, note_file
from netdesign.site.cells.numbers import split_range
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.all_tables import (
    ANCHORS,
    DECLARED,
    ENDS,
    LINKS,
    MONITORING,
    NETS,
    POSTS,
    PROJECT,
    QUIET_SHEETS,
    RANGES,
    ROPES,
    SHEETS,
    SNOW,
    TESTS,
    UNANSWERED,
    UNCERTAINTY,
    WINTER,
    is_heading,
)
from netdesign.site.columns.fields import SheetPlan, find_item
from netdesign.site.declared_sheet import mark_replaced, read_declared, replace_cells
from netdesign.site.further_sheets import read_monitoring, read_uncertain
from netdesign.site.headings import Table, count_known, refuse_unused_answers
from netdesign.site.lines import (
    Lines,
    index_lines,
    refuse_unknown_ids,
    spread_over_rows,
)
from netdesign.site.model import NetRow, Project, ReplacedCell, Site
from netdesign.site.net_rows import build_net_rows
from netdesign.site.plausible import ask
from netdesign.site.ranges import (
    STIFFNESS,
    RangesSheet,
    add_answered_ranges,
    assume_stiffness,
    build_ranges,
    free_columns,
)
from netdesign.site.readings import Reading, Row, refuse, refuse_misfits
from netdesign.site.snow_sheets import (
    check_layers,
    read_layers,
    read_winter,
)
from netdesign.site.statements import list_missing
from netdesign.site.support_types import list_catalogue
from netdesign.site.tables import (
    find_table,
    find_tables,
    is_about,
    match_item,
    read_rows,
    say_place,
)
from netdesign.site.titles import (
    give_answers,
    is_absent,
    is_asked,
    is_meant,
    is_near,
    judge_answers,
    list_meant,
    read_answers,
)
from netdesign.site.type_lines import (
    count_in_tests,
    fill_in_section,
    name_by_ground,
    place_in_ground,
    read_links,
)
from netdesign.site.type_resistances import (
    check_ends,
    check_section,
    check_tests,
    fill_in_resistances,
)
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.words.message import Message, say

# Headings of sheet Nets, at least, on a sheet that holds net rows.
_LEAST_KNOWN = 4
_TYPE_PLANS = (ANCHORS, ROPES, POSTS)


def read_site(
    path: str | Path,
    text_format: TextFormat = UNDECLARED,
    instead: Mapping[str, str] = MappingProxyType({}),
    sheets: Mapping[str, str] = MappingProxyType({}),
) -> Site:
    """Read a site workbook.

    Parameters
    ----------
    path : str or Path
        An xlsx, xlsm or csv file, or a folder of csv files, laid out as
        `netdesign.site.columns.all_tables` says.
    text_format : TextFormat
        What is declared of the file's text.
    instead : mapping of str to str
        Texts that are read in the place of those of some cells (``Nets!P8``).
    sheets : mapping of str to str
        Answers about sheets beside those of the file of answers.

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
    cells = read_cells(Path(path), text_format, sheets)
    workbook, replaced = replace_cells(cells, instead)
    workbook = doubt_results(workbook)
    findings = [*workbook.remarks, *judge_answers(workbook)]
    findings.extend(_ask_for_rows_elsewhere(Path(path), workbook, text_format))
    return replace(_build_site(workbook, replaced, findings), text_format=text_format)


def _build_site(
    workbook: Workbook, replaced: tuple[ReplacedCell, ...], findings: list[Finding]
) -> Site:
    project, of_project = _read_project(workbook, findings)
    workbook = add_answered_ranges(workbook)
    tables, nets, ranges = _find_tables(workbook, findings)
    typed = [line for table in nets for line in read_rows(table, findings)]
    lines = _read_lines(workbook, tables, typed, ranges, findings)
    net_rows = _build_rows(tables[RANGES.name], nets, lines, findings)
    monitoring = read_monitoring(tables[MONITORING.name], lines.places, findings)
    winter = read_winter(tables[WINTER.name], lines.places, findings)
    uncertain = read_uncertain(tables[UNCERTAINTY.name], lines.places, findings)
    links = read_links(lines.links, lines.types, findings)
    declared, confirmed = read_declared(
        tables[DECLARED.name], workbook, lines.places, findings
    )
    findings.extend(_note_unread(workbook, findings))
    if ranges.ranges is None or any(one.severity == "error" for one in findings):
        raise _refuse(workbook, project, of_project, findings)
    notes = fold_findings(list(map(_shorten, findings)))
    asked = ask(lines, confirmed, findings)
    rows = (_complete(row, ranges, links, asked[row.id]) for row in net_rows)
    return Site(
        project=project,
        ranges=ranges.ranges,
        rows=tuple(mark_replaced(row, replaced) for row in rows),
        file_name=workbook.file,
        sha256=workbook.sha256,
        notes=(*notes, *confirmed.values()),
        findings=tuple(findings),
        range_inputs=ranges.inputs,
        project_cells=of_project,
        monitoring=monitoring,
        winter=winter,
        declared=declared,
        confirmed=tuple(sorted(confirmed)),
        map_file=workbook.answers.file,
        map_sha256=workbook.answers.sha256,
        catalogue=list_catalogue(lines.types),
        links=links,
        what_if=replaced,
        uncertain=uncertain,
    )


def _refuse(
    workbook: Workbook,
    project: Project,
    of_project: Mapping[str, str],
    findings: list[Finding],
) -> SiteDataError:
    findings.extend(_list_unknown_profiles(workbook, project, of_project))
    return SiteDataError(findings, fold_findings(findings, workbook.file))


def _ask_for_rows_elsewhere(
    path: Path, workbook: Workbook, text_format: TextFormat
) -> Iterator[Finding]:
    """Sheets with net rows under a name that nobody knows: half a site must not vanish.

    They are read only where a workbook holds sheets that have no part in a check, and
    asked about until somebody answers for them.
    """
    given = workbook.answers.sheets
    names = {
        name
        for name in workbook.unread
        if given.get(name, UNANSWERED) == UNANSWERED
        and name not in (*workbook.hidden, *QUIET_SHEETS)
        and not NETS.begins(name)  # asked about by its name
    }
    if not names or not list_meant(workbook, NETS):
        return
    try:
        every = read_workbook(
            path,
            names.__contains__,
            is_heading=is_heading,
            text_format=text_format,
        )
    except SiteDataError:  # what has no part in the check may be damaged
        return
    accepted = say("table.copy_accepted", name=NETS.title)
    for sheet in every.sheets:
        if sheet.name in names and count_known(sheet, NETS) >= _LEAST_KNOWN:
            yield workbook.finding(say("table.net_rows"), accepted, sheet.name)


def _list_unknown_profiles(
    workbook: Workbook, project: Project, cells: Mapping[str, str]
) -> Iterator[Finding]:
    """Profile that does not exist, beside other faults.

    Without them it is no fault of the workbook: a command may name another profile.
    """
    named = project.standard
    if not named or named in list_standards() or is_there(Path(named)):
        return
    sheet, _, cell = cells["standard"].rpartition("!")
    yield Finding(
        file=workbook.file,
        sheet=sheet,
        cell=cell,
        text=named,
        rule=say("item.no_profile"),
        accepted=say("accepted.words", words=list_standards()),
    )


def _complete(
    row: NetRow,
    ranges: RangesSheet,
    links: Mapping[str, tuple[Link, ...]],
    questions: tuple[Message, ...],
) -> NetRow:
    """Net row with its questions and lacks; a row is completed in one go.

    What every force of it lacks would hide what its checks lack besides.
    """
    unsaid = row.unsaid + ranges.unsaid
    missing = list_missing(row, links) if unsaid else ()
    every = tuple(dict.fromkeys((*unsaid, *missing)))
    return replace(row, unsaid=every, questions=questions)


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
    if table and not _is_stiffness_given(workbook, plan):
        ranges = assume_stiffness(ranges)
        plan = free_columns(plan, ranges.ends)
    others = [one for one in SHEETS if one not in (NETS, RANGES, PROJECT)]
    tables = {plan.name: find_table(workbook, plan, findings) for plan in others}
    nets = find_tables(workbook, plan, findings)
    return {RANGES.name: table, **tables}, nets, ranges


def _is_stiffness_given(workbook: Workbook, plan: SheetPlan) -> bool:
    """A stiffness of the net stands somewhere, or no net row is found at all."""
    if not next(one for one in plan.fields if one.key == STIFFNESS).required:
        return True
    tables = find_tables(workbook, plan.free((STIFFNESS,)), [])
    given = {key for table in tables for key in table.columns}
    return not tables or STIFFNESS in given


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
        sheet: _read_types(tables[sheet], rows, findings)
        for sheet, rows in of_types.items()
    }


def _build_rows(
    ranged: Table | None,
    nets: Sequence[Table],
    lines: Lines,
    findings: list[Finding],
) -> tuple[NetRow, ...]:
    """Net rows without a fault, held against what ranges over the whole site."""
    ranges = lines.ranges
    rows = build_net_rows(nets[0], lines, findings) if nets else ()
    findings.extend(ranges.findings)
    if ranged and ranges.ranges:
        check_layers(rows, lines.snow, ranges.ranges, findings)
    return rows


def read_cells(
    path: Path,
    text_format: TextFormat = UNDECLARED,
    sheets: Mapping[str, str] = MappingProxyType({}),
) -> Workbook:
    """Cells of the sheets that a site workbook has; nothing is understood yet."""
    answers = read_answers(path)
    answers = replace(answers, sheets={**answers.sheets, **sheets})
    if not text_format.decimal_mark:
        text_format = replace(text_format, decimal_mark=answers.decimal_mark)

    def is_wanted(sheet_name: str) -> bool:
        return any(is_meant(sheet_name, plan, answers) for plan in SHEETS)

    def is_name(text: str) -> bool:
        return is_wanted(text) or any(is_near(text, plan) for plan in SHEETS)

    workbook = read_workbook(path, is_wanted, is_name, is_heading, text_format)
    return give_answers(workbook, answers)


def _shorten(finding: Finding) -> Finding:
    """Remark without the list of headings, which helps only where one is sought."""
    is_long = finding.rule.key == "heading.unknown"
    return replace(finding, accepted="") if is_long else finding


def _note_unread(workbook: Workbook, findings: list[Finding]) -> list[Finding]:
    rule = say("table.not_read")
    told = {finding.sheet for finding in findings}
    return [
        note_file(workbook.file, rule, name)
        for name in workbook.unread
        if name not in QUIET_SHEETS and name not in told
    ]


def _read_project(
    workbook: Workbook, findings: list[Finding]
) -> tuple[Project, Mapping[str, str]]:
    """Project of the cover sheet, and cells of its items."""
    table = find_table(workbook, PROJECT, findings)
    values: dict[str, str] = {}
    cells: dict[str, str] = {}
    if table is None:
        return Project(), {}
    for row in read_rows(table, findings):
        item, value = row["item"], row["value"]
        if not item.word or _is_elsewhere(item, value, table, findings):
            continue
        if _is_strange(item, value, table, findings):
            continue
        meaning = match_item(item, table, "item", findings)
        field = meaning.field
        if field is None or value.state != "given" or not (item.cell and value.cell):
            continue
        if field.key in cells:
            rule = say("item.twice", place=cells[field.key])
            refuse(item, rule, say("item.one_line"), findings)
        elif field.key == "accepted_law" and value.word not in CREEP_LAWS:
            accepted = say("accepted.words", words=tuple(CREEP_LAWS))
            refuse(value, say("item.no_law"), accepted, findings)
        else:
            values[field.key], cells[field.key] = value.word, value.place
    refuse_unused_answers(table, findings)
    return Project(**values), cells


def _is_elsewhere(
    item: Reading, value: Reading, table: Table, findings: list[Finding]
) -> bool:
    """A line gives what stands on sheet Nets or Ranges, and is refused."""
    name = item.word
    if value.state != "given" or find_item(name, PROJECT.items):
        return False
    if item.cell is None or any(
        is_asked(item.cell, one) for one in table.sheet.answers
    ):
        return False
    column = find_item(name, [one for one in NETS.fields if one.key != "id"])
    quantity = find_item(name, RANGES.items)
    if quantity and (column is None or split_range(value.word)):
        refuse(item, say("item.once"), say_place(quantity, RANGES), findings)
    elif column:
        refuse(item, say("item.once"), say_place(column, NETS), findings)
    return bool(column or quantity)


def _is_strange(
    item: Reading, value: Reading, table: Table, findings: list[Finding]
) -> bool:
    """A line of a cover sheet is about something else, which is told."""
    if item.cell is None or table.titles:
        return False
    if value.state == "given" and is_about(item.cell, table):
        return False
    refuse(item, say("item.not_read"), "", findings, severity="note")
    return True


def _read_types(
    table: Table | None, rows: list[Row], findings: list[Finding]
) -> dict[str, Row] | None:
    """Lines of a type sheet by id; a faulty line keeps its id known.

    None without the sheet, its headings or its column of ids.
    """
    if table is None:
        return None
    rows = [fill_in_section(row) for row in rows]
    for row in rows:
        basis = row.get("basis")
        if basis and basis.state == "blank" and row["pull_out"].state == "given":
            rule = say("type.basis_empty", place=row["pull_out"].place)
            refuse(basis, rule, basis.field.accepted, findings)
        refuse_misfits(row, findings)
    filled = [fill_in_resistances(row, findings) for row in rows]
    for row in filled:  # a computed resistance beside tests is one too many, too
        check_tests(row, findings)
        check_ends(row, findings)
        check_section(row, findings)
    by_id = index_lines(filled, "id", say("nets.ids_once"), findings)
    return by_id if "id" in table.columns else None
