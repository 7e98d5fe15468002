"""Scene and settings: scales, and guards at their bounds."""

import math
from dataclasses import replace
from itertools import pairwise

import pytest

from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.outcome import ModelError


def test_scales(a_scene):
    scene = a_scene(ground="sliding", slip_length_m=2.0, friction_deg=45.0)
    assert scene.force_scale == pytest.approx(0.4 * 917 * 9.81 * 4**2, rel=1e-12)
    law = scene.flow_problem
    assert law.slip_ratio == pytest.approx(0.5, rel=1e-15)
    assert law.friction == pytest.approx(1.0, rel=1e-15)
    # a / b of the fit: exp(16.03 - 16.75 + (22.51 - 19.25) D)
    (layer,) = law.layers
    assert layer.bulk_ratio == pytest.approx(math.exp(-0.72 + 3.26 * 0.4), rel=1e-12)
    assert (law.exponent, law.ground) == (3.0, "sliding")
    assert law.gravity == (
        pytest.approx(math.sin(math.radians(40))),
        pytest.approx(-math.cos(math.radians(40))),
    )


def test_fluidity_does_not_reach_the_flow_of_uniform_snow(a_scene):
    """It only rescales time: no force of a steady state can depend on it."""
    scene = a_scene()
    faster = replace(scene, fluidity=7.0 * scene.creep_fluidity)
    assert faster.flow_problem == scene.flow_problem
    assert faster.velocity_scale == pytest.approx(7.0 * scene.velocity_scale, rel=1e-14)


def test_snow_without_weight_is_refused(a_scene):
    with pytest.raises(ModelError, match="would have no weight"):
        a_scene(slope_deg=0.0, gravity="parallel")


@pytest.mark.parametrize(("slack", "inclination"), [(0.15, 60.0), (0.5, 40.0)])
def test_net_that_would_lie_on_the_ground_is_refused(a_scene, slack, inclination):
    with pytest.raises(ModelError, match=r"slack = .*lie on the ground.*less than"):
        a_scene(slack=slack, inclination_deg=inclination)


@pytest.mark.parametrize("fluidity", [0.0, -1.0, math.nan, math.inf])
def test_fluidity_is_guarded(a_scene, fluidity):
    with pytest.raises(ModelError, match="fluidity"):
        replace(a_scene(), fluidity=fluidity)


@pytest.mark.parametrize("field", ["ground_contact", "net_contact"])
def test_contact_word_is_guarded(a_scene, field):
    with pytest.raises(ModelError, match=f"{field.replace('_', ' ')} = 'glued'"):
        replace(a_scene(), **{field: "glued"})


@pytest.mark.parametrize("height", [4.0, 4.0 * (1 - 0.9e-6), 5.0])
def test_net_as_high_as_the_snow_is_accepted(a_scene, height):
    assert a_scene(height_m=height).net.height_normal == height


@pytest.mark.parametrize("height", [4.0 * (1 - 1.1e-6), 2.0])
def test_snow_above_the_head_is_refused(a_scene, height):
    with pytest.raises(ModelError, match="overtops the net; raise the net"):
        a_scene(height_m=height)


@pytest.mark.parametrize("length", [1.0, 800.0])
def test_bounds_of_the_length_are_accepted(a_scene, length):
    assert a_scene(length_m=length).snowpack.upslope_length == length


@pytest.mark.parametrize("length", [0.999, 800.1])
def test_length_is_refused(a_scene, length):
    with pytest.raises(ModelError, match="upslope length over snow thickness"):
        a_scene(length_m=length)


def test_levels_are_refined_in_every_size():
    for coarse, fine in pairwise(MESH_LEVELS):
        assert fine.net_spacing <= coarse.net_spacing
        assert fine.upslope_spacing < coarse.upslope_spacing
        assert fine.corner < coarse.corner


def test_sectors_grow_by_half_or_more():
    """Else two meshes would be too alike to show the error of either."""
    for coarse, fine in pairwise(MESH_LEVELS):
        assert fine.sectors >= 1.5 * coarse.sectors


RANGES = {
    "accuracy": (1e-4, 0.1),
    "stress_tolerance": (1e-14, 2e-4),
    "shape_tolerance": (1e-14, 2e-4),
    "balance_tolerance": (1e-14, 1e-6),
}


@pytest.mark.parametrize("field", RANGES)
def test_settings_at_their_bounds(field):
    low, high = RANGES[field]
    for value in (low, high):
        assert getattr(SolverSettings(**{field: value}), field) == value
    below, above = math.nextafter(low, 0.0), math.nextafter(high, 1.0)
    for value in (below, above, math.nan, math.inf, 0.0):
        with pytest.raises(ModelError, match=field.split("_")[0]):
            SolverSettings(**{field: value})


@pytest.mark.parametrize("field", ["max_rounds", "max_iterations"])
def test_counts_at_their_bounds(field):
    assert getattr(SolverSettings(**{field: 1}), field) == 1
    for value in (0, -1, math.nan, math.inf):
        with pytest.raises(ModelError, match=field.split("_")[1]):
            SolverSettings(**{field: value})


@pytest.mark.parametrize("levels", [(), MESH_LEVELS[:1]])
def test_one_mesh_gives_no_error(levels):
    with pytest.raises(ModelError, match="at least two mesh levels"):
        SolverSettings(levels=levels)
