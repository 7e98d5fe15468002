"""Writes parts of the input workbook: formats, names and units in its language."""

from __future__ import annotations

import datetime
from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace
from io import BytesIO
from textwrap import wrap
from typing import TYPE_CHECKING

from netdesign.cable.net import find_sag
from netdesign.site.assumed import MULTIPLE, Assumed, load_assumed
from netdesign.site.columns.all_tables import FURTHER, load_file
from netdesign.site.columns.fields import Field, SheetPlan
from netdesign.site.columns.office import (
    Column,
    load_columns,
    load_plan,
    load_text,
    name_measure,
)
from netdesign.words.catalogue import Language, render, set_marks, write_unit
from netdesign.words.message import say

if TYPE_CHECKING:  # slow to import and only needed to write a workbook
    from xlsxwriter.format import Format
    from xlsxwriter.workbook import Workbook
    from xlsxwriter.worksheet import Worksheet

Tables = Mapping[str, Sequence[Mapping[str, object]]]  # lines by table and key

_YELLOW, _GREY, _INK = "#FFF2B3", "#7A7A7A", "#1F2A36"
_PALE, _LINE = "#EEF1F4", "#C9CFD6"

_OPTIONS = {
    "strings_to_formulas": False,
    "strings_to_numbers": False,
    "strings_to_urls": False,
    "in_memory": True,
    # every office has it or its double, so that widths are the same in all programs
    "default_format_properties": {"font_name": "Arial", "font_size": 10},
}
# The same program writes the same bytes: no clock goes into the file.
_CREATED = datetime.datetime(2000, 1, 1)
_A4 = 9


@dataclass(frozen=True)
class Form:
    """Workbook while it is written: its formats, its sheets, its lines."""

    workbook: Workbook
    language: Language
    sheets: Sequence[str]
    tables: Tables
    measures: Mapping[tuple[str, str], str]
    formats: dict[str, Format] = field(default_factory=dict)

    def text(self, key: str, area: str = "text") -> str:
        """Text of the template."""
        return load_text(key, self.language, area)

    def style(self, name: str) -> Format:
        """Format of a name, which is created at its first use."""
        if name not in self.formats:
            properties = {"font_color": _INK, "valign": "vcenter", **_STYLES[name]}
            self.formats[name] = self.workbook.add_format(properties)
        return self.formats[name]

    def style_cell(self, column: Column) -> Format:
        """Format of a cell to fill in; text keeps ids such as 007 as typed."""
        is_number = column.field.kind in ("number", "count")
        return self.style("number" if is_number else "text")


_EDGE = {"border": 1, "border_color": _LINE}
_SMALL = {**_EDGE, "font_size": 9, "text_wrap": True, "valign": "top"}
_STYLES: Mapping[str, Mapping[str, object]] = {
    "title": {"bold": True, "font_size": 14},
    "about": {"font_color": _GREY, "italic": True},
    "group": {"bold": True, "font_color": "#FFFFFF", "bg_color": "#4A5A6A"},
    "head": {**_SMALL, "bold": True, "bg_color": _PALE},
    "head yes": {**_SMALL, "bold": True, "bg_color": _YELLOW},
    "unit": {**_EDGE, "font_size": 9, "bg_color": _PALE},
    "unit yes": {**_EDGE, "font_size": 9, "bg_color": _YELLOW},
    "empty": {
        **{**_SMALL, "font_size": 8},
        **{"font_color": _GREY, "italic": True, "bg_color": _PALE},
    },
    "number": {**_EDGE},
    "text": {**_EDGE, "num_format": "@", "indent": 1},
    "missing": {"bg_color": _YELLOW},
    "yes": {**_EDGE, "bg_color": _YELLOW},
    "plain": {"text_wrap": True, "valign": "top"},
    "bold": {"bold": True},
    "cell": _SMALL,
    "grey": {**_SMALL, "font_color": _GREY, "italic": True},
}


def start_workbook(content: BytesIO, language: Language) -> Workbook:
    """Workbook that goes into ``content`` once it is closed."""
    import xlsxwriter

    workbook = xlsxwriter.Workbook(content, deepcopy(_OPTIONS))  # it writes into them
    title = load_text("title", language)
    workbook.set_properties({"title": title, "created": _CREATED})
    return workbook


def add_sheet(form: Form, title: str) -> Worksheet:
    """Sheet of a name, which is printed on the width of a page."""
    sheet = form.workbook.add_worksheet(title)
    sheet.hide_gridlines(2)
    sheet.set_landscape()
    sheet.set_paper(_A4)
    sheet.fit_to_pages(1, 0)
    return sheet


def find_plan(table: str) -> SheetPlan:
    """Plan of a sheet of the input workbook or of an add-on."""
    further = (plan for plan in FURTHER if plan.name == table)
    return next(further, None) or load_plan(table)


def is_further(table: str) -> bool:
    """Whether a sheet belongs to an add-on."""
    return any(plan.name == table for plan in FURTHER)


def count_lines(text: str, width: float) -> int:
    """Number of lines of a text in a column, whose width is in characters."""
    return max(1, len(wrap(text, max(1, int(width)))))


def list_shown(form: Form, table: str) -> list[Column]:
    """Columns of a table; columns of the structure only beside sheet Parts."""
    if is_further(table):
        return [_show_field(field) for field in find_plan(table).fields]
    return [
        column
        for column in load_columns(table)
        if column.group != "structure" or "parts" in form.sheets
    ]


def _show_field(field: Field) -> Column:
    """Column of a sheet of an add-on."""
    return Column(
        field=field,
        unit=field.unit,
        need="yes" if field.required else "",
        texts={"note": field.notes, "why": {}, "divided": {}},
        measured={},
    )


def name_column(form: Form, column: Column, is_divided: bool = False) -> str:
    """Name of a column, divided by hyphens where its heading is narrow."""
    divided = column.texts["divided"].get(form.language, "")
    if is_divided and divided:
        return divided.replace("|", "-\n")
    return column.field.label_in(form.language)


def say_unit(form: Form, column: Column) -> str:
    """Unit of a column; with several measures, the unit chosen for it or the first."""
    if column.choice:
        key = (column.field.table, column.field.key)
        first = load_file("office")["choices"][column.choice][0]
        measure = form.measures.get(key) or first
        return name_measure(column.choice, measure, form.language)
    return write_unit(column.unit) if column.field.units else ""


def write_about(
    form: Form,
    sheet: Worksheet,
    place: tuple[int, int],
    keys: Sequence[str],
    column: Column,
) -> list[str]:
    """Write the texts about a column, from a cell to the right, and return them.

    Parameters
    ----------
    place : tuple of int
        Row and column of the first cell, from 0.
    keys : sequence of str
        Of the headings above the cells.
    """
    texts = {
        "item": name_column(form, column),
        "unit": say_unit(form, column),
        "accepted": say_accepted(column, form.language),
        "empty": say_empty(column, form.language),
        "source": say_why(column, form.language),
        "has": form.text(column.has, "who"),
        "meaning": column.texts["note"][form.language],
    }
    row, first = place
    for number, key in enumerate(keys, start=first):
        style = "grey" if key in ("empty", "source") else "cell"
        sheet.write_string(row, number, texts[key], form.style(style))
    return [texts[key] for key in keys]


def say_empty(column: Column, language: Language) -> str:
    """Range or value that is assumed for an empty cell, or a phrase about it."""
    values = column.assumed or _list_ends(column)
    if values:
        texts = dict.fromkeys(_show(value, language) for value in values)
        return f" {load_text('to', language)} ".join(texts)
    if column.said:
        return load_text(column.said, language, "said")
    assumed = _find(column)
    return render(assumed.text, language) if assumed else ""


def say_why(column: Column, language: Language) -> str:
    """Source of the assumed value; empty where nothing is assumed."""
    if language in column.texts["why"]:
        return column.texts["why"][language]
    assumed = _find(column)
    return render(assumed.why, language) if assumed else ""


def say_accepted(column: Column, language: Language) -> str:
    """Bounds or words that a cell accepts, in the shown unit; empty for free text."""
    field = column.field
    low, high = _show_in_unit(column, field.bounds)
    is_open = not field.words and field.bounds[0] == field.bounds[1]
    units = ("%",) if column.is_percent else field.units
    shown = replace(field, bounds=(low, high), units=units).accepted
    accepted = say("accepted.or_range", accepted=shown) if field.may_range else shown
    return "" if is_open else render(accepted, language)


def _find(column: Column) -> Assumed | None:
    if column.said or column.field.required or not column.has:
        return None
    return load_assumed().get(column.field.key)


def _list_ends(column: Column) -> Sequence[float | str]:
    assumed = _find(column)
    if assumed is None or assumed.word:
        return ()
    if assumed.unit == MULTIPLE:
        return tuple(f"{end:g} {MULTIPLE}" for end in assumed.shown)
    return _show_in_unit(column, assumed.shown)


def _show_in_unit(column: Column, ends: Sequence[float]) -> tuple[float, ...]:
    """Ends of a range in the unit that the template shows."""
    if column.choice == "sag_unit":
        return tuple(round(100.0 * find_sag(end), 1) for end in ends)
    return tuple(round(column.show(end), 6) for end in ends)


def _show(value: float | str, language: Language) -> str:
    text = value if isinstance(value, str) else f"{value:.6g}"
    return set_marks(text, language)
