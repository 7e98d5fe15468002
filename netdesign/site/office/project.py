"""Sheet Project of the input workbook: what holds for the whole site."""

from __future__ import annotations

from collections.abc import Mapping

from netdesign.site.cells.cells import Cell
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.fields import Field, normalise_unit
from netdesign.site.columns.office import load_plan
from netdesign.site.headings import Table
from netdesign.site.model import Project
from netdesign.site.ranges import DOCUMENTS
from netdesign.site.readings import Reading, Row, explain_unit, read_nothing, refuse
from netdesign.site.tables import match_item, read_answered
from netdesign.words.message import say

_TEXTS = ("name", "number", "author", "checker", "standard")


def read_lines(table: Table | None, lines: list[Row], findings: list[Finding]) -> Row:
    """Lines of sheet Project by key, each read as its item asks.

    Parameters
    ----------
    table : Table or None
        The sheet; None where it is missing.
    lines : list of Row
        Its lines, as texts.
    findings : list of Finding
        Appended to: a line that is no item, or that stands twice.
    """
    by_key: dict[str, Reading] = {}
    for line in lines if table else ():
        assert table is not None
        item = line["item"]
        if not item.word:
            if table.sheet.is_delimited and line["value"].word:  # cut at a wrong place
                refuse(item, say("cell.empty"), item.field.accepted, findings)
            continue
        field = match_item(item, table.plan.items, findings)
        if field is None:
            continue
        if field.key in by_key:
            rule = say("item.twice", place=by_key[field.key].place)
            refuse(item, rule, say("item.one_line"), findings)
            continue
        cell = line["value"].cell
        by_key[field.key] = (
            read_nothing(field, None)
            if cell is None
            else _read_value(table, cell, field, line["unit"], findings)
        )
    items = load_plan("project").items
    return {
        field.key: by_key.get(field.key) or read_nothing(field, None) for field in items
    }


def _read_value(
    table: Table, cell: Cell, field: Field, typed: Reading, findings: list[Finding]
) -> Reading:
    unit = normalise_unit(typed.word.strip(" []()")) if field.units else ""
    unit = unit or field.unit
    if unit not in field.units and field.units:
        refuse(typed, *explain_unit(unit, field), findings)
        return Reading(field=field, state="faulty", text=cell.text, cell=cell)
    return read_answered(table.sheet, cell, field, unit, findings)


def build_project(lines: Row) -> tuple[Project, Mapping[str, str]]:
    """Project of the site, and the cells of its lines."""
    filled_in = {
        key: lines[key] for key in (*_TEXTS, *DOCUMENTS) if lines[key].state == "given"
    }
    values = {key: reading.word for key, reading in filled_in.items()}
    return Project(**values), {key: reading.place for key, reading in filled_in.items()}
