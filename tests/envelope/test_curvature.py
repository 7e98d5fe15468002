"""What hides between the cases, for forces whose maximum is known."""

import math
from dataclasses import replace

import pytest

from netdesign.checks import Band
from netdesign.envelope.extremes import find_extremes
from netdesign.envelope.ranges import Interval, Ranges, build_cases
from netdesign.envelope.rows import estimate_hidden
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Outcome
from tests.each import each


def run(force, *, count=3, failed=()):
    ranges = Ranges.of(
        density=Interval(low=400.0, high=400.0, count=1),
        friction_angle=Interval(low=0.0, high=1.0, count=count),
        inclination=Interval(low=0.5, high=0.5, count=1),
    )
    results = []
    for place, case in enumerate(build_cases(ranges)):
        value = force(case.friction_angle)
        result = CaseResult(
            case=case,
            outcome=Outcome.CONVERGED,
            member_forces={"post": Band(low=value, value=value, high=value)},
        )
        if place in failed:
            result = replace(result, outcome=Outcome.DIVERGED, member_forces={})
        results.append(result)
    return find_extremes(results)["post"], results


@each("top", [0.15, 0.3, 0.5, 0.62, 0.75, 0.95])
def test_parabola_never_rises_above_the_estimate(top):
    def force(x):
        return 100.0 - 40.0 * (x - top) ** 2

    extreme, results = run(force)
    found = estimate_hidden(extreme, results)
    assert found.unknown == ()
    assert found.hidden == pytest.approx(40.0 * 0.5**2 * 2 / 8, rel=1e-12)
    assert force(top) <= extreme.force.value + found.hidden * (1 + 1e-12)


def test_smooth_force_between_many_samples():
    extreme, results = run(lambda x: 100.0 * math.sin(2.2 * x + 0.3), count=7)
    found = estimate_hidden(extreme, results)
    assert extreme.force.value + 1.1 * found.hidden >= 100.0
    assert found.hidden < 2.0


def test_straight_force_hides_nothing():
    extreme, results = run(lambda x: 50.0 + x)
    assert estimate_hidden(extreme, results).hidden == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(("count", "failed"), [(2, ()), (3, (0,)), (5, (1,))])
def test_what_is_not_known_is_named(count, failed):
    extreme, results = run(lambda x: 2.0 - x, count=count, failed=failed)
    found = estimate_hidden(extreme, results)
    assert (found.hidden, found.unknown) == (0.0, ("friction_angle",))
