"""Opens a site file of any accepted kind safely: xlsx, xlsm, ods, csv."""

from __future__ import annotations

import hashlib
import zipfile
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

from netdesign.edge.causes import explain
from netdesign.edge.given_files import make_printable, read_bounded
from netdesign.edge.locks import is_held
from netdesign.outcome import ContentError
from netdesign.site.cells.cells import UNDECLARED, Sheet, TextFormat, Workbook
from netdesign.site.cells.delimited import read_delimited
from netdesign.site.cells.findings import Finding, note_file, refuse_file
from netdesign.site.cells.limits import (
    DAMAGE,
    MAX_ENTRIES,
    MAX_FILE_BYTES,
    MAX_TEXT_BYTES,
    guard_archive,
)
from netdesign.site.cells.ods import read_ods
from netdesign.site.cells.xlsx import read_xlsx
from netdesign.words.message import Message, say

_OLE_MAGIC = b"\xd0\xcf\x11\xe0"
_ZIP_MAGIC = b"PK"
# Of defusedxml, by name: it is imported where XML is read.
_FORBIDDEN = ("DTDForbidden", "EntitiesForbidden", "ExternalReferenceForbidden")
_ACCEPTED_FILE = say("accepted.file")
_TEXT_SUFFIXES = (".csv", ".tsv", ".txt")
_MACRO_PARTS = ("xl/vbaProject.bin", "Basic/", "Scripts/")

_Content = tuple[
    tuple[Sheet, ...], tuple[str, ...], frozenset[str], tuple[Finding, ...]
]


def read_workbook(
    path: Path,
    is_wanted: Callable[[str], bool],
    is_name: Callable[[str], bool] | None = None,
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
    is_name : callable, optional
        Tells whether a line alone in its row names a sheet of a csv file, perhaps
        misspelt; by default, whether the sheet is wanted.
    is_heading : callable
        Tells from a cell's text whether it is a known heading; finds the
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
        With one finding, if the file as a whole cannot be read: missing, not a
        workbook, damaged, hostile or far too large.
    """
    is_folder = _is_folder(path)
    if is_text(path):
        paths = sorted(path.glob("*.csv")) if is_folder else [path]
        if not paths:
            raise refuse_file(path.name, say("book.no_csv"), say("book.nets_csv"))
        contents = _read_texts(path.name, paths)
        sheets, unread, remarks = read_delimited(
            contents,
            is_wanted,
            is_name or is_wanted,
            is_heading,
            text_format,
            by_name=is_folder,
        )
        read: _Content = sheets, unread, frozenset(), remarks
        content = b"".join(contents.values())
    else:
        content = _read_file(path, MAX_FILE_BYTES)
        read = _read_archive(path.name, content, is_wanted, text_format)
    return Workbook(
        file=make_printable(path.name),
        sha256=hashlib.sha256(content).hexdigest(),
        sheets=read[0],
        unread=read[1],
        hidden=read[2],
        remarks=read[3],
    )


def is_text(path: Path) -> bool:
    """A file is read as csv, or is a folder of csv files."""
    return _is_folder(path) or path.suffix.casefold() in _TEXT_SUFFIXES


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except OSError as error:  # no file can have that name, or nobody may look there
        rule = say("book.not_looked_for", path=str(path), cause=explain(error))
        raise refuse_file(path.name, rule, _ACCEPTED_FILE) from error


def _read_archive(
    file: str,
    content: bytes,
    is_wanted: Callable[[str], bool],
    text_format: TextFormat,
) -> _Content:
    _refuse_other_kinds(file, content)
    try:
        guard_archive(file, content)
        with zipfile.ZipFile(BytesIO(content)) as archive:
            parts = archive.namelist()
        if "xl/workbook.bin" in parts:
            raise refuse_file(file, say("book.binary"), _ACCEPTED_FILE)
        is_ods = "content.xml" in parts
        read = (read_ods if is_ods else read_xlsx)(
            file, content, is_wanted, text_format.decimal_mark
        )
    except DAMAGE as error:
        rule = say("book.unreadable", detail=_describe_damage(error))
        raise refuse_file(file, rule, _ACCEPTED_FILE) from error
    has_macros = any(part.startswith(_MACRO_PARTS) for part in parts)
    note = note_file(file, say("book.macros"))
    return *read, (note,) if has_macros else ()


def _describe_damage(error: BaseException) -> Message:
    """Words of ours for what is wrong with a file."""
    cause = error.__cause__ or error  # openpyxl wraps what the parser says
    if isinstance(cause, ContentError):
        return cause.message
    if type(cause).__name__ in _FORBIDDEN:
        return say("book.entities")
    if isinstance(cause, RuntimeError) and "encrypted" in str(cause):
        return say("book.password")
    return say("book.lacks_part" if isinstance(cause, KeyError) else "book.damaged")


def _read_texts(name: str, paths: list[Path]) -> dict[str, bytes]:
    """Contents of csv files by name; all together are not larger than one may be."""
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
