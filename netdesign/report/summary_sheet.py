"""First sheet of the workbook: verdicts, live over the sheet of checks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from netdesign.outcome import Verdict, merge_verdicts
from netdesign.report.check_view import find_highest, find_utilisation_band
from netdesign.report.table import Cell, Column
from netdesign.report.view import ReportView, RowView
from netdesign.report.words import (
    MISSING,
    VERDICTS,
    name_heading,
    number_format,
)
from netdesign.report.workbook import Book, count_lines
from netdesign.study import RowStudy, Study

_HEAD_ROW = 4  # zero-based
_WIDTHS = (4, 18, 13, 6, 9, 6, 10, 10, 21, 22, 10, 34)
_COUNTED = (Verdict.FAIL, Verdict.NOT_PROVEN, Verdict.PASS)  # columns D, E, F


def add_summary_sheet(book: Book, study: Study, view: ReportView) -> None:
    """Sheet "Summary": overall verdict, net rows, assumed values, signatures."""
    sheet = book.add_sheet("Summary", "Anchor check of snow nets")
    sheet.write_string(1, 0, view.running_title or MISSING, book.text())
    last = _HEAD_ROW + max(len(study.rows), 1)
    _write_overall(book, sheet, study, last)
    book.write_head(sheet, _HEAD_ROW, _list_columns(), _WIDTHS)
    for index, width in enumerate(_WIDTHS):
        sheet.set_column(index, index, width)
    if not study.rows:
        sheet.write_string(last, 1, "none: the site has no net rows", book.text())
    for number, (row, shown) in enumerate(zip(study.rows, view.rows, strict=True), 1):
        _write_row(book, sheet, number, row, shown)
    book.colour_verdicts(sheet, (2, 2, last, 2))
    book.add_ratio_bars(sheet, (_HEAD_ROW + 1, 6, last, 6))
    sheet.autofilter(_HEAD_ROW, 0, last, len(_WIDTHS) - 1)
    sheet.freeze_panes(_HEAD_ROW + 1, 2)
    sheet.repeat_rows(_HEAD_ROW)
    _write_below(book, sheet, view, last + 2)


def _list_columns() -> tuple[Column, ...]:
    ratio = name_heading("utilisation")
    return (
        Column(heading="No.", is_number=True),
        Column(heading="Net row"),
        Column(heading="Verdict"),
        *(Column(heading=VERDICTS[v].word, is_number=True) for v in _COUNTED),
        Column(heading=f"Largest {ratio.lower()}", is_number=True),
        Column(heading="Largest high end", is_number=True),
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
    sheet.write_string(2, 0, "Verdict", form)
    formula = _merge_formula(
        f'COUNTIF({rows},"FAIL")',
        f'COUNTIF({rows},"NOT PROVEN")',
        f'COUNTIF({rows},"PASS")',
        f'"{VERDICTS[study.verdict].word if held else MISSING}"',
    )
    sheet.write_formula(2, 2, formula, form, VERDICTS[study.verdict].word)
    sheet.write_string(2, 3, VERDICTS[study.verdict].meaning, book.text())
    book.workbook.define_name("overall_verdict", "=Summary!$C$3")
    book.workbook.define_name(
        "row_verdicts", f"=Summary!$C${_HEAD_ROW + 2}:$C${last + 1}"
    )


def _merge_formula(fails: str, gaps: str, passes: str, held: str) -> str:
    """Write ``outcome.merge_verdicts`` as a formula; ``held`` keeps a pass back."""
    return (
        f'=IF({fails}>0,"FAIL",IF({held}<>"{MISSING}",{held},'
        f'IF(OR({gaps}>0,{passes}=0),"NOT PROVEN","PASS")))'
    )


def _write_row(
    book: Book, sheet: Any, number: int, row: RowStudy, shown: RowView
) -> None:
    index = _HEAD_ROW + number
    line = index + 1
    verdicts = [check.verdict for check in row.checks]
    held = row.verdict is not merge_verdicts(verdicts)
    sheet.write_number(index, 0, number, book.format(align="right"))
    sheet.write_string(index, 1, shown.id, book.text(bold=True, text_wrap=True))
    formula = _merge_formula(f"D{line}", f"E{line}", f"F{line}", f"K{line}")
    sheet.write_formula(index, 2, formula, book.text(bold=True), shown.verdict.word)
    for column, verdict in enumerate(_COUNTED, 3):
        count = (
            f"=COUNTIFS(check_net_row_number,A{line},"
            f'check_verdict,"{VERDICTS[verdict].word}")'
        )
        form = book.format(align="right")
        sheet.write_formula(index, column, count, form, verdicts.count(verdict))
    _write_largest(book, sheet, index, row)
    texts = (
        shown.governing.title if shown.governing else "none: no check was made",
        shown.governing.case if shown.governing else MISSING,
        shown.verdict.word if held else MISSING,
        _explain(shown),
    )
    for column, text in enumerate(texts, 8):
        cell = Cell(text=text)
        book.write_cell(sheet, (index, column), Column(heading=""), cell)
    lines = count_lines((shown.id, *texts), (_WIDTHS[1], *_WIDTHS[8:]))
    book.set_height(sheet, index, lines)


def _write_largest(book: Book, sheet: Any, index: int, row: RowStudy) -> None:
    highest = find_highest(row.checks)
    known = [find_utilisation_band(check)[1] for check in row.checks]
    ends = [end for end in known if end is not None]
    cached = (highest.utilisation if highest else None, max(ends, default=None))
    form = book.format(align="right", num_format=number_format("utilisation"))
    for column, (name, value) in enumerate(
        zip(("check_utilisation", "check_utilisation_high"), cached, strict=True), 6
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
    """Assumed values, identification and room for signatures, under the rows."""
    head, text = book.text(bold=True, bottom=1), book.text()
    blocks: list[tuple[str, Sequence[tuple[str, str]]]] = [
        ("Assumed: confirm in your copy of the standard", _list_assumed(view)),
        ("Identification", view.identification),
        (
            "Signatures",
            (("Prepared", view.prepared), ("Checked", view.checked), ("Approved", "")),
        ),
    ]
    for title, pairs in blocks:
        for column in range(5):
            sheet.write_string(top, column, "" if column else title, head)
        for label, value in pairs:
            top += 1
            sheet.write_string(top, 0, label, text)
            sheet.write_string(top, 2, value, text)
        top += 2


def _list_assumed(view: ReportView) -> Sequence[tuple[str, str]]:
    return [
        (
            f"Clause {clause.text}",
            f"{what.text.rstrip('.')}: {value.text} {unit.text}".rstrip(" -"),
        )
        for clause, what, value, unit, *_ in view.assumed.rows
    ] or [("none", "")]
