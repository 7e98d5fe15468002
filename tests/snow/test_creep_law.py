"""Coefficients of the creep law. Its closed forms: tests/verification/test_slab.py."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.outcome import ModelError
from netdesign.snow.creep_law import (
    BOUTILLIER_2004,
    CREEP_LAWS,
    compute_bulk_factor,
    compute_shear_factor,
    compute_strain_rate,
    require_admissible,
)
from tests.each import each

LAW = BOUTILLIER_2004


# FACTS.md, section 2, worked from the printed coefficients; four digits.
@pytest.mark.parametrize(
    ("density", "shear", "bulk"),
    [
        (0.25, 7.442e4, 6.768e4),
        (0.30, 2.842e4, 2.196e4),
        (0.40, 4146.0, 2312.0),
        (0.50, 604.9, 243.5),
        (0.60, 88.23, 25.64),
    ],
)
def test_low_density_fit(density, shear, bulk):
    assert compute_shear_factor(LAW, density) == pytest.approx(shear, rel=2e-4)
    assert compute_bulk_factor(LAW, density) == pytest.approx(bulk, rel=2e-4)


def test_dense_branch_is_duva_and_crow():
    """(N4) at D = 0.9, n = 3: 2n/(n+1) = 3/2, (1-D)^(1/n) = 0.1^(1/3)."""
    void = 0.1 ** (1 / 3)
    assert compute_shear_factor(LAW, 0.9) == pytest.approx(
        (1 + 0.2 / 3) / 0.9**1.5, rel=1e-14
    )
    assert compute_bulk_factor(LAW, 0.9) == pytest.approx(
        0.75 * (void / (3 * (1 - void))) ** 1.5, rel=1e-13
    )


SETS = [
    # FACTS.md, section 2, four digits; of the original set where its branches meet
    ("zwinger-2007", 0.50, 206.3, 129.2),
    ("zwinger-2007", 0.60, 42.54, 16.69),
    ("zwinger-2007", 0.40, 1000.0, 1000.0),
    ("zwinger-2007", 0.20, 1000.0, 1000.0),  # clamped
    ("gagliardini-1997", 0.785, 1.6439, 0.26363),
]


@pytest.mark.parametrize(("name", "density", "shear", "bulk"), SETS)
def test_other_sets(name, density, shear, bulk):
    law = CREEP_LAWS[name]
    assert compute_shear_factor(law, density) == pytest.approx(shear, rel=3e-4)
    assert compute_bulk_factor(law, density) == pytest.approx(bulk, rel=3e-4)


@pytest.mark.parametrize("law", CREEP_LAWS.values(), ids=lambda law: law.name)
def test_every_set_is_continuous_at_its_branch(law):
    below = math.nextafter(law.branch, 0.0)
    for compute in (compute_shear_factor, compute_bulk_factor):
        assert compute(law, below) == pytest.approx(compute(law, law.branch), rel=3e-3)


def test_snow_that_would_shrink_sideways_is_refused():
    """3a < 2b: the original set below D = 0.504, FACTS.md, section 2."""
    law = CREEP_LAWS["gagliardini-1997"]
    require_admissible(law, 0.505)
    with pytest.raises(ModelError, match=r"3a = .* < 2b = .*shrink sideways"):
        require_admissible(law, 0.503)
    with pytest.raises(ModelError, match="shrink sideways"):
        replace(law, calibrated=(0.4, 1.0))


def test_limit_of_the_papers_set():
    """FACTS.md, section 2: 3a = 2b at D = 0.097; of zwinger's fit at 0.313."""
    require_admissible(LAW, 0.098)
    with pytest.raises(ModelError, match="boutillier-2004"):
        require_admissible(LAW, 0.096)
    unclamped = replace(CREEP_LAWS["zwinger-2007"], clamp=0.0)
    require_admissible(unclamped, 0.314)
    with pytest.raises(ModelError, match="zwinger-2007"):
        require_admissible(unclamped, 0.312)


# --- strain rate in space: FACTS.md, section 3, B = 20 MPa^-3 a^-1, 10 kPa --------

ELMER = CREEP_LAWS["zwinger-2007"]
PRESSED = -0.01  # [MPa]


def rate_of(stress):
    return compute_strain_rate(ELMER, 0.5, 20.0, np.diag(stress))


def test_uniaxial_stress():
    rate = rate_of([0.0, 0.0, PRESSED])
    assert rate[2, 2] == pytest.approx(-0.1381, rel=5e-4)
    assert rate[0, 0] == rate[1, 1] == pytest.approx(0.03328, rel=5e-4)


def test_isotropic_stress():
    rate = rate_of([PRESSED] * 3)
    np.testing.assert_allclose(np.diag(rate), -0.1113, rtol=5e-4)


def test_confined_stress():
    """p and tau_xx of the table; nothing moves sideways."""
    side = PRESSED + 0.00455 + 0.002275
    rate = rate_of([side, side, PRESSED])
    assert rate[2, 2] == pytest.approx(-0.0991, rel=2e-3)  # printed digits, cubed
    np.testing.assert_allclose(np.diag(rate)[:2], 0.0, atol=1e-4)


# --- fault 9: the law of another exponent is derived, not kept (N28) -----------------


def test_the_derived_coefficients_by_hand():
    """At D = 0.5 and n = 3 a = e^6.405 = 604.86, b = e^5.495 = 243.47; m = 1: a^2."""
    law = replace(LAW, exponent=1.0)
    assert compute_shear_factor(law, 0.5) == pytest.approx(604.86**2, rel=1e-4)
    assert compute_bulk_factor(law, 0.5) == pytest.approx(243.47 * 604.86, rel=1e-4)


def rate_at_one_size(law, relative_density):
    """Strain rate over B under a uniaxial pressure whose S of (N8) is 1."""
    a, b = (
        of(LAW, relative_density) for of in (compute_shear_factor, compute_bulk_factor)
    )
    pressure = 1.0 / math.sqrt(1.0 / 3.0 + b / (9.0 * a))
    return compute_strain_rate(law, relative_density, 1.0, np.diag([0, 0, -pressure]))


@each("seed", range(40))
def test_snow_of_any_density_creeps_as_in_the_set_whatever_the_exponent(seed):
    """Drawn exponents and densities, on both branches, in every direction."""
    rng = np.random.default_rng([61, 9, seed])
    law = replace(LAW, exponent=float(rng.uniform(1.0, 6.0)))
    density = float(rng.uniform(0.1, 0.95))
    wanted = rate_at_one_size(LAW, density)
    np.testing.assert_allclose(rate_at_one_size(law, density), wanted, rtol=1e-9)


def test_a_set_of_its_own_exponent_is_taken_as_it_is():
    own = replace(LAW, exponent=2.0, own_exponent=2.0)
    assert compute_shear_factor(own, 0.5) == compute_shear_factor(LAW, 0.5)
