"""Form of pull-out tests: a sheet Tests to fill in on the site, and how it is read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from io import BytesIO
from pathlib import Path

from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import Answers
from netdesign.site.cells.findings import fold_findings
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.all_tables import TESTS
from netdesign.site.headings import Table
from netdesign.site.readings import Row
from netdesign.site.tables import find_table, read_rows
from netdesign.site.template.workbook import start_book, write_sheet
from netdesign.site.titles import is_meant
from netdesign.words.catalogue import Language, render
from netdesign.words.message import say

# A form without a load or a result is not filled in.
_FORM = replace(
    TESTS,
    fields=tuple(
        replace(one, refers_to="", required=one.required or one.key == "result")
        for one in TESTS.fields
    ),
)
_FILLED = ("force", "result", "displacement")  # on the site
_WIDTH = 17


def build_form(
    lines: Sequence[Mapping[str, object]],
    places: Sequence[tuple[str, float]],
    steps: Sequence[float],
    language: Language,
) -> bytes:
    """Xlsx bytes of a form.

    Parameters
    ----------
    lines : sequence of mapping
        Of each test what is known: type, ground, planned proof load [kN].
    places : sequence of (str, float)
        Net row of each test, and design force on its anchor [kN].
    steps : sequence of float
        Loads at which displacements are read, over the proof load [-].
    language : str
        Of the form; it may be filled in and read in any.
    """
    content = BytesIO()
    book = start_book(content, language)
    sheet = write_sheet(book, _FORM, lines)
    headings = [render(say("plan.row"), language), render(say("plan.force"), language)]
    headings += [
        render(say(key, share=100.0 * step), language)
        for step in steps
        for key in ("plan.step", "plan.moved")
    ]
    first = len(_FORM.fields)
    sheet.set_column(first, first + len(headings) - 1, _WIDTH)
    for column, heading in enumerate(headings, first):
        sheet.write_string(0, column, heading, book.formats["heading"])
    for number, (line, (row, force)) in enumerate(zip(lines, places, strict=True), 1):
        load = float(str(line["proof_load"]))
        sheet.write_string(number, first, row, book.formats["text"])
        sheet.write_number(number, first + 1, round(force, 1), book.formats["number"])
        for place, step in enumerate(steps):
            column = first + 2 + 2 * place
            shown = round(step * load, 1)
            sheet.write_number(number, column, shown, book.formats["number"])
            sheet.write_blank(number, column + 1, None, book.formats["number"])
    sheet.print_area(0, 0, max(len(lines), 1), first + len(headings) - 1)
    book.workbook.close()
    return content.getvalue()


def read_form(path: Path) -> tuple[list[Row], int]:
    """Tests of a form that are filled in, and the number of those still to be done.

    Raises
    ------
    SiteDataError
        With all findings: no such sheet, no test, what cannot be read or is missing.
    """
    workbook = read_workbook(path, lambda name: is_meant(name, TESTS, Answers()))
    findings = list(workbook.remarks)
    table = find_table(workbook, _FORM, findings)
    open_rows = [row for row in table.rows if _is_open(table, row)] if table else []
    if table is not None:
        done = [row for row in table.rows if row not in open_rows]
        table = replace(table, rows=tuple(done))
    rows = read_rows(table, findings)
    if not rows:
        rule, accepted = say("plan.no_test"), say("plan.form_wanted")
        findings.append(workbook.finding(rule, accepted))
    errors = [one for one in findings if one.severity == "error"]
    if errors:  # the form's other columns are for the record on the site
        raise SiteDataError(errors, fold_findings(errors, workbook.file))
    return rows, len(open_rows)


def _is_open(table: Table, row: int) -> bool:
    """Nothing stands yet in the cells that the site fills in."""
    filled = [table.columns[key].number for key in _FILLED if key in table.columns]
    return all(table.sheet.cell(row, column).is_blank for column in filled)
