"""Creep laws of another exponent: alike at one stress, and what that leaves."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.scene import Scene
from netdesign.coupling.steady.rigid import measure_glide_factor
from netdesign.outcome import ModelError
from netdesign.snow.creep_law import (
    BOUTILLIER_2004,
    CREEP_LAWS,
    STATED_EXPONENTS,
    compute_bulk_factor,
    compute_shear_factor,
    compute_strain_rate,
    derive_exponent,
)
from netdesign.snow.ground import (
    GroundLaw,
    compute_slip_length,
    load_glide_tables_of_exponents,
)
from netdesign.snow.law import linearise_sliding
from netdesign.snow.snowpack import Layer, Snowpack, build_layered_snowpack
from netdesign.snow.wall import Wall
from tests.each import each

DERIVED_LAWS = {
    law.name: law
    for one in CREEP_LAWS.values()
    for law in (derive_exponent(one, stated.exponent) for stated in STATED_EXPONENTS)
}
FLUIDITY = 2.6e-25  # [Pa^-3 s^-1]
LAYERS = (
    Layer(thickness=0.7, density=411.0),
    Layer(thickness=0.8, density=367.0),
    Layer(thickness=0.5, density=232.0),
)


def invariant(law, density, stress):
    """S of (N8), from the three-dimensional stress."""
    a, b = compute_shear_factor(law, density), compute_bulk_factor(law, density)
    pressure = -np.trace(stress) / 3.0
    deviator = stress + pressure * np.eye(3)
    return math.sqrt((deviator**2).sum() / 2.0 + b / a * pressure**2)


@each("name", ["boutillier-2004", "zwinger-2007"])
@each("exponent", [1.0, 1.8, 2.15, 3.6])
def test_strain_rates_are_alike_at_one_stress_at_every_density(name, exponent):
    law, size = CREEP_LAWS[name], 3.7e3
    other = derive_exponent(law, exponent)
    own = FLUIDITY * size ** (3.0 - exponent)  # (N29)
    raw = np.random.default_rng(7).normal(size=(3, 3))
    for density in (0.41, 0.53, 0.77):
        stress = raw + raw.T
        stress *= size / invariant(law, density, stress)
        expected = compute_strain_rate(law, density, FLUIDITY, stress)
        found = compute_strain_rate(other, density, own, stress)
        assert found == pytest.approx(expected, rel=1e-10)
        twice = compute_strain_rate(other, density, own, 2.0 * stress)
        assert twice == pytest.approx(2.0**exponent * found, rel=1e-10)


def test_own_exponent_changes_nothing_but_the_name():
    same = derive_exponent(BOUTILLIER_2004, 3.0)
    assert same.shear_fit == BOUTILLIER_2004.shear_fit
    assert same.bulk_fit == pytest.approx(BOUTILLIER_2004.bulk_fit, rel=1e-15)
    assert same.name == "boutillier-2004-n3"


def test_layers_keep_their_contrast():
    def ratios(law):
        scene = Scene(
            snowpack=build_layered_snowpack(
                LAYERS, slope_angle=0.7, upslope_length=9.1
            ),
            ground=GroundLaw(kind="no-slip"),
            net=Wall(height_normal=2.0),
            creep_law=law,
        )
        return [
            (one.fluidity_ratio, one.bulk_ratio) for one in scene.flow_problem.layers
        ]

    own = ratios(BOUTILLIER_2004)
    other = ratios(derive_exponent(BOUTILLIER_2004, 1.8))
    assert np.array(other) == pytest.approx(np.array(own), rel=1e-12)


def test_nothing_is_derived_beyond_the_branch():
    with pytest.raises(ModelError, match="no other exponent is derived"):
        derive_exponent(replace(BOUTILLIER_2004, calibrated=(0.85, 0.95)), 2.0)
    with pytest.raises(ModelError, match="creep exponent"):
        derive_exponent(BOUTILLIER_2004, 0.9)
    assert not derive_exponent(BOUTILLIER_2004, 2.0).is_calibrated(0.82)


def test_stated_densities():
    stated = {one.exponent: one for one in STATED_EXPONENTS}
    assert [stated[1.8].is_stated_for(rho) for rho in (170.0, 230.0)] == [True, False]
    assert [stated[3.6].is_stated_for(rho) for rho in (300.0, 350.0)] == [False, True]
    assert all(stated[2.15].is_stated_for(rho) for rho in (150.0, 500.0))


@each("name", load_glide_tables_of_exponents())
def test_slip_length_at_the_entries_of_the_table(name):
    table = load_glide_tables_of_exponents()[name]
    assert name in DERIVED_LAWS or name.endswith("-slip1")
    assert sorted(table.glide_factors) == list(table.glide_factors)
    for ratio, glide in zip(table.slip_ratios, table.glide_factors, strict=True):
        assert compute_slip_length(glide, 2.7, name) == pytest.approx(2.7 * ratio)


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "ratio"), [("boutillier-2004-n1.8", 4.0), ("zwinger-2007-n3.6", 0.25)]
)
def test_recipe_gives_the_stored_table(name, ratio):
    table = load_glide_tables_of_exponents()[name]
    place = table.slip_ratios.index(ratio)
    measured = measure_glide_factor(DERIVED_LAWS[name], ratio)
    assert measured == pytest.approx(table.glide_factors[place], abs=1e-4)


def test_other_slip_law_glides_as_fast_where_nothing_holds():
    """Speed of the neutral zone on the ground, by the law itself."""
    sine = math.sin(0.7)
    scene = Scene(
        snowpack=Snowpack(
            slope_angle=0.7, thickness=2.0, upslope_length=9.0, density=340.0
        ),
        ground=GroundLaw(kind="sliding", slip_length=1.3),
        net=Wall(height_normal=2.0),
    )
    ground = replace(scene.ground, slip_exponent=1.0)
    linear = replace(scene, ground=ground).flow_problem
    speeds = []
    for problem in (scene.flow_problem, linear):
        shear = np.array([[sine]])
        tangent = linearise_sliding(problem, shear)
        speeds.append(((shear - tangent.intercept) / tangent.modulus).item())
    assert speeds[1] == pytest.approx(speeds[0], rel=1e-4)  # the stress floor
    assert linear.slip_ratio == pytest.approx(0.65 * sine**2, rel=1e-14)
