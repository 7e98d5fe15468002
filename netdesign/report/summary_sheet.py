"""First sheet of the workbook: verdicts, live over the sheet of checks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from netdesign.outcome import Verdict, merge_verdicts
from netdesign.report.check_sheet import HEAD_ROW as FIRST_CHECK
from netdesign.report.check_view import find_highest, find_utilisation_band
from netdesign.report.table import Cell, Column
from netdesign.report.view import ReportView, RowView
from netdesign.report.words import (
    MISSING,
    name_heading,
    number_format,
)
from netdesign.report.workbook import Book, count_lines
from netdesign.report.workbook_charts import add_utilisation_chart
from netdesign.study import RowStudy, Study

_HEAD_ROW = 4  # zero-based
_WIDTHS = (4, 14, 18, 10, 12, 9, 13, 11, 8, 21, 23, 12, 32)
_COUNTED = (Verdict.FAIL, Verdict.NOT_PROVEN, Verdict.PASS)  # columns D, E, F
_RATIO, _LIMIT, _FIRST_TEXT, _HELD = 6, 8, 9, "L"


def add_summary_sheet(book: Book, study: Study, view: ReportView) -> None:
    """Sheet "Summary": overall verdict, net rows, assumed values, signatures."""
    sheet = book.add_sheet("Summary", "Anchor check of snow nets")
    sheet.write_string(1, 0, view.running_title or MISSING, book.text())
    last = _HEAD_ROW + max(len(study.rows), 1)
    _write_overall(book, sheet, study, last)
    columns = [
        Column(heading=book.words(one.heading), is_number=one.is_number)
        for one in _list_columns(book)
    ]
    book.write_head(sheet, _HEAD_ROW, columns, _WIDTHS)
    for index, width in enumerate(_WIDTHS):
        sheet.set_column(index, index, width)
    if not study.rows:
        text = book.words("none: the site has no net rows")
        sheet.write_string(last, 1, text, book.text())
    first_check = FIRST_CHECK + 2  # line in the sheet of checks, counted from one
    for number, (row, shown) in enumerate(zip(study.rows, view.rows, strict=True), 1):
        _write_row(book, sheet, number, row, shown)
        target = book.refer("Checks", f"A{first_check}")
        book.link(sheet, (_HEAD_ROW + number, 1), target, shown.id)
        first_check += len(row.checks)
    book.colour_verdicts(sheet, (2, 2, last, 2))
    book.add_ratio_bars(sheet, (_HEAD_ROW + 1, _RATIO, last, _RATIO))
    sheet.autofilter(_HEAD_ROW, 0, last, len(_WIDTHS) - 1)
    sheet.freeze_panes(_HEAD_ROW + 1, 2)
    sheet.repeat_rows(_HEAD_ROW)
    add_utilisation_chart(book, sheet, (_HEAD_ROW + 1, last), (last + 2, _LIMIT + 1))
    _write_below(book, sheet, view, last + 2)


def link_sheets(book: Book, names: Sequence[str]) -> None:
    """Lead from the summary to every other sheet, in the line above its table."""
    sheet = book.workbook.get_worksheet_by_name(book.name("Summary"))
    for column, name in enumerate(names, 1):
        target = book.refer(name, "A1")
        book.link(sheet, (_HEAD_ROW - 1, column), target, book.name(name))


def _list_columns(book: Book) -> tuple[Column, ...]:
    ratio = name_heading("utilisation")
    return (
        Column(heading="No.", is_number=True),
        Column(heading="Net row"),
        Column(heading="Verdict"),
        *(Column(heading=book.word(v), is_number=True) for v in _COUNTED),
        Column(heading=f"Largest {ratio.lower()}", is_number=True),
        Column(heading="Largest high end", is_number=True),
        Column(heading="Limit", is_number=True),
        Column(heading="Governing check, as studied"),
        Column(heading="Its case"),
        Column(heading="Held back by study"),
        Column(heading="Reasons"),
    )


def _write_overall(book: Book, sheet: Any, study: Study, last: int) -> None:
    parts = [row.verdict for row in study.rows]
    held = study.verdict is not merge_verdicts(parts)
    rows = f"C{_HEAD_ROW + 2}:C{last + 1}"
    form = book.text(bold=True, font_size=12)
    word = book.word(study.verdict)
    sheet.write_string(2, 0, book.words("Verdict"), form)
    counts = [f'COUNTIF({rows},"{book.word(verdict)}")' for verdict in _COUNTED]
    formula = _merge_formula(book, counts, f'"{word if held else MISSING}"')
    sheet.write_formula(2, 2, formula, form, word)
    sheet.write_string(2, 3, book.verdicts[study.verdict].meaning, book.text())
    names = {
        "overall_verdict": "$C$3",
        "row_verdicts": f"$C${_HEAD_ROW + 2}:$C${last + 1}",
    }
    for name, area in names.items():
        book.workbook.define_name(name, f"={book.refer('Summary', area)}")


def _merge_formula(book: Book, counts: Sequence[str], held: str) -> str:
    """Write ``outcome.merge_verdicts`` as a formula; ``held`` keeps a pass back."""
    fails, gaps, passes = counts
    fail, unproven, met = map(book.word, _COUNTED)
    return (
        f'=IF({fails}>0,"{fail}",IF({held}<>"{MISSING}",{held},'
        f'IF(OR({gaps}>0,{passes}=0),"{unproven}","{met}")))'
    )


def _write_row(
    book: Book, sheet: Any, number: int, row: RowStudy, shown: RowView
) -> None:
    index = _HEAD_ROW + number
    line = index + 1
    verdicts = [check.verdict for check in row.checks]
    held = row.verdict is not merge_verdicts(verdicts)
    sheet.write_number(index, 0, number, book.format(align="right"))
    counts = [f"{column}{line}" for column in "DEF"]
    formula = _merge_formula(book, counts, f"{_HELD}{line}")
    sheet.write_formula(index, 2, formula, book.text(bold=True), shown.verdict.word)
    for column, verdict in enumerate(_COUNTED, 3):
        count = (
            f"=COUNTIFS(check_net_row_number,A{line},"
            f'check_verdict,"{book.word(verdict)}")'
        )
        form = book.format(align="right")
        sheet.write_formula(index, column, count, form, verdicts.count(verdict))
    _write_largest(book, sheet, index, row)
    sheet.write_number(index, _LIMIT, 1, book.format(align="right"))
    none = book.words("none: no check was made")
    texts = (
        shown.governing.title if shown.governing else none,
        shown.governing.case if shown.governing else MISSING,
        shown.verdict.word if held else MISSING,
        _explain(shown),
    )
    for column, text in enumerate(texts, _FIRST_TEXT):
        cell = Cell(text=text)
        book.write_cell(sheet, (index, column), Column(heading=""), cell)
    lines = count_lines((shown.id, *texts), (_WIDTHS[1], *_WIDTHS[_FIRST_TEXT:]))
    book.set_height(sheet, index, lines)


def _write_largest(book: Book, sheet: Any, index: int, row: RowStudy) -> None:
    highest = find_highest(row.checks)
    known = [find_utilisation_band(check)[1] for check in row.checks]
    ends = [end for end in known if end is not None]
    cached = (highest.utilisation if highest else None, max(ends, default=None))
    form = book.format(align="right", num_format=number_format("utilisation"))
    for column, (name, value) in enumerate(
        zip(("check_utilisation", "check_utilisation_high"), cached, strict=True),
        _RATIO,
    ):
        mine = f"check_net_row_number,A{index + 1}"
        formula = (
            f'=IF(COUNTIFS({mine},{name},">=0")>0,'
            f'_xlfn.MAXIFS({name},{mine}),"{MISSING}")'
        )
        sheet.write_formula(
            index, column, formula, form, MISSING if value is None else value
        )


def _explain(shown: RowView) -> str:
    reasons = list(shown.reasons)
    if shown.governing and not reasons:
        reasons.append(shown.governing.reason)
    return " ".join(reasons) or MISSING


def _write_below(book: Book, sheet: Any, view: ReportView, top: int) -> None:
    """Identification, room for signatures, assumed values, under the rows."""
    head, text = book.text(bold=True, bottom=1), book.text()
    wrapped, room = book.text(text_wrap=True), sum(_WIDTHS[2:_LIMIT])
    signed = (("Prepared", view.prepared), ("Checked", view.checked), ("Approved", ""))
    blocks: list[tuple[str, Sequence[tuple[str, str]]]] = [
        ("Identification and sign-off", view.identification),
        ("Signatures", [(book.words(label), name) for label, name in signed]),
        ("Assumed: confirm in your copy of the standard", _list_assumed(book, view)),
    ]
    for title, pairs in blocks:
        for column in range(_LIMIT):
            shown = "" if column else book.words(title)
            sheet.write_string(top, column, shown, head)
        for label, value in pairs:
            top += 1
            sheet.write_string(top, 0, label, text)
            sheet.merge_range(top, 2, top, _LIMIT - 1, "", wrapped)
            sheet.write_string(top, 2, value, wrapped)
            book.set_height(sheet, top, count_lines([value], [room]))
        top += 2


def _list_assumed(book: Book, view: ReportView) -> Sequence[tuple[str, str]]:
    return [
        (
            f"{book.words('Clause')} {clause.text}",
            f"{what.text.rstrip('.')}: {value.text} {unit.text}".rstrip(" -"),
        )
        for clause, what, value, unit, *_ in view.assumed.rows
    ] or [(book.words("none"), "")]
