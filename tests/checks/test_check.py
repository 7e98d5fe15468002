"""The verdict rules, at their bounds, and with everything that can be missing."""

import math
from dataclasses import replace

import pytest

from netdesign.calculation.quantity import leaf
from netdesign.checks import (
    Band,
    Standard,
    StandardValue,
    load_standard,
)
from netdesign.checks.comparison import find_proof_factor, find_resistance
from netdesign.checks.geometry import check_inclination
from netdesign.checks.rating import judge
from netdesign.outcome import ModelError, Verdict
from netdesign.resistance.ground import PullOutTests
from netdesign.structure.members import DEPENDENT_MODES, MEMBER_MODES
from netdesign.words.catalogue import name_mode
from tests.checks.entries import a_force, a_resistance, a_value, no_force, unsolved
from tests.each import each
from tests.read_check import check_member

KN = 1e3
ABOVE_1 = math.nextafter(1.0, 2.0)
BELOW_1 = math.nextafter(1.0, 0.0)


def a_standard(*values: StandardValue) -> Standard:
    return replace(load_standard("nf-p-95-304-style"), values=values)


def plain_standard() -> Standard:
    """Factors of 1 on both sides, inclination from 25 to 35 degrees."""
    return a_standard(
        a_value("action.snow", 1.0),
        a_value("resistance.tendon", 1.0),
        a_value("geometry.inclination.min", 25.0, "deg"),
        a_value("geometry.inclination.max", 35.0, "deg"),
    )


def verdict_of(action, resistance=None, standard=None, gap=None) -> Verdict:
    return check_member(
        action,
        resistance or a_resistance(),
        standard or plain_standard(),
        unsolved(gap),
    ).verdict


@each(
    "low, high, verdict",
    [
        (0.0, 0.0, Verdict.PASS),
        (0.5, BELOW_1, Verdict.PASS),
        (0.5, 1.0, Verdict.PASS),
        (1.0, 1.0, Verdict.PASS),
        (0.5, ABOVE_1, Verdict.NOT_PROVEN),
        (1.0, ABOVE_1, Verdict.NOT_PROVEN),
        (BELOW_1, 2.0, Verdict.NOT_PROVEN),
        (ABOVE_1, ABOVE_1, Verdict.FAIL),
        (ABOVE_1, 2.0, Verdict.FAIL),
    ],
)
def test_verdict_at_a_utilisation_of_one(low, high, verdict):
    assert judge(low, high, least=0.0, most=1.0) is verdict
    # in kN, so that no unit's factor rounds what is next to the limit
    force = leaf("E_k", high, "kN", "foot_anchor", band=(low, high))
    assert verdict_of(force, a_resistance(KN)) is verdict


@each(
    "low, value, high",
    [
        (2.0, 1.0, 3.0),
        (1.0, 3.0, 2.0),
        (-1.0, 1.0, 2.0),
        (math.nan, 1.0, 2.0),
        (1.0, math.nan, 2.0),
        (1.0, 1.0, math.nan),
        (1.0, 1.0, math.inf),
    ],
)
def test_band_refuses_disorder_and_what_is_no_number(low, value, high):
    with pytest.raises(ModelError, match="0 <= low <= value <= high"):
        Band(low=low, value=value, high=high)


def test_numbers_of_a_check_are_action_times_and_resistance_over_factor():
    standard = a_standard(
        a_value("action.snow", 1.5), a_value("resistance.tendon", 1.25)
    )
    action = a_force(100 * KN, 90 * KN, 120 * KN)
    result = check_member(action, a_resistance(500 * KN), standard)
    assert (result.id, result.clause) == ("foot_anchor.tendon", "4.2")
    assert (result.member, result.mode) == ("foot_anchor", "tendon")
    assert result.read("E_k") == 100.0
    factors = result.read("γ_E"), result.read("γ_R")
    assert factors == (1.5, 1.25)
    assert result.step_of["E_d"].ends == (135.0, 150.0, 180.0)
    assert result.read("R_k") == 500.0
    assert result.read("R_d") == 400.0
    assert result.step_of["μ"].ends == (0.3375, 0.375, 0.45)
    assert result.verdict is Verdict.PASS


@each("mode", [mode for _, mode in (*MEMBER_MODES, *DEPENDENT_MODES)])
@each("basis", ["", "tested", "declared"])
def test_every_lack_of_a_factor_names_its_mode_in_words(mode, basis):
    """Of a profile with a factor of the action only."""
    resistance = a_resistance(mode=mode, basis=basis)
    bare = a_standard(a_value("action.snow", 1.0))
    result = check_member(a_force(0.5), resistance, bare)
    told = str(result.reason)
    assert f"resistance.{mode}, " in told  # what its profile has to be given
    assert f"({name_mode(mode)})" in told


def test_all_that_is_missing_is_told_at_once():
    result = check_member(
        no_force(),
        a_resistance(None),
        a_standard(),
        unsolved("worker ended"),
    )
    assert result.verdict is Verdict.NOT_PROVEN
    for part in ("worker ended", "Anchors!B4", "action.snow", "resistance.tendon"):
        assert part in str(result.reason)


def test_member_that_may_be_tight_needs_its_resistance():
    action = leaf("E_k", 0.0, "kN", "foot_anchor", band=(0.0, 5e-324))
    assert verdict_of(action, a_resistance(None)) is Verdict.NOT_PROVEN


def just_below(degrees: float) -> float:
    return math.nextafter(math.radians(degrees), 0.0)


def just_above(degrees: float) -> float:
    return math.nextafter(math.radians(degrees), 2.0)


@each(
    "low, high, verdict",
    [
        (math.radians(25), math.radians(35), Verdict.PASS),
        (math.radians(30), math.radians(30), Verdict.PASS),
        (just_below(25), math.radians(30), Verdict.NOT_PROVEN),
        (math.radians(30), just_above(35), Verdict.NOT_PROVEN),
        (math.radians(10), math.radians(25), Verdict.NOT_PROVEN),
        (math.radians(10), just_below(25), Verdict.FAIL),
        (just_above(35), math.radians(40), Verdict.FAIL),
        (25.0, 35.0, Verdict.FAIL),  # degrees taken for radians
        (math.nan, math.radians(30), Verdict.NOT_PROVEN),
        (math.radians(30), math.inf, Verdict.NOT_PROVEN),
    ],
)
def test_inclination_against_the_range_of_the_profile(low, high, verdict):
    result = check_inclination(low, high, plain_standard())
    assert result.verdict is verdict
    assert result.id == "geometry.inclination"
    assert result.clause == "4.2"


def test_without_a_factor_there_is_no_clause():
    result = check_member(a_force(0.5), a_resistance(), a_standard())
    assert result.clause == "-"
    inclination = check_inclination(0.5, 0.6, a_standard())
    assert inclination.clause == "-"


@pytest.mark.parametrize("end", ["min", "max"])
def test_one_limit_of_the_inclination_alone_proves_nothing(end):
    values = [v for v in plain_standard().values if v.id.endswith(end)]
    result = check_inclination(0.5, 0.55, a_standard(*values))
    assert result.verdict is Verdict.NOT_PROVEN


@pytest.mark.parametrize("left_out", ["mean", "least"])
def test_tests_need_both_of_their_correlation_factors(left_out):
    """Three tests of 300, 330 and 390 kN; EN 1997 correlates mean and least."""
    standard = load_standard("eurocode")
    tests = PullOutTests(count=3, mean=340 * KN, least=300 * KN)
    known = a_resistance(None, mode="pull_out", basis="tested", tests=tests)
    found = find_resistance(known, standard)
    assert found.lacks == ()
    assert 0.0 < found.value <= 300
    tables = tuple(t for t in standard.tables if not t.id.endswith(left_out))
    found = find_resistance(known, replace(standard, tables=tables))
    assert found.value is None
    (lack,) = found.lacks
    assert str(lack).startswith("the profile has no correlation factors for 3 tests")


@pytest.mark.parametrize(
    ("profile", "factor"),
    [("eurocode", 1.2 * 1.15), ("nf-p-95-304-style", 1.2 * 1.35)],
)
def test_proof_load_proves_the_anchor_by_as_many_held_tests(profile, factor):
    assert find_proof_factor(load_standard(profile)) == pytest.approx(factor)
    bare = load_standard(profile)
    bare = replace(bare, values=tuple(v for v in bare.values if v.id != "tests.count"))
    assert find_proof_factor(bare) is None
    assert find_proof_factor(replace(load_standard(profile), tables=())) is None
