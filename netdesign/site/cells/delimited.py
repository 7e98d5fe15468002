"""Reads csv files into sheets of cells: finds encoding, delimiter and sheets.

One file may hold several sheets: a line with nothing but the name of a sheet, as
``Nets`` or ``[Nets]``, begins it. In a folder every file is the sheet that its
name says. All cells are text; row numbers are those of the file.
"""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping
from io import StringIO
from itertools import islice

from netdesign.site.cells.cells import Cell, Sheet, TextFormat, group_by_row
from netdesign.site.cells.findings import Finding, note_file, refuse_file
from netdesign.site.cells.limits import (
    MAX_COLUMNS,
    MAX_LINES,
    MAX_ROWS,
    require_cells,
    require_columns,
    require_rows,
    require_width,
)
from netdesign.site.columns.unit_names import KNOWN_UNITS, normalise_unit
from netdesign.words.message import Message, say

DELIMITERS = (";", ",", "\t", "|")
_DEFAULT_SHEET = "Nets"
_NAMES = {";": "semicolon", ",": "comma", "\t": "tab", "|": "bar", " ": "space"}
_BOMS = {b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16"}

_Records = list[list[str]]


def read_delimited(
    contents: Mapping[str, bytes],
    is_wanted: Callable[[str], bool],
    is_name: Callable[[str], bool],
    is_heading: Callable[[str], bool],
    text_format: TextFormat,
    *,
    by_name: bool,
) -> tuple[tuple[Sheet, ...], tuple[str, ...], tuple[Finding, ...]]:
    """Sheets of csv files, names of the files that hold none, and remarks.

    Parameters
    ----------
    contents : mapping of str to bytes
        Content of each file by its name.
    is_wanted, is_name, is_heading : callable
        Tell whether a text is the name of a sheet, or one misspelt, and a heading.
    text_format : TextFormat
        What is declared of the files.
    by_name : bool
        Whether a file that does not begin with the name of a sheet is the one that
        its own name says; otherwise it is sheet Nets.

    Raises
    ------
    SiteDataError
        If a file is no text, or its delimiter cannot be told.
    """
    sheets: list[Sheet] = []
    unread: list[str] = []
    remarks: list[Finding] = []
    for file, content in contents.items():
        name = _name_sheet(file, is_wanted) or ("" if by_name else _DEFAULT_SHEET)
        if not name:
            unread.append(file.removesuffix(".csv"))  # as an answer names it
            continue
        text, encoding = _decode(file, content)
        delimiter = text_format.delimiter or _find_delimiter(file, text, is_heading)
        records = _split(file, text, delimiter)
        require_rows(file, name, len(records), MAX_LINES)
        require_cells(file, name, sum(map(len, records)))
        for record in records:
            require_width(file, name, len(record))
        rule = say(
            "csv.read_with", delimiter=_name_delimiter(delimiter), encoding=encoding
        )
        remarks.append(note_file(file, rule))
        for sheet in _cut_sheets(file, name, records, is_wanted, is_name, text_format):
            if is_wanted(sheet.name):
                sheets.append(sheet)
            else:
                unread.append(sheet.name)
    return tuple(sheets), tuple(unread), tuple(remarks)


def _name_sheet(file: str, is_wanted: Callable[[str], bool]) -> str:
    """Sheet that a file's name says: ``Nets.csv``, ``site - Nets.csv``."""
    stem = file.rpartition(".")[0]
    last = stem.replace("_", "-").rpartition("-")[2].strip()
    return next((name for name in (stem, last) if is_wanted(name)), "")


def _decode(file: str, content: bytes) -> tuple[str, str]:
    for encoding in (_BOMS.get(content[:2], "utf-8-sig"), "cp1252"):
        try:
            text = content.decode(encoding)
        except UnicodeDecodeError:
            continue
        if "\0" not in text:
            return text, encoding.removesuffix("-sig")
    raise refuse_file(file, say("csv.no_text"), say("csv.encodings"))


def _split(file: str, text: str, delimiter: str) -> _Records:
    # strict: a quote that is never closed must not swallow the rest of the file
    source = StringIO(text, newline="")
    reader = csv.reader(source, delimiter=delimiter, strict=True)
    records: _Records = []
    line = 1  # where the next record begins: an open quote reads on to the end
    try:
        for record in islice(reader, MAX_LINES + 1):
            records.append(_cut_end(record))
            line = reader.line_num + 1
    except csv.Error as error:
        cause = say("csv.open_quote", line=line)
        if "limit" in str(error):
            cause = say("csv.long_cell", line=line, most=csv.field_size_limit())
        rule = say("csv.unreadable", cause=cause)
        raise refuse_file(file, rule, say("csv.quotes")) from None
    return records


def _cut_end(record: list[str]) -> list[str]:
    """Record without its empty cells at the end."""
    while record and not record[-1]:
        record.pop()
    return record


def _find_delimiter(file: str, text: str, is_heading: Callable[[str], bool]) -> str:
    """Delimiter that makes the most known headings; a tie is no answer."""
    counts = {mark: _count_headings(text, mark, is_heading) for mark in DELIMITERS}
    most = max(counts.values())
    best = [mark for mark, count in counts.items() if count == most]
    if most and len(best) == 1:
        return best[0]
    names = tuple(_name_delimiter(mark) for mark in (best if most else DELIMITERS))
    raise refuse_file(file, say("csv.no_delimiter", names=names), say("csv.declare"))


def _name_delimiter(mark: str) -> Message | str:
    return say(f"delimiter.{_NAMES[mark]}") if mark in _NAMES else f'"{mark}"'


def _count_headings(
    text: str, delimiter: str, is_heading: Callable[[str], bool]
) -> int:
    reader = csv.reader(StringIO(text, newline=""), delimiter=delimiter)
    try:
        records = list(islice(reader, MAX_ROWS))
    except csv.Error:
        return 0
    # a single cell in its line may be a heading of any reading
    return sum(
        is_heading(cell)
        for cells in records
        if len(cells) > 1
        for cell in cells[:MAX_COLUMNS]
    )


def _cut_sheets(
    file: str,
    first: str,
    records: _Records,
    is_wanted: Callable[[str], bool],
    is_name: Callable[[str], bool],
    text_format: TextFormat,
) -> list[Sheet]:
    """Cut a file into its sheets at the lines that name one."""
    groups: list[tuple[str, list[Cell]]] = [(first, [])]
    for row, record in enumerate(records, start=1):
        # a misspelt name is told from a line of the table by the empty one above
        is_apart = row == 1 or not any(map(str.strip, records[row - 2]))
        if title := _find_title(record, is_name if is_apart else is_wanted):
            groups.append((title, []))
            continue
        name, cells = groups[-1]
        cells += [
            Cell(
                file=file,
                sheet=name,
                row=row,
                column=column,
                value=text,
                decimal_mark=text_format.decimal_mark,
            )
            for column, text in enumerate(record, start=1)
            if text
        ]
    sheets = []
    for name, cells in groups:
        require_columns(file, name, cells)
        if cells:
            rows = group_by_row(cells)
            sheets.append(Sheet(file=file, name=name, rows=rows, is_delimited=True))
    return sheets


def _find_title(record: list[str], is_name: Callable[[str], bool]) -> str:
    """Name of the sheet that a line begins; empty for any other line.

    A name in brackets that nobody knows begins a sheet too: what stands below it
    must not count as lines of the sheet before.
    """
    filled = [text.strip() for text in record if text.strip()]
    if len(filled) != 1:
        return ""
    name = filled[0].strip("[]#: ")
    in_brackets = record[0].strip().startswith("[") and filled[0].endswith("]")
    is_title = in_brackets and normalise_unit(name) not in KNOWN_UNITS
    return name if is_title or is_name(name) else ""
