"""Study -> workbook: the page's tables as numbers, the checks as live formulas."""

from __future__ import annotations

import io
from collections.abc import Sequence
from datetime import UTC, datetime

from netdesign.errors import NetDesignError
from netdesign.report.blocks.table import Cell, Column, Table
from netdesign.report.view import tables
from netdesign.report.view.hold_tables import build_hold_numbers
from netdesign.report.view.whole import ReportView, build_view
from netdesign.report.words import Words
from netdesign.report.workbook.calculation_sheet import (
    Calculations,
    add_calculation_sheet,
)
from netdesign.report.workbook.charts import add_case_chart, add_force_chart
from netdesign.report.workbook.check_sheet import add_check_sheet
from netdesign.report.workbook.given_cells import GivenCells
from netdesign.report.workbook.summary_sheet import add_summary_sheet, link_sheets
from netdesign.report.workbook.writer import DEFAULT_FONT, Book
from netdesign.study.records import Study
from netdesign.words.catalogue import Language

_FIRST_LINE = 4  # of a table below its caption and headings, zero-based
_NO_TIME = datetime(1980, 1, 1)
SHEETS = (
    "summary",
    "inputs",
    "checks",
    "calculations",
    "actions",
    "statics",
    "floor_statics",
    "resistances",
    "envelope",
    "cases",
    "changes",
    "holds",
    "support",
    "directions",
    "guideline",
    "notes",
    "formulas",
    "quality",
    "assumptions",
    "profile",
    "provenance",
)


def render_workbook(
    study: Study, language: Language = "en", view: ReportView | None = None
) -> bytes:
    """Workbook of a study; the same study gives the same bytes.

    Parameters
    ----------
    study : Study
        What is shown.
    language : str
        ``en``, ``fr`` or ``de``.
    view : ReportView, optional
        Of this study in this language, where it is there already.

    Raises
    ------
    NetDesignError
        If the study contradicts its own numbers.
    """
    import xlsxwriter

    words = Words(language)
    view = view or build_view(study, language)
    buffer = io.BytesIO()
    options = {
        "in_memory": True,
        "strings_to_formulas": False,
        "strings_to_urls": False,
        "strings_to_numbers": False,
        "default_format_properties": dict(DEFAULT_FONT),  # it is altered there
    }
    with xlsxwriter.Workbook(buffer, options) as workbook:
        workbook.set_properties(
            {
                "title": words("heading.anchor_check"),
                "subject": view.running_title,
                "author": view.prepared,
                "created": _read_time(study.provenance.started),
            }
        )
        workbook.set_size(2400, 1400)
        workbook.set_calc_mode("auto")
        book = Book(workbook, view.running_title, words)
        _add_sheets(book, study, view)
        names = tuple(sheet.get_name() for sheet in workbook.worksheets())
        if names != tuple(book.name(sheet) for sheet in SHEETS):
            raise NetDesignError(f"the workbook is incomplete: it has only {names}")
    return buffer.getvalue()


def _add_sheets(book: Book, study: Study, view: ReportView) -> None:
    add_summary_sheet(book, study, view)
    _add_inputs(book, view)
    cells = GivenCells(book, study, view)
    calculations = Calculations(book, study, cells)
    add_check_sheet(book, study, view, cells, calculations)
    add_calculation_sheet(book, view, calculations)
    _add_figures(book, view)
    _add_row_tables(book, study, view)
    title = book.words("heading.reading")
    book.add_table_sheet("notes", title, [_list_sentences(book, title, view.reading)])
    formulas = book.words("heading.formulas")
    book.add_table_sheet("formulas", formulas, [view.formulas, view.figure_tables])
    notes = book.words("heading.notes")
    for name, title, parts in (
        ("quality", "heading.solver_quality", [view.quality, view.outcomes]),
        ("assumptions", "heading.assumptions", [view.assumptions]),
        ("profile", "heading.limit_profile", [view.profile]),
        (
            "provenance",
            "heading.provenance",
            [view.provenance, _list_sentences(book, notes, view.notes)],
        ),
    ):
        book.add_table_sheet(name, book.words(title), parts)
    cells.watch()
    link_sheets(book, SHEETS[1:])
    book.end_pages()


def _add_inputs(book: Book, view: ReportView) -> None:
    inputs = [(book.words("heading.ranges"), view.ranges)]
    inputs += [(row.id, row.inputs) for row in view.rows]
    caption = book.words("heading.typed_and_understood")
    title = book.words("heading.inputs")
    replaced = [view.what_if] if view.mark else []
    shown = [*replaced, _stack(book, caption, inputs)]
    book.add_table_sheet("inputs", title, shown)


def _add_row_tables(book: Book, study: Study, view: ReportView) -> None:
    """Sheets on which the same table of every net row stands."""
    cases = [
        (shown.id, tables.build_cases(row, book.words))
        for row, shown in zip(study.rows, view.rows, strict=True)
    ]
    for name, title, parts in (
        ("envelope", "heading.largest_of_members", _list_parts(view, "extremes")),
        ("cases", "heading.all_cases", cases),
        ("changes", "heading.what_would_flip", _list_parts(view, "changes")),
        ("holds", "heading.single_values", _list_holds(book, study, view)),
        ("support", "heading.forces_on_ground", _list_parts(view, "anchors")),
        ("directions", "heading.directions_of_pulls", _list_parts(view, "pulls")),
        ("guideline", "heading.check_by_guideline", _list_parts(view, "guideline")),
    ):
        caption = parts[0][1].caption if parts else book.words(title)
        stacked = _stack(book, caption, parts)
        shown = [stacked]
        if name == "guideline":
            floors = _list_parts(view, "floor")
            shown.append(_stack(book, book.words("caption.floor"), floors))
            for other in ("slab", "model_form"):
                parts_of_other = _list_parts(view, other)
                words = book.words(f"opinion.{other}")
                shown.append(_stack(book, words, parts_of_other))
        if name == "directions":
            turns = [(row.id, row.figures.turns) for row in view.rows]
            shown.append(_stack(book, book.words("caption.turns"), turns))
        if name == "support":
            shown += _list_panels(book, view)
            ends = [(row.id, row.end_effects) for row in view.rows]
            shown.append(_stack(book, book.words("end_view.caption"), ends))
        sheet = book.add_table_sheet(name, book.words(title), shown)
        bottom = _FIRST_LINE + len(stacked.rows) - 1
        if name == "envelope" and stacked.rows:
            add_force_chart(book, sheet, (_FIRST_LINE, bottom), (0, 1, 2))
        if name == "cases" and stacked.rows:
            add_case_chart(book, sheet, _span(parts), bottom)


def _add_figures(book: Book, view: ReportView) -> None:
    """Sheets of what the figures of the checks follow from, all rows together."""
    for name, tables_of_sheet in (
        ("actions", ("actions", "panel_actions", "widths")),
        ("statics", ("statics", "sideways")),
        ("floor_statics", ("floor_statics",)),
        ("resistances", ("resistances", "tests")),
    ):
        shown = []
        for table in tables_of_sheet:
            parts = [(row.id, getattr(row.figures, table)) for row in view.rows]
            caption = parts[0][1].caption if parts else ""
            shown.append(_stack(book, caption, parts))
        book.add_table_sheet(name, book.words(f"heading.{name}"), shown)


def _list_panels(book: Book, view: ReportView) -> list[Table]:
    """Forces and ropes of the rows that have a panel between their posts."""
    panels = [(row.id, row.panel) for row in view.rows if row.panel]
    if not panels:
        return []
    forces = [(name, panel.forces) for name, panel in panels]
    ropes = [(name, panel.ropes) for name, panel in panels]
    return [_stack(book, parts[0][1].caption, parts) for parts in (forces, ropes)]


def _list_holds(book: Book, study: Study, view: ReportView) -> list[tuple[str, Table]]:
    """Limits of single values of each net row, their ends as numbers."""
    return [
        (shown.id, build_hold_numbers(row, book.words))
        for row, shown in zip(study.rows, view.rows, strict=True)
    ]


def _list_parts(view: ReportView, table: str) -> list[tuple[str, Table]]:
    return [(row.id, getattr(row, table)) for row in view.rows]


def _span(parts: Sequence[tuple[str, Table]]) -> list[tuple[int, int]]:
    """First and last line of each net row in a stacked table."""
    spans, first = [], _FIRST_LINE
    for _, table in parts:
        if table.rows:
            spans.append((first, first + len(table.rows) - 1))
        first += len(table.rows)
    return spans


def _stack(book: Book, caption: str, parts: Sequence[tuple[str, Table]]) -> Table:
    if parts:
        return tables.stack_tables(caption, parts, book.words)
    heading, empty = book.words("heading.net_row"), book.words("show.none")
    columns = (Column(heading=heading),)
    return Table(caption=caption, columns=columns, rows=(), empty=empty)


def _list_sentences(book: Book, caption: str, sentences: Sequence[str]) -> Table:
    return Table(
        caption=caption,
        columns=(Column(heading=book.words("heading.note")),),
        rows=tuple((Cell(text=sentence),) for sentence in sentences),
        empty=book.words("show.none"),
    )


def _read_time(started: str) -> datetime:
    """Start of the study in UTC without a zone, as workbooks store it."""
    if not started:
        return _NO_TIME
    time = datetime.fromisoformat(started)
    return time.astimezone(UTC).replace(tzinfo=None) if time.tzinfo else time
