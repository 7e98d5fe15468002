"""Quality of the solutions, cases, second opinions as tables."""

from netdesign.report.page import render_html
from netdesign.report.sections.annexes import (
    build_cases,
)
from netdesign.report.words import ENGLISH
from tests.report.build_study import build_study
from tests.report.reading import PageReader

STUDY = build_study()


def test_failed_case_is_named_and_in_no_maximum():
    page = PageReader(render_html(STUDY, has_annexes=True))
    cases = page.tables["annex-cases"]
    assert [sum("60 iterations" in x[-1] for x in table) for table in cases] == [
        0,
        1,
        0,
    ]
    rows = build_cases(STUDY.rows[1], ENGLISH).rows
    assert len([cells for cells in rows if "-" in cells[3].text]) == 1
