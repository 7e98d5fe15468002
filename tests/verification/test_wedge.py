"""Ground that an anchor pulls out: closed forms, and the second reader's mechanisms."""

import math
import random

import numpy as np
import pytest

from netdesign.outcome import ModelError
from netdesign.resistance.ground import (
    Soil,
    compute_cone_resistance,
    compute_slab_stability,
    compute_wedge_resistance,
)
from tests.each import each
from tests.verification.second_reader import resistance

STRAIGHT_OUT = math.pi / 2


def draw_soil(draw, **special):
    """Ground without water, unless it is told otherwise."""
    given = {
        "is_drained": True,
        "cohesion": 1e3 * draw.uniform(3.0, 30.0),
        "friction": math.radians(draw.uniform(18.0, 41.0)),
        "weight": 1e3 * draw.uniform(16.3, 22.7),
    }
    return Soil(**given | special)


def lift(soil, least, largest=None, **special):
    given = {"depth": 1.7, "width": 3.3, "slope": 0.0}
    return compute_wedge_resistance(
        soil,
        least_pull=least,
        largest_pull=least if largest is None else largest,
        **given | special,
    )


@each("is_drained", [True, False])
def test_weight_alone_of_level_ground_is_that_between_planes_at_the_friction_angle(
    is_drained,
):
    """R = gamma b h^2 tan(phi), of a straight pull; of soaked ground less its water."""
    draw = random.Random(3)
    for _ in range(20):
        soil = draw_soil(draw, cohesion=0.0, is_drained=is_drained)
        depth, width = draw.uniform(0.4, 4.0), draw.uniform(1.5, 4.5)
        found = lift(soil, STRAIGHT_OUT, depth=depth, width=width)
        unit = soil.weight - (0.0 if is_drained else 10e3)
        weight = unit * width * depth**2 * math.tan(soil.friction)
        assert found.value == pytest.approx(weight, rel=1e-6)
        assert found.plane == pytest.approx(STRAIGHT_OUT - soil.friction, abs=1e-3)


def test_cohesion_alone_of_any_slope_is_that_of_two_planes():
    """R = 4 c b h / (1 + sin(alpha)) as phi goes to zero, of any pull."""
    draw = random.Random(4)
    for _ in range(20):
        angle = draw.uniform(0.2, 1.5)
        soil = draw_soil(draw, friction=math.radians(1.0), weight=1e-6)
        bound = 4.0 * soil.cohesion * 3.3 * 1.7 / (1.0 + math.sin(angle))
        assert lift(soil, angle).value == pytest.approx(bound, rel=0.06)
        assert lift(soil, angle).value > bound  # a little friction holds a little


@each("seed", range(40))
def test_drawn_wedges_and_slabs_are_those_of_the_second_reader(seed):
    """Any slope and water, a range of pulls, loose ground that holds nothing."""
    draw = random.Random(seed)
    cohesion = 1e3 * draw.choice([0.0, draw.uniform(3.0, 40.0)])
    soil = draw_soil(draw, cohesion=cohesion, is_drained=draw.random() < 0.5)
    slope, depth = math.radians(draw.uniform(-50.0, 50.0)), draw.uniform(0.4, 4.0)
    pulls = sorted(math.radians(draw.uniform(5.0, 85.0)) for _ in "ab")
    width, (own, drained) = draw.uniform(1.3, 4.5), take_design(soil)
    expected = resistance.lift_wedge(own, depth, width, slope, pulls, **drained)
    found = lift(soil, *pulls, slope=slope, depth=depth, width=width)
    assert found.value / 1e3 == pytest.approx(expected, rel=1e-8)
    stability = compute_slab_stability(soil, depth, slope)
    held = resistance.hold_slab(own, depth, abs(slope), **drained)
    assert stability == pytest.approx(held, rel=1e-12)
    if stability >= 1.0:  # a wedge that slides lies in a slab that slides
        assert found.value > 0.0
    assert compute_slab_stability(soil, depth, 0.0) == math.inf


def take_design(soil):
    """Ground as the second reader has it [kPa, rad, kN/m3]."""
    own = (soil.cohesion / 1e3, soil.friction, soil.weight / 1e3)
    return own, {"drained": soil.is_drained}


def test_ground_of_the_least_friction_has_a_design_strength():
    """As a list may give it: one degree, and its tangent over a factor."""
    soil = Soil(cohesion=5e3, friction=math.radians(1.0), weight=18e3).reduce(1.25, 1.4)
    assert math.degrees(soil.friction) == pytest.approx(1.0 / 1.4, rel=1e-3)
    assert 0.0 < lift(soil, 0.6).value < math.inf


@pytest.mark.parametrize("wrong", [{"depth": 0.0}, {"width": -1.0}])
def test_wedge_without_size_is_refused(wrong):
    with pytest.raises(ModelError):
        lift(draw_soil(random.Random(8)), 0.5, **wrong)


# Foot anchor of R4: slope 40 deg, drilled 8 m at 20 deg, 3 m of ground, c' and tan phi'
# over 1.25, unit weight 20 kN/m3, pulls from 11.83 to 30.69 deg.
R4_SLOPE, R4_DEMAND_kN = math.radians(40.0), 266.6646
R4_PULLS = math.radians(11.831059), math.radians(30.691016)
R4_DEEPEST = 8.0 * math.sin(math.radians(20.0))


def ground_of_r4(cohesion_kPa, *, is_drained):
    soil = Soil(
        cohesion=1e3 * cohesion_kPa,
        friction=math.radians(36.0),
        weight=20e3,
        is_drained=is_drained,
    )
    return soil.reduce(1.25, 1.25)


@each(
    "cohesion_kPa, is_drained, resistance_kN, utilisation, stability",
    [
        (32.0, True, 346.8, 0.769, 1.42),
        (32.0, False, 310.7, 0.858, 1.07),
        (20.0, True, 232.8, 1.145, 1.15),
        (20.0, False, 196.4, 1.358, 0.80),
        (10.0, True, 136.5, 1.954, 0.92),
        (10.0, False, 0.0, math.inf, 0.57),
    ],
)
def test_ground_of_r4_dry_and_soaked(
    cohesion_kPa, is_drained, resistance_kN, utilisation, stability
):
    """Second derivation of the statics, to the digits that it prints."""
    soil = ground_of_r4(cohesion_kPa, is_drained=is_drained)
    held_kN = min(
        lift(soil, *R4_PULLS, depth=depth, width=3.0, slope=R4_SLOPE).value / 1e3
        for depth in (0.5 * R4_DEEPEST, R4_DEEPEST)  # the bond may lie anywhere
    )
    assert held_kN == pytest.approx(resistance_kN, abs=0.05)
    if resistance_kN:
        used = R4_DEMAND_kN / held_kN
        assert used == pytest.approx(utilisation, abs=5.1e-4)
    slab = compute_slab_stability(soil, R4_DEEPEST, R4_SLOPE)
    assert slab == pytest.approx(stability, abs=5.1e-3)


def draw_pull(draw):
    """Direction of a pull on a lateral anchor or an end guy's, out of the ground."""
    pull = np.array([draw.uniform(-0.4, 0.4), draw.uniform(0.0, 0.7), 1.0])
    return tuple(pull / np.linalg.norm(pull))


@each("seed", range(5))
def test_cone_straight_out_of_level_ground_is_the_right_circular_one(seed):
    """(pi/3) gamma h^3 tan^2 phi by its weight, pi c h^2 tan phi by its mantle."""
    draw = random.Random(seed)
    depth, up = draw.uniform(0.4, 3.0), (0.0, 1.0, 0.0)
    loose = draw_soil(draw, cohesion=0.0)
    tangent = math.tan(loose.friction)
    found = compute_cone_resistance(loose, depth=depth, slope=0.0, pull=up)
    weight = math.pi / 3.0 * loose.weight * depth**3 * tangent**2
    assert found.value == pytest.approx(weight, rel=1e-9)
    assert found.plane == pytest.approx(STRAIGHT_OUT - loose.friction)
    light = draw_soil(draw, weight=1e-6)
    found = compute_cone_resistance(light, depth=depth, slope=0.0, pull=up)
    mantle = math.pi * light.cohesion * depth**2 * math.tan(light.friction)
    assert found.value == pytest.approx(mantle, rel=1e-9)


@each("seed", range(20))
def test_drawn_cones_are_those_of_the_second_reader(seed):
    draw = random.Random(seed)
    cohesion = 1e3 * draw.choice([0.0, draw.uniform(5.0, 30.0)])
    soil = draw_soil(draw, cohesion=cohesion, is_drained=draw.random() < 0.5)
    slope, depth = math.radians(draw.uniform(5.0, 50.0)), draw.uniform(0.5, 3.0)
    pull, (own, drained) = draw_pull(draw), take_design(soil)
    expected = resistance.lift_cone(own, depth, slope, pull, **drained)
    found = compute_cone_resistance(soil, depth=depth, slope=slope, pull=pull)
    assert found.value / 1e3 == pytest.approx(expected, rel=1e-6)


def test_a_cone_without_depth_is_refused():
    with pytest.raises(ModelError):
        compute_cone_resistance(
            draw_soil(random.Random(3)), depth=0.0, slope=0.5, pull=(0.0, 0.0, 1.0)
        )
