"""Settling of light snow by the creep laws, against the model delta-snow."""

import math

import pytest

from netdesign.snow.creep_law import (
    CREEP_LAWS,
    ICE_DENSITY,
    compute_bulk_factor,
    compute_shear_factor,
)

DENSITIES = (100.0, 150.0, 200.0, 250.0, 300.0, 350.0, 400.0)
STRESS_PER_DENSITY = 9.81 * 1.0  # in the middle of 2 m
ETA_0, K = 8.523356e6, 0.02993175  # delta-snow, snow/THEORY.md, N26
YEAR = 365.25 * 86400.0


def settle(density):
    """Rate of delta-snow [1/s], N26."""
    return density * STRESS_PER_DENSITY / (ETA_0 * math.exp(K * density))


def find_fluidity(law, density):
    """Fluidity at which a law settles at that rate, N25 [MPa^-n / a]."""
    shear = compute_shear_factor(law, density / ICE_DENSITY)
    bulk = compute_bulk_factor(law, density / ICE_DENSITY)
    power = (law.exponent + 1) / 2
    softness = (4 / (3 * shear) + 1 / bulk) ** -power
    stress = density * STRESS_PER_DENSITY / 1e6
    return settle(density) * YEAR / (stress**law.exponent * softness)


@pytest.mark.parametrize(
    ("name", "spread"),
    [("boutillier-2004", 6.9), ("gagliardini-1997", 5.6), ("zwinger-2007", 3.5e4)],
)
def test_the_spread_that_reports_tell_is_that_of_the_law(name, spread):
    found = [find_fluidity(CREEP_LAWS[name], density) for density in DENSITIES]
    assert max(found) / min(found) == pytest.approx(spread, rel=0.02)
