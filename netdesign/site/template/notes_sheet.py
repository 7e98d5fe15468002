"""First sheet of the input workbook: how to fill it in, with a drawing and a table."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.resources import files
from io import BytesIO
from textwrap import wrap
from typing import TYPE_CHECKING

from netdesign.site.columns.all_tables import NETS, USUAL_QUANTITIES
from netdesign.site.columns.fields import Field, Language
from netdesign.site.columns.languages import load_text
from netdesign.words.numerals import set_marks

if TYPE_CHECKING:
    from xlsxwriter.format import Format
    from xlsxwriter.workbook import Workbook
    from xlsxwriter.worksheet import Worksheet

# Symbols of the fields of sheet Nets, in drawing and table.
SYMBOLS: Mapping[str, str] = {
    "slope_angle": "ψ",
    "snow_thickness": "d",
    "snow_height": "H",
    "upslope_length": "L",
    "net_height": "Dₖ",
    "post_tilt": "δ",
    "uphill_anchor_distance": "e₁",
    "downhill_anchor_distance": "e₂",
    "inclination": "θ",
}

_A4 = 9
_LINE = 15.5  # height of a line of text [pt]
_WIDTHS = (9, 28, 16, 19, 46)  # symbol, quantity, unit, range, meaning
_PICTURE_ROW, _PICTURE_ROWS = 5, 25
_PICTURE_SCALE = 0.95  # of its own size, so that it fits the width of the table


def write_notes(workbook: Workbook, language: Language) -> None:
    """Add the sheet of notes: what to do, the section, every number of a net row."""
    texts = load_text(language)
    sheet = workbook.add_worksheet(texts["notes"])
    sheet.hide_gridlines(2)
    for column, width in enumerate(_WIDTHS):
        sheet.set_column(column, column, width)
    title = workbook.add_format({"bold": True, "font_size": 16})
    wrapped = workbook.add_format({"text_wrap": True, "valign": "top"})
    strong = workbook.add_format({"bold": True})
    sheet.write_string(0, 0, texts["title"], title)
    sheet.set_row(0, 26)
    for row, key in ((1, "intro"), (2, "numbers")):
        sheet.merge_range(row, 0, row, len(_WIDTHS) - 1, texts[key], wrapped)
        sheet.set_row(row, _LINE * count_lines(texts[key], sum(_WIDTHS)))
    sheet.write_string(4, 0, texts["sketch"], strong)
    # Said row by row: a program's own default height would squeeze the picture.
    for row in range(_PICTURE_ROW, _PICTURE_ROW + _PICTURE_ROWS):
        sheet.set_row(row, _LINE)
    sheet.insert_image(
        _PICTURE_ROW,
        0,
        "geometry.png",
        {
            "image_data": BytesIO(_read_picture(language)),
            "x_scale": _PICTURE_SCALE,
            "y_scale": _PICTURE_SCALE,
            "x_offset": 20,
            "description": texts["sketch"],
            "object_position": 3,  # its proportions are to scale
        },
    )
    _write_quantities(sheet, workbook, language)
    sheet.set_paper(_A4)
    sheet.set_portrait()
    sheet.fit_to_pages(1, 1)
    sheet.set_margins(left=0.5, right=0.5, top=0.6, bottom=0.6)
    sheet.set_footer(f"&R{texts['page']} &P {texts['of']} &N")


def name_picture(language: Language) -> str:
    """File of the section with the words of a language, beside this module."""
    return f"geometry.{language}.png"


def _read_picture(language: Language) -> bytes:
    return files(__package__).joinpath(name_picture(language)).read_bytes()


def describe_accepted(field: Field, language: Language) -> str:
    """Accepted content of a cell, as a phrase: bounds with their unit, or words."""
    words = field.wording(language).words
    if field.words:
        return ", ".join(
            words[word][0] if word in words else word for word in field.words
        )
    low, high = field.bounds
    if low == high:
        return ""
    between = {"en": "to", "fr": "à", "de": "bis"}[language]
    ends = (set_marks(f"{end:.10g}", language) for end in (low, high))
    return f" {between} ".join(ends) + f" {field.unit}".rstrip(" -")


def describe_field(field: Field, language: Language) -> str:
    """Note on a heading: meaning, what is accepted, other units, default."""
    texts = load_text(language)
    parts = [field.wording(language).note]
    if accepted := describe_accepted(field, language):
        parts.append(f"{texts['accepted']}: {accepted}")
    if len(field.units) > 1:
        units = ", ".join(f"[{unit}]" for unit in field.units)
        parts.append(f"{texts['units']}: {units}")
    if field.default is not None:
        number = set_marks(f"{field.default:g}", language)
        default = f"{number} {field.unit}".rstrip(" -")
        parts.append(f"{texts['empty']}: {default}")
    return "\n".join(part for part in parts if part)


def _write_quantities(sheet: Worksheet, workbook: Workbook, language: Language) -> None:
    texts = load_text(language)
    head = workbook.add_format({"bold": True, "bottom": 1, "bg_color": "#e6edf4"})
    cell = workbook.add_format(
        {"text_wrap": True, "valign": "top", "bottom": 1, "bottom_color": "#d3d7dc"}
    )
    symbol = workbook.add_format(
        {"bold": True, "valign": "top", "bottom": 1, "bottom_color": "#d3d7dc"}
    )
    row = _PICTURE_ROW + _PICTURE_ROWS + 1
    headings = ("symbol", "quantity", "units", "accepted", "meaning")
    for column, key in enumerate(headings):
        sheet.write_string(row, column, texts[key], head)
    fields = [field for field in NETS.fields if not field.refers_to]
    fields += [field for field in USUAL_QUANTITIES if field.key not in SYMBOLS]
    fields += [field for field in USUAL_QUANTITIES if field.key in SYMBOLS]
    for number, field in enumerate(fields, start=row + 1):
        _write_quantity(sheet, number, field, language, symbol, cell)


def _write_quantity(
    sheet: Worksheet,
    row: int,
    field: Field,
    language: Language,
    symbol: Format,
    cell: Format,
) -> None:
    wording = field.wording(language)
    sheet.write_string(row, 0, SYMBOLS.get(field.key, ""), symbol)
    accepted = describe_accepted(field, language)
    texts = (wording.label, ", ".join(field.units), accepted, wording.note)
    for column, text in enumerate(texts, start=1):
        sheet.write_string(row, column, text, cell)
    longest = zip(texts, _WIDTHS[1:], strict=True)
    sheet.set_row(row, _LINE * max(count_lines(text, width) for text, width in longest))


def count_lines(text: str, width: float) -> int:
    """Lines that a text takes in a column of a width in characters."""
    return max(1, len(wrap(text, max(1, int(width)))))
