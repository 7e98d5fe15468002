"""Return values of annual maxima."""

import pytest

from netdesign.addons.winter.statistics import Gumbel, fit_gumbel


def test_fewer_than_fifteen_winters_tell_no_return_value():
    assert fit_gumbel(list(range(14))) is None
    assert fit_gumbel(list(range(15))).count == 15


@pytest.mark.parametrize(
    ("period", "factor"), [(2.0, -0.164), (10.0, 1.305), (100.0, 3.137)]
)
def test_frequency_factors_are_those_of_the_textbooks(period, factor):
    fit = Gumbel(count=40, mean=17.3, deviation=5.9)
    got = (fit.find_return_value(period)[0] - 17.3) / 5.9
    assert got == pytest.approx(factor, abs=6e-4)
