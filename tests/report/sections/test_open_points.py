"""Everything that is open of a study, for ``--explain`` and the workbook."""

from dataclasses import replace

import pytest

from netdesign.checks import Proof
from netdesign.outcome import Verdict
from netdesign.report.page.html import render_html
from netdesign.report.sections.open_points import list_open_points
from netdesign.report.words import ENGLISH, Words
from netdesign.words.catalogue import LANGUAGES
from netdesign.words.message import say
from tests.report.build_study import as_given, build_study
from tests.turn import turn

STUDY = build_study()


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_check_that_does_not_pass_is_an_open_point(language):
    words = Words(language)
    points = list(list_open_points(STUDY, words))
    for row in STUDY.rows:
        is_open = any(one.verdict is not Verdict.PASS for one in row.checks)
        assert any(one.startswith(f"{row.id}, ") for one in points) is is_open
    assert any("2" in one and "5" in one for one in points)  # values to confirm


@pytest.mark.parametrize("verdict", [Verdict.FAIL, Verdict.NOT_PROVEN])
def test_a_point_without_a_force_names_its_cause(verdict):
    row = STUDY.rows[0]
    cause = as_given("The net of 1.9 m does not reach the 2.5 m that are needed.")
    check = next(one for one in row.checks if not one.is_of_force)
    check = turn(check, verdict, reason=cause)
    study = replace(STUDY, rows=[replace(row, checks=[check])])
    (first, *_) = list_open_points(study, ENGLISH)
    assert ENGLISH.show(cause) in first


def test_many_checks_with_one_cause_are_counted():
    row = STUDY.rows[0]
    lost = turn(row.checks[0], Verdict.NOT_PROVEN, reason=say("check.no_case_solved"))
    open_ = [
        replace(lost, id=f"c{k}", mode=mode, changes=[])
        for k, mode in enumerate(("tendon", "pull_out", "rope", "bearing", "sliding",
                                  "compression", "bending"))
    ]  # fmt: skip
    changed = replace(row, checks=open_)
    (first, *_) = list_open_points(replace(STUDY, rows=[changed]), ENGLISH)
    assert "and 3 more checks: no case could be calculated" in first


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
    told = " ".join(list_open_points(study, ENGLISH))
    for part in ("Report EX-G9", "C. Weber", "2026-03-02", "Declared!B2"):
        assert part in told


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
    assert list(list_open_points(bare, ENGLISH)) == []
    assert ENGLISH("todo.none") in render_html(bare)


def test_a_borehole_that_rises_is_a_point_to_settle_with_its_rows():
    study = build_study(rows=2)
    first, second = study.rows
    rising = replace(first, pulls=[replace(one, dip_deg=-0.4) for one in first.pulls])
    told = list(list_open_points(replace(study, rows=[rising, second]), ENGLISH))
    (point,) = [one for one in told if "grouted" in one]
    assert f"Net anchor (foot) ({first.id})" in point
