"""What decides a member: the worst verdict, the largest utilisation, a force alone."""

import random
from dataclasses import replace

import pytest

from netdesign.outcome import SEVERITY, Verdict
from netdesign.report.sections.rated import (
    ANCHOR_MEMBERS,
    find_deciding,
    find_demand,
    list_anchor,
    list_part,
    rate,
)
from netdesign.study.scopes import Scope, list_of_scope
from tests.report.build_study import build_study
from tests.turn import turn

STUDY = build_study()
FORCES = [one for row in STUDY.rows for one in row.checks if one.is_of_force]


def draw_checks(dice):
    """Some checks of a force, of any verdict; of some the resistance is not known."""
    checks = []
    for number in range(dice.randint(1, 7)):
        check = replace(dice.choice(FORCES), id=f"c{number}")
        verdict = dice.choice(list(Verdict))
        used = dice.uniform(1.01, 9.0) if verdict is Verdict.FAIL else None
        if used is None and verdict is Verdict.PASS:
            used = dice.uniform(0.05, 0.99)
        checks.append(turn(check, verdict, utilisation=used))
    return checks


def test_a_group_has_its_worst_verdict_and_the_check_that_decides():
    dice = random.Random(20261129)
    for _ in range(300):
        checks = draw_checks(dice)
        rated = rate(checks)
        assert rated.verdict is min((x.verdict for x in checks), key=SEVERITY.index)
        if rated.verdict is not Verdict.DECLARED:
            assert rated.check.verdict is rated.verdict
        alike = [x for x in checks if x.verdict is rated.check.verdict]
        if rated.used is None:
            assert rated.verdict in (Verdict.NOT_PROVEN, Verdict.DECLARED)
        elif rated.verdict in (Verdict.FAIL, Verdict.PASS):
            assert rated.used == max(x.used for x in alike)
    assert rate([]) is None


def test_a_force_without_a_resistance_is_shown_before_any_utilisation():
    known, lacking = (replace(FORCES[0], id=one) for one in "ab")
    known = turn(known, Verdict.NOT_PROVEN, reason="in doubt")
    steps = [x for x in lacking.steps if x.symbol not in ("R_k", "R_d", "μ")]
    lacking = replace(lacking, steps=steps, open=[])
    assert rate([known, lacking]).check is lacking


@pytest.mark.parametrize("row", STUDY.rows)
def test_every_check_of_a_force_is_in_one_line_of_its_row(row):
    lines = [list_anchor(row, (one,)) for one in ANCHOR_MEMBERS]
    members = {one.member for one in row.checks} - set(ANCHOR_MEMBERS)
    lines += [list_part(row, ANCHOR_MEMBERS)]
    lines += [list_part(row, (one,)) for one in sorted(members)]
    found = [one.id for line in lines for one in line if one.is_of_force]
    assert sorted(found) == sorted(one.id for one in row.checks if one.is_of_force)


def test_the_largest_force_of_a_member_is_no_less_than_any_of_its_checks():
    for row in STUDY.rows:
        for member in ANCHOR_MEMBERS:
            checks = list_anchor(row, (member,))
            known = [x.demand_kN for x in checks if x.demand_kN is not None]
            assert find_demand(checks) == max(known, default=None)


def test_the_deciding_check_has_the_verdict_of_its_row():
    for row in STUDY.rows:
        check = find_deciding(row)
        assert check.verdict is row.verdict or not row.checks
    assert {x.id for x in list_of_scope(STUDY.rows[0].checks, Scope.ANCHORS)}
