"""Reads xlsx and xlsm workbooks into sheets of cells."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from string import ascii_uppercase
from typing import TYPE_CHECKING, Any

from netdesign.outcome import ContentError, NetDesignError
from netdesign.site.cells.cells import (
    MAX_COLUMNS,
    MAX_ROWS,
    Cell,
    MergedRange,
    Sheet,
    group_by_row,
    guard_archive,
    require_rows,
    require_width,
)
from netdesign.site.cells.findings import refuse_file
from netdesign.site.cells.numbers import (
    DecimalMark,
    find_format_unit,
    show_percent,
    show_thousands,
)
from netdesign.words.message import say

if TYPE_CHECKING:  # openpyxl is slow to import and only needed to open a file
    from openpyxl import Workbook as OpenWorkbook
    from openpyxl.reader.excel import ExcelReader


def _open(content: bytes, *, stored_results: bool) -> ExcelReader:
    """Reader of a workbook, which knows the part of each sheet."""
    import openpyxl
    from openpyxl.reader.excel import ExcelReader

    if not openpyxl.DEFUSEDXML:
        raise NetDesignError(say("program.no_defusedxml"))
    reader = ExcelReader(
        BytesIO(content),
        read_only=True,
        data_only=stored_results,
        keep_links=False,
        rich_text=stored_results,
    )
    reader.read()
    return reader


_MOST_MERGED = 100_000


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
        stored = _open(content, stored_results=True)
        for sheet in stored.wb.worksheets:
            layout = _scan_layout(stored, sheet.title)
            require_rows(path.name, sheet.title, layout.last_row)
            if sum(merged.size for merged in layout.merged) > _MOST_MERGED:
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
) -> tuple[tuple[Sheet, ...], tuple[str, ...], frozenset[str], bool]:
    """Wanted sheets, names of the others, those that nobody sees; never macros.

    The last tells whether its formulas are calculated only by hand.
    """
    with warnings.catch_warnings():
        # openpyxl warns of features that it would drop on saving; nothing is saved.
        warnings.simplefilter("ignore")
        reader = _open(content, stored_results=True)
        stored = reader.wb
        names = [sheet.title for sheet in stored.worksheets]
        layouts = {
            name: _scan_layout(reader, name) for name in names if is_wanted(name)
        }
        formulas: dict[str, Mapping[tuple[int, int], str]] = {}
        if any(layout.has_formulas for layout in layouts.values()):
            # openpyxl shows a formula or its stored result, never both: open it again.
            typed = _open(content, stored_results=False).wb
            formulas = {
                name: _read_formulas(typed[name], layout)
                for name, layout in layouts.items()
            }
        sheets = tuple(
            _read_sheet(
                file, stored[name], layout, formulas.get(name, {}), decimal_mark
            )
            for name, layout in layouts.items()
        )
    hidden = {one.title for one in stored.worksheets if one.sheet_state != "visible"}
    unread = tuple(one for one in names if not is_wanted(one))
    is_by_hand = stored.calculation.calcMode == "manual"
    return sheets, unread, frozenset(hidden), is_by_hand


def _read_formulas(typed: Any, layout: _Layout) -> dict[tuple[int, int], str]:
    return {
        # array formulas come as an object with the text inside
        (cell.row, cell.column): str(getattr(cell.value, "text", cell.value))
        for cell in _filled_cells(typed, layout.last_row)
        if cell.data_type == "f"
    }


def _read_sheet(
    file: str,
    stored: Any,
    layout: _Layout,
    formulas: Mapping[tuple[int, int], str],
    decimal_mark: DecimalMark,
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
        for (row, column), formula in formulas.items()
    }
    for cell in _filled_cells(stored, layout.last_row):
        place = (cell.row, cell.column)
        cells[place] = _take_cell(file, cell, formulas.get(place, ""), decimal_mark)
    require_width(file, stored.title, max((one for _, one in cells), default=0))
    return Sheet(
        file=file,
        name=stored.title,
        rows=group_by_row(cells.values()),
        merged=tuple(layout.merged),
        hidden_rows=frozenset(layout.hidden_rows),
        hidden_columns=frozenset(layout.hidden_columns),
        is_hidden=stored.sheet_state != "visible",
    )


def _filled_cells(sheet: Any, last_row: int) -> list[Any]:
    # The size that a file declares for its sheet may be wrong: do not trust it.
    sheet.reset_dimensions()
    rows = sheet.iter_rows(max_row=last_row) if last_row else ()
    return [cell for row in rows for cell in row if cell.value is not None]


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
        is_thousandth=show_thousands(shown),
        shown_unit=find_format_unit(shown, cell.value) if shown else "",
        decimal_mark=decimal_mark,
        doubt=_STRUCK if _is_struck(cell) else None,
    )


_STRUCK = say("cell.struck")


@dataclass(slots=True)
class _Layout:
    """Layout of a sheet while its parts arrive."""

    last_row: int = 0
    merged: list[MergedRange] = field(default_factory=list)
    hidden_rows: set[int] = field(default_factory=set)
    hidden_columns: set[int] = field(default_factory=set)
    has_formulas: bool = False


def _is_struck(cell: Any) -> bool:
    """Text of a cell is struck out, or a part of it."""
    parts = cell.value if isinstance(cell.value, list) else ()
    fonts = [getattr(part, "font", None) for part in parts]
    fonts += [cell.font] if cell.has_style else []
    return any(font is not None and font.strike for font in fonts)


def _scan_layout(reader: ExcelReader, name: str) -> _Layout:
    """Last filled row, merged ranges, what is hidden, and whether formulas are there.

    openpyxl gives merged ranges only in its other mode, which makes one object
    of every merged cell: a few bytes of XML would exhaust the memory.
    """
    from defusedxml.ElementTree import iterparse

    row, layout = 0, _Layout()
    parts = {sheet.name: rel.target for sheet, rel in reader.parser.find_sheets()}
    with reader.archive.open(parts[name]) as source:
        for _, element in iterparse(source):
            tag = element.tag.rpartition("}")[2]
            if tag == "f":
                layout.has_formulas = True
            elif tag == "mergeCell":
                layout.merged.append(_read_merged_range(element.get("ref", "")))
            elif tag == "col" and _is_true(element.get("hidden")):
                first, last = int(element.get("min", 1)), int(element.get("max", 1))
                layout.hidden_columns.update(range(first, min(last, MAX_COLUMNS) + 1))
            elif tag == "row":
                row = _follow_row(element, row)
                if any(len(cell) for cell in element):
                    layout.last_row = max(layout.last_row, row)
                    if _is_true(element.get("hidden")):
                        layout.hidden_rows.add(row)
                element.clear()
    return layout


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


def _is_true(attribute: str | None) -> bool:
    return attribute in ("1", "true")


def _read_merged_range(text: str) -> MergedRange:
    from openpyxl.utils import range_boundaries

    column, row, last_column, last_row = range_boundaries(text)
    return MergedRange(
        text=text,
        row=row or 1,
        column=column or 1,
        last_row=last_row or MAX_ROWS,
        last_column=last_column or MAX_COLUMNS,
    )
