"""Study -> workbook: the page's tables as numbers, the checks as live formulas."""

from __future__ import annotations

import io
from datetime import UTC, datetime

from netdesign.errors import NetDesignError
from netdesign.report import tables
from netdesign.report.check_sheet import add_check_sheet
from netdesign.report.summary_sheet import add_summary_sheet
from netdesign.report.table import Cell, Column, Table
from netdesign.report.view import ReportView, build_view
from netdesign.report.workbook import Book
from netdesign.study import Study

_NO_TIME = datetime(1980, 1, 1)
SHEETS = (
    "Summary",
    "Inputs",
    "Checks",
    "Envelope",
    "Cases",
    "Changes",
    "Support",
    "Guideline",
    "Quality",
    "Provenance",
)


def render_workbook(study: Study) -> bytes:
    """Workbook of a study; the same study gives the same bytes.

    Raises
    ------
    NetDesignError
        If the study contradicts its own numbers.
    """
    import xlsxwriter

    view = build_view(study)
    buffer = io.BytesIO()
    options = {
        "in_memory": True,
        "strings_to_formulas": False,
        "strings_to_urls": False,
        "strings_to_numbers": False,
    }
    with xlsxwriter.Workbook(buffer, options) as workbook:
        workbook.set_properties(
            {
                "title": "Anchor check of snow nets",
                "subject": view.running_title,
                "author": view.prepared,
                "created": _read_time(study.provenance.started),
            }
        )
        workbook.set_size(2400, 1400)
        workbook.set_calc_mode("auto")
        _add_sheets(Book(workbook, view.running_title), study, view)
        names = tuple(sheet.get_name() for sheet in workbook.worksheets())
        if names != SHEETS:
            raise NetDesignError(f"the workbook is incomplete: it has only {names}")
    return buffer.getvalue()


def _add_sheets(book: Book, study: Study, view: ReportView) -> None:
    add_summary_sheet(book, study, view)
    inputs = [("Ranges", view.ranges)]
    inputs += [(row.id, row.inputs) for row in view.rows]
    book.add_table_sheet(
        "Inputs",
        "Inputs",
        [tables.stack_tables("As typed and as understood, with the cell", inputs)],
    )
    add_check_sheet(book, study)
    extremes = [(row.id, row.extremes) for row in view.rows]
    cases = [(row.id, tables.build_cases(row)) for row in study.rows]
    changes = [(row.id, row.changes) for row in view.rows]
    anchors = [(row.id, row.anchors) for row in view.rows]
    guideline = [(row.id, row.guideline) for row in view.rows]
    for name, title, parts in (
        ("Envelope", "Largest force of each member", extremes),
        ("Cases", "All cases", cases),
        ("Changes", "What would flip the checks", changes),
        ("Support", "Forces on the ground in the drawn case", anchors),
        ("Guideline", "Independent check by the guideline", guideline),
    ):
        caption = parts[0][1].caption if parts else title
        stacked = tables.stack_tables(caption, parts) if parts else _say_none(caption)
        book.add_table_sheet(name, title, [stacked])
    book.add_table_sheet("Quality", "Solver quality", [view.quality, view.outcomes])
    book.add_table_sheet(
        "Provenance",
        "Provenance",
        [view.provenance, view.profile, _list_notes(view)],
    )


def _list_notes(view: ReportView) -> Table:
    return Table(
        caption="Notes of the importer",
        columns=(Column(heading="Note"),),
        rows=tuple((Cell(text=note),) for note in view.notes),
    )


def _say_none(title: str) -> Table:
    return Table(caption=title, columns=(Column(heading="Net row"),), rows=())


def _read_time(started: str) -> datetime:
    """Start of the study in UTC without a zone, as workbooks store it."""
    if not started:
        return _NO_TIME
    time = datetime.fromisoformat(started)
    return time.astimezone(UTC).replace(tzinfo=None) if time.tzinfo else time
