"""Anchors, structure and siting in words: each with what decides it."""

from dataclasses import replace

import pytest

from netdesign.checks.comparison import compare
from netdesign.checks.geometry import Approval
from netdesign.outcome import Verdict
from netdesign.report.blocks import write_plain
from netdesign.report.page import render_html
from netdesign.report.sections.checks import (
    describe_study_scopes,
    list_exceeding,
)
from netdesign.report.sections.decision import show_structure
from netdesign.report.words import ENGLISH
from netdesign.study.scopes import SCOPES
from netdesign.words.message import say
from tests.report.build_study import build_study
from tests.report.reading import PageReader
from tests.turn import turn

STUDY = build_study()


def read_page(study):
    """Text of the first page."""
    page = " ".join("".join(PageReader(render_html(study)).text).split())
    return page.partition(ENGLISH("heading.schedule"))[0]


DOCUMENT = "EX-TA 12-3"


def approve(row):
    """Row whose structure an approval proves."""
    of_structure = replace(
        row.checks[0], id="structure.approval", member="structure", mode="approval"
    )
    bare = replace(of_structure, steps=[], finding=None)
    proof = Approval(document=DOCUMENT, cell="Net types!C4").prove()
    line = turn(bare, Verdict.DECLARED, proof=proof)
    anchors = [one for one in row.checks if one.member.endswith("anchor")]
    return replace(row, checks=[*anchors, line])


@pytest.mark.parametrize(
    ("verdict", "key"), [(Verdict.FAIL, "outside"), (Verdict.NOT_PROVEN, "unsure")]
)
def test_outside_its_approval_is_a_row_beyond_a_limit_alone(verdict, key):
    """An altitude that is not given may lie inside."""
    row = approve(STUDY.rows[0])
    *anchors, line = row.checks
    line = turn(line, Verdict.NOT_PROVEN)
    limits = compare("approval", verdict, say("check.fails"))
    row = replace(row, checks=[*anchors, limits, line])
    assert write_plain(show_structure(row, ENGLISH)).endswith(ENGLISH(f"rated.{key}"))


def test_every_scope_stands_with_its_verdict_and_utilisation():
    for row in STUDY.rows:
        study = replace(STUDY, rows=[row])
        told = describe_study_scopes(study, ENGLISH).split(" · ")
        assert len(told) == len(SCOPES)
        for scope, text in zip(SCOPES, told, strict=True):
            record = row.scopes[scope]
            assert ENGLISH(f"verdict.{record.verdict}") in text
            if record.utilisation is not None:
                used = ENGLISH.show_number("utilisation", record.utilisation)
                assert used in text


def test_the_whole_study_names_the_row_that_decides():
    told = describe_study_scopes(STUDY, ENGLISH).split(" · ")
    for record, text in zip(STUDY.scopes.values(), told, strict=True):
        assert (record.verdict is not Verdict.PASS) == text.endswith(record.row)


def test_what_the_coupled_force_exceeds_is_named_with_its_factor():
    """Only where the guideline's load decides: else the check fails by itself."""
    assert not list(list_exceeding(STUDY, ENGLISH))
    row = STUDY.rows[0]
    check = next(one for one in row.checks if one.utilisation)
    steps = {one.symbol: one for one in check.steps}
    factor, design = steps["γ_E"].value, steps["R_d"].value
    force = replace(steps["E_k"], symbol="E_g", value=0.5 * design / factor, formula="")
    beside = replace(force, symbol="E_c", value=1.37 * design / factor)
    guided = replace(
        check,
        steps=[
            *(replace(one, low=None, high=None) for one in (force, beside)),
            replace(
                steps["E_k"], value=force.value, formula="E_g", low=None, high=None
            ),
            *(steps[one] for one in ("γ_E", "γ_R", "R_k", "R_d") if one in steps),
        ],
        open=[],
    )
    assert guided.exceeds_by_model
    others = [one for one in row.checks if one is not check]
    study = replace(STUDY, rows=[replace(row, checks=[guided, *others])])
    (told,) = list_exceeding(study, ENGLISH)
    assert "1.37" in told
    assert told.startswith(row.id)
    assert " ".join(told.split()) in read_page(study)


def test_a_load_that_decides_is_said_on_the_first_page():
    profile = replace(STUDY.profile, is_by_guideline=True, has_maker_floor=False)
    shown = read_page(replace(STUDY, profile=profile))
    for key in ("floor.decides", "floor.no_maker"):
        assert ENGLISH(key) in shown
        assert ENGLISH(key) not in read_page(STUDY)
