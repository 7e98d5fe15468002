"""Sheet of the notional reliability in the workbook of a study."""

from __future__ import annotations

from dataclasses import replace

from netdesign.addons.reliability.section import (
    tabulate_indices,
    tabulate_shares,
    tabulate_variables,
)
from netdesign.report.workbook.writer import BETWEEN_TABLES, TABLE_TOP, Book
from netdesign.study.records import Study

NAME = "reliability"
_SHARE = 2  # column of the shares, zero-based


def add_sheet(book: Book, study: Study) -> None:
    """Add the sheet, with bars behind its shares."""
    words = book.words
    indices, shares = tabulate_indices(study, words), tabulate_shares(study, words)
    note = words("reliability.is_not")
    told = words("reliability.captioned", caption=indices.caption, note=note)
    tables = [replace(indices, caption=told), shares, tabulate_variables(study, words)]
    sheet = book.add_table_sheet(NAME, words("heading.reliability"), tables)
    first = TABLE_TOP + len(indices.rows) + BETWEEN_TABLES
    if shares.rows:
        last = first + len(shares.rows) - 1
        book.add_ratio_bars(sheet, (first, _SHARE, last, _SHARE), full=1.0)
