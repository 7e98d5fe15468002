"""Page of a net row: every member once, the loads beside each other, what is open."""

from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.report.page.html import render_html
from netdesign.report.sections.rated import find_worked
from netdesign.report.words import ENGLISH, show_check
from netdesign.words.catalogue import LANGUAGES
from tests.report.build_study import build_study
from tests.report.reading import PageReader
from tests.turn import turn

STUDY = build_study()


def read_page(study=STUDY, language="en"):
    return PageReader(render_html(study, language))


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_member_has_a_line_with_force_resistance_and_utilisation(language):
    page = read_page(language=language)
    for number, row in enumerate(STUDY.rows, 1):
        (table,) = page.tables[f"row-{number}-checks"]
        members = {x.member for x in row.checks if x.is_of_force}
        links = {x.mode for x in row.checks if x.mode == "connection"}
        assert len(table) - 1 == len(members) + len(links)


def test_a_requirement_that_fails_says_why():
    row = STUDY.rows[0]
    check = next(x for x in row.checks if not x.is_of_force)
    failed = turn(check, Verdict.FAIL, reason="The net is too low by 0.37 m.")
    checks = [failed if x is check else x for x in row.checks]
    page = read_page(replace(STUDY, rows=[replace(row, checks=checks)]))
    assert "The net is too low by 0.37 m." in " ".join(page.text)


def test_the_governing_check_of_each_row_is_worked_out():
    page = read_page()
    headings = " ".join(" ".join(page.text).split())
    for number, row in enumerate(STUDY.rows, 1):
        check = find_worked(row)
        (table,) = page.tables[f"worked-{number}"]
        symbols = {line[1].split(" ")[0] for line in table[1:]}
        assert "E" in symbols
        assert ("μ" in symbols) is (check.used is not None)
        assert f"{row.id}; {show_check(ENGLISH, check)}" in headings
