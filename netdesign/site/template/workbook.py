"""Sheets of add-ons in the input workbook: headings, units, notes, drop-downs."""

from __future__ import annotations

import datetime
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from netdesign.site.assumed import load_assumed
from netdesign.site.columns.all_tables import (
    load_text,
)
from netdesign.site.columns.fields import Field, SheetPlan
from netdesign.words.catalogue import Language, render
from netdesign.words.message import say

if TYPE_CHECKING:  # slow to import and only needed to write a workbook
    from xlsxwriter.format import Format
    from xlsxwriter.workbook import Workbook
    from xlsxwriter.worksheet import Worksheet

# The same program writes the same bytes: no clock goes into the file.
_CREATED = datetime.datetime(2000, 1, 1)
_LAST_ROW = 200  # drop-downs and bounds reach down to this line
_PRINTED_ROWS = 24  # of an empty form; a longer table is printed to its end
_COLUMN_WIDTH = 12.5
_TEXT_WIDTH = 30
_NOTE_WIDTH = 40  # characters in a line of a note on a heading
_A4 = 9
_HEADING_LINE = 15.5  # [pt]
_WIDEST_PAGE = 14  # columns; more go on two pages, each with the first column
_INK, _SOFT, _REQUIRED, _HEADING = "#1b1e22", "#9aa2ab", "#fff8dc", "#e6edf4"
_OPTIONS = {
    "strings_to_formulas": False,
    "strings_to_numbers": False,
    "strings_to_urls": False,
    "in_memory": True,
}
# Every office has it or its double, so that widths are the same in all programs.
_FONT = {"font_name": "Arial", "font_size": 10}

_Lines = Sequence[Mapping[str, object]]  # of one sheet, by field key


@dataclass(frozen=True, slots=True)
class Book:
    """Workbook while it is written: its language and its formats."""

    workbook: Workbook
    language: Language
    formats: Mapping[str, Format]

    @property
    def created(self) -> datetime.datetime:
        """Date of every workbook: the same program writes the same bytes."""
        return _CREATED

    @property
    def texts(self) -> Mapping[str, str]:
        """General texts of the workbook in its language."""
        return load_text(self.language)


def start_book(content: BytesIO, language: Language) -> Book:
    """Workbook that goes into ``content`` once it is closed."""
    import xlsxwriter

    # a copy of the font: XlsxWriter writes into what it is given
    options = {**_OPTIONS, "default_format_properties": dict(_FONT)}
    workbook = xlsxwriter.Workbook(content, options)
    title = load_text(language)["title"]
    workbook.set_properties({"title": title, "created": _CREATED})
    return Book(workbook, language, _add_formats(workbook))


def _add_formats(workbook: Workbook) -> dict[str, Format]:
    """Cells to fill in have thin borders; required ones a wash of colour."""
    head = {"bold": True, "text_wrap": True, "valign": "top", "font_color": _INK}
    cell = {"border": 1, "border_color": _SOFT}
    return {
        "heading": workbook.add_format(
            {**head, "bg_color": _HEADING, "bottom": 2, "border_color": _INK}
        ),
        "text": workbook.add_format({**cell, "num_format": "@"}),
        "number": workbook.add_format(cell),
        "required text": workbook.add_format(
            {**cell, "num_format": "@", "bg_color": _REQUIRED}
        ),
        "required number": workbook.add_format({**cell, "bg_color": _REQUIRED}),
    }


def write_sheet(book: Book, plan: SheetPlan, lines: _Lines) -> None:
    """Sheet of a plan: headings with notes, what cells accept, its lines."""
    sheet = book.workbook.add_worksheet(plan.name_in(book.language))
    last_row = max(_PRINTED_ROWS, len(lines))
    _set_up_page(sheet, book, plan, last_row)
    headings = [field.heading_for(book.language) for field in plan.fields]
    widths = [
        _TEXT_WIDTH if field.kind in ("text", "date") else _fit_words(heading)
        for field, heading in zip(plan.fields, headings, strict=True)
    ]
    lines_high = max(map(count_lines, headings, widths))
    sheet.set_row(0, _HEADING_LINE * lines_high + _HEADING_LINE / 4)
    for column, field in enumerate(plan.fields):
        sheet.set_column(column, column, widths[column])
        sheet.write_string(0, column, headings[column], book.formats["heading"])
        if note := describe_field(field, book.language):
            sheet.write_comment(0, column, note, _size_note(note))
        if rule := _validation(field, book):
            sheet.data_validation(1, column, _LAST_ROW, column, rule)
        for row in range(1, last_row + 1):
            sheet.write_blank(row, column, None, _choose_format(field, book))
    for row, line in enumerate(lines, start=1):
        _write_line(sheet, book, plan, row, line)


def _size_note(note: str) -> dict[str, Any]:
    """Box of a note on a heading, high enough for its text."""
    lines = sum(count_lines(line, _NOTE_WIDTH) for line in note.split("\n"))
    return {"x_scale": 2.2, "height": max(104, 17 * lines + 10), "author": ""}


def _fit_words(heading: str) -> float:
    """Width of a column that breaks no word of its heading, which is bold."""
    longest = max(len(word) for word in heading.split())
    return max(_COLUMN_WIDTH, 1.2 * longest + 1)


def _set_up_page(sheet: Worksheet, book: Book, plan: SheetPlan, last_row: int) -> None:
    texts = book.texts
    sheet.freeze_panes(1, 1)
    sheet.set_paper(_A4)
    sheet.set_landscape()
    sheet.fit_to_pages(1 if len(plan.fields) <= _WIDEST_PAGE else 2, 0)
    sheet.repeat_columns(0)
    sheet.set_margins(left=0.5, right=0.5, top=0.8, bottom=0.7)
    sheet.repeat_rows(0)
    sheet.print_area(0, 0, last_row, len(plan.fields) - 1)
    name = plan.name_in(book.language)
    sheet.set_header(f"&L&B{texts['title']}&R{name}".replace("'", "’"))
    sheet.set_footer(f"&L&F&R{texts['page']} &P {texts['of']} &N")


def _choose_format(field: Field, book: Book) -> Format:
    # Text cells keep an id such as 007, or a revision 1/2, as it is typed.
    kind = "number" if field.kind in ("number", "count") else "text"
    return book.formats[f"required {kind}" if field.required else kind]


def _write_line(
    sheet: Worksheet,
    book: Book,
    plan: SheetPlan,
    row: int,
    line: Mapping[str, object],
) -> None:
    columns = {field.key: column for column, field in enumerate(plan.fields)}
    for key, value in line.items():
        column = columns[key]
        style = _choose_format(plan.fields[column], book)
        if isinstance(value, str):
            field = plan.fields[column]
            known = value in field.words
            word = render(field.name_word(value), book.language) if known else value
            sheet.write_string(row, column, word, style)
        else:
            sheet.write_number(row, column, value, style)


def _validation(field: Field, book: Book) -> dict[str, Any] | None:
    """Rule that the spreadsheet program applies while the engineer types."""
    if field.words:
        words = [render(field.name_word(word), book.language) for word in field.words]
        return {"validate": "list", "source": words}
    low, high = field.bounds
    if low == high:
        return None
    accepted = describe_accepted(field, book.language)
    return {
        "validate": "integer" if field.kind == "count" else "decimal",
        "criteria": "between",
        "minimum": low,
        "maximum": high,
        # A warning only: the heading may be given another unit.
        "error_type": "warning" if len(field.units) > 1 else "stop",
        "error_title": book.texts["out_of_range"],
        "error_message": _put_behind(
            field.label_in(book.language), accepted, book.language
        ),
    }


def describe_accepted(field: Field, language: Language) -> str:
    """Accepted content of a cell, as a phrase; empty where anything is."""
    is_open = not field.words and field.bounds[0] == field.bounds[1]
    return "" if is_open else render(field.accepted, language)


def describe_field(field: Field, language: Language) -> str:
    """Note on a heading: meaning, what is accepted, other units, what is assumed."""
    texts = load_text(language)
    parts = [field.notes[language]]
    if accepted := describe_accepted(field, language):
        parts.append(_put_behind(texts["accepted"], accepted, language))
    if len(field.units) > 1:
        units = ", ".join(f"[{unit}]" for unit in field.units)
        parts.append(_put_behind(texts["units"], units, language))
    assumed = load_assumed().get(field.key)
    if assumed and assumed.column == f"{field.table}.{field.key}":
        text = render(assumed.text, language)
        parts.append(_put_behind(texts["empty"], text, language))
    return "\n".join(part for part in parts if part)


def _put_behind(label: str, text: str, language: Language) -> str:
    """Label and text with the colon of the language between them."""
    return render(say("show.label", label=label, text=text), language)


def count_lines(text: str, width: float) -> int:
    """Lines that a text takes in a column of a width in characters."""
    return max(1, len(wrap(text, max(1, int(width)))))
