"""Sheet Notes of the input workbook: colours, the section, what columns mean."""

from __future__ import annotations

from importlib.resources import files
from io import BytesIO
from typing import TYPE_CHECKING

from netdesign.site.columns.all_tables import load_file
from netdesign.site.columns.office import PARTS, load_plan
from netdesign.site.template.form import (
    Form,
    add_sheet,
    count_lines,
    is_further,
    list_shown,
    write_about,
)
from netdesign.words.catalogue import Language, render
from netdesign.words.message import say

if TYPE_CHECKING:  # slow to import and only needed to write a workbook
    from xlsxwriter.worksheet import Worksheet

_KEYS = ("item", "unit", "accepted", "empty", "has", "meaning")
_NOTE_WIDTHS = (13, 25, 12, 16, 27, 15, 62)
_PICTURE_ROW, _PICTURE_ROWS = 6, 22


def write_notes(form: Form) -> None:
    """Sheet Notes: colours, the section with its names, every column."""
    sheet = add_sheet(form, render(say("sheet.notes"), form.language))
    for number, width in enumerate(_NOTE_WIDTHS):
        sheet.set_column(number, number, width)
    sheet.write_string(0, 0, form.text("title"), form.style("title"))
    sheet.write_blank(2, 0, None, form.style("yes"))
    sheet.write_string(2, 1, form.text("needed"))
    sheet.write_blank(3, 0, None, form.style("cell"))
    sheet.write_string(3, 1, form.text("optional"))
    sheet.write_string(4, 0, form.text("range"))
    sheet.write_string(5, 0, form.text("section"), form.style("bold"))
    picture = files(__package__).joinpath(name_section(form.language)).read_bytes()
    options = {"image_data": BytesIO(picture), "description": form.text("section")}
    scale = {"x_scale": 0.6, "y_scale": 0.6, "object_position": 3}
    sheet.insert_image(_PICTURE_ROW, 0, "section.png", options | scale)
    row = _PICTURE_ROW + _PICTURE_ROWS + 1
    for name in (name for name in form.sheets if not is_further(name)):
        for table in PARTS if name == "parts" else (name,):
            row = _write_columns(form, sheet, row, table) + 1


def _write_columns(form: Form, sheet: Worksheet, row: int, table: str) -> int:
    """Columns of a table with what they mean; returns the row below."""
    plan = load_plan(table)
    title = plan.name_in(form.language)
    if table in PARTS:
        about = load_file("office")["sheets"][table]["about"][form.language]
        title = f"{title}: {about}"
    titles = [title, *[""] * (len(_NOTE_WIDTHS) - 1)]
    sheet.write_row(row, 0, titles, form.style("group"))
    sheet.write_row(row + 1, 0, ["", *map(form.text, _KEYS)], form.style("head"))
    columns = list_shown(form, table)
    for line, column in enumerate(columns, start=row + 2):
        sheet.write_blank(line, 0, None, form.style("yes" if column.need else "cell"))
        texts = write_about(form, sheet, (line, 1), _KEYS, column)
        lines = max(map(count_lines, texts, _NOTE_WIDTHS[1:]))
        sheet.set_row(line, 13.0 * lines)
    return row + 2 + len(columns)


def name_section(language: Language) -> str:
    """File of the section with the names of a language, beside this module."""
    return f"section.{language}.png"
