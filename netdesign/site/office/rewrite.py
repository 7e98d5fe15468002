"""A workbook with sheet Nets as lines of the input workbook, and what was done.

Every cell that is filled in either has a place there, or is named in the list.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.site.cells.cells import Workbook
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import (
    DECLARED,
    MONITORING,
    NETS,
    PROJECT,
    RANGES,
    SHEETS,
    UNCERTAINTY,
    WINTER,
)
from netdesign.site.columns.fields import SheetPlan
from netdesign.site.columns.office import load_text
from netdesign.site.declared_sheet import split_replacement
from netdesign.site.headings import Table
from netdesign.site.office.rewrite_rows import rewrite_rows
from netdesign.site.office.rewrite_types import rewrite_types
from netdesign.site.office.told import Told, copy_cells, show
from netdesign.site.project_sheet import read_project
from netdesign.site.ranges import read_line
from netdesign.site.readings import Reading, Row
from netdesign.site.tables import find_table, find_tables, read_field, read_rows
from netdesign.words.catalogue import Language
from netdesign.words.message import Message, say

_FURTHER = {
    MONITORING.name: "monitoring",
    WINTER.name: "winter",
    UNCERTAINTY.name: "reliability",
}
_PARTS = ("ropes", "posts", "links", "soils")
_SHEETS = {"layers": "snow", "tests": "tests", "declared": "declared"}
_OF_PROJECT = ("density", "friction_angle", "inclination")
_DOCUMENTS = {
    **dict.fromkeys(("density", "thickness", "snow_height"), "snow_document"),
    "glide_factor": "glide_document",
}
_LEFT = ("Nets", "Ends", "Anchors", "Ropes", "Posts", "Tests", "Links", "Snow")
_Ranged = dict[str, tuple[str, Reading]]  # text of the new cell, justification


@dataclass(frozen=True, slots=True, kw_only=True)
class Rewritten:
    """Lines of the input workbook.

    Attributes
    ----------
    tables : mapping of str to sequence of mapping
        Lines by table and key.
    measures : mapping
        What unit cells measure, by table and key.
    sheets : sequence of str
        Sheets beside those that are always there.
    done : sequence of Message
        What was done, each kind once.
    """

    tables: Mapping[str, Sequence[Mapping[str, object]]]
    measures: Mapping[tuple[str, str], str]
    sheets: Sequence[str]
    done: Sequence[Message]


def rewrite(workbook: Workbook, language: Language) -> Rewritten:
    """Rewrite a workbook; cells that cannot be understood are copied as they are.

    Parameters
    ----------
    workbook : Workbook
        As read.
    language : str
        Of the workbook that is written, also of the words in its ranges.
    """
    told, unheard = Told(), list[Finding]()
    tables = {
        plan.name: find_table(workbook, _free_all(plan), unheard)
        for plan in SHEETS
        if plan not in (NETS, PROJECT)
    }
    lines = {name: read_rows(table, unheard) for name, table in tables.items()}
    nets = find_tables(workbook, _free_all(NETS), unheard)
    lines["Nets"] = [line for table in nets for line in read_rows(table, unheard)]
    ranged = _read_ranges(tables[RANGES.name], language, told)
    texts = {key: text for key, (text, _) in ranged.items()}
    made, measures = rewrite_rows(lines, texts, told)
    made |= rewrite_types(lines, told)
    common = made.pop("project")[0]
    made["project"] = [_rewrite_project(workbook, ranged, common, told)]
    made["declared"] = list(_rewrite_declared(lines[DECLARED.name], told))
    for name in _FURTHER:
        made[name] = [copy_cells(line, list(line), told) for line in lines[name]]
    measures["layers", "thickness"] = _measure_layers(lines["Snow"])
    _add_up_layers(made, measures)
    for name in _LEFT:
        told.leave_rest(name, lines[name])
    sheets = [name for table, name in _SHEETS.items() if made.get(table)]
    sheets += ["parts"] if any(made.get(one) for one in _PARTS) else []
    sheets += [name for plan, name in _FURTHER.items() if lines[plan]]
    done = tuple(told.list_done())
    return Rewritten(tables=made, measures=measures, sheets=sheets, done=done)


def _free_all(plan: SheetPlan) -> SheetPlan:
    """Plan that needs no column: what is not there is left empty."""
    freed = plan.free({one.key for one in plan.fields})
    return replace(freed, required=False, one_of=())


def _measure_layers(lines: Sequence[Row]) -> str:
    is_vertical = any(one["height"].state == "given" for one in lines)
    return "vertical" if is_vertical else "normal"


def _add_up_layers(
    made: Mapping[str, Sequence[dict[str, object]]],
    measures: Mapping[tuple[str, str], str],
) -> None:
    """Give a row whose snow only its layers say the sum of these."""
    is_alike = measures["rows", "snow"] == measures["layers", "thickness"]
    for row in made["rows"]:
        of_row = [one for one in made["layers"] if one.get("row") == row.get("id")]
        sizes = [one.get("thickness") for one in of_row]
        slope = row.get("slope_angle")
        if "snow" in row or not sizes or not isinstance(slope, float):
            continue
        total = math.fsum(one for one in sizes if isinstance(one, float))
        factor = math.cos(math.radians(slope))
        if not is_alike:
            is_vertical = measures["rows", "snow"] == "vertical"
            total = total / factor if is_vertical else total * factor
        row["snow"] = round(total, 3)


def _read_ranges(table: Table | None, language: Language, told: Told) -> _Ranged:
    """Ranges as texts of cells in the first unit of their column."""
    ranged: _Ranged = {}
    for row in table.rows if table else ():
        assert table is not None
        found: dict[str, object] = {}
        names: dict[str, Reading] = {}
        read_line(table, row, found, names, [])  # type: ignore[arg-type]
        typed = {
            key: read_field(table, key, row, []) for key in ("low", "high", "span")
        }
        why = read_field(table, "justification", row, [])
        for key, one in found.items():
            if one is None:
                for cell in typed.values():
                    if cell.cell is not None and not cell.cell.is_blank:
                        told.leave(cell, say("rewrite.of_range"))
                continue
            ends = (one.low.number, one.high.number)  # type: ignore[attr-defined]
            to = f" {load_text('to', language)} "
            mark = load_text("comma", language)
            text = to.join(f"{_scale(key, end):g}".replace(".", mark) for end in ends)
            ranged[key] = (text, why)
            told.do(say("rewrite.range"), names[key])
    return ranged


def _scale(key: str, end: float) -> float:
    """End of a range in the unit that the new workbook shows."""
    return round(100.0 * end, 6) if key == "slack" else end


def _rewrite_project(
    workbook: Workbook, ranged: _Ranged, common: Mapping[str, object], told: Told
) -> dict[str, object]:
    """Lines of sheet Project: what identifies the study, and holds for the site."""
    project, cells = read_project(workbook, [])
    number = ", ".join(filter(None, (project.number, project.revision)))
    if place := cells.get("accepted_law"):
        told.done[say("rewrite.creep_law")] = [place]
    found: dict[str, object] = {
        **{"name": project.name, "number": number, "author": project.author},
        **{"checker": project.checker, "standard": project.standard},
        **common,
    }
    for key, (text, why) in ranged.items():
        if key in _OF_PROJECT:
            found[key] = text
        if why.state != "given":
            continue
        line = _DOCUMENTS.get(key, "")
        if line and line not in found:
            found[line] = why.word
            told.do(say("rewrite.document"), why)
        else:
            told.leave(why, say("rewrite.of_reason"))
    return {key: value for key, value in found.items() if value != ""}


def _rewrite_declared(lines: Sequence[Row], told: Told) -> Iterator[dict[str, object]]:
    for line in lines:
        if split_replacement(line["check"].word):
            told.leave(line["check"], say("rewrite.confirmed"))
            continue
        yield {key: show(one) for key, one in line.items() if one.state != "blank"}
