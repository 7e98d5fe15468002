"""First sheet of the workbook: verdicts, live over the sheet of checks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from netdesign.outcome import Verdict, merge_verdicts
from netdesign.quantities import QUANTITIES
from netdesign.report.blocks import Cell, Column
from netdesign.report.sections.checks import describe_briefly
from netdesign.report.sections.decision import (
    identify,
    list_open_points,
    name_verification,
)
from netdesign.report.sections.whole import title_pages
from netdesign.report.what_if import mark_title
from netdesign.report.words import (
    MISSING,
    UNBOUNDED,
    Words,
    show_check,
    show_text,
)
from netdesign.report.workbook.check_sheet import CHANGED, show_cached, show_load
from netdesign.report.workbook.check_sheet import HEAD_ROW as FIRST_CHECK
from netdesign.report.workbook.formulas import quote, write_merged
from netdesign.report.workbook.writer import Book, count_lines, fit_headings
from netdesign.study.document import compute_digest
from netdesign.study.governing import find_case, find_governing, find_highest
from netdesign.study.records import CheckRecord, RowStudy, Study

_HEAD_ROW = 4  # zero-based
_WIDTHS = (4, 9, 16, 6, 6, 6, 6, 9, 9, 17, 17, 9, 20)
_ALL_WIDE, _LEAST = 163, 20  # characters of a line; of them for the reasons
_LABELLED = 3  # columns of a label below the rows
# Columns D, E, F, G, whose headings stand upright: their words are long.
_COUNTED = (Verdict.FAIL, Verdict.NOT_PROVEN, Verdict.DECLARED, Verdict.PASS)
_COUNTS = range(3, 7)
_RATIO, _GOVERNING, _CASE, _HELD, _REASONS = 7, 9, 10, 11, 12
_STORED = 5  # columns from a live sentence to the study's, which is hidden
_BELOW = 9  # columns of what stands below the rows
# Line, first and last column of each link to a sheet, as wide as its name is long.
_LINKS = tuple(
    (line, *columns)
    for line in (0, 1)
    for columns in ((7, 8), (9, 9), (10, 10), (11, 12))
)


def add_summary_sheet(book: Book, study: Study) -> None:
    """Sheet "Decision": overall verdict, net rows, open points, signatures."""
    mark = book.words("what_if.mark") if study.what_if else ""
    titles = (mark, book.words("heading.anchor_check"))
    sheet = book.add_sheet("decision", " · ".join(one for one in titles if one))
    running = title_pages(study, book.words)
    sheet.write_string(1, 0, running or MISSING, book.text())
    last = _HEAD_ROW + max(len(study.rows), 1)
    _write_overall(book, sheet, study, last)
    widths = _find_widths(book)
    book.write_head(sheet, _HEAD_ROW, _list_columns(book), widths, _COUNTS)
    for index, width in enumerate(widths):
        sheet.set_column(index, index, width)
    hidden = [column + _STORED for column in (_GOVERNING, _CASE, _REASONS)]
    sheet.set_column(min(hidden), max(hidden), None, None, {"hidden": True})
    if not study.rows:
        text = book.words("heading.no_rows")
        sheet.write_string(last, 1, text, book.text())
    first_check = FIRST_CHECK + 2  # line in the sheet of checks, counted from one
    for number, row in enumerate(study.rows, 1):
        _write_row(book, sheet, number, row)
        target = book.refer("checks", f"A{first_check}")
        book.link(sheet, (_HEAD_ROW + number, 1), target, show_text(row.id))
        first_check += len(row.checks)
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
    for (row, first, last), name in zip(_LINKS, names, strict=True):
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
        Column(heading=words("heading.largest_utilisation"), is_number=True),
        Column(heading=words("heading.largest_high_end"), is_number=True),
        Column(heading=words("heading.governing_check")),
        Column(heading=words("heading.its_case")),
        Column(heading=words("heading.held_back")),
        Column(heading=words("heading.reasons")),
    )


def _write_overall(book: Book, sheet: Any, study: Study, last: int) -> None:
    held = study.verdict is not merge_verdicts(row.verdict for row in study.rows)
    rows = f"C{_HEAD_ROW + 2}:C{last + 1}"
    form = book.text(bold=True, font_size=12)
    word = book.word(study.verdict)
    label = mark_title(study, book.words("heading.verdict"), book.words)
    sheet.write_string(2, 0, label, form)
    counts = {v: f'COUNTIF({rows},"{book.word(v)}")' for v in _COUNTED}
    formula = write_merged(
        counts,
        total=len(study.rows),
        held=f'"{word if held else MISSING}"',
        words=book.verdicts,
    )
    small = book.text(bold=True, font_size=12, shrink=True)
    sheet.write_formula(2, 2, formula, small, word)
    meaning = f'"{book.verdicts[Verdict.NOT_PROVEN].meaning}"'
    for one in (Verdict.DECLARED, Verdict.FAIL, Verdict.PASS):
        shown = book.verdicts[one]
        meaning = f'IF(C3="{shown.word}","{shown.meaning}",{meaning})'
    told = book.verdicts[study.verdict].meaning
    sheet.write_formula(2, 3, f"={meaning}", book.text(), told)
    names = {
        "overall_verdict": "$C$3",
        "row_verdicts": f"$C${_HEAD_ROW + 2}:$C${last + 1}",
    }
    for name, area in names.items():
        book.workbook.define_name(name, f"={book.refer('decision', area)}")


def _write_row(book: Book, sheet: Any, number: int, row: RowStudy) -> None:
    index = _HEAD_ROW + number
    line = index + 1
    verdicts = [check.verdict for check in row.checks]
    sheet.write_number(index, 0, number, book.format(align="right"))
    formula = write_merged(
        {v: f"{column}{line}" for v, column in zip(_COUNTED, "DEFG", strict=True)},
        total=len(row.checks),
        held=f"{chr(ord('A') + _HELD)}{line}",
        words=book.verdicts,
    )
    bold = book.text(bold=True, text_wrap=True)
    sheet.write_formula(index, 2, formula, bold, book.word(row.verdict))
    for column, verdict in enumerate(_COUNTED, 3):
        count = (
            f"=COUNTIFS(check_net_row_number,A{line},"
            f'check_verdict,"{book.word(verdict)}")'
        )
        form = book.format(align="right")
        sheet.write_formula(index, column, count, form, verdicts.count(verdict))
    _write_largest(book, sheet, index, row)
    _write_words(book, sheet, index, row)


def _write_words(book: Book, sheet: Any, index: int, row: RowStudy) -> None:
    """Governing check, its case and the reasons, while every check is as it was.

    Afterwards the sheet of checks says which one governs.
    """
    line, words = index + 1, book.words
    check = find_governing(row.checks)
    held = row.verdict is not merge_verdicts(one.verdict for one in row.checks)
    verdict = book.word(row.verdict)
    cell = Cell(text=verdict if held else MISSING)
    book.write_cell(sheet, (index, _HELD), Column(heading=""), cell)
    texts = {
        _GOVERNING: show_check(words, check) if check else words("heading.no_check"),
        _CASE: _describe_case(check, words),
        _REASONS: describe_briefly(row, words) or MISSING,
    }
    mine = f"check_net_row_number,A{line}"
    unchanged = f"COUNTIFS({mine},check_unchanged,1)=COUNTIFS({mine})"
    form = book.text(text_wrap=True)
    for column, text in texts.items():
        stored = (index, column + _STORED)
        book.write_cell(sheet, stored, Column(heading=""), Cell(text=text))
        then = f"{chr(ord('A') + stored[1])}{line}"
        now = quote(words(CHANGED) if column == _REASONS else MISSING)
        formula = f"=IF(AND(C{line}={quote(verdict)},{unchanged}),{then},{now})"
        sheet.write_formula(index, column, formula, form, text)
    fields = {1: show_text(row.id), 2: verdict, **texts}
    widths = _find_widths(book)
    lines = count_lines(list(fields.values()), [widths[k] for k in fields])
    book.set_height(sheet, index, lines)


def _describe_case(check: CheckRecord | None, words: Words) -> str:
    """Case that brings the governing demand, or the guideline's load case."""
    if check is None:
        return MISSING
    case = find_case(check)
    return show_load(check, words) if case is None else words.name_case(case)


def _write_largest(book: Book, sheet: Any, index: int, row: RowStudy) -> None:
    highest = find_highest(row.checks)
    known = [check.used_band[1] for check in row.checks]
    ends = [end for end in known if end is not None]
    cached = (highest.used if highest else None, max(ends, default=None))
    shown = QUANTITIES["utilisation"].number_format
    form = book.format(align="right", num_format=shown)
    for column, (name, value) in enumerate(
        zip(("check_utilisation", "check_utilisation_high"), cached, strict=True),
        _RATIO,
    ):
        mine = f"check_net_row_number,A{index + 1}"
        formula = (
            f'=IF(COUNTIFS({mine},{name},"{UNBOUNDED}")>0,"{UNBOUNDED}",'
            f'IF(COUNTIFS({mine},{name},">=0")>0,'
            f'_xlfn.MAXIFS({name},{mine}),"{MISSING}"))'
        )
        sheet.write_formula(index, column, formula, form, show_cached(value))


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
