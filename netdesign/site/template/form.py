"""The input workbook while it is written: formats, names and units in its language."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from netdesign.site.columns.all_tables import load_file
from netdesign.site.columns.office import (
    Column,
    load_columns,
    load_text,
    name_measure,
)
from netdesign.site.template.workbook import Book
from netdesign.words.catalogue import Language

if TYPE_CHECKING:  # slow to import and only needed to write a workbook
    from xlsxwriter.format import Format

Tables = Mapping[str, Sequence[Mapping[str, object]]]  # lines by table and key

_YELLOW, _GREY, _INK, _PALE, _LINE = (
    *("#FFF2B3", "#7A7A7A", "#1F2A36"),
    *("#EEF1F4", "#C9CFD6"),
)
_SIGNS = {"deg": "°", "degC": "°C", "kg/m3": "kg/m³", "kN/m3": "kN/m³"} | {
    f"cm{n}": f"cm{sign}" for n, sign in ((2, "²"), (3, "³"), (4, "⁴"))
}


@dataclass(frozen=True)
class Form:
    """Workbook while it is written: its formats, its sheets, its lines."""

    book: Book
    sheets: Sequence[str]
    tables: Tables
    measures: Mapping[tuple[str, str], str]
    formats: dict[str, Format] = field(default_factory=dict)

    @property
    def language(self) -> Language:
        """Of sheets, headings, words and notes."""
        return self.book.language

    def text(self, key: str, area: str = "text") -> str:
        """Text of the template."""
        return load_text(key, self.language, area)

    def style(self, name: str, **more: object) -> Format:
        """Format of a name; made once."""
        if name not in self.formats:
            made = {"font_color": _INK, "valign": "vcenter", **_STYLES[name], **more}
            self.formats[name] = self.book.workbook.add_format(made)
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


def list_shown(form: Form, table: str) -> list[Column]:
    """Columns of a table; those of the structure only beside sheet Parts."""
    return [
        one
        for one in load_columns(table)
        if one.group != "structure" or "parts" in form.sheets
    ]


def name_column(form: Form, column: Column, is_divided: bool = False) -> str:
    """Name of a column, divided by hyphens where its heading is narrow."""
    divided = column.texts["divided"].get(form.language, "")
    if is_divided and divided:
        return divided.replace("|", "-\n")
    return column.field.label_in(form.language)


def say_unit(form: Form, column: Column) -> str:
    """Unit of a column; of several measures the one that is given, or the first."""
    if column.choice:
        key = (column.field.table, column.field.key)
        first = load_file("office")["choices"][column.choice][0]
        measure = form.measures.get(key) or first
        return name_measure(column.choice, measure, form.language)
    return _SIGNS.get(column.unit, column.unit) if column.field.units else ""
