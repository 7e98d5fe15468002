"""First sheet of the workbook: verdict, a line for each net row, open points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from netdesign.outcome import Verdict
from netdesign.report.blocks import (
    Cell,
    Column,
    given_cell,
    number_cell,
    number_column,
    text_cell,
)
from netdesign.report.sections.checks import describe_briefly, name_case
from netdesign.report.sections.decision import (
    identify,
    list_open_points,
    name_verification,
)
from netdesign.report.sections.whole import title_pages
from netdesign.report.what_if import mark_title, name_kind
from netdesign.report.words import (
    MISSING,
    show_check,
    show_text,
)
from netdesign.report.workbook.check_sheet import FIRST_LINE, count_block
from netdesign.report.workbook.writer import Book, count_lines, fit_headings
from netdesign.study.document import compute_digest
from netdesign.study.governing import find_governing, find_highest
from netdesign.study.records import RowStudy, Study

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


def _write_row(book: Book, sheet: Any, number: int, row: RowStudy) -> None:
    words, columns = book.words, _list_columns(book)
    verdicts = [check.verdict for check in row.checks]
    highest = find_highest(row.checks)
    ends = [check.used_band[1] for check in row.checks]
    known = [end for end in ends if end is not None]
    check = find_governing(row.checks)
    cells = (
        given_cell(words, number),
        text_cell(row.id),
        Cell(text=book.word(row.verdict)),
        *(given_cell(words, verdicts.count(verdict)) for verdict in _COUNTED),
        number_cell(words, "utilisation", highest.used if highest else None),
        number_cell(words, "utilisation", max(known, default=None)),
        text_cell(show_check(words, check) if check else words("heading.no_check")),
        text_cell(name_case(check, words) if check else MISSING),
        text_cell(describe_briefly(row, words)),
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
