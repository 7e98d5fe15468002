"""Opens an xlsx workbook safely and gives its sheets as cells with addresses."""

from __future__ import annotations

import hashlib
import re
import warnings
import zipfile
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from netdesign.errors import NetDesignError, SiteDataError
from netdesign.site.cells import Cell, MergedRange, Sheet, Workbook, name_column
from netdesign.site.diagnostics import Finding, quote

if TYPE_CHECKING:  # openpyxl is slow to import and only needed to open a file
    from openpyxl import Workbook as OpenWorkbook

# A site workbook has tens of kilobytes; whatever is far larger is not one.
MAX_FILE_BYTES = 8 * 2**20
MAX_EXPANDED_BYTES = 32 * 2**20
MAX_ENTRIES = 500
MAX_RATIO = 200.0
MAX_ROWS = 2000
MAX_COLUMNS = 200

_RATIO_COUNTS_ABOVE = 2**20  # small parts may be as regular as they like
_CHUNK = 2**16
_OLE_MAGIC = b"\xd0\xcf\x11\xe0"
_ACCEPTED_FILE = "a workbook saved as .xlsx, without password"

# What zipfile, the XML parsers and openpyxl raise on damaged or hostile files.
_DAMAGE = (
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


def read_workbook(path: Path, is_wanted: Callable[[str], bool]) -> Workbook:
    """Read the wanted sheets of an xlsx file.

    Parameters
    ----------
    path : Path
        The file. It is read once; guards, hash and content see the same bytes.
    is_wanted : callable
        Tells from a sheet's name whether to read it.

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
    content = _read_file(path)
    try:
        _guard_archive(path.name, content)
        sheets, unread = _read_sheets(path.name, content, is_wanted)
    except _DAMAGE as error:
        cause = error.__cause__ or error  # openpyxl wraps what the parser says
        detail = quote(f"{type(cause).__name__}: {cause}")
        raise _refuse_file(
            path.name, f"cannot be read as a workbook ({detail})", _ACCEPTED_FILE
        ) from error
    return Workbook(
        file=path.name,
        sha256=hashlib.sha256(content).hexdigest(),
        sheets=sheets,
        unread=unread,
    )


def _refuse_file(file: str, rule: str, accepted: str, sheet: str = "") -> SiteDataError:
    finding = Finding(file=file, sheet=sheet, rule=rule, accepted=accepted)
    return SiteDataError([finding])


def _read_file(path: Path) -> bytes:
    if not path.is_file():
        raise _refuse_file(path.name, f"does not exist at {path}", _ACCEPTED_FILE)
    try:
        if path.stat().st_size > MAX_FILE_BYTES:
            raise _refuse_file(
                path.name,
                "is too large for a site workbook",
                f"at most {MAX_FILE_BYTES / 2**20:g} MiB; remove pictures and "
                "sheets that are not needed",
            )
        content = path.read_bytes()
    except OSError as error:
        rule = f"cannot be opened ({error.strerror})"
        raise _refuse_file(path.name, rule, _ACCEPTED_FILE) from error
    if content.startswith(_OLE_MAGIC):
        rule = "is an old .xls workbook or has a password"
        raise _refuse_file(path.name, rule, _ACCEPTED_FILE)
    return content


def _guard_archive(file: str, content: bytes) -> None:
    """Refuse archives that would expand beyond reason, before any XML is parsed."""
    with zipfile.ZipFile(BytesIO(content)) as archive:
        entries = archive.infolist()
        if len(entries) > MAX_ENTRIES:
            rule = f"is an archive of {len(entries)} parts"
            raise _refuse_file(file, rule, f"at most {MAX_ENTRIES} parts")
        if len({entry.filename for entry in entries}) < len(entries):
            raise _refuse_file(file, "holds two parts of the same name", _ACCEPTED_FILE)
        if sum(entry.file_size for entry in entries) > MAX_EXPANDED_BYTES:
            raise _refuse_expansion(file)
        remaining = MAX_EXPANDED_BYTES
        for entry in entries:
            remaining -= _expand(archive, entry, remaining, file)


def _expand(
    archive: zipfile.ZipFile, entry: zipfile.ZipInfo, allowed: int, file: str
) -> int:
    """Count the bytes that a part really expands to; its checksum is tested too."""
    size = 0
    with archive.open(entry) as part:
        while chunk := part.read(_CHUNK):
            size += len(chunk)
            if size > allowed:
                raise _refuse_expansion(file)
    if size > _RATIO_COUNTS_ABOVE and size > MAX_RATIO * entry.compress_size:
        raise _refuse_expansion(file)
    return size


def _refuse_expansion(file: str) -> SiteDataError:
    return _refuse_file(
        file,
        "expands beyond what a site workbook needs",
        f"at most {MAX_EXPANDED_BYTES / 2**20:g} MiB expanded, and no part packed "
        f"more than {MAX_RATIO:g} to 1",
    )


def _open(content: bytes, *, stored_results: bool) -> OpenWorkbook:
    import openpyxl

    if not openpyxl.DEFUSEDXML:
        message = "openpyxl runs without defusedxml: install defusedxml"
        raise NetDesignError(message)
    return openpyxl.load_workbook(
        BytesIO(content), read_only=True, data_only=stored_results, keep_links=False
    )


def _read_sheets(
    file: str, content: bytes, is_wanted: Callable[[str], bool]
) -> tuple[tuple[Sheet, ...], tuple[str, ...]]:
    with warnings.catch_warnings():
        # openpyxl warns of features that it would drop on saving; nothing is saved.
        warnings.simplefilter("ignore")
        # openpyxl shows a formula or its stored result, never both: open it twice.
        typed = _open(content, stored_results=False)
        stored = _open(content, stored_results=True)
        names = [sheet.title for sheet in typed.worksheets]
        sheets = tuple(
            _read_sheet(file, typed[name], stored[name])
            for name in names
            if is_wanted(name)
        )
    return sheets, tuple(name for name in names if not is_wanted(name))


def _read_sheet(file: str, typed: Any, stored: Any) -> Sheet:
    layout = _scan_layout(typed)
    if layout.last_row > MAX_ROWS:
        rule = f"has cells filled down to row {layout.last_row}"
        raise _refuse_file(file, rule, f"at most {MAX_ROWS} rows", typed.title)
    formulas = {
        (cell.row, cell.column): _show_formula(cell.value)
        for cell in _filled_cells(typed, layout.last_row)
        if cell.data_type == "f"
    }
    # First the formulas alone; those with a stored result are then replaced.
    cells = {
        (row, column): Cell(
            file=file, sheet=typed.title, row=row, column=column, formula=formula
        )
        for (row, column), formula in formulas.items()
    }
    for cell in _filled_cells(stored, layout.last_row):
        place = (cell.row, cell.column)
        cells[place] = _take_cell(file, cell, formulas.get(place, ""))
    if any(column > MAX_COLUMNS for _, column in cells):
        rule = f"has cells filled beyond column {name_column(MAX_COLUMNS)}"
        raise _refuse_file(file, rule, f"at most {MAX_COLUMNS} columns", typed.title)
    return Sheet(
        file=file,
        name=typed.title,
        rows=_group_by_row(cells),
        merged=layout.merged,
        hidden_rows=layout.hidden_rows,
        is_hidden=typed.sheet_state != "visible",
    )


def _group_by_row(
    cells: Mapping[tuple[int, int], Cell],
) -> dict[int, dict[int, Cell]]:
    rows: dict[int, dict[int, Cell]] = {}
    for row, column in sorted(cells):
        rows.setdefault(row, {})[column] = cells[row, column]
    return rows


def _filled_cells(sheet: Any, last_row: int) -> list[Any]:
    # The size that a file declares for its sheet may be wrong: do not trust it.
    sheet.reset_dimensions()
    rows = sheet.iter_rows(max_row=last_row) if last_row else ()
    return [cell for row in rows for cell in row if cell.value is not None]


def _take_cell(file: str, cell: Any, formula: str) -> Cell:
    return Cell(
        file=file,
        sheet=cell.parent.title,
        row=cell.row,
        column=cell.column,
        value=cell.value,
        formula=formula,
        is_error=cell.data_type == "e",
        is_percent=cell.data_type == "n" and _shows_percent(cell.number_format),
    )


def _show_formula(value: Any) -> str:
    # Array formulas come as an object with the text inside.
    return str(getattr(value, "text", value))


def _shows_percent(number_format: str) -> bool:
    """Whether a format multiplies by 100; a quoted percent sign does not."""
    return "%" in re.sub(r'"[^"]*"|\\.', "", number_format)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Layout:
    last_row: int
    merged: tuple[MergedRange, ...]
    hidden_rows: frozenset[int]


def _scan_layout(sheet: Any) -> _Layout:
    """Last filled row, merged ranges and hidden filled rows of a sheet.

    openpyxl gives merged ranges only in its other mode, which makes one object
    of every merged cell: a few bytes of XML would exhaust the memory.
    """
    from defusedxml.ElementTree import iterparse

    row = last_row = 0
    merged: list[MergedRange] = []
    hidden: set[int] = set()
    with sheet._get_source() as source:
        for _, element in iterparse(source):
            tag = element.tag.rpartition("}")[2]
            if tag == "mergeCell":
                merged.append(_read_merged_range(element.get("ref", "")))
            elif tag == "row":
                row = int(element.get("r", row + 1))
                if any(len(cell) for cell in element):
                    last_row = max(last_row, row)
                    if element.get("hidden") in ("1", "true"):
                        hidden.add(row)
                element.clear()
    return _Layout(
        last_row=last_row, merged=tuple(merged), hidden_rows=frozenset(hidden)
    )


def _read_merged_range(text: str) -> MergedRange:
    from openpyxl.utils import range_boundaries

    column, row, _, last_row = range_boundaries(text)
    return MergedRange(
        text=text, row=row or 1, column=column or 1, last_row=last_row or MAX_ROWS
    )
