"""Rewrites a workbook of version 0.1 as lines of the input workbook.

Every filled cell has a place there, or is named in the list of what was done.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from netdesign.site.cells.cells import TextFormat, Workbook
from netdesign.site.cells.findings import Finding
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.all_tables import FURTHER, load_old_plans
from netdesign.site.columns.fields import (
    Field,
    SheetPlan,
    find_item,
    normalise_unit,
    split_heading,
)
from netdesign.site.columns.office import is_heading, load_columns, load_text
from netdesign.site.declared_sheet import split_replacement
from netdesign.site.office.project import SHARED
from netdesign.site.office.rewrite_lines import (
    Line,
    Lines,
    RewriteLog,
    is_typed,
    rewrite_rows,
    rewrite_types,
    show,
)
from netdesign.site.office.sheets import is_old
from netdesign.site.readings import Reading, Row, read_cell
from netdesign.site.tables import find_table, read_rows
from netdesign.words.catalogue import Language
from netdesign.words.message import Message, say

_DOCUMENTS = {
    **dict.fromkeys(("density", "thickness", "snow_height"), "snow_document"),
    "glide_factor": "glide_document",
}
_UNREAD = ("heading.unknown", "heading.close_to_missing", "table.no_heading_unread")
_Ranged = dict[str, tuple[str, Reading]]  # text of the new cell, justification


@dataclass(frozen=True, slots=True, kw_only=True)
class Rewritten:
    """Lines of the input workbook, and what was done to get them.

    Attributes
    ----------
    tables : mapping of str to sequence of mapping
        Lines by table and key.
    measures : mapping
        What unit cells measure, by table and key.
    done : sequence of Message
        What was done, each kind once.
    """

    tables: Mapping[str, Sequence[Line]]
    measures: Mapping[tuple[str, str], str]
    done: Sequence[Message]


def read_old(path: Path, text_format: TextFormat) -> Workbook | None:
    """Workbook of version 0.1; None of any other."""
    plans = load_old_plans().values()

    def is_wanted(name: str) -> bool:
        return any(plan.matches(name) for plan in plans)

    workbook = read_workbook(path, is_wanted, is_heading, text_format)
    return workbook if is_old(workbook) else None


def rewrite(workbook: Workbook, language: Language) -> Rewritten:
    """Rewrite a workbook; cells that are not understood are copied as they are.

    Parameters
    ----------
    workbook : Workbook
        As `read_old` gives it.
    language : str
        Of the workbook that is written, also of the words in its ranges.
    """
    log, findings = RewriteLog(), list[Finding]()
    lines = {
        name: read_rows(find_table(workbook, _free_all(plan), findings), findings)
        for name, plan in load_old_plans().items()
    }
    ranged = _read_ranges(lines["Ranges"], language, log)
    texts = {key: text for key, (text, _) in ranged.items()}
    tables, measures = rewrite_rows(lines, texts, log)
    tables |= rewrite_types(lines, log)
    tables["project"] = [_rewrite_project(lines, ranged, log)]
    tables["declared"] = list(_rewrite_declared(lines["Declared"], log))
    for name in (plan.name for plan in FURTHER):
        tables[name] = [_copy_all(line) for line in lines.pop(name)]
    for of_sheet in lines.values():
        log.leave_rest(of_sheet)
    unread = (finding.message for finding in findings if finding.rule.key in _UNREAD)
    done = (*log.list_done(), *unread)
    return Rewritten(tables=tables, measures=measures, done=done)


def _free_all(plan: SheetPlan) -> SheetPlan:
    """Plan that needs no column: what is not there is left empty."""
    fields = tuple(replace(field, required=False) for field in plan.fields)
    return replace(plan, fields=fields, required=False)


def _copy_all(line: Row) -> Line:
    return {key: show(cell) for key, cell in line.items() if is_typed(cell)}


def _read_ranges(lines: Sequence[Row], language: Language, log: RewriteLog) -> _Ranged:
    """Ranges as texts of cells in the first unit of their column."""
    items = load_old_plans()["Ranges"].items
    to, mark = f" {load_text('to', language)} ", load_text("comma", language)
    ranged: _Ranged = {}
    for line in lines:
        if not any(is_typed(line[key]) for key in ("low", "high", "span")):
            log.tick(*line.values())
            continue
        field = find_item(line["quantity"].word, items)
        ends = _read_ends(line, field) if field else ()
        if field is None or len(ends) < 2:
            log.leave("rewrite.of_range", line["quantity"])
            log.tick(*line.values())
            continue
        share = 100.0 if field.key == "slack" else 1.0
        texts = (f"{round(share * end, 6):g}".replace(".", mark) for end in ends)
        ranged[field.key] = (to.join(texts), line["justification"])
        log.change(say("rewrite.range"), line["quantity"])
        log.tick(*(cell for key, cell in line.items() if key != "justification"))
    return ranged


def _read_ends(line: Row, field: Field) -> Sequence[float]:
    """Low and high end of a line, in the first unit of its quantity; else none."""
    typed = normalise_unit(line["unit"].word.strip(" []()"))
    unit = typed or split_heading(line["quantity"].word)[1] or field.unit
    cells = (line[key].cell for key in ("low", "high") if unit in field.units)
    ends = [read_cell(cell, field, unit, []) for cell in cells if cell is not None]
    return [end.number for end in ends if end.state == "given"]


def _rewrite_project(lines: Lines, ranged: _Ranged, log: RewriteLog) -> Line:
    """Lines of sheet Project: what identifies the study, and holds for the site."""
    items = load_old_plans()["Project"].items
    project: Line = {}
    for line in lines["Project"]:
        field, value = find_item(line["item"].word, items), line["value"]
        if field is None or field.key == "accepted_law":
            log.leave("rewrite.creep_law" if field else "rewrite.left", line["item"])
        elif is_typed(value):
            project[field.key] = value.word
        log.tick(line["item"], value)
    numbers = (project.get("number", ""), project.pop("revision", ""))
    project["number"] = ", ".join(filter(None, map(str, numbers)))
    project |= _find_common(lines, log)
    for key, (text, reason) in ranged.items():
        if key in SHARED:
            project[key] = text
        document = _DOCUMENTS.get(key, "")
        if document and document not in project and is_typed(reason):
            project[document] = reason.word
            log.change(say("rewrite.document"), reason)
        else:
            log.leave("rewrite.of_reason", reason)
    return project


def _find_common(lines: Lines, log: RewriteLog) -> Line:
    """What sheet Project says once, where all lines say the same."""
    common: Line = {}
    for column in load_columns("project"):
        sheet, _, key = column.like.rpartition(".")
        cells = [line[key] for line in lines.get(sheet, ()) if is_typed(line[key])]
        if len({cell.value for cell in cells}) == 1:
            common[column.field.key] = show(cells[0])
            log.change(say("rewrite.once", name=column.field.name), *cells)
        else:
            log.leave("rewrite.several", *cells)
    return common


def _rewrite_declared(lines: Sequence[Row], log: RewriteLog) -> Iterator[Line]:
    for line in lines:
        is_confirmed = split_replacement(line["check"].word)
        log.leave("rewrite.confirmed", *([line["check"]] if is_confirmed else []))
        log.tick(*line.values())
        if not is_confirmed:
            yield _copy_all(line)
