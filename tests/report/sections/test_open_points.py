"""All that is to be done of a study: one list for page, terminal and workbook."""

from dataclasses import replace

import pytest

from netdesign.checks import Proof
from netdesign.outcome import Verdict
from netdesign.report.page.html import render_html
from netdesign.report.sections.basis import count_assumed, show_line
from netdesign.report.words import ENGLISH, Words
from netdesign.study.to_do import list_to_do
from netdesign.words.catalogue import LANGUAGES
from netdesign.words.message import say
from netdesign.words.names import name_member
from tests.report.build_study import as_given, build_study
from tests.turn import turn

STUDY = build_study()


def list_lines(study, words=ENGLISH):
    """Every line to be done, in words."""
    return [show_line(line, study, words) for line in list_to_do(study, None)]


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_check_that_does_not_pass_is_an_open_point(language):
    words, lines = Words(language), list_to_do(STUDY, None)
    for row in STUDY.rows:
        is_open = any(one.verdict is not Verdict.PASS for one in row.checks)
        assert any(row.id in line.rows for line in lines) is is_open
    assumed, count = count_assumed(STUDY)
    told = words("todo.unconfirmed", assumed=assumed, count=count)
    assert told in render_html(STUDY, language)


@pytest.mark.parametrize("verdict", [Verdict.FAIL, Verdict.NOT_PROVEN])
def test_a_point_without_a_force_names_its_cause(verdict):
    row = STUDY.rows[0]
    cause = as_given("The net of 1.9 m does not reach the 2.5 m that are needed.")
    check = next(one for one in row.checks if not one.is_of_force)
    check = turn(check, verdict, reason=cause)
    study = replace(STUDY, rows=[replace(row, checks=[check])])
    (first,) = list_lines(study)
    assert ENGLISH.show(cause) in first


def test_many_checks_with_one_cause_share_a_line():
    row = STUDY.rows[0]
    lost = turn(row.checks[0], Verdict.NOT_PROVEN, reason=say("check.no_case_solved"))
    open_ = [
        replace(lost, id=f"c{k}", mode=mode, changes=[])
        for k, mode in enumerate(("tendon", "pull_out", "rope", "bearing", "sliding",
                                  "compression", "bending"))
    ]  # fmt: skip
    changed = replace(row, checks=open_)
    lines = list_to_do(replace(STUDY, rows=[changed]), None)
    reason = say("check.no_case_solved")
    (line,) = (x for x in lines if x.text.arguments.get("reason") == reason)
    assert line.text.arguments["checks"] == (name_member(lost.member),)


def test_what_is_proven_elsewhere_is_an_open_point_with_its_document():
    row = STUDY.rows[2]
    proof = Proof(
        document="Report EX-G9",
        author="C. Weber",
        date="2026-03-02",
        cell="Declared!B2",
    )
    checks = [
        turn(one, Verdict.DECLARED, proof=proof)
        if one.verdict is Verdict.NOT_PROVEN
        else one
        for one in row.checks
    ]
    study = replace(STUDY, rows=[replace(row, checks=checks)])
    assert any("Report EX-G9" in line for line in list_lines(study))
    page = render_html(study)
    for part in ("Report EX-G9", "C. Weber", "2026-03-02", "Declared!B2"):
        assert part in page


def test_nothing_is_open_where_all_passes_and_is_confirmed():
    study = build_study(rows=1)
    values = [replace(one, status="read") for one in study.profile.values]
    row = replace(
        study.rows[0],
        inputs=[x for x in study.rows[0].inputs if x.cell != "default"],
    )
    bare = replace(
        study,
        rows=[row],
        profile=replace(study.profile, values=values),
        range_inputs=[],
    )
    assert list_lines(bare) == []
    assert ENGLISH("todo.none") in render_html(bare)
