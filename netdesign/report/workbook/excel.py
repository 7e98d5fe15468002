"""Study -> workbook: the page's tables as numbers, steps of checks as formulas."""

from __future__ import annotations

import io
from collections.abc import Iterator
from dataclasses import replace

from netdesign.outcome import NetDesignError
from netdesign.report.blocks import Column, Table, text_cell
from netdesign.report.sections.annexes import build_provenance
from netdesign.report.sections.basis import (
    build_inputs,
    build_profile,
    list_defaults,
    list_notes,
    list_reading,
    share_notes,
    show_ranges,
)
from netdesign.report.sections.checks import list_changes
from netdesign.report.sections.quality import (
    build_cases,
    build_extremes,
    stack_rows,
    stack_tables,
)
from netdesign.report.sections.reliability import (
    list_records,
    tabulate_indices,
    tabulate_shares,
    tabulate_variables,
)
from netdesign.report.sections.schedule import build_quantities, build_schedule
from netdesign.report.sections.whole import list_properties
from netdesign.report.what_if import build_what_if
from netdesign.report.words import Words, show_text
from netdesign.report.workbook.check_sheet import add_check_sheet
from netdesign.report.workbook.summary_sheet import add_summary_sheet, link_sheets
from netdesign.report.workbook.writer import DEFAULT_FONT, Book
from netdesign.study.records import Study
from netdesign.words.catalogue import Language

_FIRST_LINE = 4  # of a table below its caption and headings, zero-based
_BETWEEN = 3  # lines from one table of a sheet to the next
SHEETS = (
    "decision",
    "schedule",
    "inputs",
    "checks",
    "profile",
    "cases",
    "notes",
    "provenance",
)
_RELIABILITY = "reliability"  # a sheet more, where somebody asks for it
_SHARE = 2  # column of the shares, zero-based


def render_workbook(
    study: Study, language: Language = "en", *, is_verified: bool = False
) -> bytes:
    """Workbook of a study; the same study gives the same bytes.

    Parameters
    ----------
    study : Study
        What is shown.
    language : str
        ``en``, ``fr`` or ``de``.
    is_verified : bool
        The stored study was solved again in this run.
    """
    import xlsxwriter

    words = Words(language)
    buffer = io.BytesIO()
    options = {
        "in_memory": True,
        "strings_to_formulas": False,
        "strings_to_urls": False,
        "strings_to_numbers": False,
        "default_format_properties": dict(DEFAULT_FONT),  # it is altered there
    }
    with xlsxwriter.Workbook(buffer, options) as workbook:
        properties = list_properties(study, words)
        workbook.set_properties(properties)
        workbook.set_size(2400, 1400)
        workbook.set_calc_mode("auto")
        book = Book(workbook, properties["subject"], words)
        _add_sheets(book, study, is_verified=is_verified)
        names = tuple(sheet.get_name() for sheet in workbook.worksheets())
        further = (_RELIABILITY,) if list_records(study) else ()
        if names != tuple(book.name(sheet) for sheet in (*SHEETS, *further)):
            raise NetDesignError(f"the workbook is incomplete: it has only {names}")
    return buffer.getvalue()


def _add_sheets(book: Book, study: Study, *, is_verified: bool) -> None:
    words = book.words
    above = build_what_if(study, words) if study.what_if else None
    parts = list_inputs(study, words)
    add_summary_sheet(book, study, is_verified=is_verified)
    _add_schedule(book, study)
    stacked = stack_tables(words("heading.typed_and_understood"), parts, words)
    book.add_table_sheet(
        "inputs", words("heading.inputs"), [*([above] if above else []), stacked]
    )
    add_check_sheet(book, study)
    profile = build_profile(study, words)
    book.add_table_sheet("profile", words("heading.limit_profile"), [profile])
    _add_cases(book, study)
    book.add_table_sheet(
        "notes", words("heading.notes"), list(_list_notes(book, study))
    )
    made = [build_provenance(study, words)]
    book.add_table_sheet("provenance", words("heading.provenance"), made)
    if list_records(study):
        _add_reliability(book, study)
    link_sheets(book, SHEETS[1:])


def _add_schedule(book: Book, study: Study) -> None:
    """Sheet of what is built and what is ordered, with room for prices."""
    from xlsxwriter.utility import xl_rowcol_to_cell

    words = book.words
    built = build_schedule(study, words)
    ordered = build_quantities(study, words, has_prices=True)
    title = words("heading.schedule")
    sheet = book.add_table_sheet("schedule", title, [built, ordered])
    first = _FIRST_LINE + len(built.rows) + _BETWEEN
    number, total, price = (len(ordered.columns) - one for one in (6, 4, 3))
    for line, cells in enumerate(ordered.rows, first):
        by_piece = cells[number].number is not None
        counted = xl_rowcol_to_cell(line, number if by_piece else total)
        paid = xl_rowcol_to_cell(line, price)
        formula = f'=IF(COUNT({paid},{counted})<2,"",{counted}*{paid})'
        sheet.write_formula(line, price + 1, formula, None, "")


def list_inputs(study: Study, words: Words) -> list[tuple[str, Table]]:
    """Inputs cell by cell: of the ranges, then of each net row."""
    caption = words("heading.inputs_with_cells")
    rows = [(row.id, build_inputs(row.inputs, caption, words)) for row in study.rows]
    return [(words("heading.ranges"), show_ranges(study, words)), *rows]


def _add_cases(book: Book, study: Study) -> None:
    """Sheet of all cases, and of the largest force of each member."""
    words = book.words
    shown = [
        stack_rows(words("caption.cases"), study, build_cases, words),
        stack_rows(words("caption.extremes"), study, build_extremes, words),
    ]
    book.add_table_sheet("cases", words("heading.all_cases"), shown)


def _add_reliability(book: Book, study: Study) -> None:
    """Sheet of the notional reliability, with bars behind its shares."""
    words = book.words
    indices, shares = tabulate_indices(study, words), tabulate_shares(study, words)
    note = words("reliability.is_not")
    told = words("reliability.captioned", caption=indices.caption, note=note)
    tables = [replace(indices, caption=told), shares, tabulate_variables(study, words)]
    sheet = book.add_table_sheet(_RELIABILITY, words("heading.reliability"), tables)
    first = _FIRST_LINE + len(indices.rows) + _BETWEEN
    if shares.rows:
        last = first + len(shares.rows) - 1
        book.add_ratio_bars(sheet, (first, _SHARE, last, _SHARE), full=1.0)


def _list_notes(book: Book, study: Study) -> Iterator[Table]:
    """Notes, default values, what would turn each check, and how to read a row."""
    words = book.words
    notes, shared = list_notes(study, words), share_notes(study, words)
    notes += [
        words("show.label", label=show_text(row.id), text=text)
        for row in study.rows
        for text in map(words.show, row.notes)
        if text not in shared
    ]
    checks = [(row.id, check) for row in study.rows for check in row.checks]
    for heading, sentences in (
        ("notes", list(dict.fromkeys(notes))),
        ("not_typed", list_defaults(study, words)),
        ("would_pass_with", list_changes(checks, words)),
        ("reading", list_reading(study, words)),
    ):
        yield Table(
            caption=words(f"heading.{heading}"),
            columns=(Column(heading=words("heading.note")),),
            rows=tuple((text_cell(sentence),) for sentence in sentences),
            empty=words("show.none"),
        )
