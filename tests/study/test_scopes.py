"""Anchors, structure, siting: each check in its scope, each verdict of its own."""

import random
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.checks import OpenKind
from netdesign.outcome import SEVERITY, Verdict, merge_verdicts
from netdesign.site.declared_sheet import DECLARABLE
from netdesign.study.scopes import (
    SCOPES,
    Scope,
    ScopeRecord,
    find_scopes,
    list_of_scope,
    sum_up_row,
    sum_up_study,
)
from tests.make import read_tables
from tests.report.build_study import build_study
from tests.study.knowing_less.drawn_tables import draw_tables
from tests.turn import turn

STUDY = build_study()
CHECKS = STUDY.rows[0].checks
VERDICTS = st.lists(
    st.sampled_from([*Verdict]), min_size=len(CHECKS), max_size=len(CHECKS)
)


def name_one(member, mode):
    subject = "geometry" if member == "net" else member
    return replace(CHECKS[0], id=f"{subject}.{mode}", member=member, mode=mode)


def test_every_check_that_there_is_belongs_to_a_scope():
    found = {
        (member, mode): find_scopes(name_one(member, mode))
        for member, mode in DECLARABLE
    }
    assert {len(one) for name, one in found.items() if name[1] != "ends"} == {1}
    assert found["uphill_anchor", "wedge"] == {Scope.ANCHORS}
    assert found["end_guy_anchor", "connection"] == {Scope.STRUCTURE}
    assert found["post", "lateral"] == {Scope.STRUCTURE}
    assert found["net", "cover"] == {Scope.ANCHORS}
    assert found["net", "gap"] == {Scope.SITING}
    # whose ends are not known has neither anchors nor structure
    assert found["net", "ends"] == {Scope.ANCHORS, Scope.STRUCTURE}


@pytest.mark.parametrize(
    ("block", "column", "typed", "asked"),
    [
        ("anchor_types", "pull_out", 4900.0, {Scope.ANCHORS}),
        ("posts", "bearing", 4900.0, {Scope.STRUCTURE}),
        ("net_types", "mesh_strength", 9000.0, {Scope.STRUCTURE}),
        ("rows", "post_spacing", 9.0, set(SCOPES)),
    ],
)
def test_a_doubted_cell_bears_on_what_its_number_decides(block, column, typed, asked):
    tables = draw_tables(11)
    tests = ("test_count", "test_mean")  # a number of them would have to fit
    for k, line in enumerate(tables[block]):
        kept = {key: value for key, value in line.items() if key not in tests}
        tables[block][k] = kept | {column: typed}
    site = read_tables(tables)
    (doubt, *_) = site.rows[0].questions
    check = replace(name_one("inputs", "plausible"), id="inputs.plausible")
    check = check.with_open(OpenKind.VALUE_ASKED, doubt)
    assert find_scopes(check) == asked


@given(VERDICTS)
def test_the_row_has_the_worst_verdict_of_its_scopes(verdicts):
    checks = [turn(*pair) for pair in zip(CHECKS, verdicts, strict=True)]
    row = replace(STUDY.rows[0], checks=checks)
    of_scopes = [one.verdict for one in row.scopes.values()]
    if all(list_of_scope(checks, one) for one in SCOPES):
        assert row.verdict is min(of_scopes, key=SEVERITY.index)
    assert merge_verdicts(of_scopes) in (row.verdict, Verdict.NOT_PROVEN)


def test_a_scope_names_the_check_that_decides():
    checks = list(CHECKS)
    random.Random(62).shuffle(checks)
    for scope, record in sum_up_row(checks).items():
        worst = min(
            list_of_scope(checks, scope), key=lambda one: one.rank, default=None
        )
        assert record.governing == (worst.id if worst else "")
        assert record.utilisation == (worst.utilisation if worst else None)


def test_no_row_stands_for_what_a_part_of_a_site_leaves_open():
    """Rows that pass are not named as those that decide."""
    passing = ScopeRecord(verdict=Verdict.PASS, utilisation=0.83, governing="x")
    failing = ScopeRecord(verdict=Verdict.FAIL, utilisation=1.37, governing="y")
    rows = {
        "U1": dict.fromkeys(SCOPES, passing),
        "U2": {**dict.fromkeys(SCOPES, passing), Scope.ANCHORS: failing},
    }
    found = sum_up_study(rows, is_part=True)
    assert found[Scope.ANCHORS].row == "U2"
    assert found[Scope.SITING].row is None
    assert found[Scope.SITING].verdict is Verdict.NOT_PROVEN
