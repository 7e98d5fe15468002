"""What a pass may rest on: declarations, doubts, information, nets below their snow."""

import math
from dataclasses import replace

import pytest

from netdesign.checks import (
    CheckResult,
    Declaration,
    Proof,
    check_member,
    declare,
    load_standard,
    withhold,
)
from netdesign.checks.check import judge
from netdesign.checks.geometry import check_height
from netdesign.outcome import Verdict
from netdesign.words.names import as_given
from tests.checks.entries import a_force, a_resistance, a_value
from tests.each import each

PROFILE = load_standard("nf-p-95-304-style")
BARE = replace(
    PROFILE, values=(a_value("action.snow", 1.0), a_value("resistance.tendon", 1.0))
)
DECLARATION = Declaration(
    row_id="R3",
    member="foot_anchor",
    mode="tendon",
    proof=Proof(
        document="Report G-17",
        author="B. Rüegg",
        date="2026-03-09",
        cell="Declared!B2",
    ),
)


def check(
    low: float, high: float, strength: float | None = 1.0, **open_points
) -> CheckResult:
    action = a_force(low, low, high)
    gaps = {"gap": None} | open_points
    return check_member(action, a_resistance(strength), BARE, **gaps)


@pytest.mark.parametrize(
    ("low", "high", "strength"), [(0.2, 0.9, 1.0), (0.7, 1.3, 1.0), (0.4, 0.6, None)]
)
def test_what_does_not_fail_becomes_declared_and_keeps_its_numbers(low, high, strength):
    computed = check(low, high, strength)
    found = declare(computed, DECLARATION)
    assert found.verdict is Verdict.DECLARED
    assert found.used is computed.used
    assert found.declared is DECLARATION.proof
    told = str(found.reason)
    for part in ("Report G-17", "B. Rüegg", "2026-03-09", "Declared!B2"):
        assert part in told
    assert str(computed.reason).rstrip(".") in told


def test_what_is_computed_and_fails_stays_a_failure():
    computed = check(1.1, 1.7)
    found = declare(computed, DECLARATION)
    assert computed.verdict is found.verdict is Verdict.FAIL
    assert "Report G-17" in str(found.reason)
    assert "cannot change that" in str(found.reason)


def test_without_a_declaration_nothing_changes():
    computed = check(0.2, 0.9)
    assert declare(computed, None) is computed


def test_a_declaration_without_a_date_says_so():
    told = str(
        declare(
            check(0.2, 0.9),
            replace(DECLARATION, proof=replace(DECLARATION.proof, date="")),
        ).reason
    )
    assert "without a date" in told


@pytest.mark.parametrize(
    ("low", "high", "verdict"),
    [(0.1, 0.3, Verdict.NOT_PROVEN), (1.2, 1.9, Verdict.FAIL)],
)
def test_with_a_doubt_about_the_model_nothing_passes(low, high, verdict):
    found = check(low, high, doubt=as_given("snow of another kind"))
    assert found.verdict is verdict
    assert "snow of another kind" in str(found.reason)


def test_gap_and_doubt_are_both_told():
    told = str(check(0.1, 0.3, gap=as_given("3 failed"), doubt=as_given("odd")).reason)
    assert told == "Not proven: 3 failed; odd."


@pytest.mark.parametrize(("low", "high"), [(0.1, 0.3), (1.2, 1.9)])
def test_information_proves_nothing_either_way(low, high):
    computed = check(low, high)
    found = withhold(computed, as_given("snow overtops the net"))
    assert found.verdict is Verdict.NOT_PROVEN
    assert found.used is computed.used
    assert str(found.reason) == "Not proven: snow overtops the net."


@each("ratio", [None, 0.83, 1.0])
@each(
    "height, verdict",
    [
        (math.nextafter(2.7, 0.0), Verdict.FAIL),
        (1.9, Verdict.FAIL),
        (2.7, Verdict.PASS),
    ],
)
def test_a_net_below_its_snow_fails_under_every_profile(ratio, height, verdict):
    values = [] if ratio is None else [a_value("geometry.height.ratio", ratio)]
    found = check_height(height, 2.7, replace(PROFILE, values=tuple(values)))
    if ratio is None and verdict is Verdict.PASS:
        assert found is None
    else:
        assert found.verdict is verdict
        assert found.clause == ("-" if ratio is None else "4.2")


def test_a_profile_may_ask_for_more_than_the_snow():
    more = replace(PROFILE, values=(a_value("geometry.height.ratio", 1.07),))
    assert check_height(2.8, 2.7, more).verdict is Verdict.FAIL
    assert judge(2.9, 2.9, least=1.07 * 2.7, most=math.inf) is Verdict.PASS
    assert check_height(2.9, 2.7, more).verdict is Verdict.PASS
