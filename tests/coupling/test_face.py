"""Forces along a net turned into pressure."""

import math

import numpy as np
import pytest

from netdesign.coupling.interface import Face

PRESSURE, SHEAR = 30e3, 6e3  # [Pa]
TILT = math.radians(30.0)


def build_face(*, is_quadratic):
    """Plane face 4 m high under uniform pressure and upward shear, exact forces."""
    along = np.array([math.sin(TILT), math.cos(TILT)])
    normal = np.array([along[1], -along[0]])
    distances = np.linspace(0.0, 4.0, 9)
    shares = np.full(9, 0.5)
    shares[[0, -1]] = 0.25
    if is_quadratic:  # Simpson: 1 4 2 4 2 4 2 4 1 times h / 6 of each edge of 1 m
        shares = np.array([1, 4, 2, 4, 2, 4, 2, 4, 1]) / 6.0
    traction = PRESSURE * normal + SHEAR * along
    return Face(
        points=np.outer(along, distances),
        forces=np.outer(traction, shares),
        is_quadratic=is_quadratic,
    )


@pytest.mark.parametrize("is_quadratic", [True, False])
def test_pressures_are_those_that_made_the_forces(is_quadratic):
    pressures = build_face(is_quadratic=is_quadratic).pressures
    assert pressures == pytest.approx(np.full(9, PRESSURE))
