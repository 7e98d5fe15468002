"""Page, workbook, view and terminal say the same, check by check."""

import io
import re

import pytest
from rich.console import Console

from netdesign.outcome import Verdict
from netdesign.report.page import render_html
from netdesign.report.sections.checks import describe_resistance
from netdesign.report.terminal import print_summary
from netdesign.report.words import ENGLISH, VERDICTS, show_check, show_member
from netdesign.report.workbook.excel import render_workbook
from netdesign.study.scopes import find_governing
from netdesign.words.catalogue import name_mode
from tests.report.build_study import build_study
from tests.report.reading import PageReader, read_checks, read_rows, read_workbook

STUDY = build_study()
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[+-]\d+)?")
MARKED = re.compile(NUMBER.pattern.replace(r"\.", "[.,]", 1))


@pytest.fixture(scope="module")
def page():
    return PageReader(render_html(STUDY, has_annexes=True))


@pytest.fixture(scope="module")
def content():
    return render_workbook(STUDY)


@pytest.fixture(scope="module")
def book(content):
    return read_workbook(content)


def show(key, value):
    return value if isinstance(value, str) else ENGLISH.show_number(key, value)


def told(page):
    return " ".join(" ".join(page.text).split())


def list_lines(page, number):
    """Lines of the table of members of a row, each with the check that it shows."""
    row = STUDY.rows[number]
    table, *_ = page.tables[f"row-{number + 1}-checks"]
    for cells in table[1:]:
        named = [
            one
            for one in row.checks
            if one.is_of_force
            and ENGLISH.show(name_mode(one.mode)) == cells[1]
            and cells[0] in (show_member(ENGLISH, one.member), "Links of the anchors")
            and show("demand_kN", one.demand_kN) == cells[4]
        ]
        yield cells, named


def read_step(book, check, symbol):
    """Value of a step of a check in the workbook; "-" where it has no such step."""
    line = check.steps.get(symbol)
    return book["Checks"][f"H{line}"].value if line else "-"


def test_checks_agree(page, book, content):
    """Each line of a member is one of its checks, with the numbers of the workbook."""
    sheet = {(one.row, one.name): one for one in read_checks(content)}
    for number, row in enumerate(STUDY.rows):
        shown = 0
        for cells, checks in list_lines(page, number):
            shown += 1
            lines = [sheet[row.id, show_check(ENGLISH, one)] for one in checks]
            assert any(
                cells[4] == show("demand_kN", read_step(book, line, "E_d"))
                and cells[5] == show("resistance_kN", read_step(book, line, "R_d"))
                and show("utilisation", line.used[1]).strip("-") in cells[6]
                for line in lines
            ), cells
        assert shown
        for check in row.checks:
            line = sheet[row.id, show_check(ENGLISH, check)]
            assert line.verdict == ENGLISH(f"verdict.{check.verdict}")
            assert (line.resistance or "-") == describe_resistance(check, ENGLISH)
            assert ENGLISH.show(check.reason).rstrip(".") in line.told
            if check.verdict is not Verdict.PASS and (check.open or check.open_reasons):
                is_open = check.verdict is Verdict.NOT_PROVEN
                reasons = check.open_reasons if is_open else (check.plain_reason,)
                assert all(ENGLISH.show(reason) in told(page) for reason in reasons)


def test_verdicts_agree(page, book):
    stream = io.StringIO()
    print_summary(STUDY, Console(file=stream, width=200))
    lines = stream.getvalue().splitlines()
    summary = read_rows(book["Decision"], "Row")
    shown = page.tables["decision"][0][1:]
    for index, row in enumerate(STUDY.rows):
        word = ENGLISH(f"verdict.{row.verdict}")
        assert shown[index][0].startswith(f"{VERDICTS[row.verdict].symbol} {word}")
        assert summary[index]["Verdict"] == word
        signs = {VERDICTS[one.verdict].symbol for one in row.scopes.values()}
        assert all(one in lines[2 + index] for one in signs)
        used = ENGLISH.show_number("utilisation", find_governing(row.checks).used)
        assert used in lines[2 + index]
    overall = ENGLISH(f"verdict.{STUDY.verdict}")
    assert book["Decision"]["B3"].value == overall
    assert f"Verdict: {overall}" in lines
    assert f"{overall}" in "".join(page.text)


@pytest.mark.parametrize("language", ["fr", "de"])
def test_languages_show_the_same_numbers_and_keys(page, language):
    other = PageReader(render_html(STUDY, language, has_annexes=True))
    assert other.ids == page.ids
    for section, tables in page.tables.items():
        for table, theirs in zip(tables, other.tables[section], strict=True):
            for cells, shown in zip(table, theirs, strict=True):
                for cell, text in zip(cells, shown, strict=True):
                    numbers = [
                        [found.replace(",", ".") for found in MARKED.findall(one)]
                        for one in (cell, text)
                    ]
                    assert numbers[0] == numbers[1]


def test_provenance_agrees(page, book):
    cells = {line[0]: line[1] for line in page.tables["annex-verify"][0][1:]}
    shown = list(book["Notes"].iter_rows(values_only=True))
    start = max(k for k, line in enumerate(shown) if line[0] == "Provenance")
    pairs = [[one for one in line if one is not None] for line in shown[start + 1 :]]
    assert cells == {name: value for name, value in pairs}
    assert cells["Site file, SHA-256"] == STUDY.provenance.site_sha256
    assert cells["Limit profile, SHA-256"] == STUDY.profile.sha256
