"""Writes an office's list as it sends it: xlsx, ods, or a folder of csv files."""

from __future__ import annotations

import csv
from typing import TYPE_CHECKING
from xml.sax.saxutils import escape

import openpyxl
from openpyxl.styles import Font

from tests.site.cells.ods_files import write_cell, write_ods
from tests.site.messy.sheets import fill

if TYPE_CHECKING:
    from pathlib import Path
    from types import ModuleType


def write_xlsx(office: ModuleType, path: Path) -> Path:
    """Workbook with merged titles and lines struck out."""
    book = openpyxl.Workbook()
    book.remove(book.active)
    for name, lines in office.SHEETS.items():
        sheet = book.create_sheet(name)
        fill(sheet, lines)
        if name in office.MERGED:
            sheet.merge_cells(office.MERGED[name])
        for cell in sheet[office.STRUCK[name]] if name in office.STRUCK else ():
            cell.font = Font(strike=True)
    book.save(path)
    return path


def write_folder(office: ModuleType, path: Path) -> Path:
    """Folder of csv files with semicolons."""
    path.mkdir()
    for name, lines in office.SHEETS.items():
        with (path / f"{name}.csv").open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, delimiter=";")
            writer.writerows(["" if one is None else one for one in ln] for ln in lines)
    return path


def write_ods_list(office: ModuleType, path: Path) -> Path:
    """The same as ods, with merged titles and lines struck out."""
    sheets = {
        name: [
            [
                _write_cell(one, is_struck=office.STRUCK.get(name) == number)
                for one in line
            ]
            for number, line in enumerate(lines, start=1)
        ]
        for name, lines in office.SHEETS.items()
    }
    for name, merged in office.MERGED.items():
        columns = len(office.SHEETS[name][1]) if "A1" in merged else 1
        columns = max(map(len, office.SHEETS[name])) if columns < 3 else columns
        title = escape(str(office.SHEETS[name][0][0]))
        sheets[name][0] = [
            f'<table:table-cell office:value-type="string" '
            f'table:number-columns-spanned="{columns}" table:number-rows-spanned="1">'
            f"<text:p>{title}</text:p></table:table-cell>"
        ]
    style = (
        '<style:style style:name="struck" style:family="table-cell">'
        '<style:text-properties style:text-line-through-style="solid"/></style:style>'
    )
    return write_ods(path, sheets, styles=style)


def _write_cell(value: object, *, is_struck: bool) -> object:
    if not is_struck or value is None:
        return value
    cell = write_cell(value)
    return cell.replace(
        "<table:table-cell", '<table:table-cell table:style-name="struck"'
    )
