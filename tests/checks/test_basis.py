"""What a pass may rest on: declarations, doubts, information, nets below their snow."""

import math
from dataclasses import replace

import pytest

from netdesign.checks import Check, Open, OpenKind, Proof, load_standard
from netdesign.checks.geometry import check_height
from netdesign.checks.rating import judge
from netdesign.outcome import Verdict
from tests.checks.entries import a_force, a_resistance, a_value
from tests.each import each
from tests.read_check import check_member

PROFILE = load_standard("nf-p-95-304-style")
BARE = replace(
    PROFILE, values=(a_value("action.snow", 1.0), a_value("resistance.tendon", 1.0))
)
PROOF = Proof(
    document="Report G-17", author="B. Rüegg", date="2026-03-09", cell="Declared!B2"
)


def check(
    low: float, high: float, strength: float | None = 1.0, proof: Proof | None = None
) -> Check:
    action = a_force(low, low, high)
    told = proof.describe() if proof else None
    points = [Open(kind=OpenKind.PROVEN_ELSEWHERE, message=told, proof=proof)]
    return check_member(action, a_resistance(strength), BARE, points if proof else [])


@pytest.mark.parametrize(
    ("low", "high", "strength"), [(0.2, 0.9, 1.0), (0.7, 1.3, 1.0), (0.4, 0.6, None)]
)
def test_what_does_not_fail_becomes_declared_and_keeps_its_numbers(low, high, strength):
    computed = check(low, high, strength)
    found = check(low, high, strength, PROOF)
    assert found.verdict is Verdict.DECLARED
    assert found.steps == computed.steps
    assert found.declared is PROOF
    told = str(found.reason)
    for part in ("Report G-17", "B. Rüegg", "2026-03-09", "Declared!B2"):
        assert part in told
    assert str(computed.reason).rstrip(".") in told
    undated = check(low, high, strength, replace(PROOF, date="")).declared.describe()
    assert undated.key != found.declared.describe().key


def test_what_is_computed_and_fails_stays_a_failure():
    found = check(1.1, 1.7, proof=PROOF)
    assert check(1.1, 1.7).verdict is found.verdict is Verdict.FAIL
    assert "Report G-17" in str(found.reason)
    assert "cannot change that" in str(found.reason)


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
