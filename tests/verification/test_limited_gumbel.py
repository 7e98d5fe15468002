"""Gumbel's distribution of maxima that are known above a limit alone."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.stats import genextreme, gumbel_r

from netdesign.addons.winter import statistics
from netdesign.addons.winter.statistics import LEAST_ABOVE, fit_limited
from tests.each import each

MODE, SCALE = 16.3, 4.7
PERIODS = (30.0, 100.0)


def draw(winters, samples=1, seed=17):
    rng = np.random.default_rng(seed + winters)
    return rng.gumbel(MODE, SCALE, size=(samples, winters))


def find_truth(period):
    return MODE - SCALE * math.log(-math.log(1.0 - 1.0 / period))


@each("winters, share", [(19, 0.0), (19, 0.3), (37, 0.6), (58, 0.3)])
def test_fit_is_the_largest_likelihood(winters, share):
    """Density above the limit, probability below it; without one the whole density."""
    sample = draw(winters)[0]
    limit = float(np.quantile(sample, share)) - (share == 0.0) * 1e-9

    def oppose(parameters):
        mode, scale = parameters[0], math.exp(parameters[1])
        above = sample[sample > limit]
        below = (winters - above.size) * gumbel_r.logcdf(limit, mode, scale)
        return -gumbel_r.logpdf(above, mode, scale).sum() - below

    start = [sample.mean(), math.log(sample.std())]
    best = minimize(oppose, start, method="Nelder-Mead", options={"xatol": 1e-7})
    found = fit_limited(list(sample), limit)
    assert found.location == pytest.approx(best.x[0], rel=1e-4)
    assert found.scale == pytest.approx(math.exp(best.x[1]), rel=1e-4)
    if share == 0.0:
        assert found.below == 0
        assert (found.location, found.scale) == pytest.approx(
            gumbel_r.fit(sample), rel=1e-4
        )


def test_what_lies_below_the_limit_may_be_any_number_below():
    sample = draw(31)[0]
    limit = float(np.quantile(sample, 0.4))
    one = fit_limited(list(sample), limit)
    other = fit_limited([0.0 if x <= limit else x for x in sample], limit)
    assert (one.location, one.scale, one.below) == (
        *(other.location, other.scale),
        other.below,
    )
    assert one.find_interval(100.0) == other.find_interval(100.0)


@each("share", [0.1, 0.5, 0.9])
def test_many_winters_find_the_distribution(share, monkeypatch):
    monkeypatch.setattr(statistics, "_BOOTSTRAP", 2)
    limit = float(gumbel_r.ppf(share, MODE, SCALE))
    found = fit_limited(list(draw(40_000)[0]), limit)
    assert found.location == pytest.approx(MODE, rel=0.02)
    assert found.scale == pytest.approx(SCALE, rel=0.02)
    assert found.mean == pytest.approx(gumbel_r.mean(MODE, SCALE), rel=0.02)
    assert found.variation == pytest.approx(
        gumbel_r.std(MODE, SCALE) / gumbel_r.mean(MODE, SCALE), rel=0.03
    )
    for period in PERIODS:
        value, _ = found.find_return_value(period)
        assert value == pytest.approx(find_truth(period), rel=0.02)


def test_moved_and_stretched_maxima_move_and_stretch_all():
    sample, limit = draw(35)[0], MODE
    one, other = (
        fit_limited(list(sample), limit),
        fit_limited(list(3.0 * sample - 7.0), 3.0 * limit - 7.0),
    )
    for period in PERIODS:
        low, high = one.find_interval(period)
        value, error = one.find_return_value(period)
        assert other.find_interval(period) == pytest.approx(
            (3.0 * low - 7.0, 3.0 * high - 7.0), rel=1e-9
        )
        assert other.find_return_value(period) == pytest.approx(
            (3.0 * value - 7.0, 3.0 * error), rel=1e-9
        )
        assert high - value > value - low > 0.0


def test_too_few_winters_or_too_few_above_the_limit_have_no_fit():
    sample = sorted(draw(23)[0])
    assert fit_limited(sample[:14], -1e3) is None
    assert fit_limited(sample, sample[-1]) is None
    assert fit_limited(sample, sample[-LEAST_ABOVE]) is None
    assert fit_limited(sample, sample[-LEAST_ABOVE - 1]).below == 23 - LEAST_ABOVE


@pytest.mark.long
@pytest.mark.parametrize("winters", [15, 30, 60])
def test_upper_ends_hold_in_nineteen_of_twenty_samples(winters, monkeypatch):
    """30 % below the limit: the shares of addons/winter/THEORY.md, section 10."""
    monkeypatch.setattr(statistics, "_BOOTSTRAP", 400)
    limit = float(gumbel_r.ppf(0.3, MODE, SCALE))
    fits = [fit_limited(list(one), limit) for one in draw(winters, 2000)]
    fits = [one for one in fits if one]
    assert len(fits) > 1800
    for period in PERIODS:
        truth = find_truth(period)
        low, high = np.array([one.find_interval(period) for one in fits]).T
        assert 0.93 < np.mean(high >= truth) < 0.97
        assert 0.92 < np.mean(low <= truth) < 0.97
        values, errors = np.array([one.find_return_value(period) for one in fits]).T
        assert values.mean() == pytest.approx(truth, rel=0.025)
        assert errors.mean() == pytest.approx(values.std(), rel=0.08)


@pytest.mark.long
@each("shape, low, held", [(0.1, -0.079, 0.83), (0.2, -0.159, 0.56)])
def test_a_heavier_tail_makes_the_value_too_low(shape, low, held, monkeypatch):
    """By as much as addons/winter/THEORY.md says."""
    monkeypatch.setattr(statistics, "_BOOTSTRAP", 200)
    tail = genextreme(-shape, MODE, SCALE)
    samples = tail.rvs(size=(1000, 40), random_state=5)
    fits = [fit_limited(list(one), float(tail.ppf(0.3))) for one in samples]
    truth = tail.ppf(0.99)
    values = [one.find_return_value(100.0)[0] for one in fits if one]
    highs = np.array([one.find_interval(100.0)[1] for one in fits if one])
    assert np.mean(values) / truth - 1.0 == pytest.approx(low, abs=0.015)
    assert np.mean(highs >= truth) == pytest.approx(held, abs=0.04)
