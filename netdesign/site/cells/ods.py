"""Reads OpenDocument spreadsheets (ods) into sheets of cells.

The format is one XML file: a hardened parser and these lines read it, where a
package for it would bring a parser that is not hardened.
"""

from __future__ import annotations

import datetime
import re
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from io import BytesIO
from typing import Any

from netdesign.outcome import ContentError
from netdesign.site.cells.cells import (
    MAX_COLUMNS,
    MAX_ROWS,
    Cell,
    MergedRange,
    Sheet,
    group_by_row,
    name_column,
    require_columns,
    require_rows,
)
from netdesign.site.cells.numbers import DecimalMark, find_text_unit
from netdesign.words.message import say

_OFFICE = "{urn:oasis:names:tc:opendocument:xmlns:office:1.0}"
_TABLE = "{urn:oasis:names:tc:opendocument:xmlns:table:1.0}"
_TEXT = "{urn:oasis:names:tc:opendocument:xmlns:text:1.0}"
_STYLE = "{urn:oasis:names:tc:opendocument:xmlns:style:1.0}"
_CALCEXT = "{urn:org:documentfoundation:names:experimental:calc:xmlns:calcext:1.0}"

_STRUCK = f"{_STYLE}text-line-through-style"
_ERROR = re.compile(r"#[A-Z/0?!]+|Err:[0-9]+")
_TIME = re.compile(r"PT([0-9]+)H([0-9]+)M([0-9.]+)S")
_LARGEST_WHOLE = 1e15
_NUMBERS = ("float", "percentage", "currency")


@dataclass(slots=True)
class _OpenSheet:
    """A sheet while its rows arrive."""

    file: str
    name: str
    is_hidden: bool
    decimal_mark: DecimalMark
    row: int = 0  # the last one seen
    cells: list[Cell] = field(default_factory=list)
    merged: list[MergedRange] = field(default_factory=list)
    hidden_rows: set[int] = field(default_factory=set)
    struck_rows: set[int] = field(default_factory=set)
    columns: int = 0  # described so far
    hidden_columns: set[int] = field(default_factory=set)

    def close(self) -> Sheet:
        require_columns(self.file, self.name, self.cells)
        return Sheet(
            file=self.file,
            name=self.name,
            rows=group_by_row(self.cells),
            merged=tuple(self.merged),
            hidden_rows=frozenset(self.hidden_rows),
            struck_rows=frozenset(self.struck_rows),
            hidden_columns=frozenset(self.hidden_columns),
            is_hidden=self.is_hidden,
        )


def read_ods(
    file: str,
    content: bytes,
    is_wanted: Callable[[str], bool],
    decimal_mark: DecimalMark,
) -> tuple[tuple[Sheet, ...], tuple[str, ...], frozenset[str]]:
    """Wanted sheets, names of the others, and of all that nobody sees.

    Raises
    ------
    ValueError, LookupError, SyntaxError
        If the file is damaged.
    SiteDataError
        If a sheet is far too large.
    """
    from defusedxml.ElementTree import iterparse

    sheets: list[Sheet] = []
    unread: list[str] = []
    hidden: set[str] = set()
    hidden_styles: set[str] = set()
    struck_styles: set[str] = set()
    sheet: _OpenSheet | None = None
    with (
        zipfile.ZipFile(BytesIO(content)) as archive,
        archive.open("content.xml") as source,
    ):
        for event, element in iterparse(source, events=("start", "end")):
            if event == "start" and element.tag == f"{_TABLE}table":
                if sheet is not None:
                    raise ContentError(say("book.table_inside"))
                name = element.get(f"{_TABLE}name", "")
                style = element.get(f"{_TABLE}style-name", "")
                sheet = _OpenSheet(file, name, style in hidden_styles, decimal_mark)
                hidden |= {name} if sheet.is_hidden else set()
            elif event == "end" and element.tag == f"{_STYLE}style":
                hidden_styles |= _name_hidden_style(element)
                struck_styles |= _name_struck_style(element)
            elif event == "end" and sheet is not None:
                if element.tag == f"{_TABLE}table":
                    if is_wanted(sheet.name):
                        sheets.append(sheet.close())
                    else:
                        unread.append(sheet.name)
                    sheet = None
                elif is_wanted(sheet.name):
                    _take_element(sheet, element, struck_styles)
    return tuple(sheets), tuple(unread), frozenset(hidden)


def _name_hidden_style(style: Any) -> set[str]:
    properties = style.find(f"{_STYLE}table-properties")
    is_hidden = properties is not None and properties.get(f"{_TABLE}display") == "false"
    return {style.get(f"{_STYLE}name", "")} if is_hidden else set()


def _name_struck_style(style: Any) -> set[str]:
    properties = style.find(f"{_STYLE}text-properties")
    line = None if properties is None else properties.get(_STRUCK)
    return {style.get(f"{_STYLE}name", "")} if line not in (None, "none") else set()


def _take_element(sheet: _OpenSheet, element: Any, struck_styles: set[str]) -> None:
    if element.tag == f"{_TABLE}table-row":
        _take_row(sheet, element, struck_styles)
        element.clear()
    elif element.tag == f"{_TABLE}table-column":
        count = _read_count(element, "number-columns-repeated")
        first, sheet.columns = sheet.columns + 1, sheet.columns + count
        if _is_hidden(element):
            last = min(sheet.columns, MAX_COLUMNS)
            sheet.hidden_columns.update(range(first, last + 1))


def _take_row(sheet: _OpenSheet, element: Any, struck_styles: set[str]) -> None:
    count = _read_count(element, "number-rows-repeated")
    filled = list(_filled_cells(element))
    is_struck = bool(filled) and all(
        cell.get(f"{_TABLE}style-name") in struck_styles for _, cell in filled
    )
    for row in range(sheet.row + 1, sheet.row + count + 1) if filled else ():
        require_rows(sheet.file, sheet.name, row)
        if _is_hidden(element):
            sheet.hidden_rows.add(row)
        if is_struck:
            sheet.struck_rows.add(row)
        for column, cell in filled:
            _note_merge(sheet, cell, row, column)
            sheet.cells += _take_cell(sheet, cell, row, column)
    sheet.row += count


def _filled_cells(row: Any) -> Iterator[tuple[int, Any]]:
    """Cells that hold something or begin a merged range, with their columns."""
    column = 0
    for cell in row:
        if cell.tag not in (f"{_TABLE}table-cell", f"{_TABLE}covered-table-cell"):
            continue
        count = _read_count(cell, "number-columns-repeated")
        is_filled = len(cell) or any(
            cell.get(name) for name in (f"{_TABLE}formula", f"{_OFFICE}value-type")
        )
        if is_filled or _spans(cell) != (1, 1):
            # A filled cell repeated across the sheet is refused by its columns.
            for number in range(column + 1, column + count + 1):
                yield number, cell
                if number > MAX_COLUMNS:
                    return
        column += count


def _read_count(element: Any, name: str) -> int:
    count = int(element.get(f"{_TABLE}{name}", 1))
    if count < 1:
        raise ContentError(say("book.count", name=name, count=count))
    return count


def _spans(cell: Any) -> tuple[int, int]:
    rows = _read_count(cell, "number-rows-spanned")
    return rows, _read_count(cell, "number-columns-spanned")


def _note_merge(sheet: _OpenSheet, cell: Any, row: int, column: int) -> None:
    rows, columns = _spans(cell)
    if (rows, columns) == (1, 1):
        return
    last_row, last_column = row + rows - 1, column + columns - 1
    last = f"{name_column(last_column)}{last_row}"
    sheet.merged.append(
        MergedRange(
            text=f"{name_column(column)}{row}:{last}",
            row=row,
            column=column,
            last_row=min(last_row, MAX_ROWS),
            last_column=min(last_column, MAX_COLUMNS),
        )
    )


def _take_cell(sheet: _OpenSheet, cell: Any, row: int, column: int) -> list[Cell]:
    formula = cell.get(f"{_TABLE}formula", "").partition("=")
    kind = cell.get(f"{_OFFICE}value-type", "")
    text = "\n".join("".join(line.itertext()) for line in cell.findall(f"{_TEXT}p"))
    if not (formula[1] or kind or text):
        return []
    is_error = cell.get(f"{_CALCEXT}value-type") == "error" or bool(
        formula[1] and _ERROR.fullmatch(text)
    )
    return [
        Cell(
            file=sheet.file,
            sheet=sheet.name,
            row=row,
            column=column,
            value=text if is_error else _read_value(cell, kind, text),
            formula="".join(formula[1:]),
            is_error=is_error,
            is_percent=kind == "percentage",
            shown_unit=find_text_unit(text) if kind in _NUMBERS else "",
            decimal_mark=sheet.decimal_mark,
        )
    ]


def _read_value(cell: Any, kind: str, text: str) -> object:
    if kind in _NUMBERS:
        number = float(cell.get(f"{_OFFICE}value"))
        is_whole = number.is_integer() and abs(number) < _LARGEST_WHOLE
        return int(number) if is_whole else number
    if kind == "date":
        return datetime.datetime.fromisoformat(cell.get(f"{_OFFICE}date-value"))
    if kind == "time":
        hours, minutes, seconds = _TIME.fullmatch(
            cell.get(f"{_OFFICE}time-value")
        ).groups()  # type: ignore[union-attr]
        return datetime.timedelta(
            hours=int(hours), minutes=int(minutes), seconds=float(seconds)
        )
    if kind == "boolean":
        return cell.get(f"{_OFFICE}boolean-value") == "true"
    return text or None


def _is_hidden(element: Any) -> bool:
    return element.get(f"{_TABLE}visibility") in ("collapse", "filter")
