"""Ground that an anchor pulls out, against closed forms and drawn wedges."""

import math
import random

import numpy as np
import pytest

from netdesign.outcome import ModelError
from netdesign.resistance.ground import (
    WATER,
    Soil,
    compute_cone_resistance,
    compute_slab_stability,
    compute_wedge_resistance,
)
from tests.each import each

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


@each("is_drained", [True, False])
def test_the_weakest_of_drawn_wedges_is_no_weaker(is_drained):
    """Forces on a wedge by hand: those of both planes, and its weight."""
    draw = random.Random(5)
    for _ in range(30):
        cohesion = 1e3 * draw.uniform(25.0, 40.0)
        soil = draw_soil(draw, cohesion=cohesion, is_drained=is_drained)
        slope = math.radians(draw.uniform(-50.0, 50.0))
        angle = math.radians(draw.uniform(8.0, 80.0))
        found = lift(soil, angle, slope=slope)
        pulls = []
        for _ in range(200):
            plane = draw.uniform(0.02, math.pi - 2.0 * soil.friction - 0.02)
            pulls.append(pull_by_forces(soil, plane, angle, slope))
        known = [one for one in pulls if one is not None]
        assert found.value <= min(known) * (1.0 + 1e-9)
        nearest = pull_by_forces(soil, found.plane, angle, slope)
        assert found.value == pytest.approx(nearest, rel=1e-6)


def pull_by_forces(soil, plane, angle, slope, depth=1.7, width=3.3):
    """Pull on one wedge [N], from the equilibrium of its forces; None if it locks.

    Each plane bears its cohesion along itself and a force at phi to its normal, which
    does no work on a motion at phi to the plane.
    """
    phi = soil.friction
    behind = plane + 2.0 * phi
    front, rear = depth / math.sin(plane), depth / math.sin(behind)
    area = 0.5 * depth * (front * math.cos(plane) - rear * math.cos(behind))
    weight = soil.weight * area * width
    along = plane + phi
    motion = (math.cos(along), math.sin(along))
    on_front = (math.cos(plane), math.sin(plane))
    on_rear = (math.cos(behind), math.sin(behind))
    down = (math.sin(slope), -math.cos(slope))
    against = sum(
        soil.cohesion * width * length * _dot(motion, way)
        for length, way in ((front, on_front), (rear, on_rear))
    )
    against -= weight * _dot(motion, down)
    if not soil.is_drained:  # pore pressure on both planes, which open by phi
        head = WATER * math.cos(slope) * depth / 2.0
        against -= head * (front + rear) * width * math.sin(phi)
    working = _dot(motion, (math.cos(angle), math.sin(angle)))
    return against / working if working > 1e-6 else None


def _dot(one, other):
    return one[0] * other[0] + one[1] * other[1]


def test_more_strength_never_holds_less_nor_more_directions_more():
    draw = random.Random(6)
    for _ in range(60):
        soil, slope = draw_soil(draw), math.radians(draw.uniform(-50.0, 50.0))
        angle = math.radians(draw.uniform(5.0, 85.0))
        least = lift(soil, angle, slope=slope).value
        stronger = {
            "cohesion": soil.cohesion * draw.uniform(1.0, 2.0),
            "friction": soil.friction * draw.uniform(1.0, 1.2),
            "weight": soil.weight,
            "is_drained": True,
        }
        assert lift(Soil(**stronger), angle, slope=slope).value >= least * (1 - 1e-6)
        wider = lift(soil, angle - 0.2, angle + 0.1, slope=slope).value
        assert wider <= least * (1 + 1e-6)
        factored = lift(soil.reduce(1.25, 1.25), angle, slope=slope).value
        assert factored <= least


def test_ground_pulled_up_the_slope_holds_more_and_steep_loose_ground_nothing():
    dry = {"friction": math.radians(33.0), "weight": 19.3e3, "is_drained": True}
    soil = Soil(cohesion=4.1e3, **dry)
    slope = math.radians(37.0)
    down, up = lift(soil, 0.5, slope=slope), lift(soil, 0.5, slope=-slope)
    assert 0.0 < down.value < up.value
    loose = Soil(cohesion=0.0, **dry)
    assert lift(loose, 0.5, slope=slope).value == 0.0
    assert lift(loose, 0.5, slope=math.radians(31.0)).value > 0.0


def test_force_grows_with_the_width_and_is_continuous_in_the_depth():
    soil = draw_soil(random.Random(7))
    one = lift(soil, 0.6, slope=0.5, width=1.3).value
    assert lift(soil, 0.6, slope=0.5, width=2.6).value == pytest.approx(2.0 * one)
    near = lift(soil, 0.6, slope=0.5, width=1.3, depth=1.7 + 1e-7).value
    assert near == pytest.approx(one, rel=1e-6)


def test_ground_of_the_least_friction_has_a_design_strength():
    """As a list may give it: one degree, and its tangent over a factor."""
    soil = Soil(cohesion=5e3, friction=math.radians(1.0), weight=18e3).reduce(1.25, 1.4)
    assert math.degrees(soil.friction) == pytest.approx(1.0 / 1.4, rel=1e-3)
    assert 0.0 < lift(soil, 0.6).value < math.inf


@pytest.mark.parametrize(
    "wrong",
    [{"cohesion": -1.0}, {"friction": 0.0}, {"friction": 1.2}, {"weight": math.nan}],
)
def test_ground_that_none_is_refused(wrong):
    with pytest.raises(ModelError):
        Soil(**{"cohesion": 4e3, "friction": 0.5, "weight": 19e3} | wrong)


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


def test_slab_of_r4_by_hand():
    """c' 32 kPa, water to the surface, depth 2.736 m, step by step."""
    cohesion, friction = 32.0 / 1.25, math.tan(math.radians(36.0)) / 1.25
    pressing = (20.0 - 10.0) * 2.736161 * math.cos(R4_SLOPE)
    driving = 20.0 * 2.736161 * math.sin(R4_SLOPE)
    by_hand = (cohesion + pressing * friction) / driving
    soil = ground_of_r4(32.0, is_drained=False)
    for slope in (R4_SLOPE, -R4_SLOPE):  # the pull turns its sign
        found = compute_slab_stability(soil, R4_DEEPEST, slope)
        assert found == pytest.approx(by_hand, rel=1e-6)
    assert compute_slab_stability(soil, 2.7, 0.0) == math.inf


def test_water_never_helps_and_a_deeper_slab_never_stands_better():
    draw = random.Random(9)
    for _ in range(60):
        soil, slope = draw_soil(draw), math.radians(draw.uniform(-50.0, 50.0))
        soaked = Soil(
            cohesion=soil.cohesion, friction=soil.friction, weight=soil.weight
        )
        angle, depth = math.radians(draw.uniform(5.0, 85.0)), draw.uniform(0.5, 4.0)
        dry = lift(soil, angle, slope=slope, depth=depth).value
        assert lift(soaked, angle, slope=slope, depth=depth).value <= dry * (1 + 1e-9)
        stands = compute_slab_stability(soaked, depth, slope)
        assert stands <= compute_slab_stability(soil, depth, slope)
        assert compute_slab_stability(soaked, 1.1 * depth, slope) <= stands
        near = compute_slab_stability(soaked, depth * (1 + 1e-9), slope)
        assert near == pytest.approx(stands, rel=1e-8)


def test_a_wedge_that_slides_lies_in_a_slab_that_slides():
    """So that a slab that stands leaves every wedge a resistance."""
    draw = random.Random(10)
    for _ in range(200):
        soil = draw_soil(draw, is_drained=draw.random() < 0.5)
        slope, depth = math.radians(draw.uniform(20.0, 50.0)), draw.uniform(0.5, 5.0)
        if compute_slab_stability(soil, depth, slope) >= 1.0:
            assert lift(soil, 0.5, slope=slope, depth=depth).value > 0.0


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


def pull_on_cone(soil, depth, slope, pull, way):
    """Pull on one cone [N] by triangles of its mantle and its mouth; None if it locks.

    ``way``: of its motion.
    """
    side = np.cross(way, (0.3, 0.4, 0.5))
    side /= np.linalg.norm(side)
    other = np.cross(way, side)
    turns = np.linspace(0.0, 2.0 * math.pi, 1441)
    across = np.outer(np.cos(turns), side) + np.outer(np.sin(turns), other)
    lines = math.cos(soil.friction) * np.array(way) + math.sin(soil.friction) * across
    mouth = lines * (depth / lines[:, 1:2])
    mantle = np.linalg.norm(np.cross(mouth[:-1], mouth[1:]), axis=1).sum() / 2.0
    inside = mouth - mouth.mean(axis=0)
    opening = abs(np.cross(inside[:-1], inside[1:])[:, 1].sum()) / 2.0
    volume = opening * depth / 3.0
    falls = np.dot(way, (math.sin(slope), -math.cos(slope), 0.0))
    against = soil.cohesion * math.cos(soil.friction) * mantle
    against -= soil.weight * volume * falls
    against -= soil.uplift * math.cos(slope) * volume * way[1]
    working = np.dot(way, pull)
    return against / working if working > 1e-6 else None


@each("is_drained", [True, False])
@each("seed", range(4))
def test_the_weakest_of_drawn_cones_is_no_weaker(seed, is_drained):
    draw = random.Random(seed)
    cohesion = 1e3 * draw.uniform(15.0, 30.0)
    soil = draw_soil(draw, cohesion=cohesion, is_drained=is_drained)
    slope, pull = math.radians(draw.uniform(25.0, 50.0)), draw_pull(draw)
    found = compute_cone_resistance(soil, depth=1.3, slope=slope, pull=pull).value
    drawn = []
    for _ in range(1500):
        rise = draw.uniform(soil.friction + 0.02, 0.5 * math.pi)
        aside = draw.uniform(-1.3, 1.3)
        flat = math.cos(rise)
        way = (flat * math.sin(aside), math.sin(rise), flat * math.cos(aside))
        drawn.append(pull_on_cone(soil, 1.3, slope, pull, way))
    least = min(one for one in drawn if one is not None)
    assert found <= least * (1.0 + 1e-3)
    assert found == pytest.approx(least, rel=0.03)


@each("seed", range(8))
def test_a_cone_holds_more_in_stronger_deeper_drained_and_flatter_ground(seed):
    draw = random.Random(seed)
    soil = draw_soil(draw, cohesion=1e3 * draw.uniform(20.0, 30.0), is_drained=False)
    slope, pull = math.radians(draw.uniform(25.0, 45.0)), draw_pull(draw)

    def hold(depth=1.4, falling=slope, **special):
        changed = Soil(
            **{name: getattr(soil, name) for name in soil.__slots__} | special
        )
        return compute_cone_resistance(
            changed, depth=depth, slope=falling, pull=pull
        ).value

    least = hold()
    assert hold(cohesion=1.2 * soil.cohesion) > least > 0.0
    assert hold(friction=1.1 * soil.friction) > least
    assert hold(is_drained=True) > least
    assert hold(falling=0.8 * slope) > least
    assert hold(depth=1.4 + 1e-7) == pytest.approx(least, rel=1e-6)


def test_loose_steep_ground_holds_no_cone():
    loose = Soil(cohesion=0.0, friction=0.6, weight=19e3, is_drained=True)
    along = (0.0, 0.0, 1.0)
    for slope, holds in ((0.59, True), (0.61, False)):
        found = compute_cone_resistance(loose, depth=1.5, slope=slope, pull=along)
        assert (found.value > 0.0) is holds
    with pytest.raises(ModelError):
        compute_cone_resistance(loose, depth=0.0, slope=0.5, pull=along)
