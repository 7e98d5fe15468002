"""Fractiles of single tests: closed forms, held tests, what is not said."""

import math
import random

import numpy as np
import pytest
from scipy.stats import CensoredData, norm, t

from netdesign.outcome import ModelError
from netdesign.resistance.fractile import (
    find_fractile,
    find_fractile_of_known_scatter,
)
from netdesign.resistance.pull_out import SingleTest
from tests.each import each


def pull(*loads, held=()):
    """Tests of loads [kN]; those of ``held`` held."""
    return [SingleTest(load=1e3 * one, is_held=False) for one in loads] + [
        SingleTest(load=1e3 * one, is_held=True) for one in held
    ]


@pytest.mark.parametrize(
    ("count", "known", "unknown"),
    [(3, 1.89, 3.37), (4, 1.83, 2.63), (5, 1.80, 2.33), (10, 1.72, 1.92)],
)
def test_numbers_of_standard_deviations_are_those_of_en_1990(count, known, unknown):
    """Table D1, to its two digits: 1.899 is printed 1.89 with three tests."""
    tests = pull(*(300.0 + 20.0 * k for k in range(count)))
    found = find_fractile_of_known_scatter(tests, 0.3)
    sigma = math.sqrt(math.log(1.09))
    assert math.log(found.factor) / sigma == pytest.approx(known, abs=0.011)
    found = find_fractile(tests)
    deviation = float(np.std([math.log(one.load) for one in tests], ddof=1))
    assert math.log(found.factor) / deviation == pytest.approx(unknown, abs=0.006)


def test_three_tests_by_hand():
    """ln: mean 5.69256, deviation 0.18330; 3.372 of them below: exp(5.0745) = 159.9."""
    tests = pull(250.0, 290.0, 360.0)
    assert find_fractile(tests).value / 1e3 == pytest.approx(159.9, abs=0.1)
    median = (250.0 * 290.0 * 360.0) ** (1 / 3)
    assert find_fractile(tests).median / 1e3 == pytest.approx(median, rel=1e-12)


@each("seed", range(6))
def test_held_tests_have_the_likelihood_of_scipy(seed):
    rng = random.Random(seed)
    pulled = [rng.uniform(200.0, 500.0) for _ in range(rng.randint(2, 6))]
    held = [rng.uniform(200.0, 400.0) for _ in range(rng.randint(1, 4))]
    found = find_fractile(pull(*pulled, held=held))
    logs = np.log(1e3 * np.array([*pulled, *held]))
    is_held = np.array([False] * len(pulled) + [True] * len(held))
    mean, deviation = norm.fit(CensoredData.right_censored(logs, is_held))
    assert found.median == pytest.approx(math.exp(mean), rel=1e-3)
    n = len(pulled)
    quantile = t.ppf(0.95, n - 1) * math.sqrt((n + 1) / (n - 1))
    assert math.log(found.factor) == pytest.approx(quantile * deviation, rel=2e-3)


@each("seed", range(200))
def test_known_scatter_never_gains_by_a_pull_out_at_the_same_load(seed):
    """So that a result that is not said counts as pulled out."""
    rng = random.Random(seed)
    pulled = [rng.uniform(50.0, 900.0) for _ in range(rng.randint(1, 5))]
    held = [rng.uniform(50.0, 900.0) for _ in range(rng.randint(1, 4))]
    variation = rng.uniform(0.05, 0.6)
    stays = find_fractile_of_known_scatter(pull(*pulled, held=held), variation)
    gives_way = pull(*pulled, held[0], held=held[1:])
    less = find_fractile_of_known_scatter(gives_way, variation)
    open_ = [*pull(*pulled, held=held[1:]), SingleTest(load=1e3 * held[0])]
    assert less.value <= stays.value
    not_said = find_fractile_of_known_scatter(open_, variation).value
    assert not_said == pytest.approx(less.value, rel=1e-12)


@each("seed", range(200))
def test_a_result_that_is_not_said_is_never_better_than_any_that_is(seed):
    rng = random.Random(seed)
    loads = [rng.uniform(5e4, 9e5) for _ in range(rng.randint(1, 6))]
    tests = [SingleTest(load=x, is_held=rng.random() < 0.7) for x in loads]
    variation = rng.uniform(0.05, 0.6)
    said = find_fractile_of_known_scatter(tests, variation).value
    empty = rng.sample(range(len(tests)), rng.randint(1, len(tests)))
    for place in empty:
        tests[place] = SingleTest(load=loads[place])
    left = find_fractile_of_known_scatter(tests, variation).value
    assert left <= said * (1.0 + 1e-12)


def test_held_tests_alone_are_a_lower_bound():
    loads = (300.0, 310.0, 320.0)
    held = find_fractile_of_known_scatter(pull(held=loads), 0.3)
    assert held == find_fractile_of_known_scatter(pull(*loads), 0.3)


@pytest.mark.parametrize(
    ("tests", "told"),
    [
        (pull(held=(300.0, 310.0, 320.0)), "two tests that pulled out"),
        (pull(300.0, held=(310.0, 320.0)), "number: 1"),
        (pull(300.0, 300.0, held=(320.0,)), "one and the same load"),
        ([*pull(300.0, 350.0), SingleTest(load=4e5)], "outcome of each test"),
    ],
)
def test_a_scatter_that_would_be_guessed_gives_no_fractile(tests, told):
    with pytest.raises(ModelError, match=told):
        find_fractile(tests)


def test_a_test_has_a_load():
    with pytest.raises(ModelError, match="load of a test"):
        SingleTest(load=0.0)
