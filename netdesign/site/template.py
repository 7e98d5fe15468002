"""Writes the input workbook: headings, units, notes, drop-downs, an example."""

from __future__ import annotations

import datetime
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from netdesign.output import require_free, write_files
from netdesign.resources import find_resource
from netdesign.site.columns import (
    PROJECT,
    PROJECT_ITEMS,
    RANGE_QUANTITIES,
    RANGES,
    SHEETS,
)
from netdesign.site.fields import Field, SheetPlan

if TYPE_CHECKING:  # slow to import and only needed to write a workbook
    from xlsxwriter.format import Format
    from xlsxwriter.workbook import Workbook
    from xlsxwriter.worksheet import Worksheet

EXAMPLE_FILE = "example_site.toml"

# The same program writes the same bytes: no clock goes into the file.
_CREATED = datetime.datetime(2000, 1, 1)
_LAST_ROW = 200  # drop-downs and bounds reach down to this line
_COLUMN_WIDTH = 14
_TEXT_WIDTH = 28
_OPTIONS = {
    "strings_to_formulas": False,
    "strings_to_numbers": False,
    "strings_to_urls": False,
    "in_memory": True,
}

_Lines = Sequence[Mapping[str, object]]  # of one sheet, by field key


@dataclass(frozen=True, slots=True)
class _Formats:
    heading: Format
    text: Format


def write_site_workbook(
    path: Path, *, example: bool = False, overwrite: bool = False
) -> None:
    """Write an input workbook to fill in, or the built-in example site.

    Parameters
    ----------
    path : Path
        The xlsx file to write.
    example : bool
        Fill in the example site; otherwise only the names of project items and
        ranges are there.
    overwrite : bool
        Replace a file that exists.

    Raises
    ------
    OutputError
        If the file exists and may not be replaced, or cannot be written.
    """
    import xlsxwriter

    require_free([path], overwrite=overwrite)
    lines = load_example() if example else _starting_lines()
    content = BytesIO()
    workbook = xlsxwriter.Workbook(content, _OPTIONS)
    workbook.set_properties({"title": "Snow net site", "created": _CREATED})
    formats = _Formats(
        heading=workbook.add_format({"bold": True, "text_wrap": True, "bottom": 1}),
        text=workbook.add_format({"num_format": "@"}),
    )
    for plan in SHEETS:
        _write_sheet(workbook, plan, lines.get(plan.name, ()), formats)
    workbook.close()
    write_files({path: content.getvalue()})


def load_example() -> dict[str, _Lines]:
    """Load the lines of the example site: by sheet, then line, then field key."""
    file = find_resource("templates") / EXAMPLE_FILE
    return tomllib.loads(file.read_text(encoding="utf-8"))


def _starting_lines() -> dict[str, _Lines]:
    """Give the lines of which only the numbers are the engineer's."""
    return {
        PROJECT.name: [{"item": field.label} for field in PROJECT_ITEMS],
        RANGES.name: [
            {"quantity": field.label, "unit": field.unit} for field in RANGE_QUANTITIES
        ],
    }


def _write_sheet(
    workbook: Workbook, plan: SheetPlan, lines: _Lines, formats: _Formats
) -> None:
    sheet = workbook.add_worksheet(plan.name)
    sheet.freeze_panes(1, 1)
    sheet.set_landscape()
    sheet.fit_to_pages(1, 0)
    for column, field in enumerate(plan.fields):
        # Text cells keep an id such as 007, or a revision 1/2, as it is typed.
        is_number = field.kind in ("number", "count")
        width = _TEXT_WIDTH if field.kind == "text" else _COLUMN_WIDTH
        sheet.set_column(column, column, width, None if is_number else formats.text)
        sheet.write_string(0, column, field.heading, formats.heading)
        if note := _describe(field):
            sheet.write_comment(0, column, note, {"x_scale": 2})
        if rule := _validation(field):
            sheet.data_validation(1, column, _LAST_ROW, column, rule)
    for row, line in enumerate(lines, start=1):
        _write_line(sheet, plan, row, line)


def _write_line(
    sheet: Worksheet, plan: SheetPlan, row: int, line: Mapping[str, object]
) -> None:
    columns = {field.key: column for column, field in enumerate(plan.fields)}
    for key, value in line.items():
        if isinstance(value, str):
            sheet.write_string(row, columns[key], value)
        else:
            sheet.write_number(row, columns[key], value)


def _describe(field: Field) -> str:
    """Note on a heading: meaning, what is accepted, default."""
    parts = [field.note]
    if field.units or field.words:
        parts.append(f"accepted: {field.accepted}")
    if len(field.units) > 1:
        parts.append("units: " + " or ".join(f"[{unit}]" for unit in field.units))
    if field.default is not None:
        parts.append(f"left empty: {field.default:g} {field.unit}".rstrip(" -"))
    return "\n".join(part for part in parts if part)


def _validation(field: Field) -> dict[str, Any] | None:
    """Rule that the spreadsheet program applies while the engineer types."""
    if field.words:
        return {"validate": "list", "source": list(field.words)}
    if field.refers_to:
        # A warning only: the type may be defined afterwards.
        ids = f"={field.refers_to}!$A$2:$A${_LAST_ROW + 1}"
        return {"validate": "list", "source": ids, "error_type": "warning"}
    low, high = field.bounds
    if low == high:  # ends of ranges: their bounds depend on the line
        return None
    return {
        "validate": "integer" if field.kind == "count" else "decimal",
        "criteria": "between",
        "minimum": low,
        "maximum": high,
        "error_title": "Out of range",
        "error_message": f"{field.label}: {field.accepted}",
    }
