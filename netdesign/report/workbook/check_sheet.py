"""Sheet of checks: its numbers are those of the calculations, its verdicts follow them.

Each formula is stored with the value of the study, so that viewers which do not
calculate show the study's numbers.
"""

from __future__ import annotations

from typing import Any

from netdesign.report.workbook.calculation_sheet import Calculations, GivenCells
from netdesign.report.workbook.check_columns import (
    CASES,
    FIELDS,
    FOLDED,
    FURTHER,
    HIDDEN,
    LEAD,
    LOADS,
    RANK,
    RATIOS,
    SHOWN,
    TAIL,
    UNCHANGED,
    VERDICT,
)
from netdesign.report.workbook.check_line import CheckLine
from netdesign.report.workbook.writer import Book, fit_headings
from netdesign.study.records import Study

_PAGES = 2  # of paper side by side; on one its figures were too small to be read
HEAD_ROW = 3  # zero-based; the first check is one below


def has_further(study: Study) -> bool:
    """True if more than the usual three quantities range."""
    checks = (check for row in study.rows for check in row.checks)
    return any(len(check.case.values) > 3 for check in checks if check.case)


def add_check_sheet(
    book: Book,
    study: Study,
    cells: GivenCells,
    calculations: Calculations,
) -> None:
    """Sheet "Checks" and the defined names that the summary counts by."""
    sheet = book.add_sheet("checks", book.words("heading.checks"))
    _write_head(book, sheet, study)
    line = HEAD_ROW + 1
    for number, row in enumerate(study.rows):
        for place, check in enumerate(row.checks):
            followed = [
                *cells.list_followed(number, check),
                *calculations.list_followed((number, place)),
            ]
            CheckLine(
                book=book,
                sheet=sheet,
                line=line,
                check=check,
                place=(number, place),
                calculations=calculations,
                followed=followed,
            ).write(row.id)
            line += 1
    if line == HEAD_ROW + 1:
        text = book.words("heading.no_check")
        sheet.write_string(line, 0, text, book.text())
    _finish(book, sheet, max(line, HEAD_ROW + 2))


def _write_head(book: Book, sheet: Any, study: Study) -> None:
    """Notes and headings; width of the columns."""
    sheet.fit_to_pages(_PAGES, 0)
    sheet.repeat_columns(LEAD[0].index, LEAD[2].index)
    book.link_back(sheet, (0, 3))
    first_page = SHOWN[: VERDICT.index + 1]  # what stands beside it is another one
    widths = [field.width for field in first_page]
    live = book.words("caption.live_values", sheet=book.name("steps"))
    formulas = " ".join((book.words("caption.check_formulas"), live))
    for line, text in enumerate((formulas, book.words("caption.check_verdicts")), 1):
        book.write_wide(sheet, (line, 0), text, widths, italic=True)
    columns = [field.name(book.words) for field in FIELDS]
    widths = fit_headings(columns, [field.width for field in FIELDS])
    book.write_head(sheet, HEAD_ROW, columns, widths)
    for field, width in zip(FIELDS, widths, strict=True):
        is_idle = field is FURTHER and not has_further(study)
        is_hidden = field in (*HIDDEN, *FOLDED) or is_idle
        options = {"hidden": is_hidden, "level": int(field in FOLDED)}
        area = f"{field.letter}:{field.letter}"
        sheet.set_column(area, width, None, options)


def _finish(book: Book, sheet: Any, last: int) -> None:
    first = HEAD_ROW + 2
    named = {
        "check_net_row_number": LEAD[0],
        "check_name": LEAD[2],
        "check_utilisation": RATIOS[1],
        "check_utilisation_high": RATIOS[2],
        "check_verdict": VERDICT,
        "check_reason": TAIL[1],
        "check_rank": RANK,
        "check_unchanged": UNCHANGED,
        "check_load": LOADS[2],
        **{f"check_case_{n}": field for n, field in enumerate(CASES, 1)},
        "check_case_further": FURTHER,
    }
    for name, field in named.items():
        area = f"${field.letter}${first}:${field.letter}${last}"
        book.workbook.define_name(name, f"={book.refer('checks', area)}")
    for field, decorate in (
        (VERDICT, book.colour_verdicts),
        (RATIOS[1], book.add_ratio_bars),
    ):
        decorate(sheet, (first - 1, field.index, last - 1, field.index))
    sheet.autofilter(HEAD_ROW, 0, last - 1, len(SHOWN) - 1)
    sheet.freeze_panes(HEAD_ROW + 1, 3)
    sheet.repeat_rows(HEAD_ROW)
