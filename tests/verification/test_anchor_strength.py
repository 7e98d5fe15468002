"""Strength of anchors against the second derivation of the statics, and by hand."""

import math
from dataclasses import replace
from itertools import pairwise

import pytest

from netdesign.checks import check_member, load_standard
from netdesign.checks.schema import BY_REPORT
from netdesign.outcome import Verdict
from netdesign.resistance.ground import (
    Bond,
    PullOutTests,
    compute_pull_out_from_bond,
    compute_steel_bond,
    limit_proof_load,
)
from netdesign.study.row_resistances import shorten_bond
from tests.checks.entries import a_force, a_resistance
from tests.each import each

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
    typed = check_member(action, pull_out(380e3, basis=BY_REPORT), EUROCODE)
    assert typed.utilisation == pytest.approx(0.9474, rel=1e-9)
    assert typed.read("γ_R") == tested.read("γ_R") == 1.15


@each("tendon_kN, limit_kN", [(400, 320), (480, 384), (800, 640), (1400, 1120)])
def test_proof_load_that_the_tendons_of_the_example_allow(tendon_kN, limit_kN):
    assert limit_proof_load(tendon_kN, tendon_kN) == pytest.approx(limit_kN, rel=1e-12)


@each("count, most_kN", [(1, 457), (2, 492), (3, 533), (5, 640)])
def test_most_that_held_tests_show_of_a_tendon_of_800_kN(count, most_kN):
    """640 kN over 1.40, 1.30, 1.20, 1.00: of tests alike the mean governs (R1).

    The second derivation has 533 and 610 kN by the factors of the least alone.
    """
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


def bonded(length, free=0.0, steel=None, **changes):
    """Pull-out resistance of 90 mm in gravel, 95 kPa, and its bond."""
    value = compute_pull_out_from_bond(
        drill_diameter=0.09, bond_length=length, bond_stress=95e3
    )
    given = {"basis": "computed", "bond": Bond(length=length, free=free, steel=steel)}
    return pull_out(**({"value": value} | given | changes))


@each(
    "length, free, resistance_kN",
    [
        (5.0, 1.0, 71.1),
        (12.0, 1.0, 142.1),  # linear 170.5
        (20.0, 1.0, 142.1),  # 284.2
        (29.0, 3.0, 142.1),  # 412.1
        (5.0, 0.0, 56.8),
        (11.0, 0.0, 142.1),
        (12.0, 0.0, 142.1),
        (5.0, 0.5, 71.05 * 4.5 / 5.0),
    ],
)
def test_bond_less_its_first_metre_and_no_more_than_ten(length, free, resistance_kN):
    """Second derivation, over 1.89, the factor without a model factor."""
    found = shorten_bond(bonded(length, free), load_standard("nf-p-95-304-style"))
    assert found.value / 1e3 / 1.89 == pytest.approx(resistance_kN, abs=0.06)


def test_bond_grows_with_its_length_without_a_step():
    profile = load_standard("eurocode")
    lengths = [1.01 + 0.01 * k for k in range(1500)]
    found = [shorten_bond(bonded(one), profile).value for one in lengths]
    steps = [after - before for before, after in pairwise(found)]
    most = 95e3 * math.pi * 0.09 * 0.01
    assert min(steps) >= -1e-6
    assert max(steps) <= most * (1.0 + 1e-6)
    freed = [shorten_bond(bonded(4.0, 0.1 * k), profile).value for k in range(15)]
    assert freed == sorted(freed)
    none = shorten_bond(bonded(0.9), profile)
    assert none.value is None
    assert "first metre" in str(none.lack)


def test_bond_of_steel_and_grout():
    """40 mm on 4 m: 1352 kN by design; less than the ground in granite alone."""
    assert compute_steel_bond(0.04, 4.0) / 1e3 == pytest.approx(1352, rel=4e-3)  # 1357
    by_hand = math.pi * 0.04 * 4.0 * 2.7e6
    assert compute_steel_bond(0.04, 4.0) == pytest.approx(by_hand, rel=1e-12)
    profile = load_standard("eurocode")
    strong = bonded(4.0, 1.0, 0.016, value=2e6)
    found = shorten_bond(strong, profile)
    factor = profile.find("resistance.pull_out.computed").value
    assert factor == pytest.approx(1.15 * 1.40 * 1.25)
    by_steel = factor * math.pi * 0.016 * 4.0 * 2.7e6
    assert found.value == pytest.approx(by_steel, rel=1e-12)
    assert "bond of steel and grout" in str(found.derivation)
    rope = shorten_bond(bonded(4.0, 1.0, None, value=2e6), profile)
    assert rope.value == pytest.approx(2e6, rel=1e-12)


def test_a_profile_without_a_longest_bond_proves_none():
    profile = load_standard("eurocode")
    kept = tuple(one for one in profile.values if one.id != "bond.length.max")
    found = shorten_bond(bonded(4.0), replace(profile, values=kept))
    assert found.value is None
    assert "bond.length.max" in str(found.lack)
