"""Opens a site file of any accepted kind safely: xlsx, xlsm, csv.

It finds encoding and delimiter of csv files. Each file is a sheet: in a folder the
sheet that its name gives, alone the net rows. All cells are text, with rows as in the
file.
"""

from __future__ import annotations

import csv
import hashlib
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import replace
from io import BytesIO, StringIO
from itertools import islice
from pathlib import Path

from netdesign.edge.input_files import explain, is_held, make_printable, read_bounded
from netdesign.outcome import ContentError
from netdesign.site.cells.cells import (
    DAMAGE,
    MAX_COLUMNS,
    MAX_ENTRIES,
    MAX_FILE_BYTES,
    MAX_LINES,
    MAX_ROWS,
    MAX_TEXT_BYTES,
    UNDECLARED,
    Cell,
    Sheet,
    TextFormat,
    Workbook,
    group_by_row,
    guard_archive,
    require_cells,
    require_rows,
    require_width,
)
from netdesign.site.cells.findings import Finding, note_file, refuse_file
from netdesign.site.cells.xlsx import read_xlsx
from netdesign.words.message import Message, say

DELIMITERS = (";", ",", "\t", "|")
_DEFAULT_SHEET = "Rows"
_NAMES = {";": "semicolon", ",": "comma", "\t": "tab", "|": "bar", " ": "space"}
_BOMS = {b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16"}

_Records = list[list[str]]


def read_delimited(
    contents: Mapping[str, bytes],
    is_wanted: Callable[[str], bool],
    is_heading: Callable[[str], bool],
    text_format: TextFormat,
    *,
    by_name: bool,
) -> Workbook:
    """Sheets of csv files, names of the files that hold none, and remarks.

    Parameters
    ----------
    contents : mapping of str to bytes
        Content of each file by its name.
    is_wanted, is_heading : callable
        Tell whether a text is the name of a sheet, and a heading.
    text_format : TextFormat
        What is declared of the files.
    by_name : bool
        Whether a file is the sheet that its own name says; otherwise it is sheet Rows.

    Raises
    ------
    SiteDataError
        If a file is no text, or its delimiter is ambiguous.
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
        require_width(file, name, max(map(len, records), default=0))
        rule = say(
            "csv.read_with", delimiter=_name_delimiter(delimiter), encoding=encoding
        )
        remarks.append(note_file(file, rule))
        if not is_wanted(name):
            unread.append(name)
            continue
        sheets.append(_make_sheet(file, name, records, text_format))
    return Workbook(
        file="", sheets=tuple(sheets), unread=tuple(unread), remarks=tuple(remarks)
    )


def _name_sheet(file: str, is_wanted: Callable[[str], bool]) -> str:
    """Sheet that the name of a file gives: ``Rows.csv``, ``site - Rows.csv``."""
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
    """Delimiter that gives the most known headings; a tie between two is refused."""
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


def _make_sheet(
    file: str, name: str, records: _Records, text_format: TextFormat
) -> Sheet:
    cells = (
        Cell(
            file=file,
            sheet=name,
            row=row,
            column=column,
            value=text,
            decimal_mark=text_format.decimal_mark,
        )
        for row, record in enumerate(records, start=1)
        for column, text in enumerate(record, start=1)
        if text
    )
    return Sheet(file=file, name=name, rows=group_by_row(cells), is_delimited=True)


_OLE_MAGIC = b"\xd0\xcf\x11\xe0"
_ZIP_MAGIC = b"PK"
# Of defusedxml, by name: it is imported where XML is read.
_FORBIDDEN = ("DTDForbidden", "EntitiesForbidden", "ExternalReferenceForbidden")
_ACCEPTED_FILE = say("accepted.file")
_TEXT_SUFFIXES = (".csv", ".tsv", ".txt")
# Of "Strict Open XML Spreadsheet", whose sheets the reader of workbooks does not see.
_STRICT = b"http://purl.oclc.org/ooxml/"
_MACRO_PART = "xl/vbaProject.bin"


def read_workbook(
    path: Path,
    is_wanted: Callable[[str], bool],
    is_heading: Callable[[str], bool] = lambda _: False,
    text_format: TextFormat = UNDECLARED,
) -> Workbook:
    """Read the wanted sheets of a workbook, a csv file, or a folder of csv files.

    Parameters
    ----------
    path : Path
        The file. It is read once; guards, hash and content see the same bytes.
    is_wanted : callable
        Tells from a sheet's name whether to read it.
    is_heading : callable
        Tells from a cell's text whether it is a known heading, which finds the
        delimiter of a csv file.
    text_format : TextFormat
        What is declared of the file's text.

    Returns
    -------
    Workbook
        Filled cells with their addresses.

    Raises
    ------
    SiteDataError
        With a finding, if the file as a whole cannot be read: missing, not a
        workbook, damaged, hostile or far too large.
    """
    is_folder = _is_folder(path)
    if is_text(path):
        paths = sorted(path.glob("*.csv")) if is_folder else [path]
        if not paths:
            raise refuse_file(path.name, say("book.no_csv"), say("book.rows_csv"))
        contents = _read_texts(path.name, paths)
        content = b"".join(contents.values())
        workbook = read_delimited(
            contents, is_wanted, is_heading, text_format, by_name=is_folder
        )
    else:
        content = _read_file(path, MAX_FILE_BYTES)
        workbook = _read_archive(path.name, content, is_wanted, text_format)
    digest = hashlib.sha256(content).hexdigest()
    return replace(workbook, file=make_printable(path.name), sha256=digest)


def is_text(path: Path) -> bool:
    """Whether a file is read as csv, or is a folder of csv files."""
    return _is_folder(path) or path.suffix.casefold() in _TEXT_SUFFIXES


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except OSError as error:  # the name is impossible, or the folder is closed to us
        rule = say("book.not_looked_for", path=str(path), cause=explain(error))
        raise refuse_file(path.name, rule, _ACCEPTED_FILE) from error


def _read_archive(
    file: str,
    content: bytes,
    is_wanted: Callable[[str], bool],
    text_format: TextFormat,
) -> Workbook:
    _refuse_other_kinds(file, content)
    try:
        guard_archive(file, content)
        with zipfile.ZipFile(BytesIO(content)) as archive:
            parts = archive.namelist()
            is_strict = any(
                _STRICT in archive.read(part) for part in parts if _is_root(part)
            )
        if is_strict:
            raise refuse_file(file, say("book.strict"), _ACCEPTED_FILE)
        if "xl/workbook.bin" in parts:
            raise refuse_file(file, say("book.binary"), _ACCEPTED_FILE)
        if "content.xml" in parts:
            raise refuse_file(file, say("book.ods"), _ACCEPTED_FILE)
        workbook = read_xlsx(file, content, is_wanted, text_format.decimal_mark)
    except DAMAGE as error:
        rule = say("book.unreadable", detail=_describe_damage(error))
        raise refuse_file(file, rule, _ACCEPTED_FILE) from error
    if not (workbook.sheets or workbook.unread):
        raise refuse_file(file, say("book.no_sheet"), _ACCEPTED_FILE)
    remarks = (note_file(file, say("book.macros")),) if _MACRO_PART in parts else ()
    return replace(workbook, remarks=remarks)


def _is_root(part: str) -> bool:
    """Whether a part names the kind of the whole file."""
    return part.endswith("_rels/.rels") or part.endswith("workbook.xml")


def _describe_damage(error: BaseException) -> Message:
    """Reason in our own words why a file cannot be opened."""
    cause = error.__cause__ or error  # openpyxl wraps what the parser says
    if isinstance(cause, ContentError):
        return cause.message
    if type(cause).__name__ in _FORBIDDEN:
        return say("book.entities")
    if isinstance(cause, RuntimeError) and "encrypted" in str(cause):
        return say("book.password")
    return say("book.lacks_part" if isinstance(cause, KeyError) else "book.damaged")


def _read_texts(name: str, paths: list[Path]) -> dict[str, bytes]:
    """Contents of csv files by name; their sum has the limit of a single file."""
    if len(paths) > MAX_ENTRIES:
        rule = say("book.many_csv", count=len(paths))
        raise refuse_file(name, rule, say("book.most_files", most=MAX_ENTRIES))
    contents: dict[str, bytes] = {}
    remaining = MAX_TEXT_BYTES
    for path in paths:
        contents[path.name] = _read_file(path, remaining)
        remaining -= len(contents[path.name])
    return contents


def _read_file(path: Path, most: int) -> bytes:
    try:
        if not path.is_file():
            raise refuse_file(
                path.name, say("book.not_there", path=str(path)), _ACCEPTED_FILE
            )
        return read_bounded(path, most)
    except OSError as error:
        if is_held(error, path):
            rule = say("book.open_in_program")
            raise refuse_file(path.name, rule, say("book.close_it")) from error
        rule = say("book.not_opened", cause=explain(error))
        raise refuse_file(path.name, rule, _ACCEPTED_FILE) from error
    except ValueError:
        raise refuse_file(
            path.name,
            say("book.too_large"),
            say(
                "book.most_size",
                most=MAX_FILE_BYTES / 2**20,
                text=MAX_TEXT_BYTES / 2**20,
            ),
        ) from None


def _refuse_other_kinds(file: str, content: bytes) -> None:
    if content.startswith(_OLE_MAGIC):
        rule = say("book.old_or_password")
        raise refuse_file(file, rule, _ACCEPTED_FILE)
    if not content.startswith(_ZIP_MAGIC) and _looks_like_text(content):
        raise refuse_file(file, say("book.text_file"), say("book.csv_ending"))


def _looks_like_text(content: bytes) -> bool:
    start = content[:1000]
    return bool(start.strip()) and not any(byte < 9 for byte in start)
