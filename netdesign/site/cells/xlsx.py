"""Reads xlsx and xlsm workbooks into sheets of cells."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from string import ascii_uppercase
from typing import TYPE_CHECKING, Any

from netdesign.outcome import ContentError, NetDesignError
from netdesign.site.cells.cells import (
    MAX_ROWS,
    Cell,
    Sheet,
    Workbook,
    group_by_row,
    guard_archive,
    name_column,
    require_rows,
    require_width,
    split_address,
)
from netdesign.site.cells.findings import refuse_file
from netdesign.site.cells.numbers import (
    DecimalMark,
    find_format_unit,
    show_percent,
)
from netdesign.words.message import say

if TYPE_CHECKING:  # openpyxl is slow to import and only needed to open a file
    from openpyxl import Workbook as OpenWorkbook
    from openpyxl.formula.translate import Translator
    from openpyxl.reader.excel import ExcelReader
    from openpyxl.worksheet.cell_range import CellRange

_MOST_MERGED = 100_000


def _open(content: bytes) -> ExcelReader:
    """Reader of a workbook with its stored results, which knows each sheet's part."""
    import openpyxl
    from openpyxl.reader.excel import ExcelReader

    if not openpyxl.DEFUSEDXML:
        raise NetDesignError(say("program.no_defusedxml"))
    reader = ExcelReader(
        BytesIO(content),
        read_only=True,
        data_only=True,
        keep_links=False,
        rich_text=True,
    )
    reader.read()
    return reader


def open_for_editing(path: Path) -> OpenWorkbook:
    """Workbook with its formats and formulas, to be changed and saved; no macros.

    Raises
    ------
    SiteDataError
        If it is too large for that: in this mode every merged cell costs memory.
    """
    import openpyxl

    content = path.read_bytes()
    guard_archive(path.name, content)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        stored = _open(content)
        for sheet in stored.wb.worksheets:
            layout = _scan_layout(stored, sheet.title)
            require_rows(path.name, sheet.title, layout.last_row)
            sizes = (merged.size for merged in layout.merged)
            if sum(size["rows"] * size["columns"] for size in sizes) > _MOST_MERGED:
                accepted = say("book.most_cells", most=_MOST_MERGED)
                raise refuse_file(
                    path.name, say("book.many_merged"), accepted, sheet.title
                )
        return openpyxl.load_workbook(BytesIO(content), keep_links=False)


def read_xlsx(
    file: str,
    content: bytes,
    is_wanted: Callable[[str], bool],
    decimal_mark: DecimalMark,
) -> Workbook:
    """Read the wanted sheets of a workbook, and the names of the others; no macros."""
    with warnings.catch_warnings():
        # openpyxl warns of features that it would drop on saving; nothing is saved.
        warnings.simplefilter("ignore")
        reader = _open(content)
        worksheets = reader.wb.worksheets
        sheets = tuple(
            _read_sheet(file, stored, _scan_layout(reader, stored.title), decimal_mark)
            for stored in worksheets
            if is_wanted(stored.title)
        )
    return Workbook(
        file=file,
        sheets=sheets,
        unread=tuple(
            stored.title for stored in worksheets if not is_wanted(stored.title)
        ),
        is_by_hand=reader.wb.calculation.calcMode == "manual",
    )


def _read_sheet(
    file: str, stored: Any, layout: _Layout, decimal_mark: DecimalMark
) -> Sheet:
    require_rows(file, stored.title, layout.last_row)
    if len(layout.merged) > MAX_ROWS:
        rule = say("book.merged_ranges", count=len(layout.merged))
        accepted = say("book.at_most", most=MAX_ROWS)
        raise refuse_file(file, rule, accepted, stored.title)
    # First the formulas alone; those with a stored result are then replaced.
    cells = {
        (row, column): Cell(
            file=file, sheet=stored.title, row=row, column=column, formula=formula
        )
        for (row, column), formula in layout.formulas.items()
    }
    # The size that a file declares for its sheet may be wrong: do not trust it.
    stored.reset_dimensions()
    rows = stored.iter_rows(max_row=layout.last_row) if layout.last_row else ()
    for cell in (cell for row in rows for cell in row if cell.value is not None):
        place = (cell.row, cell.column)
        formula = layout.formulas.get(place, "")
        cells[place] = _take_cell(file, cell, formula, decimal_mark)
    require_width(file, stored.title, max((column for _, column in cells), default=0))
    return Sheet(
        file=file,
        name=stored.title,
        rows=group_by_row(cells.values()),
        merged=tuple(layout.merged),
    )


def _take_cell(file: str, cell: Any, formula: str, decimal_mark: DecimalMark) -> Cell:
    is_number = cell.data_type == "n" and isinstance(cell.value, int | float)
    is_rich = isinstance(cell.value, list)  # a text with formats of its own
    shown = str(cell.number_format) if is_number else ""
    return Cell(
        file=file,
        sheet=cell.parent.title,
        row=cell.row,
        column=cell.column,
        value=str(cell.value) if is_rich else cell.value,
        formula=formula,
        is_error=cell.data_type == "e",
        is_percent=show_percent(shown),
        shown_unit=find_format_unit(shown),
        decimal_mark=decimal_mark,
        doubt=_STRUCK if _is_struck(cell) else None,
    )


_STRUCK = say("cell.struck")


@dataclass(slots=True)
class _Layout:
    """Layout of a sheet, which openpyxl leaves out when it reads stored results."""

    last_row: int = 0
    merged: list[CellRange] = field(default_factory=list)
    formulas: dict[tuple[int, int], str] = field(default_factory=dict)


def _is_struck(cell: Any) -> bool:
    """Whether the text of a cell, or a part of it, is struck out."""
    parts = cell.value if isinstance(cell.value, list) else ()
    fonts = [getattr(part, "font", None) for part in parts]
    fonts += [cell.font] if cell.has_style else []
    return any(font is not None and font.strike for font in fonts)


def _scan_layout(reader: ExcelReader, name: str) -> _Layout:
    """Last filled row, merged ranges, formulas of a sheet.

    openpyxl gives merged ranges only in its other mode, which makes an object
    of every merged cell: a few bytes of XML would exhaust the memory.
    """
    from defusedxml.ElementTree import iterparse
    from openpyxl.worksheet.cell_range import CellRange

    row, layout = 0, _Layout()
    shared: dict[str, Translator] = {}
    parts = {sheet.name: rel.target for sheet, rel in reader.parser.find_sheets()}
    with reader.archive.open(parts[name]) as source:
        for _, element in iterparse(source):
            tag = element.tag.rpartition("}")[2]
            if tag == "mergeCell":
                layout.merged.append(CellRange(element.get("ref", "")))
            elif tag == "row":
                row = _follow_row(element, row)
                layout.formulas |= _list_formulas(element, row, shared)
                if any(len(cell) for cell in element):
                    layout.last_row = max(layout.last_row, row)
                element.clear()
    return layout


def _list_formulas(
    row: Any, number: int, shared: dict[str, Translator]
) -> Iterator[tuple[tuple[int, int], str]]:
    """Places and formulas of a row; a shared formula stands in its first cell alone."""
    from openpyxl.formula.translate import Translator

    column = 0
    for cell in row:
        place = cell.get("r") or f"{name_column(column + 1)}{number}"
        column, _ = split_address(place)
        part = cell.find("{*}f")
        if part is None:
            continue
        text, key = f"={part.text or ''}", part.get("si")
        if key in shared:
            text = shared[key].translate_formula(place)
        elif key is not None:
            shared[key] = Translator(text, place)
        yield (number, column), text


def _follow_row(element: Any, row_before: int) -> int:
    """Number of a row; an error where a cell would have two contents."""
    row = int(element.get("r", row_before + 1))
    if row <= row_before:
        raise ContentError(say("book.row_after", row=row, before=row_before))
    places = [place for cell in element if (place := cell.get("r"))]
    if len(set(places)) < len(places):
        raise ContentError(say("book.cell_twice", row=row))
    if any(place.lstrip(ascii_uppercase) != str(row) for place in places):
        raise ContentError(say("book.other_row", row=row))
    return row
