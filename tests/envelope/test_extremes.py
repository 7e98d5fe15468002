"""Extremes of made-up results: no solver, every number is stated here."""

import random
from itertools import permutations

import numpy as np

from netdesign.checks.inputs import Band
from netdesign.envelope.extremes import describe_gap, find_extremes
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Outcome
from netdesign.words.catalogue import as_given
from netdesign.words.message import group_reasons, say
from tests.each import each


def solved(density, **forces):
    """Converged result with ``member=(low, value, high)`` [N]."""
    return CaseResult(
        case=Case(density=density, friction_angle=0.5, inclination=0.5),
        outcome=Outcome.CONVERGED,
        member_forces={
            member: Band(low=low, value=value, high=high)
            for member, (low, value, high) in forces.items()
        },
    )


def failed(density, outcome=Outcome.MAX_ITERATIONS, reason="60 rounds"):
    return CaseResult(
        case=Case(density=density, friction_angle=0.5, inclination=0.5),
        outcome=outcome,
        reason=as_given(reason),
        member_forces={},
    )


def test_largest_value_governs_and_carries_what_acts_with_it():
    results = [
        solved(250.0, foot=(9.0, 10.0, 11.0), post=(29.0, 30.0, 31.0)),
        solved(350.0, foot=(39.0, 40.0, 41.0), post=(19.0, 20.0, 21.0)),
        solved(450.0, foot=(24.0, 25.0, 26.0), post=(24.0, 25.0, 26.0)),
    ]
    extremes = find_extremes(results)
    assert set(extremes) == {"foot", "post"}
    assert extremes["foot"].force.value == 40.0
    assert extremes["foot"].governing is results[1]
    assert extremes["foot"].governing.member_forces["post"].value == 20.0
    assert extremes["post"].governing is results[0]
    assert extremes["foot"].member == "foot"


def test_band_spans_the_bands_of_all_cases_not_only_the_governing_one():
    results = [
        solved(250.0, foot=(38.0, 40.0, 41.0)),
        solved(350.0, foot=(30.0, 39.0, 50.0)),  # smaller, but less certain
        solved(450.0, foot=(38.5, 38.7, 38.9)),
    ]
    force = find_extremes(results)["foot"].force
    assert (force.low, force.value, force.high) == (38.5, 40.0, 50.0)


def test_only_converged_cases_count():
    """A failed case that carries numbers all the same cannot govern."""
    liar = CaseResult(
        case=Case(density=450.0, friction_angle=0.5, inclination=0.5),
        outcome=Outcome.BALANCE_VIOLATED,
        reason="residual",
        member_forces={"foot": Band(low=900.0, value=1000.0, high=1100.0)},
    )
    results = [solved(250.0, foot=(9.0, 10.0, 11.0)), liar, failed(350.0)]
    extreme = find_extremes(results)["foot"]
    assert extreme.force.high == 11.0
    assert extreme.governing is results[0]


@each("outcome", [o for o in Outcome if o != Outcome.CONVERGED])
def test_no_failed_outcome_takes_part(outcome):
    assert find_extremes([failed(300.0, outcome)]) == {}


def test_order_of_the_cases_does_not_matter():
    """Ties included: a slack guy has 0 N in every case."""
    results = [
        solved(250.0, foot=(9.0, 10.0, 12.0), guy=(0.0, 0.0, 0.0)),
        solved(350.0, foot=(8.0, 10.0, 11.0), guy=(0.0, 0.0, 0.0)),
        failed(400.0),
        solved(450.0, foot=(7.0, 7.0, 7.0), guy=(0.0, 0.0, 0.0)),
    ]
    expected = find_extremes(results)
    assert expected["foot"].governing is results[0]
    for shuffled in permutations(results):
        extremes = find_extremes(shuffled)
        for member, extreme in expected.items():
            assert extremes[member].force == extreme.force
            assert extremes[member].governing is extreme.governing


def test_extreme_is_the_maximum_of_many():
    draw = random.Random(7)
    values = [draw.uniform(0.0, 1e6) for _ in range(200)]
    results = [
        solved(200.0 + k, foot=(0.9 * value, value, 1.1 * value))
        for k, value in enumerate(values)
    ]
    extreme = find_extremes(results)["foot"]
    assert extreme.force.value == max(values)
    assert extreme.governing is results[values.index(max(values))]


def test_gap_is_empty_only_if_every_case_converged():
    good = solved(250.0, foot=(1.0, 2.0, 3.0))
    assert describe_gap([good, good]) is None
    assert str(describe_gap([])) == "no case was given"
    assert str(describe_gap([good, failed(300.0)])) == "1 of 2 cases failed (60 rounds)"


def test_gap_counts_cases_and_names_each_reason_once_with_its_count():
    results = [
        failed(250.0, reason="b"),
        failed(300.0, reason="a"),
        failed(350.0, reason="b"),
    ]
    assert str(describe_gap(results)) == "3 of 3 cases failed (2 times: b; a)"
    assert describe_gap(results[::-1]) == describe_gap(results)


@each("seed", range(20))
def test_a_thousand_reasons_of_a_few_kinds_are_as_many_clauses(seed):
    """Fault 19: drawn numbers in four kinds of reasons, in any order."""
    rng = np.random.default_rng([61, 19, seed])
    kinds = [
        lambda: say("steady.layers_contrast", contrast=float(rng.uniform(2, 1e9))),
        lambda: say("steady.much_slack", slack=float(rng.uniform(0.1, 0.3))),
        lambda: say("balance.suction", share=float(rng.uniform()), accepted=0.05),
        lambda: say("steady.still_moves", moved=float(rng.uniform()), rounds=60),
    ]
    drawn = [kinds[rng.integers(4)]() for _ in range(500)]
    reasons = [
        say("steady.not_found", what=one, causes=(kinds[0](),)) if k % 3 else one
        for k, one in enumerate(drawn)
    ]
    told = group_reasons(reasons)
    assert len(told) == 8
    assert sum(int(str(one).split()[0]) for one in told) == 500
    assert len("; ".join(map(str, told))) < 2000
    assert group_reasons(reasons[::-1]) == told
