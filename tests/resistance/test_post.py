"""Buckling against hand calculations and limits."""

import pytest

from netdesign.resistance.catalogue import find_imperfection
from netdesign.resistance.post import compute_buckling_resistance

# A section of 34.0 cm2 and 318 cm4 about the weak axis, steel of 235 MPa.
POST = {
    "area": 34.0e-4,
    "second_moment": 318e-8,
    "yield_strength": 235e6,
    "modulus": 210e9,
    "imperfection": 0.49,
}


def test_buckling_of_a_post_step_by_step():
    """Length 3 m, curve c, by EN 1993-1-1, 6.3.1.2, with pocket-calculator numbers."""
    found = compute_buckling_resistance(length=3.0, **POST)
    # N_cr = pi^2 210e9 * 318e-8 / 9 = 732.3 kN
    assert found.critical == pytest.approx(732.3e3, rel=1e-3)
    # lambda = sqrt(34e-4 * 235e6 / 732.3e3) = sqrt(1.0911) = 1.0446
    assert found.slenderness == pytest.approx(1.0446, rel=1e-4)
    # Phi = 0.5 (1 + 0.49 * 0.8446 + 1.0911) = 1.2525; sqrt(1.5687 - 1.0911) = 0.6911
    # chi = 1 / (1.2525 + 0.6911) = 0.5145
    assert found.reduction == pytest.approx(0.5145, rel=1e-3)
    # N_k = 0.5145 * 799 kN = 411.1 kN
    assert found.value == pytest.approx(411.1e3, rel=1e-3)


def test_stocky_post_reaches_its_yield_force():
    found = compute_buckling_resistance(length=0.3, **POST)
    assert found.slenderness < 0.2
    assert found.value == pytest.approx(34.0e-4 * 235e6, rel=1e-15)


def test_slender_post_tends_to_eulers_load():
    found = compute_buckling_resistance(length=60.0, **POST)
    assert found.value == pytest.approx(found.critical, rel=0.05)
    assert found.value < found.critical


@pytest.mark.parametrize(
    ("curve", "factor"),
    [("a0", 0.13), ("a", 0.21), ("b", 0.34), ("c", 0.49), ("d", 0.76)],
)
def test_imperfection_grows_from_curve_to_curve(curve, factor):
    datum = find_imperfection(curve)
    assert (datum.value, datum.status) == (factor, "assumed")
