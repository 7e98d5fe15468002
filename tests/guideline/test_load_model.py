"""The guideline's load against the collection of standards, sections 2.2 and 2.3."""

import math
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.guideline.load_model import (
    compute_altitude_factor,
    compute_creep_factor,
    compute_snow_load,
    read_load_model,
)
from tests.each import each

MODEL = read_load_model(load_standard("swiss-guideline-2007"))
STEEP = math.radians(45.0)


def a_load(**changes):
    values = {
        "density": 270.0,
        "height_vertical": 3.0,
        "slope_angle": STEEP,
        "glide_factor": 2.0,
        "net_height": 3.0,
        "inclination": 0.0,
    }
    return compute_snow_load(MODEL, **(values | changes))


@pytest.mark.parametrize(
    ("density", "recalled"),
    [(200, 0.70), (300, 0.76), (400, 0.83), (500, 0.92), (600, 1.05)],
)
def test_creep_factor_gives_the_recalled_table(density, recalled):
    found = compute_creep_factor(MODEL, density, STEEP)
    assert found == pytest.approx(recalled, abs=0.005)


def test_creep_factor_follows_the_sine_of_twice_the_slope():
    at_30 = compute_creep_factor(MODEL, 300.0, math.radians(30.0))
    at_45 = compute_creep_factor(MODEL, 300.0, STEEP)
    assert at_30 == pytest.approx(at_45 * math.sin(math.radians(60.0)), rel=1e-14)


@each(
    "height, density, glide, expected",
    [
        (2.0, 270, 1.2, 4.8),
        (3.0, 270, 2.6, 23.4),
        (4.0, 270, 3.2, 51.2),
        (4.0, 400, 1.2, 31.7),
        (4.0, 400, 2.0, 52.9),
        (4.0, 400, 3.2, 84.6),
    ],
)
def test_pressure_on_a_rigid_wall(height, density, glide, expected):
    """Worked values of the collection, section 2.3 [kN/m]."""
    load = a_load(height_vertical=height, density=density, glide_factor=glide)
    assert load.rigid / 1e3 == pytest.approx(expected, abs=0.1)


def test_dimensioning_form_of_the_guideline():
    """At 45 degrees S'_N = N f_c H^2 [kN/m] up to rounding of the factors.

    By (G3a) without rounding, at any slope and altitude: 2.0 * 1.2 * 9 = 21.6 kN/m.
    """
    assert a_load().rigid / 1e3 == pytest.approx(2.0 * 3.0**2, rel=2e-3)
    creep = replace(MODEL, dimensioning=1e3).dimensioning_creep
    for slope in (31.7, 45.0, 52.3):
        load = a_load(
            density=1.2 * 270.0,
            slope_angle=math.radians(slope),
            creep_factor=creep,
        )
        assert load.rigid / 1e3 == pytest.approx(21.6, rel=1e-14)
        assert load.creep_factor == pytest.approx(2.0 / 2.7, rel=1e-14)
    assert MODEL.dimensioning_creep is None


@pytest.mark.parametrize(
    ("altitude", "factor"),
    [(0, 1.0), (1500, 1.0), (2000, 1.10), (3000, 1.30), (4000, 1.30)],
)
def test_altitude_factor(altitude, factor):
    assert compute_altitude_factor(MODEL, altitude) == pytest.approx(factor, rel=1e-14)


def test_parts_of_the_load():
    load = a_load(inclination=math.radians(30.0), height_vertical=2.0)
    assert load.parallel == pytest.approx(0.8 * load.rigid, rel=1e-15)
    assert load.normal == pytest.approx(load.parallel * 0.35 / 2.0, rel=1e-14)
    filled = 2.0 * math.cos(STEEP)  # snow below the net's head
    prism = 270 * 10 * filled**2 / 2 * math.tan(math.radians(30.0))
    assert load.resultant[0] == pytest.approx(
        load.parallel + prism * math.sin(STEEP), rel=1e-14
    )
    assert load.resultant[1] == pytest.approx(
        -load.normal - prism * math.cos(STEEP), rel=1e-14
    )
