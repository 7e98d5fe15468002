"""Sheets with net rows under a name that nobody knows: half a site must not vanish."""

from __future__ import annotations

from pathlib import Path

from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import TextFormat, Workbook
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.all_tables import NETS, QUIET_SHEETS, is_heading
from netdesign.site.columns.lexicon import UNANSWERED
from netdesign.site.headings import count_known
from netdesign.site.mapping import is_meant

# Headings of sheet Nets, at least, on a sheet that holds net rows.
_LEAST_KNOWN = 4


def list_rows_elsewhere(
    path: Path, workbook: Workbook, text_format: TextFormat
) -> tuple[str, ...]:
    """Names of such sheets beside those of net rows, until somebody answers for them.

    They are read only where a workbook holds sheets that have no part in a check.
    """
    given = workbook.answers.sheets
    is_there = any(
        is_meant(one.name, NETS, workbook.answers) for one in workbook.sheets
    )
    names = {
        name
        for name in workbook.unread
        if given.get(name, UNANSWERED) == UNANSWERED
        and name not in (*workbook.hidden, *QUIET_SHEETS)
        and not NETS.begins(name)  # asked about by its name
    }
    if not names or not is_there:
        return ()
    try:
        every = read_workbook(path, names.__contains__, None, is_heading, text_format)
    except SiteDataError:  # what has no part in the check may be damaged
        return ()
    return tuple(
        sheet.name
        for sheet in every.sheets
        if sheet.name in names and count_known(sheet, NETS) >= _LEAST_KNOWN
    )
