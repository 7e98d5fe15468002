"""Study -> workbook: the page's tables as numbers, steps of checks as formulas.

The first sheet has the verdict, a line for each net row and the open points.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from typing import Any

from netdesign.outcome import NetDesignError, Verdict
from netdesign.report.blocks import (
    Cell,
    Column,
    Table,
    given_cell,
    number_cell,
    number_column,
    text_cell,
)
from netdesign.report.sections.additions import list_additions
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
from netdesign.report.sections.checks import describe_briefly, list_changes, name_case
from netdesign.report.sections.decision import identify, name_verification
from netdesign.report.sections.open_points import list_open_points
from netdesign.report.sections.quality import (
    build_bounds,
    build_cases,
    stack_rows,
    stack_tables,
)
from netdesign.report.sections.scopes import describe_scopes, describe_study_scopes
from netdesign.report.sections.whole import list_properties, title_pages
from netdesign.report.what_if import build_what_if, mark_title, name_kind
from netdesign.report.words import (
    MISSING,
    Words,
    show_check,
    show_text,
)
from netdesign.report.workbook.check_sheet import (
    FIRST_LINE,
    add_check_sheet,
    count_block,
)
from netdesign.report.workbook.quantities import build_quantities, build_schedule
from netdesign.report.workbook.writer import (
    BETWEEN_TABLES,
    DEFAULT_FONT,
    TABLE_TOP,
    Book,
    count_lines,
    fit_headings,
)
from netdesign.study.document import compute_digest
from netdesign.study.governing import find_governing, find_highest
from netdesign.study.records import RowStudy, Study
from netdesign.words.catalogue import Language

_HEAD_ROW = 4  # zero-based
_WIDTHS = (4, 9, 16, 6, 6, 6, 6, 9, 9, 17, 17, 20)
_ALL_WIDE, _LEAST = 163, 20  # characters of a line; of them for the reasons
_LABELLED = 3  # columns of a label below the rows
# Columns D, E, F, G, whose headings stand upright: their words are long.
_COUNTED = (Verdict.FAIL, Verdict.NOT_PROVEN, Verdict.DECLARED, Verdict.PASS)
_COUNTS = range(3, 7)
_RATIO, _REASONS = 7, 11
_BELOW = 9  # columns of what stands below the rows
# Line, first and last column of each link to a sheet, as wide as its name is long.
_LINKS = tuple(
    (line, *columns)
    for line in (0, 1)
    for columns in ((7, 8), (9, 9), (10, 10), (11, 11))
)


def add_summary_sheet(book: Book, study: Study, *, is_verified: bool) -> None:
    """Sheet "Decision": overall verdict, net rows, open points, signatures."""
    mark = book.words("what_if.mark") if study.what_if else ""
    titles = (mark, name_kind(study, book.words, is_verified=is_verified))
    sheet = book.add_sheet("decision", " · ".join(one for one in titles if one))
    running = title_pages(study, book.words)
    sheet.write_string(1, 0, running or MISSING, book.text())
    last = _HEAD_ROW + max(len(study.rows), 1)
    _write_overall(book, sheet, study)
    widths = _find_widths(book)
    book.write_head(sheet, _HEAD_ROW, _list_columns(book), widths, _COUNTS)
    for index, width in enumerate(widths):
        sheet.set_column(index, index, width)
    if not study.rows:
        text = book.words("heading.no_rows")
        sheet.write_string(last, 1, text, book.text())
    first_check = FIRST_LINE
    for number, row in enumerate(study.rows, 1):
        _write_row(book, sheet, number, row)
        target = book.refer("checks", f"A{first_check + 1}")
        book.link(sheet, (_HEAD_ROW + number, 1), target, show_text(row.id))
        first_check += sum(count_block(check) for check in row.checks)
    book.colour_verdicts(sheet, (2, 2, last, 2))
    book.add_ratio_bars(sheet, (_HEAD_ROW + 1, _RATIO, last, _RATIO))
    sheet.autofilter(_HEAD_ROW, 0, last, len(_WIDTHS) - 1)
    sheet.freeze_panes(_HEAD_ROW + 1, 2)
    sheet.repeat_rows(_HEAD_ROW)
    _write_below(book, sheet, study, last + 2)


def _find_widths(book: Book) -> list[float]:
    """Width of each column; the reasons have what the others leave."""
    widths = fit_headings(_list_columns(book), _WIDTHS, _COUNTS)
    rest = sum(widths[:_REASONS])
    return [*widths[:_REASONS], max(_LEAST, _ALL_WIDE - rest)]


def link_sheets(book: Book, names: Sequence[str]) -> None:
    """Lead from the summary to every other sheet, above its table.

    None stands beside the table: that would make all of it small in print.
    """
    sheet = book.workbook.get_worksheet_by_name(book.name("decision"))
    for (row, first, last), name in zip(_LINKS, names, strict=False):
        if last > first:
            sheet.merge_range(row, first, row, last, "")
        book.link(sheet, (row, first), book.refer(name, "A1"), book.name(name))


def _list_columns(book: Book) -> tuple[Column, ...]:
    words = book.words
    return (
        Column(heading=words("heading.no"), is_number=True),
        Column(heading=words("heading.net_row")),
        Column(heading=words("heading.verdict")),
        *(Column(heading=book.word(v), is_number=True) for v in _COUNTED),
        number_column("utilisation", words("heading.largest_utilisation")),
        number_column("utilisation", words("heading.largest_high_end")),
        Column(heading=words("heading.governing_check")),
        Column(heading=words("heading.its_case")),
        Column(heading=words("heading.reasons")),
    )


def _write_overall(book: Book, sheet: Any, study: Study) -> None:
    form = book.text(bold=True, font_size=12)
    label = mark_title(study, book.words("heading.verdict"), book.words)
    sheet.write_string(2, 0, label, form)
    shown = book.verdicts[study.verdict]
    small = book.text(bold=True, font_size=12, shrink=True)
    sheet.write_string(2, 2, shown.word, small)
    sheet.write_string(2, 3, shown.meaning, book.text())
    if study.rows:
        scopes = describe_study_scopes(study, book.words)
        sheet.write_string(3, 0, scopes, book.text())


def _write_row(book: Book, sheet: Any, number: int, row: RowStudy) -> None:
    words, columns = book.words, _list_columns(book)
    verdicts = [check.verdict for check in row.checks]
    highest = find_highest(row.checks)
    ends = [check.used_band[1] for check in row.checks]
    known = [end for end in ends if end is not None]
    check = find_governing(row.checks)
    told = (describe_scopes(row, words), describe_briefly(row, words))
    cells = (
        given_cell(words, number),
        text_cell(row.id),
        Cell(text=book.word(row.verdict)),
        *(given_cell(words, verdicts.count(verdict)) for verdict in _COUNTED),
        number_cell(words, "utilisation", highest.used if highest else None),
        number_cell(words, "utilisation", max(known, default=None)),
        text_cell(show_check(words, check) if check else words("heading.no_check")),
        text_cell(name_case(check, words) if check else MISSING),
        text_cell(words.join(filter(None, told))),
    )
    line = _HEAD_ROW + number
    for place, (column, cell) in enumerate(zip(columns, cells, strict=True)):
        book.write_cell(sheet, (line, place), column, cell)
    texts, widths = [cell.text for cell in cells], _find_widths(book)
    book.set_height(sheet, line, count_lines(texts, widths))


def _write_below(book: Book, sheet: Any, study: Study, top: int) -> None:
    """Open points, identification, room for signatures, under the rows."""
    head = book.text(bold=True, bottom=1)
    wrapped, room = book.text(text_wrap=True), sum(_WIDTHS[_LABELLED:_BELOW])
    words, project = book.words, study.project
    signed = (
        ("heading.prepared", project.author),
        ("heading.checked", project.checker),
        ("heading.approved", ""),
    )
    points = list(list_open_points(study, words)) or [words("todo.none")]
    verify = (words("heading.verify_report"), name_verification(study))
    digest = (words("heading.study_hash"), compute_digest(study))
    blocks: list[tuple[str, Sequence[tuple[str, str]]]] = [
        ("heading.todo", [(str(k), one) for k, one in enumerate(points, 1)]),
        ("heading.identification", [*identify(study, words), verify, digest]),
        (
            "heading.signatures",
            [(words(label), show_text(x) if x.strip() else "") for label, x in signed],
        ),
    ]
    for title, pairs in blocks:
        for column in range(_BELOW):
            shown = "" if column else book.words(title)
            sheet.write_string(top, column, shown, head)
        for label, value in pairs:
            top += 1
            sheet.merge_range(top, 0, top, _LABELLED - 1, "", wrapped)
            sheet.write_string(top, 0, label, wrapped)
            sheet.merge_range(top, _LABELLED, top, _BELOW - 1, "", wrapped)
            sheet.write_string(top, _LABELLED, value, wrapped)
            lines = count_lines([label, value], [sum(_WIDTHS[:_LABELLED]), room])
            book.set_height(sheet, top, lines)
        top += 2


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
        further = [one.sheet for one in list_additions(study)]
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
    for one in list_additions(study):
        one.add_sheet(book, study)
    link_sheets(book, SHEETS[1:])


def _add_schedule(book: Book, study: Study) -> None:
    """Sheet of what is built and what is ordered, with room for prices."""
    from xlsxwriter.utility import xl_rowcol_to_cell

    words = book.words
    built = build_schedule(study, words)
    ordered = build_quantities(study, words, has_prices=True)
    title = words("heading.schedule")
    sheet = book.add_table_sheet("schedule", title, [built, ordered])
    first = TABLE_TOP + len(built.rows) + BETWEEN_TABLES
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
        stack_rows(words("caption.bounds"), study, build_bounds, words),
    ]
    book.add_table_sheet("cases", words("heading.all_cases"), shown)


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
