"""Writes an office's list as it sends it: xlsx, or a folder of csv files."""

from __future__ import annotations

import csv
from typing import TYPE_CHECKING

import openpyxl
from openpyxl.styles import Font

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
