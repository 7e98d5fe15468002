"""Every row of the verdict table in checks/THEORY.md, for any numbers.

What is expected is worked out in fractions, without rounding; numbers that round to
the limit itself are left to `test_check`.
"""

import math
from dataclasses import replace
from fractions import Fraction

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from netdesign.checks import (
    Band,
    Standard,
    load_standard,
)
from netdesign.checks.rating import Open, OpenKind, judge, merge_open
from netdesign.outcome import Verdict
from netdesign.words.catalogue import as_given
from tests.checks.entries import a_force, a_resistance, a_value, no_force, unsolved
from tests.checks.row_geometry import RowGeometry, check_geometry
from tests.read_check import check_member

PASS, FAIL, OPEN = Verdict.PASS, Verdict.FAIL, Verdict.NOT_PROVEN
BARE = replace(load_standard("swiss-guideline-2007"), values=(), tables=())


FORCES = st.floats(1.0, 1e7)  # [N]
FACTORS = st.floats(0.5, 4.0)
ANY_NUMBER = st.floats()
NO_NUMBER = st.sampled_from([math.nan, math.inf, -math.inf])
GAPS = st.sampled_from(["", "1 of 4 cases failed (residual grew)"])


def profile(on_action: float | None, on_resistance: float | None) -> Standard:
    given = {"action.snow": on_action, "resistance.tendon": on_resistance}
    values = tuple(a_value(k, v) for k, v in given.items() if v is not None)
    return replace(BARE, values=values)


@st.composite
def bands(draw: st.DrawFn) -> Band:
    low, value, high = sorted(draw(st.tuples(FORCES, FORCES, FORCES)))
    return Band(low=low, value=value, high=high)


def use(force: float, on_action: float, strength: float, factor: float) -> Fraction:
    """Utilisation in full: force times factor, over resistance by factor."""
    parts = [Fraction(x) for x in (force, on_action, factor, strength)]
    return parts[0] * parts[1] * parts[2] / parts[3]


def verdict_of(action, on_action, strength, factor, gap=None):
    standard = profile(on_action, factor)
    known = a_resistance(strength)
    return check_member(force_of(action), known, standard, unsolved(gap)).verdict


def force_of(band):
    return a_force(band.value, band.low, band.high) if band else no_force()


@given(bands(), FACTORS, FORCES, FACTORS, GAPS)
@settings(max_examples=400)
def test_a_verdict_is_what_the_numbers_say(action, on_action, strength, factor, gap):
    """Rows two to five of the table: outside, a case without result, across, inside."""
    low, high = (
        use(force, on_action, strength, factor) for force in (action.low, action.high)
    )
    assume(all(abs(one - 1) > Fraction(1, 10**9) for one in (low, high)))
    if low > 1:
        expected = FAIL
    elif gap or high > 1:
        expected = OPEN
    else:
        expected = PASS
    assert verdict_of(action, on_action, strength, factor, gap) is expected


@given(bands(), FACTORS, FORCES, FACTORS, st.integers(0, 2), GAPS)
@settings(max_examples=100)
def test_a_missing_number_is_not_proven(action, on_action, strength, factor, k, gap):
    numbers = [on_action, strength, factor]
    numbers[k] = None
    assert verdict_of(action, *numbers, gap) is OPEN


@given(bands(), FACTORS, ANY_NUMBER, FACTORS)
@settings(max_examples=100)
def test_a_resistance_that_is_no_positive_number_is_not_proven(
    action, on_action, strength, factor
):
    assume(not 0.0 < strength < math.inf)
    assert verdict_of(action, on_action, strength, factor) is OPEN


@given(FACTORS, FORCES, FACTORS)
@settings(max_examples=50)
def test_no_solved_case_is_not_proven(on_action, strength, factor):
    given = (a_resistance(strength), profile(on_action, factor))
    check = check_member(no_force(), *given)
    assert check.verdict is OPEN
    assert [check.read(one) for one in ("E_k", "E_d", "μ")] == [None] * 3


@given(bands(), FORCES, st.sampled_from(["", "declared", "guessed", "tendon"]))
@settings(max_examples=50)
def test_an_unknown_basis_is_not_proven(action, strength, basis):
    on_tested = replace(
        BARE,
        values=(
            a_value("action.snow", 1.5),
            a_value("resistance.pull_out.tested", 1.35),
        ),
    )
    given_resistance = a_resistance(strength, mode="pull_out", basis=basis)
    found = check_member(force_of(action), given_resistance, on_tested)
    assert found.verdict is OPEN


@given(st.one_of(st.none(), FORCES), st.one_of(st.none(), FACTORS), GAPS)
@settings(max_examples=100)
def test_a_slack_member_passes_only_if_nothing_is_missing(strength, factor, gap):
    slack = Band(low=0.0, value=0.0, high=0.0)
    expected = OPEN if gap or not strength or not factor else PASS
    assert verdict_of(slack, factor, strength, factor, gap) is expected


@given(ANY_NUMBER, ANY_NUMBER, ANY_NUMBER, ANY_NUMBER)
@settings(max_examples=500)
def test_judge_proves_only_what_comparisons_hold(low, high, least, most):
    verdict = judge(low, high, least=least, most=most)
    is_band = math.isfinite(low) and math.isfinite(high) and low <= high
    is_band = is_band and math.isfinite(least) and most > -math.inf
    if verdict is PASS:
        assert is_band
        assert least <= low <= high <= most
    elif verdict is FAIL:
        assert is_band
        assert low > most or high < least
    else:
        inside = least <= low and high <= most
        assert not (is_band and (inside or low > most or high < least))


@given(bands(), FACTORS, FORCES, FACTORS, st.floats(1.0, 3.0))
@settings(max_examples=200)
def test_more_load_or_less_strength_never_makes_a_verdict_better(
    action, on_action, strength, factor, more
):
    order = (FAIL, OPEN, PASS)
    low, value, high = (more * one for one in (action.low, action.value, action.high))
    larger = Band(low=low, value=value, high=high)
    here = order.index(verdict_of(action, on_action, strength, factor))
    for worse in (
        verdict_of(larger, on_action, strength, factor),
        verdict_of(action, on_action * more, strength, factor),
        verdict_of(action, on_action, strength / more, factor),
        verdict_of(action, on_action, strength, factor * more),
    ):
        assert order.index(worse) <= here


ORDER = (FAIL, OPEN, Verdict.DECLARED, PASS)
KINDS = st.lists(st.sampled_from(OpenKind), max_size=5)


def points_of(kinds):
    return [Open(kind=kind, message=as_given(kind)) for kind in kinds]


@given(st.sampled_from([PASS, FAIL, OPEN]), KINDS, st.sampled_from(OpenKind), st.data())
@settings(max_examples=400)
def test_an_open_point_more_never_makes_a_verdict_better(met, kinds, more, data):
    """A document may stand in the place of numbers that are open, and of no failure."""
    here = merge_open(met, points_of(kinds))
    place = data.draw(st.integers(0, len(kinds)))
    there = merge_open(met, points_of([*kinds[:place], more, *kinds[place:]]))
    if more is OpenKind.PROVEN_ELSEWHERE and here is OPEN:
        assert there is Verdict.DECLARED
    else:
        assert ORDER.index(there) <= ORDER.index(here)
    assert (there is PASS) <= (met is PASS and not kinds)


@given(bands(), FACTORS, FORCES, FACTORS, KINDS)
@settings(max_examples=200)
def test_open_points_leave_numbers_as_they_are_and_are_all_told(
    action, on_action, strength, factor, kinds
):
    given = (force_of(action), a_resistance(strength), profile(on_action, factor))
    plain, doubted = check_member(*given), check_member(*given, points_of(kinds))
    assert doubted.utilisation_band == plain.utilisation_band
    assert ORDER.index(doubted.verdict) <= ORDER.index(plain.verdict) or kinds
    if not doubted.is_unbounded:
        told = str(doubted.plain_reason)
        elsewhere = OpenKind.PROVEN_ELSEWHERE
        assert all(one in told for one in kinds if one is not elsewhere)


@given(bands(), FACTORS, FORCES, FACTORS, st.sampled_from([PASS, FAIL, OPEN]))
@settings(max_examples=100)
def test_no_stated_comparison_stands_above_a_utilisation(
    action, on_action, strength, factor, met
):
    given = (force_of(action), a_resistance(strength), profile(on_action, factor))
    assert replace(check_member(*given), met=met).verdict is OPEN


# --- geometry: limits that are missing, in the last two rows -------------------------

ROWS = st.builds(
    RowGeometry,
    inclination_low=st.floats(0.0, 0.6),
    inclination_high=st.floats(0.6, 1.2),
    slope_angle=st.floats(0.2, 1.2),
    snow_thickness=st.floats(0.5, 5.0),
    net_height=st.floats(0.5, 5.0),
    upslope_length=st.floats(1.0, 100.0),
    gap=st.floats(0.0, 100.0),
)
FULL = load_standard("swiss-guideline-2007")
FAMILIES = ("inclination", "slope", "height", "spacing", "gap")


@given(ROWS, st.sampled_from(FAMILIES))
@settings(max_examples=100)
def test_a_missing_limit_is_not_proven_or_not_checked(row, mode):
    family = f"geometry.{mode}"
    values = tuple(v for v in FULL.values if not v.id.startswith(family))
    checked = {c.mode: c for c in check_geometry(row, replace(FULL, values=values))}
    whole = {c.mode: c for c in check_geometry(row, FULL)}
    assert set(whole) == set(FAMILIES)
    if mode in ("inclination", "slope"):
        assert checked.pop(mode).verdict is OPEN
    if mode == "height" and row.net_height < row.snow_thickness:
        assert checked.pop(mode).verdict is whole[mode].verdict is FAIL
    else:
        assert mode not in checked
    assert all(whole[other] == check for other, check in checked.items())


DECIDED = {
    "inclination_low": "inclination",
    "inclination_high": "inclination",
    "slope_angle": "slope",
    "snow_thickness": "height",
    "net_height": "height",
    "upslope_length": "spacing",
    "gap": "gap",
}


@given(ROWS, st.sampled_from(sorted(DECIDED)), NO_NUMBER)
@settings(max_examples=100)
def test_a_size_that_is_no_number_never_passes(row, name, bad):
    assume(not (name == "slope_angle" and math.isinf(bad)))  # has no tangent
    assume(not (name == "gap" and bad == math.inf))  # a free end: a condition
    spoilt = check_geometry(replace(row, **{name: bad}), FULL)
    (check,) = (one for one in spoilt if one.mode == DECIDED[name])
    assert check.verdict is OPEN
