"""Checks worked out: lines of the deciding one, and all of them in the annex."""

from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.report.blocks import Items
from netdesign.report.page import render_html
from netdesign.report.sections.annexes import list_annexes
from netdesign.report.sections.worked import work_out
from netdesign.report.words import ENGLISH, show_check
from netdesign.words.message import say
from tests.report.build_study import build_study
from tests.report.reading import PageReader

STUDY = build_study()
ROW = STUDY.rows[0]


def read(cell):
    return cell.text or "".join(one.text for one in cell.content)


def list_lines(check):
    return {
        read(row[1]): [read(cell) for cell in row]
        for row in work_out(check, ENGLISH).rows
    }


def test_only_the_load_that_governs_is_worked_out():
    check = ROW.checks[0]
    lines = list_lines(check)
    load = {"coupled": "E_c", "guideline": "E_g"}[check.governs]
    other = {"E_c": "E_g", "E_g": "E_c"}[load]
    assert any(text.startswith(f"{load} =") for text in lines)
    assert not any(text.startswith(f"{other} =") for text in lines)
    assert other in next(text for text in lines if text.startswith("E_k ="))
    assert list_lines(replace(check, steps=[])) == {}


@pytest.fixture(scope="module")
def page():
    return PageReader(render_html(STUDY, has_annexes=True))


def test_the_annex_has_each_requirement_without_a_force_once():
    page = " ".join(PageReader(render_html(STUDY, has_annexes=True)).text)
    annex = page[page.rindex(ENGLISH("heading.annex_checks")) :]
    wanted = {
        show_check(ENGLISH, one)
        for row in STUDY.rows
        for one in row.checks
        if not one.is_of_force
    }
    assert wanted
    assert all(name in annex for name in wanted)


def test_one_reason_of_many_checks_of_a_row_stands_once_in_the_annex():
    finding = say("heading.no_rows")
    checks = [
        replace(one, steps=[], met=Verdict.NOT_PROVEN, finding=finding)
        for one in ROW.checks
    ]
    bare = replace(STUDY, rows=[replace(ROW, checks=checks)])
    annex = next(iter(list_annexes(bare, ENGLISH)))
    (items,) = (one for one in annex.blocks if isinstance(one, Items))
    clauses = {(one.clause, one.verdict) for one in checks}
    assert len(items.items) == len(clauses) < len(checks)
    for one in checks:
        assert any(show_check(ENGLISH, one) in line for line in items.items)
