"""Sheet Project: what identifies a study on every page."""

from __future__ import annotations

from collections.abc import Mapping

from netdesign.site.cells.cells import Workbook
from netdesign.site.cells.findings import Finding
from netdesign.site.cells.numbers import split_range
from netdesign.site.columns.all_tables import NETS, PROJECT, RANGES
from netdesign.site.columns.fields import find_item
from netdesign.site.headings import Table, refuse_unused_answers
from netdesign.site.model import Project
from netdesign.site.readings import Reading, refuse
from netdesign.site.tables import (
    find_table,
    is_about,
    match_item,
    read_rows,
    say_place,
)
from netdesign.site.titles import is_asked
from netdesign.words.message import say


def read_project(
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
        elif field.key == "accepted_law":  # of workbooks of version 0.1
            cells[field.key] = value.place
            refuse(item, say("item.no_effect"), "", findings, severity="note")
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
