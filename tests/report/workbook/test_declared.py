"""A declared check in the workbook: counted and named, and never a pass."""

from dataclasses import replace

import pytest

from netdesign.checks import Proof
from netdesign.outcome import Verdict
from netdesign.report.words import Words
from netdesign.report.workbook.excel import render_workbook
from netdesign.words.catalogue import LANGUAGES
from tests.report.build_study import build_study
from tests.report.reading import read_workbook
from tests.turn import turn

PROOF = Proof(document="Report G-17", author="B. Rüegg", date="", cell="Declared!B2")


def declare(study):
    """The first check of a passing row is declared, and has a resistance."""
    (row,) = study.rows
    check = turn(row.checks[0], Verdict.DECLARED, proof=PROOF)
    return replace(study, rows=[replace(row, checks=[check, *row.checks[1:]])])


STUDY = declare(build_study(rows=1))


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_summary_names_what_is_declared(language):
    words = Words(language)
    book = read_workbook(render_workbook(STUDY, language))
    sheet = book[words("heading.decision")]
    shown = [cell.value for line in sheet.iter_rows() for cell in line]
    assert sheet["B7"].value == words("verdict.declared")
    assert sheet["C3"].value == words("meaning.declared")
    assert any("Report G-17" in str(text) for text in shown)
