"""Snowpack: thickness against height, direction of gravity, guards."""

import math
import re

import pytest

from netdesign.outcome import ModelError
from netdesign.snow.snowpack import (
    STEEPEST_SLOPE,
    Layer,
    Snowpack,
    build_layered_snowpack,
    compute_mean_density,
    compute_thickness,
)
from tests.each import each

SOUND = {
    "slope_angle": math.radians(30.0),
    "thickness": 2.0,
    "upslope_length": 10.0,
    "density": 300.0,
}


def a_pack(**changes) -> Snowpack:
    return Snowpack(**{**SOUND, **changes})


def test_gravity_points_downslope_and_into_the_ground():
    x, y = a_pack().gravity_direction
    assert x == pytest.approx(0.5, rel=1e-15)
    assert y == pytest.approx(-math.sqrt(3) / 2, rel=1e-15)


def test_parallel_gravity_has_no_normal_part():
    assert a_pack(gravity="parallel").gravity_direction == (
        pytest.approx(0.5, rel=1e-15),
        0.0,
    )


def test_thickness_is_less_than_vertical_height():
    """d = H cos psi: 60 degrees halve it."""
    assert compute_thickness(3.0, math.pi / 3) == pytest.approx(1.5, rel=1e-15)
    assert compute_thickness(3.0, 0.0) == 3.0


REFUSED = [
    ("slope_angle", -1e-12, "slope angle"),
    ("slope_angle", math.nextafter(STEEPEST_SLOPE, 2.0), "slope angle"),
    ("slope_angle", 30.0, "slope angle"),  # degrees taken for radians
    ("thickness", 0.0, "snow thickness"),
    ("thickness", -2.0, "snow thickness"),
    ("upslope_length", 0.0, "upslope length"),
    ("density", 0.0, "snow density"),
    ("density", math.nextafter(0.99 * 917.0, 917.0), "snow density"),
    ("density", 917.0, "snow density"),
    ("gravity", "normal", "gravity mode"),
]


@each("field, value, name", REFUSED)
def test_beyond_the_bounds_is_refused(field, value, name):
    with pytest.raises(ModelError, match=f"{name} = .*must"):
        a_pack(**{field: value})


# --- layers ------------------------------------------------------------------

LAYERS = (Layer(thickness=0.5, density=450.0), Layer(thickness=1.5, density=250.0))


def build(*layers, **changes):
    return build_layered_snowpack(
        layers, **{"slope_angle": 0.5, "upslope_length": 10.0, **changes}
    )


def test_layers_make_thickness_and_mean_density():
    pack = build(*LAYERS, gravity="parallel")
    assert pack.thickness == 2.0
    assert pack.density == pytest.approx((0.5 * 450 + 1.5 * 250) / 2, rel=1e-15)
    assert pack.density == compute_mean_density(LAYERS)
    assert (pack.layers, pack.gravity) == (LAYERS, "parallel")


@pytest.mark.parametrize(
    ("changes", "both"),
    [
        ({"thickness": 2.0 * (1 + 2e-6)}, ("2 m", "2.000004 m")),
        ({"thickness": 2.0 * (1 - 2e-6)}, ("2 m", "1.999996 m")),
        ({"density": 300.0 * (1 + 2e-6)}, ("300 kg/m³", "300.0006 kg/m³")),
        ({"density": 300.0 * (1 - 2e-6)}, ("300 kg/m³", "299.9994 kg/m³")),
    ],
)
def test_layers_that_are_not_the_snowpack(changes, both):
    """Both figures are told with their unit, and never as the same figure."""
    with pytest.raises(ModelError) as refused:
        a_pack(layers=LAYERS, **changes)
    told = str(refused.value.message)
    assert tuple(re.findall(r"[\d.]+ (?:m|kg/m³)", told)) == both
