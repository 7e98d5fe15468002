"""Strength of anchors against the second derivation of the statics, and by hand."""

from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.outcome import Verdict
from netdesign.resistance.ground import PullOutTests, limit_proof_load
from tests.checks.entries import a_force, a_resistance
from tests.each import each
from tests.read_check import check_member

EUROCODE = load_standard("eurocode")
ROPE = ("tendon", "rope")  # factors of a tendon that may be a rope


@each(
    "loop, utilisation",
    [(None, 0.9793), (1.0, 1.277), (0.9, 1.419), (0.8, 1.597)],
)
def test_rope_anchor_of_r5_under_the_eurocodes(loop, utilisation):
    """476.9 kN on a tendon of 560 kN: as a bar; as a rope with its loop."""
    given = a_resistance(560e3 * (loop or 1.0), factored_as=ROPE if loop else ())
    check = check_member(a_force(476.9e3 / 1.5), given, EUROCODE)
    assert check.utilisation == pytest.approx(utilisation, abs=6e-4)
    assert check.clause == ("EN 1993-1-11 6.2" if loop else "EN 1992-1-1 2.4.2.4")


def test_the_larger_factor_counts_and_none_of_them_may_lack():
    """ONR's class 3 asks more of a tendon than of a rope; nothing gets milder."""
    onr = load_standard("onr-24805-style")
    given = a_resistance(560e3, factored_as=ROPE)
    for standard, factor in ((EUROCODE, 1.5), (onr, 1.5)):
        assert check_member(a_force(1e5), given, standard).read("γ_R") == factor
    values = tuple(
        replace(one, value=1.725) if one.id == "resistance.tendon" else one
        for one in onr.values
    )
    steel = check_member(a_force(1e5), given, replace(onr, values=values))
    assert steel.read("γ_R") == 1.725
    no_rope = tuple(one for one in onr.values if one.id != "resistance.rope")
    open_ = check_member(a_force(1e5), given, replace(onr, values=no_rope))
    assert open_.verdict is Verdict.NOT_PROVEN
    assert "resistance.rope" in str(open_.reason)


def pull_out(value=None, **changes):
    given = {"mode": "pull_out", "basis": "tested", "value": value}
    return a_resistance(**(given | changes))


@each("count, utilisation", [(1, 1.326), (2, 1.232), (3, 1.137)])
def test_a_number_that_was_typed_and_the_same_from_tests(count, utilisation):
    """0.9474 as a characteristic value; times 1.40, 1.30, 1.20 as that of tests."""
    action = a_force(0.9474 * 380e3 / 1.15 / 1.5)
    tests = PullOutTests(count=count, least=380e3, mean=380e3)
    tested = check_member(action, pull_out(tests=tests), EUROCODE)
    assert tested.utilisation == pytest.approx(utilisation, abs=6e-4)
    typed = check_member(action, pull_out(380e3), EUROCODE)
    assert typed.utilisation == pytest.approx(0.9474, rel=1e-9)
    assert typed.read("γ_R") == tested.read("γ_R") == 1.15


@each("count, most_kN", [(1, 457), (2, 492), (3, 533), (5, 640)])
def test_most_that_held_tests_show_of_a_tendon_of_800_kN(count, most_kN):
    """640 kN over 1.40, 1.30, 1.20, 1.00: of tests alike the mean governs (R1)."""
    load = limit_proof_load(800e3, 800e3)
    tests = PullOutTests(count=count, least=load, mean=load)
    check = check_member(a_force(1e5), pull_out(tests=tests), EUROCODE)
    assert check.read("R_k") == pytest.approx(most_kN, abs=0.6)


def test_a_bar_that_yields_early_bounds_the_proof_load_by_its_yield():
    """GEWI 500/550: 0.80 x 550 below 0.95 x 500; 500/650: 0.95 x 500."""
    assert limit_proof_load(500.0, 550.0) == pytest.approx(440.0)
    assert limit_proof_load(500.0, 650.0) == pytest.approx(475.0)
    at_bend = 500.0 * 0.95 / 0.80
    assert limit_proof_load(500.0, at_bend) == pytest.approx(475.0)
