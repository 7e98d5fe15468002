"""Contents of a workbook: cells that know their place, sheets, the file.

Its limits of size are far above any real site, far below a bomb.
"""

from __future__ import annotations

import math
import re
import zipfile
import zlib
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from io import BytesIO
from typing import TYPE_CHECKING

from netdesign.outcome import SiteDataError
from netdesign.site.cells.findings import Finding, Severity, refuse_file
from netdesign.site.cells.numbers import (
    DecimalMark,
    compute_constant,
    split_unit,
)
from netdesign.words.message import Message, say

if TYPE_CHECKING:  # openpyxl is slow to import and only needed to open a file
    from openpyxl.worksheet.cell_range import CellRange


@dataclass(frozen=True, slots=True, kw_only=True)
class TextFormat:
    """Declared form of a file's text; empty entries are found in the file or by cell.

    Attributes
    ----------
    delimiter : str
        Between the columns of a csv file.
    decimal_mark : str
        Point or comma, in numbers that are stored as text.
    """

    delimiter: str = ""
    decimal_mark: DecimalMark = ""


UNDECLARED = TextFormat()


@dataclass(frozen=True, slots=True, kw_only=True)
class Cell:
    """One cell: where it is and what it holds.

    ``value`` is what the file stores: text, number, truth value, date, or None;
    of a formula it is the stored result, None where the file has none.
    """

    file: str
    sheet: str
    row: int
    column: int
    value: object = None
    formula: str = ""
    is_error: bool = False
    is_percent: bool = False  # the cell's format shows hundredfold
    shown_unit: str = ""  # what the cell's format shows beside the number
    decimal_mark: DecimalMark = ""  # declared for the file; none: judged cell by cell
    doubt: Message | None = None  # about what it holds: struck out, a stale result

    @property
    def address(self) -> str:
        """Address in its sheet: ``C14``."""
        return f"{name_column(self.column)}{self.row}"

    @property
    def place(self) -> str:
        """Address in its workbook: ``Rows!C14``."""
        return f"{self.sheet}!{self.address}"

    @property
    def text(self) -> str:
        """Text as typed: the formula, or the value as text."""
        if self.formula:
            return self.formula
        return "" if self.value is None else str(self.value)

    @property
    def is_blank(self) -> bool:
        """Whether the cell is empty, or holds nothing but spaces."""
        return not self.text.strip()

    @property
    def own_unit(self) -> str:
        """Unit that the cell shows: typed behind its number, or set by its format."""
        if isinstance(self.value, str):
            return split_unit(self.value)[1]
        return "%" if self.is_percent else self.shown_unit

    def follow_change(self) -> Cell:
        """Cell of a formula whose stored result a change may have made old."""
        return replace(self, doubt=say("cell.follows_change"))

    def retype(self, value: object) -> Cell:
        """Cell as if another value were typed there, without its display format."""
        plain = replace(self, is_error=False, is_percent=False, shown_unit="")
        return replace(plain, value=value, formula="")

    def finding(
        self,
        rule: Message,
        accepted: Message | str = "",
        field: Message | str = "",
        *,
        severity: Severity = "error",
    ) -> Finding:
        """Say what is wrong with this cell."""
        return Finding(
            file=self.file,
            sheet=self.sheet,
            cell=self.address,
            field=field,
            text=self.text,
            rule=rule,
            accepted=accepted,
            severity=severity,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Sheet:
    """One sheet; ``rows`` holds the filled cells by row, then column, from 1."""

    file: str
    name: str
    rows: Mapping[int, Mapping[int, Cell]]
    merged: tuple[CellRange, ...] = ()
    is_delimited: bool = False  # of a csv file: a line may be cut at wrong places

    def cell(self, row: int, column: int) -> Cell:
        """Cell at a place, blank where nothing is filled in."""
        blank = Cell(file=self.file, sheet=self.name, row=row, column=column)
        return self.rows.get(row, {}).get(column, blank)

    @property
    def cells(self) -> Iterator[Cell]:
        """Filled cells, row by row."""
        return (cell for row in self.rows.values() for cell in row.values())

    def row(self, number: int) -> tuple[Cell, ...]:
        """Cells of one row that hold more than spaces, from left to right."""
        cells = self.rows.get(number, {}).values()
        return tuple(cell for cell in cells if not cell.is_blank)

    def finding(
        self,
        rule: Message,
        accepted: Message | str = "",
        *,
        severity: Severity = "error",
    ) -> Finding:
        """Say what is wrong with the whole sheet."""
        return Finding(
            file=self.file,
            sheet=self.name,
            rule=rule,
            accepted=accepted,
            severity=severity,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Workbook:
    """The wanted sheets of one file, the names of the others, the file's hash."""

    file: str
    sheets: tuple[Sheet, ...]
    unread: tuple[str, ...] = ()
    sha256: str = ""
    remarks: tuple[Finding, ...] = ()  # how the file was read, what was left aside
    is_by_hand: bool = False  # formulas are calculated only on request

    def finding(
        self, rule: Message, accepted: Message | str = "", sheet: str = ""
    ) -> Finding:
        """Say what is wrong with the file, or with one of its sheets."""
        return Finding(file=self.file, sheet=sheet, rule=rule, accepted=accepted)


def doubt_results(workbook: Workbook, changed: Collection[str] = ()) -> Workbook:
    """Mark the formulas of a workbook whose stored results may be old.

    These are formulas of numbers alone that give another number, formulas that rest on
    a changed cell, and all others of a workbook that is calculated by hand.

    Parameters
    ----------
    workbook : Workbook
        As read, with the changes.
    changed : collection of str
        Places of cells that a what-if has changed: ``Rows!C8``.
    """
    followers = find_followers(workbook, changed) if changed else set[str]()

    def mark(cell: Cell) -> Cell:
        if not cell.formula or cell.doubt or not isinstance(cell.value, int | float):
            return cell
        number = compute_constant(cell.formula)
        if number is None:
            if cell.address in followers:
                return cell.follow_change()
            return replace(cell, doubt=_BY_HAND) if workbook.is_by_hand else cell
        if math.isclose(number, cell.value, rel_tol=1e-6, abs_tol=1e-9):
            return cell
        stale = say("cell.stale", stored=float(cell.value), number=number)
        return replace(cell, doubt=stale)

    sheets = tuple(
        replace(sheet, rows=group_by_row(map(mark, sheet.cells)))
        for sheet in workbook.sheets
    )
    return replace(workbook, sheets=sheets)


_BY_HAND = say("cell.by_hand")
_READ = re.compile(r"[A-Z]{1,3}[1-9]\d*|:")  # addresses; the sign of a range


def find_followers(workbook: Workbook, changed: Collection[str]) -> set[str]:
    """Addresses of changed cells, and of formulas that rest on them by any chain.

    A formula of a range may read any cell; sheets are not told apart.
    """
    read: dict[str, set[str]] = {}
    for cell in (cell for sheet in workbook.sheets for cell in sheet.cells):
        if cell.formula:
            names = _READ.findall(cell.formula.replace("$", ""))
            read.setdefault(cell.address, set()).update(names)
    followers = {":", *(place.rpartition("!")[2] for place in changed)}
    while more := {x for x, names in read.items() if names & followers} - followers:
        followers |= more
    return followers


def name_column(column: int) -> str:
    """Letters of a column counted from 1.

    >>> name_column(28)
    'AB'
    """
    from openpyxl.utils import get_column_letter  # slow to import

    return get_column_letter(column)


def split_address(address: str) -> tuple[int, int]:
    """Column and row of a cell, counted from 1.

    >>> split_address("AB7")
    (28, 7)
    """
    from openpyxl.utils.cell import coordinate_to_tuple  # slow to import

    row, column = coordinate_to_tuple(address)
    return column, row


def group_by_row(cells: Iterable[Cell]) -> dict[int, dict[int, Cell]]:
    """Cells by row, then column, both ascending."""
    rows: dict[int, dict[int, Cell]] = {}
    for cell in sorted(cells, key=lambda cell: (cell.row, cell.column)):
        rows.setdefault(cell.row, {})[cell.column] = cell
    return rows


# A site workbook has tens of kilobytes; a far larger file is none.
MAX_FILE_BYTES = 8 * 2**20
MAX_TEXT_BYTES = 4 * 2**20  # of all csv files that are read together
MAX_EXPANDED_BYTES = 32 * 2**20
MAX_ENTRIES = 500
# Elements and attributes of all parts: each costs a parser hundreds of bytes, so the
# size of a part does not bound its memory. 1000 filled rows of 30 columns have 250,000.
MAX_MARKS = 300_000
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


def _forbid_entities(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> None:
    """Refuse a part that declares entities.

    openpyxl reads with lxml where that is installed, and lxml would leave such an
    entity out of its cell without a word: this does not rest on the parser it takes.

    Raises
    ------
    defusedxml.common.EntitiesForbidden
        As defusedxml does.
    """
    from xml.etree.ElementTree import ParseError

    from defusedxml.ElementTree import iterparse

    # the reader of the part reports what is no XML; nothing can be declared behind
    # the first element
    with archive.open(entry) as part, suppress(ParseError):
        next(iterparse(part, events=("start",)), None)


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
    return size, marks


def _refuse_expansion(file: str) -> SiteDataError:
    return refuse_file(
        file,
        say("book.expands"),
        say(
            "book.expansion_limits",
            size=MAX_EXPANDED_BYTES / 2**20,
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


def require_width(file: str, sheet: str, last_column: int) -> None:
    """Refuse a last column far to the right."""
    if last_column > MAX_COLUMNS:
        rule = say("book.filled_right", column=name_column(MAX_COLUMNS))
        accepted = say("book.most_columns", most=MAX_COLUMNS)
        raise refuse_file(file, rule, accepted, sheet)
