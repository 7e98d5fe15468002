"""Limits of a site workbook's size: far above any real one, far below a bomb."""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Iterable
from contextlib import suppress
from io import BytesIO

from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import Cell, name_column
from netdesign.site.cells.findings import refuse_file
from netdesign.words.message import say

# A site workbook has tens of kilobytes; whatever is far larger is not one.
MAX_FILE_BYTES = 8 * 2**20
MAX_TEXT_BYTES = 4 * 2**20  # of all csv files that are read together
MAX_EXPANDED_BYTES = 32 * 2**20
MAX_ENTRIES = 500
# Elements and attributes of all parts: each costs a parser hundreds of bytes, so the
# size of a part does not bound its memory. 1000 filled rows of 30 columns have 250,000.
MAX_MARKS = 300_000
MAX_RATIO = 200.0
MAX_ROWS = 2000
# Of more the study is larger than `report` and `verify` read (``edge/json_text.py``).
MAX_NET_ROWS = 1000
MAX_LINES = 40_000  # of a csv file: a century of daily snow heights
MAX_COLUMNS = 200
MAX_CELLS = MAX_ROWS * MAX_COLUMNS

# Others unpack a whole block at once, before anything can be counted.
_METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)

# What zipfile, the XML parsers and openpyxl raise on damaged or hostile files.
DAMAGE = (
    ArithmeticError,
    AttributeError,
    EOFError,
    LookupError,
    OSError,
    RuntimeError,
    SyntaxError,
    TypeError,
    ValueError,
    zipfile.BadZipFile,
    zlib.error,
)

_RATIO_COUNTS_ABOVE = 2**20  # small parts may be as regular as they like
_CHUNK = 2**16


def guard_archive(file: str, content: bytes) -> None:
    """Refuse archives that would expand beyond reason, before any XML is parsed."""
    with zipfile.ZipFile(BytesIO(content)) as archive:
        entries = archive.infolist()
        if len(entries) > MAX_ENTRIES:
            rule = say("book.many_parts", count=len(entries))
            raise refuse_file(file, rule, say("book.most_parts", most=MAX_ENTRIES))
        if len({entry.filename for entry in entries}) < len(entries):
            raise refuse_file(file, say("book.same_name"), say("book.each_once"))
        if sum(entry.file_size for entry in entries) > MAX_EXPANDED_BYTES:
            raise _refuse_expansion(file)
        if any(entry.compress_type not in _METHODS for entry in entries):
            rule = say("book.odd_packing")
            raise refuse_file(file, rule, say("book.stored_or_deflated"))
        remaining, marks = MAX_EXPANDED_BYTES, 0
        for entry in entries:
            size, marks_here = _expand(archive, entry, remaining, file)
            remaining -= size
            marks += marks_here
            if marks > MAX_MARKS:
                raise _refuse_expansion(file)
            _forbid_entities(archive, entry)


class _AtRootError(Exception):
    """The first element of a part: nothing can be declared behind it."""


def _forbid_entities(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> None:
    """Refuse a part that declares entities.

    openpyxl reads with lxml where that is installed, and lxml would leave such an
    entity out of its cell without a word: this does not rest on the parser it takes.

    Raises
    ------
    defusedxml.common.EntitiesForbidden
        As defusedxml does.
    """
    from xml.parsers.expat import ExpatError, ParserCreate

    from defusedxml.common import EntitiesForbidden

    def forbid(name: str, _: bool, value: str | None, *place: str | None) -> None:
        raise EntitiesForbidden(name, value, *place)

    def stop(*_: object) -> None:
        raise _AtRootError

    parser = ParserCreate()
    parser.EntityDeclHandler, parser.StartElementHandler = forbid, stop
    with archive.open(entry) as part, suppress(_AtRootError, ExpatError):
        # what is no XML at all is told by whoever reads the part
        while chunk := part.read(_CHUNK):
            parser.Parse(chunk)


def _expand(
    archive: zipfile.ZipFile, entry: zipfile.ZipInfo, allowed: int, file: str
) -> tuple[int, int]:
    """Count bytes and marks that a part really has; its checksum is tested too."""
    size = marks = 0
    with archive.open(entry) as part:
        while chunk := part.read(_CHUNK):
            size += len(chunk)
            marks += chunk.count(b"<") + chunk.count(b"=")
            if size > allowed:
                raise _refuse_expansion(file)
    if size > _RATIO_COUNTS_ABOVE and size > MAX_RATIO * entry.compress_size:
        raise _refuse_expansion(file)
    return size, marks


def _refuse_expansion(file: str) -> SiteDataError:
    return refuse_file(
        file,
        say("book.expands"),
        say(
            "book.expansion_limits",
            size=MAX_EXPANDED_BYTES / 2**20,
            ratio=MAX_RATIO,
            marks=MAX_MARKS,
        ),
    )


def require_rows(file: str, sheet: str, last_row: int, most: int = MAX_ROWS) -> None:
    """Refuse a sheet that is filled far down."""
    if last_row > most:
        rule = say("book.filled_down", row=last_row)
        accepted = say("book.most_rows", most=most, lines=MAX_LINES)
        raise refuse_file(file, rule, accepted, sheet)


def require_cells(file: str, sheet: str, count: int) -> None:
    """Refuse a text that holds more cells than a sheet may."""
    if count > MAX_CELLS:
        rule = say("book.holds_cells", count=count)
        raise refuse_file(file, rule, say("book.most_cells", most=MAX_CELLS), sheet)


def require_columns(file: str, sheet: str, cells: Iterable[Cell]) -> None:
    """Refuse a sheet that is filled far to the right."""
    require_width(file, sheet, max((cell.column for cell in cells), default=0))


def require_width(file: str, sheet: str, last_column: int) -> None:
    """Refuse a last column far to the right."""
    if last_column > MAX_COLUMNS:
        rule = say("book.filled_right", column=name_column(MAX_COLUMNS))
        accepted = say("book.most_columns", most=MAX_COLUMNS)
        raise refuse_file(file, rule, accepted, sheet)
