"""What annual maxima tell: error of a return value, trend, density by depth.

Truths: moments of Gumbel's distribution, drawn samples, the test worked out in
NumPy, integrals.
"""

import math
from itertools import combinations

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import gumbel_r, norm

from netdesign.addons.winter.statistics import Gumbel, find_trend, fit_gumbel
from netdesign.snowpack.model_code import find_model_code_density

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


def work_out(years, maxima):
    """Kendall's tau, its p value by the normal distribution, Sen's slope; with ties."""
    pairs = [(years[j] - years[i], maxima[j] - maxima[i])
             for i, j in combinations(range(len(years)), 2)]  # fmt: skip
    s = sum(np.sign(dx) for _, dx in pairs)
    n, ties = len(years), np.unique(maxima, return_counts=True)[1]
    variance = n * (n - 1) * (2 * n + 5) - (ties * (ties - 1) * (2 * ties + 5)).sum()
    p = 2.0 * norm.sf(abs(s) / math.sqrt(variance / 18))
    decided = np.count_nonzero([dx for _, dx in pairs])
    tau = s / math.sqrt(len(pairs) * decided)
    return tau, p, np.median([dx / dt for dt, dx in pairs])


@pytest.mark.parametrize("trend", [-0.3, 0.0, 0.4])
def test_trend_with_ties_is_that_worked_out_by_hand(trend):
    rng = np.random.default_rng(31)
    years = np.sort(rng.choice(60, 35, replace=False))
    maxima = np.round(rng.gumbel(16.0, 4.7, 35) + trend * years)
    tau, p, slope = work_out(years, maxima)
    found = find_trend(years.tolist(), maxima.tolist())
    assert found.p_value == pytest.approx(p, rel=1e-9)
    assert found.slope == pytest.approx(slope, rel=1e-12)
    assert found.rank_correlation == pytest.approx(tau, rel=1e-12)
    assert found.is_shown is (trend != 0.0)


def test_ten_winters_in_one_order_have_the_exact_p_value():
    """Two of all orders of ten are as extreme."""
    found = find_trend(range(10), [float(k) for k in range(10)])
    assert found.p_value == pytest.approx(2.0 / math.factorial(10))
    assert found.slope == 1.0


def test_a_trend_shows_as_often_as_the_theory_says():
    rng = np.random.default_rng(5)
    samples = rng.gumbel(MODE, SCALE, size=(1500, 15))
    years = np.arange(15)
    shares = [
        np.mean([find_trend(years, one + b * years).is_shown for one in samples])
        for b in (0.0, 0.02)
    ]
    assert shares == pytest.approx([0.05, 0.20], abs=0.025)


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
