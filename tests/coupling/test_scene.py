"""Scene and settings: scales, and guards at their bounds."""

import math
from dataclasses import replace

import pytest

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


@pytest.mark.parametrize(("slack", "inclination"), [(0.15, 60.0), (0.5, 40.0)])
def test_net_that_would_lie_on_the_ground_is_refused(a_scene, slack, inclination):
    with pytest.raises(ModelError, match=r"slack = .*lie on the ground.*less than"):
        a_scene(slack=slack, inclination_deg=inclination)


@pytest.mark.parametrize("height", [4.0 * (1 - 1.1e-6), 2.0])
def test_snow_above_the_head_is_refused(a_scene, height):
    with pytest.raises(ModelError, match="overtops the net; raise the net"):
        a_scene(height_m=height)
