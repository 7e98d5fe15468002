"""A declared check in the workbook: never a pass, and no number makes it one."""

import io
from dataclasses import replace

import pytest

from netdesign.checks import Proof
from netdesign.outcome import Verdict
from netdesign.report.gate import require_consistent
from netdesign.report.words import Words
from netdesign.report.workbook.excel import render_workbook
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.report.build_study import as_given, build_study
from tests.report.reading import find_steps, read_workbook, recalculate

PROOF = Proof(document="Report G-17", author="B. Rüegg", date="", cell="Declared!B2")
LINE = 5  # of the first check
EDITS = {
    "as it was": {},
    "strong": {"R_k": 1e6},
    "weak": {"R_k": 1.0},
    "no resistance": {"R_k": None},
    "set to pass": {"R5": "PASS"},
    "another set to declared": {"R_k of the second": None, "R6": "PROVEN ELSEWHERE"},
}
EXPECTED = {
    "as it was": ("PROVEN ELSEWHERE", "PASS", "PROVEN ELSEWHERE"),
    "strong": ("PROVEN ELSEWHERE", "PASS", "PROVEN ELSEWHERE"),
    "weak": ("FAIL", "PASS", "FAIL"),
    "no resistance": ("PROVEN ELSEWHERE", "PASS", "PROVEN ELSEWHERE"),
    "set to pass": ("PROVEN ELSEWHERE", "PASS", "PROVEN ELSEWHERE"),
    "another set to declared": ("PROVEN ELSEWHERE", "NOT PROVEN", "NOT PROVEN"),
}


def declare(study):
    """The first check of a passing row is declared, and has a resistance."""
    (row,) = study.rows
    check = replace(
        row.checks[0],
        verdict=Verdict.DECLARED,
        declared=PROOF,
        reason=as_given("Declared as proven elsewhere."),
    )
    checks = [check, *row.checks[1:]]
    row = replace(row, checks=checks, verdict=Verdict.DECLARED)
    return replace(study, rows=[row], verdict=Verdict.DECLARED)


STUDY = declare(build_study(rows=1))


def type_over(book, place, value):
    """A cell of the checks, or the resistance of the first or second one."""
    if not place.startswith("R_k"):
        book["Checks"][place] = value
        return
    block = find_steps(book["Steps"])[place.endswith("second")]
    book["Steps"][f"E{block['R_k']}"] = value


def hold_back(study):
    row = replace(study.rows[0], verdict=Verdict.NOT_PROVEN)
    return replace(study, rows=[row], verdict=Verdict.NOT_PROVEN)


HELD_BACK = hold_back(build_study(rows=1))


def edit(cells, study=STUDY):
    book = read_workbook(render_workbook(study), formulas=True)
    for place, value in cells.items():
        type_over(book, place, value)
    buffer = io.BytesIO()
    book.save(buffer)
    return buffer.getvalue()


@pytest.fixture(scope="module")
def fresh(tmp_path_factory):
    books = {name: edit(cells) for name, cells in EDITS.items()}
    books |= {name: render_workbook(STUDY, name) for name in LANGUAGES}
    books["held back"] = edit({"R_k": 1e6}, HELD_BACK)
    return recalculate(books, tmp_path_factory.mktemp("books"))


@pytest.mark.long
@each("name", EDITS)
def test_verdicts_follow_the_numbers_and_never_become_a_pass(fresh, name):
    book = read_workbook(fresh[name])
    found = (book["Checks"]["S5"].value, book["Checks"]["S6"].value)
    assert (*found, book["Decision"]["C6"].value) == EXPECTED[name]
    assert book["Decision"]["C3"].value == EXPECTED[name][2]


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_summary_counts_and_names_what_is_declared(fresh, language):
    words = Words(language)
    sheet = read_workbook(fresh[language])[words("heading.decision")]
    shown = [cell.value for line in sheet.iter_rows() for cell in line]
    assert sheet["F5"].value == words("verdict.declared")
    assert sheet["F6"].value == 1
    assert sheet["D3"].value == words("meaning.declared")
    assert any("Report G-17" in str(text) for text in shown)


def test_a_study_may_not_call_a_check_declared_without_a_declaration():
    assert require_consistent(STUDY) is None
    (row,) = STUDY.rows
    checks = [replace(row.checks[0], declared=None), *row.checks[1:]]
    forged = replace(STUDY, rows=[replace(row, checks=checks)])
    with pytest.raises(Exception, match="without a declaration"):
        require_consistent(forged)


# Key of the sentence of the first two checks; None where they stand as in the study.
REASONS = {
    "as it was": (None, None),
    "strong": ("changed", None),
    "weak": ("changed", None),
    "no resistance": ("changed", None),
    "set to pass": (None, None),
    "another set to declared": (None, "changed"),
}


@each("name", EDITS)
def test_the_reason_of_a_declared_check_goes_with_its_numbers(name, fresh):
    sheet = read_workbook(fresh[name])["Checks"]
    told = {Words("en")(f"caption.{x}"): x for x in ("changed", "changed_factor")}
    found = tuple(told.get(sheet[f"W{line}"].value) for line in (LINE, LINE + 1))
    assert found == REASONS[name]


def test_a_row_that_the_study_holds_back_says_so(fresh):
    summary = read_workbook(fresh["held back"])["Decision"]
    assert summary["C6"].value == "NOT PROVEN"
    assert summary["L6"].value == "NOT PROVEN"
    assert summary["M6"].value == Words("en")("caption.changed")
