"""Distributions in standard normal space: fractiles, moments, return values."""

import math

import numpy as np
import pytest
from scipy.stats import gumbel_r, lognorm, norm

from netdesign.addons.reliability.variables import (
    KINDS,
    Variable,
    build_annual_maximum,
    build_by_share,
    load_assumed,
)
from netdesign.outcome import ModelError
from netdesign.words.catalogue import render
from tests.each import each

PLACES = np.array([-3.1, -1.7, -0.23, 0.0, 0.61, 1.9, 3.4, 5.7])


def freeze(variable):
    """The same distribution by SciPy."""
    mean, deviation = variable.mean, variable.deviation
    if variable.kind == "normal":
        return norm(mean, deviation)
    if variable.kind == "gumbel":
        scale = math.sqrt(6.0) / math.pi * deviation
        return gumbel_r(mean - np.euler_gamma * scale, scale)
    spread = math.sqrt(math.log1p((deviation / mean) ** 2))
    return lognorm(spread, scale=mean * math.exp(-0.5 * spread**2))


@each("kind", KINDS)
def test_places_are_those_of_scipy_and_come_back(kind):
    variable = Variable(name="x", kind=kind, mean=2.37, deviation=0.71)
    values = variable.place(PLACES)
    theirs = freeze(variable)
    assert freeze(variable).mean() == pytest.approx(2.37)
    assert theirs.std() == pytest.approx(0.71)
    assert norm.logsf(PLACES) == pytest.approx(theirs.logsf(values), rel=1e-6)
    again = [variable.find_place(one) for one in values]
    assert again == pytest.approx(PLACES, abs=1e-6)


def test_a_return_value_is_exceeded_once_in_its_period():
    height = build_annual_maximum("H", 3.17, 83.0, 0.29)
    assert norm.sf(height.find_place(3.17)) == pytest.approx(1.0 / 83.0, rel=1e-9)
    assert height.deviation / height.mean == pytest.approx(0.29)


def test_a_fractile_has_its_place():
    strength = build_by_share("R", 214.0, -1.645, 0.17)
    assert strength.find_place(214.0) == pytest.approx(-1.645)
    assert strength.deviation / strength.mean == pytest.approx(0.17)
    assert strength.mean > 214.0


@each(
    "faulty",
    [
        {"kind": "weibull"},
        {"deviation": -0.1},
        {"kind": "lognormal", "mean": 0.0},
        {"deviation": math.nan},
    ],
)
def test_what_is_no_distribution_is_refused(faulty):
    with pytest.raises(ModelError):
        Variable(
            **{"name": "x", "kind": "normal", "mean": 1.3, "deviation": 0.2} | faulty
        )


def test_every_assumed_distribution_says_where_it_is_from():
    for name, one in load_assumed().items():
        assert one.distribution in KINDS
        assert 0.0 < one.variation < 0.5, name
        assert "assumed" in render(one.source_in_words, "en")
