"""Intervals of return values: how often they hold the truth, in drawn winters.

Truth: samples of known distributions.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import genextreme

from netdesign.addons.winter.statistics import fit_extreme_values, fit_gumbel

SAMPLES = 2000
PERIODS = (30.0, 100.0)


def draw(shape, winters, *, mean=16.0, scale=4.7):
    rng = np.random.default_rng(round(1000 * winters + 100 * abs(shape)))
    return genextreme.rvs(
        -shape, mean, scale, size=(SAMPLES, winters), random_state=rng
    )


@pytest.mark.parametrize("winters", [15, 30, 60])
@pytest.mark.parametrize("period", PERIODS)
def test_upper_ends_hold_in_nineteen_of_twenty_samples(winters, period):
    truth = 16.0 - 4.7 * math.log(-math.log(1.0 - 1.0 / period))
    ends = [fit_gumbel(list(one)).find_interval(period) for one in draw(0.0, winters)]
    low, high = np.array(ends).T
    error = 3.0 * math.sqrt(0.95 * 0.05 / SAMPLES)
    assert np.mean(high >= truth) == pytest.approx(0.95, abs=error)
    assert np.mean(low <= truth) == pytest.approx(0.95, abs=error)


@pytest.mark.parametrize("winters", [15, 30, 60])
@pytest.mark.parametrize("period", [20.0, 100.0])
def test_a_further_winter_exceeds_the_predictive_value_once_in_a_period(
    winters, period
):
    """Truth: another draw of the distribution that the sample is from."""
    samples = draw(0.0, winters)
    chances, plain = [], []
    for one in samples[:1000]:
        fit = fit_gumbel(list(one))
        wide = replace(fit, deviation=fit.find_predictive_variation(period) * fit.mean)
        value, _ = wide.find_return_value(period)
        chances.append(genextreme.sf(value, 0.0, 16.0, 4.7))
        value, _ = fit.find_return_value(period)
        plain.append(genextreme.sf(value, 0.0, 16.0, 4.7))
    error = 4.0 * np.std(chances) / math.sqrt(len(chances))
    assert np.mean(chances) == pytest.approx(1.0 / period, abs=error)
    assert np.mean(plain) > 1.0 / period + error / 4.0


@pytest.mark.parametrize("winters", [15, 40])
def test_the_upper_end_is_farther_away(winters):
    fits = [fit_gumbel(list(one)) for one in draw(0.0, winters)[:50]]
    for one in fits:
        value, _ = one.find_return_value(100.0)
        low, high = one.find_interval(100.0)
        assert high - value > value - low > 0.0


@pytest.mark.parametrize("shape", [-0.15, 0.0, 0.1])
def test_l_moments_find_the_distribution(shape):
    sample = genextreme.rvs(-shape, 16.0, 4.7, size=40_000, random_state=3)
    found = fit_extreme_values(list(sample))
    assert found.shape == pytest.approx(shape, abs=0.02)
    assert found.location == pytest.approx(16.0, rel=0.01)
    assert found.scale == pytest.approx(4.7, rel=0.02)
    for period in PERIODS:
        truth = genextreme.ppf(1.0 - 1.0 / period, -shape, 16.0, 4.7)
        assert found.find_return_value(period) == pytest.approx(truth, rel=0.02)


@pytest.mark.parametrize("shape", [-0.1, 0.0, 0.1])
def test_intervals_of_the_gev_hold_nearly_as_often(shape):
    """The shape is uncertain, too: theory says a little too narrow."""
    truth = genextreme.ppf(0.99, -shape, 16.0, 4.7)
    fits = [fit_extreme_values(list(one)) for one in draw(shape, 40)[:100]]
    ends = np.array([one.find_interval(100.0) for one in fits])
    assert 0.8 < np.mean(ends[:, 1] >= truth) <= 1.0


def test_moved_and_stretched_maxima_move_and_stretch_the_ends():
    sample = draw(0.1, 35)[0]
    for fit in (fit_gumbel, fit_extreme_values):
        one = np.array(fit(list(sample)).find_interval(100.0))
        other = np.array(fit(list(3.0 * sample - 7.0)).find_interval(100.0))
        assert other == pytest.approx(3.0 * one - 7.0, rel=1e-4)


def test_winters_all_alike_have_no_shape():
    assert fit_extreme_values([7.3] * 20) is None
    assert fit_extreme_values(list(range(14))) is None
