"""Return values, their errors and intervals in drawn winters; density by depth."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import genextreme, gumbel_r

from netdesign.addons.winter.statistics import TAILS, Gumbel, fit_gumbel
from netdesign.snow.snowpack import find_model_code_density
from tests.each import each

SAMPLES = 2000
PERIODS = (30.0, 100.0)


def draw(shape, winters, *, mean=16.0, scale=4.7):
    rng = np.random.default_rng(round(1000 * winters + 100 * abs(shape)))
    return genextreme.rvs(
        -shape, mean, scale, size=(SAMPLES, winters), random_state=rng
    )


@cache
def list_fits(shape, winters):
    return [fit_gumbel(list(one)) for one in draw(shape, winters)]


def spread(find, fits):
    """What ``find`` gives of all fits: it moves and stretches with them."""
    ends = np.array(find(replace(fits[0], mean=0.0, deviation=1.0)))
    means, deviations = np.array([(one.mean, one.deviation) for one in fits]).T
    found = means + np.outer(ends, deviations)
    for number in range(0, len(fits), 97):
        assert found[:, number] == pytest.approx(find(fits[number]), rel=1e-9)
    return found


@pytest.mark.parametrize("winters", [15, 30, 60])
def test_upper_ends_hold_in_nineteen_of_twenty_samples(winters):
    fits = list_fits(0.0, winters)
    for period in PERIODS:
        truth = 16.0 - 4.7 * math.log(-math.log(1.0 - 1.0 / period))
        low, high = spread(lambda fit, t=period: fit.find_interval(t), fits)
        error = 3.0 * math.sqrt(0.95 * 0.05 / SAMPLES)
        assert np.mean(high >= truth) == pytest.approx(0.95, abs=error)
        assert np.mean(low <= truth) == pytest.approx(0.95, abs=error)


@pytest.mark.parametrize("winters", [15, 30, 60])
@pytest.mark.parametrize("period", [20.0, 100.0])
def test_a_further_winter_exceeds_the_predictive_value_once_in_a_period(
    winters, period
):
    """Truth: another draw of the distribution that the sample is from."""
    fits = list_fits(0.0, winters)[:1000]
    more = fits[0].find_predictive_variation(period) / fits[0].variation
    for one in fits[::97]:
        found = one.find_predictive_variation(period)
        assert found == pytest.approx(more * one.variation, rel=1e-9)
    wide = [replace(one, deviation=more * one.deviation) for one in fits]
    chances, plain = (
        genextreme.sf([x.find_return_value(period)[0] for x in some], 0.0, 16.0, 4.7)
        for some in (wide, fits)
    )
    error = 4.0 * np.std(chances) / math.sqrt(len(chances))
    assert np.mean(chances) == pytest.approx(1.0 / period, abs=error)
    assert np.mean(plain) > 1.0 / period + error / 4.0


@pytest.mark.parametrize("winters", [15, 40])
def test_the_upper_end_is_farther_away(winters):
    for one in list_fits(0.0, winters)[:50]:
        value, _ = one.find_return_value(100.0)
        low, high = one.find_interval(100.0)
        assert high - value > value - low > 0.0


@each("winters", [15, 30, 50])
@each("shape", TAILS)
def test_the_upper_end_of_a_heavier_tail_holds_in_nineteen_of_twenty(winters, shape):
    """Fault 12: coverage in drawn samples of that tail; Gumbel's ends miss more."""
    fits = list_fits(shape, winters)
    for period in PERIODS:
        truth = genextreme.ppf(1.0 - 1.0 / period, -shape, 16.0, 4.7)
        _, ends = spread(lambda fit, t=period: fit.find_tail(t, shape), fits)
        error = 3.0 * math.sqrt(0.95 * 0.05 / SAMPLES)
        assert np.mean(ends >= truth) == pytest.approx(0.95, abs=error)
        _, plain = spread(lambda fit, t=period: fit.find_interval(t), fits)
        assert np.mean(plain < truth) > 0.08


@pytest.mark.parametrize(
    ("period", "shape", "more"),
    [(100.0, 0.1, 0.318), (100.0, 0.2, 0.541), (30.0, 0.1, 0.0506), (30.0, 0.2, 0.008)],
)
def test_what_a_tail_adds_by_hand(period, shape, more):
    """Gamma(0.9) = 1.06863, Gamma(0.8) = 1.16423, Gamma(0.6) = 1.48919.

    T = 100, xi = 0.1: w = 5.841, mean 0.6863, deviation 1.492: 3.455 s; Gumbel 3.137 s.
    """
    fit = fit_gumbel([float(one) for one in draw(0.0, 20)[0]])
    found = fit.find_tail(period, shape)[0] - fit.find_return_value(period)[0]
    assert found / fit.deviation == pytest.approx(more, abs=1e-3)


def test_moved_and_stretched_maxima_move_and_stretch_the_ends():
    sample = draw(0.1, 35)[0]
    for find in (
        lambda fit: fit.find_interval(100.0),
        lambda fit: fit.find_tail(100.0, 0.1),
    ):
        one = np.array(find(fit_gumbel(list(sample))))
        other = np.array(find(fit_gumbel(list(3.0 * sample - 7.0))))
        assert other == pytest.approx(3.0 * one - 7.0, rel=1e-4)


VARIATION = 0.30  # of the maxima, whose mean is 1
SCALE = VARIATION * math.sqrt(6.0) / math.pi
MODE = 1.0 - np.euler_gamma * SCALE
X_100 = MODE - SCALE * math.log(-math.log(0.99))


@pytest.mark.parametrize("period", [30.0, 100.0])
def test_error_follows_from_skewness_and_kurtosis(period):
    """Delta method for x = m + K s: 1 + g K + (k - 1) K^2 / 4, of any distribution."""
    skewness, excess = (float(one) for one in gumbel_r.stats(moments="sk"))
    factor = (gumbel_r.ppf(1.0 - 1.0 / period) - gumbel_r.mean()) / gumbel_r.std()
    spread = 1.0 + skewness * factor + (excess + 2.0) / 4.0 * factor**2
    _, error = Gumbel(count=15, mean=1.0, deviation=VARIATION).find_return_value(period)
    expected = VARIATION * math.sqrt(spread / 15)
    assert error == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize(
    ("winters", "closed", "drawn", "stated"),
    [
        (15, 0.157, 0.147, 0.151),
        (30, 0.111, 0.107, 0.109),
        (60, 0.0783, 0.0775, 0.0777),
    ],
)
def test_x_100_of_drawn_winters_scatters_as_it_says(winters, closed, drawn, stated):
    """16 % of 15 winters: by the closed form, and as far as samples scatter."""
    fit = Gumbel(count=winters, mean=1.0, deviation=VARIATION)
    assert fit.find_return_value(100.0)[1] / X_100 == pytest.approx(closed, rel=5e-3)
    rng = np.random.default_rng(1907)
    samples = rng.gumbel(MODE, SCALE, size=(8000, winters))
    found = [fit_gumbel(list(one)).find_return_value(100.0) for one in samples]
    values, errors = np.array(found).T / X_100
    scatter = np.std(values)
    assert scatter == pytest.approx(drawn, rel=0.03)
    assert np.mean(errors) == pytest.approx(stated, rel=0.01)


@pytest.mark.parametrize(
    ("height", "unit_weight"), [(1.0, 2.41), (2.0, 3.07), (3.0, 3.55), (4.0, 3.87)]
)
def test_model_code_by_depth(height, unit_weight):
    """Its figures; and the mean over depth of the unit weight that it stands for."""

    def at(z):
        """Unit weight at a depth [kN/m3]: the load's derivative."""
        grown = 1.7 / 5.0 * math.exp(z / 0.85)
        return 5.0 * grown / (1.0 - 1.7 / 5.0 + grown)

    found = find_model_code_density(height) * 9.81 / 1e3
    assert found == pytest.approx(unit_weight, abs=5e-3)
    assert found == pytest.approx(quad(at, 0.0, height)[0] / height, rel=1e-9)
