import numpy as np
import pytest

from netdesign.errors import ModelError
from netdesign.snow.creep_law import DENSEST_SNOW, ICE_DENSITY
from netdesign.snow.density import compute_density


def test_mass_is_kept():
    initial = np.array([200.0, 350.0])
    jacobian = np.array([0.5, 1.25])
    np.testing.assert_allclose(
        compute_density(initial, jacobian) * jacobian, initial, rtol=1e-15
    )


@pytest.mark.parametrize("jacobian", [0.0, -0.1, np.nan])
def test_snow_turned_over_is_refused(jacobian):
    with pytest.raises(ModelError, match="J = "):
        compute_density(np.array([300.0, 300.0]), np.array([1.0, jacobian]))


def test_densest_snow_is_the_bound():
    densest = DENSEST_SNOW * ICE_DENSITY
    assert compute_density(np.array([densest]), np.array([1.0])) == densest
    with pytest.raises(ModelError, match="after settling"):
        compute_density(np.array([densest]), np.array([1.0 - 1e-12]))
    with pytest.raises(ModelError, match="after settling"):
        compute_density(np.array([np.nan]), np.array([1.0]))
