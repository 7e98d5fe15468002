"""What annual maxima tell: error of a return value, density by depth."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import gumbel_r

from netdesign.addons.winter.statistics import Gumbel, fit_gumbel
from netdesign.snow.heights import find_model_code_density

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
