"""Apparent compaction viscosity: the law by itself, the models, contrast of layers."""

import numpy as np
import pytest

from netdesign.addons.evidence.verification.closed_forms import (
    MODELS,
    compute_viscosity,
    find_middle,
)
from netdesign.snow.creep_law import (
    BOUTILLIER_2004,
    ICE_DENSITY,
    PAPER_FLUIDITY,
    ZWINGER_2007,
    compute_bulk_factor,
    compute_shear_factor,
    compute_strain_rate,
)


@pytest.mark.parametrize("density", [170.0, 293.0, 441.0])
def test_viscosity_is_that_of_confined_snow(density):
    """By the law in space: the side stress is the one that leaves no strain there."""
    relative, stress = density / ICE_DENSITY, 4.3e3
    a = compute_shear_factor(BOUTILLIER_2004, relative)
    b = compute_bulk_factor(BOUTILLIER_2004, relative)
    side = (3.0 * a - 2.0 * b) / (3.0 * a + 4.0 * b)  # K0, standards of elasticity
    rates = compute_strain_rate(
        BOUTILLIER_2004,
        relative,
        PAPER_FLUIDITY,
        -stress * np.diag([side, side, 1.0]),
    )
    assert abs(rates[0, 0]) < 1e-12 * abs(rates[2, 2])
    found = compute_viscosity(BOUTILLIER_2004, density, stress)
    assert found == pytest.approx(-stress / rates[2, 2], rel=1e-12)


def test_models_at_one_place():
    """367 kg/m3 at 0 C, by hand."""
    values = {name: compute(367.0) for name, compute in MODELS.items()}
    assert values["Crocus"] == pytest.approx(5.18e10, rel=2e-3)
    assert values["ISBA"] == pytest.approx(2.74e10, rel=2e-3)
    assert values["HS2SWE"] == pytest.approx(4.47e10, rel=2e-3)
    assert values["SNTHRM"] == pytest.approx(8.01e9, rel=2e-3)


def test_default_law_settles_like_them_in_the_middle_only():
    softness = {
        place: find_middle(place[0]) / compute_viscosity(BOUTILLIER_2004, *place)
        for place in ((250.0, 10e3), (450.0, 1e3))
    }
    assert softness[250.0, 10e3] > 20.0
    assert softness[450.0, 1e3] < 0.01
    stiff = compute_viscosity(ZWINGER_2007, 367.0, 5e3)
    own = compute_viscosity(BOUTILLIER_2004, 367.0, 5e3)
    assert stiff / own == pytest.approx(9.56, rel=1e-2)
