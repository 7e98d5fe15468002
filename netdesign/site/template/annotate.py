"""Gives a site workbook back with its findings: cells coloured and commented.

Text boxes, macros and whatever else stands beside the cells are not in the copy.
Formulas are calculated again when it is opened.
"""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from netdesign.edge.input_files import make_printable
from netdesign.site.cells.cells import DAMAGE, UNDECLARED, Sheet, TextFormat
from netdesign.site.cells.findings import Finding, refuse_file
from netdesign.site.cells.xlsx import open_for_editing
from netdesign.site.reader import read_cells
from netdesign.words.catalogue import Language, render
from netdesign.words.message import say

if TYPE_CHECKING:  # slow to import and only needed to write a workbook
    from openpyxl import Workbook as OpenWorkbook

_AUTHOR = "netdesign"
_COLOURS = {"error": "FFF4B8A8", "question": "FFFCD5A0", "note": "FFFFF2CC"}
_WORKBOOK_SUFFIXES = (".xlsx", ".xlsm")
_COMMENT_SIZE = (320, 130)  # [px]


def annotate_workbook(
    path: Path,
    findings: Sequence[Finding],
    text_format: TextFormat = UNDECLARED,
    language: Language = "en",
) -> bytes:
    """Xlsx bytes of the same workbook, with every finding at its cell.

    Parameters
    ----------
    path : Path
        The file that was read; csv files become sheets of an xlsx workbook.
    findings : sequence of Finding
        As the importer gave them.
    text_format : TextFormat
        As for reading.
    language : str
        Of the comments.

    Raises
    ------
    SiteDataError
        If the file cannot be read at all, so that there is nothing to give back.
    """
    import openpyxl

    cells = read_cells(path, text_format)  # refuses what cannot be read at all
    if path.suffix.casefold() in _WORKBOOK_SUFFIXES:
        workbook = _open(path)
        _remove_old_marks(workbook)
    else:
        workbook = openpyxl.Workbook()
        for sheet in cells.sheets:
            _copy_sheet(workbook, sheet)
        if cells.sheets:
            workbook.remove(workbook.worksheets[0])
    for finding in findings:
        if finding.cell and finding.sheet in workbook.sheetnames:
            cell = _find_shown(workbook[finding.sheet], finding.cell)
            _mark_cell(cell, finding, language)
    content = BytesIO()
    workbook.save(content)
    return content.getvalue()


def _find_shown(sheet: Any, address: str) -> Any:
    """Cell at an address; of merged cells the first, which alone is shown."""
    for merged in sheet.merged_cells.ranges:
        if address in merged:
            return sheet.cell(merged.min_row, merged.min_col)
    return sheet[address]


def _open(path: Path) -> OpenWorkbook:
    try:
        return open_for_editing(path)
    except DAMAGE as error:  # in a part that reading the site does not look at
        rule = say("book.not_copied")
        raise refuse_file(path.name, rule, say("book.copy_without")) from error


def _copy_sheet(workbook: OpenWorkbook, sheet: Sheet) -> None:
    copy = workbook.create_sheet(sheet.name)
    for cell in sheet.cells:
        _write(copy.cell(cell.row, cell.column), cell.value)


def _write(cell: Any, value: object) -> None:
    if isinstance(value, str):
        value = make_printable(value)  # workbooks cannot hold control characters
    cell.value = value
    if isinstance(value, str):
        cell.data_type = "s"  # text that begins with "=" is no formula of ours


def _remove_old_marks(workbook: OpenWorkbook) -> None:
    """Remove the marks of an earlier copy, so that no corrected cell stays marked."""
    from openpyxl.styles import PatternFill

    for sheet in workbook.worksheets:
        for row in sheet.iter_rows():
            for cell in row:
                if cell.comment is not None and cell.comment.author == _AUTHOR:
                    cell.comment = None
                    cell.fill = PatternFill()


def _mark_cell(cell: Any, finding: Finding, language: Language) -> None:
    from openpyxl.comments import Comment
    from openpyxl.styles import PatternFill

    severity = say(f"finding.{finding.severity}")
    lines = [say("annotated.mark", severity=severity, rule=finding.rule)]
    if finding.accepted:
        lines.append(say("annotated.mark_accepted", accepted=finding.accepted))
    text = make_printable("\n".join(render(line, language) for line in lines))
    if cell.comment is not None:
        text = f"{cell.comment.text}\n{text}"
    width, height = _COMMENT_SIZE
    cell.comment = Comment(text, _AUTHOR, width=width, height=height)
    cell.fill = PatternFill("solid", start_color=_COLOURS[finding.severity])
