"""A workbook with sheet Nets as lines of the input workbook, and what was done.

Every cell that is filled in either has a place there, or is named in the list.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from netdesign.site.cells.cells import Cell, TextFormat, Workbook
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
from netdesign.site.columns.office import is_heading, load_text
from netdesign.site.declared_sheet import split_replacement
from netdesign.site.office.rewrite_rows import rewrite_rows
from netdesign.site.office.rewrite_types import rewrite_types
from netdesign.site.office.sheets import is_old
from netdesign.site.office.told import Told, copy_cells, show
from netdesign.site.readings import Reading, Row, read_cell
from netdesign.site.tables import find_table, read_rows
from netdesign.words.catalogue import Language
from netdesign.words.message import Message, say

_FURTHER = dict(
    zip(
        (one.name for one in FURTHER),
        ("monitoring", "winter", "reliability"),
        strict=True,
    )
)
_PARTS = ("ropes", "posts", "links", "soils")
_SHEETS = {"layers": "snow", "tests": "tests", "declared": "declared"}
_OF_PROJECT = ("density", "friction_angle", "inclination")
_DOCUMENTS = {
    **dict.fromkeys(("density", "thickness", "snow_height"), "snow_document"),
    "glide_factor": "glide_document",
}
_LEFT = ("Nets", "Ends", "Anchors", "Ropes", "Posts", "Tests", "Links", "Snow")
_UNHEARD = ("heading.unknown", "heading.close_to_missing", "table.no_heading_unread")
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


def read_old(path: Path, text_format: TextFormat) -> Workbook | None:
    """Workbook of version 0.1; None of any other."""
    plans = load_old_plans().values()

    def is_wanted(name: str) -> bool:
        return any(plan.matches(name) for plan in plans)

    workbook = read_workbook(path, is_wanted, is_heading, text_format)
    return workbook if is_old(workbook) else None


def rewrite(workbook: Workbook, language: Language) -> Rewritten:
    """Rewrite a workbook; cells that cannot be understood are copied as they are.

    Parameters
    ----------
    workbook : Workbook
        As `read_old` gives it.
    language : str
        Of the workbook that is written, also of the words in its ranges.
    """
    told, unheard = Told(), list[Finding]()
    lines = {
        name: read_rows(find_table(workbook, _free_all(plan), unheard), unheard)
        for name, plan in load_old_plans().items()
    }
    ranged = _read_ranges(lines["Ranges"], language, told)
    texts = {key: text for key, (text, _) in ranged.items()}
    made, measures = rewrite_rows(lines, texts, told)
    made |= rewrite_types(lines, told)
    common = made.pop("project")[0]
    made["project"] = [_rewrite_project(lines["Project"], ranged, common, told)]
    made["declared"] = list(_rewrite_declared(lines["Declared"], told))
    for name in _FURTHER:
        made[name] = [copy_cells(line, list(line), told) for line in lines[name]]
    measures["layers", "thickness"] = _measure_layers(lines["Snow"])
    _add_up_layers(made, measures)
    for name in _LEFT:
        told.leave_rest(name, lines[name])
    sheets = [name for table, name in _SHEETS.items() if made.get(table)]
    sheets += ["parts"] if any(made.get(one) for one in _PARTS) else []
    sheets += [sheet for name, sheet in _FURTHER.items() if lines[name]]
    left = (one.message for one in unheard if one.rule.key in _UNHEARD)
    done = (*told.list_done(), *left)
    return Rewritten(tables=made, measures=measures, sheets=sheets, done=done)


def _free_all(plan: SheetPlan) -> SheetPlan:
    """Plan that needs no column: what is not there is left empty."""
    fields = tuple(replace(one, required=False) for one in plan.fields)
    return replace(plan, fields=fields, required=False, one_of=())


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


def _read_ranges(lines: Sequence[Row], language: Language, told: Told) -> _Ranged:
    """Ranges as texts of cells in the first unit of their column."""
    items = load_old_plans()["Ranges"].items
    to, mark = f" {load_text('to', language)} ", load_text("comma", language)
    ranged: _Ranged = {}
    for line in lines:
        name = line["quantity"]
        field = find_item(name.word, items)
        ends = _read_ends(line, field) if field else []
        numbers = (line[key].cell for key in ("span", "low", "high"))
        if all(cell is None or cell.is_blank for cell in numbers):
            told.take(*line.values())
            continue
        if field is None or not ends:
            for one in line.values():
                if one.cell is not None and not one.cell.is_blank:
                    told.leave(one, say("rewrite.of_range"))
            continue
        texts = (f"{_scale(field.key, end):g}".replace(".", mark) for end in ends)
        ranged[field.key] = (to.join(texts), line["justification"])
        told.do(say("rewrite.range"), name)
    return ranged


def _read_ends(line: Row, field: Field) -> list[float]:
    """Low and high end of a line, in the first unit of its quantity."""
    typed = normalise_unit(line["unit"].word.strip(" []()"))
    unit = typed or split_heading(line["quantity"].word)[1] or field.unit
    span = line["span"].cell
    if span is not None and not span.is_blank:
        both = read_cell(span, replace(field, may_range=True), unit, [])
        return list(both.span or ())
    cells = (line["low"].cell, line["high"].cell)
    ends = [_read_end(cell, field, unit) for cell in cells if cell]
    known = [one for one in ends if one is not None]
    return known if len(known) == len(cells) else []


def _read_end(cell: Cell, field: Field, unit: str) -> float | None:
    if unit not in field.units:
        return None
    reading = read_cell(cell, field, unit, [])
    return reading.number if reading.state == "given" else None


def _scale(key: str, end: float) -> float:
    """End of a range in the unit that the new workbook shows."""
    return round(100.0 * end, 6) if key == "slack" else end


def _rewrite_project(
    lines: Sequence[Row], ranged: _Ranged, common: Mapping[str, object], told: Told
) -> dict[str, object]:
    """Lines of sheet Project: what identifies the study, and holds for the site."""
    items = load_old_plans()["Project"].items
    named = {
        field.key: line["value"]
        for line in lines
        if line["value"].word and (field := find_item(line["item"].word, items))
    }
    if law := named.pop("accepted_law", None):
        told.done[say("rewrite.creep_law")] = [law.place]
    texts = {key: one.word for key, one in named.items()}
    numbers = (texts.get("number", ""), texts.pop("revision", ""))
    texts["number"] = ", ".join(filter(None, numbers))
    found: dict[str, object] = {**texts, **common}
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
