"""A post that the net lifts: numbers by hand, elastic members, closed bounds."""

import math
import random
from itertools import product

import numpy as np
import pytest
from scipy.optimize import nnls

from netdesign.outcome import Outcome
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.head import FailedSupport, HeadForces, compute_head_forces
from netdesign.structure.layout import SupportLayout, SupportPoints, place_support
from netdesign.structure.members import Member
from netdesign.structure.splay import weigh_splay
from tests.structure.splayed_head import compute_splayed_head

# Guys of 4 and 3 m to both sides: 5 m long, u = (-0.8, -0.6), d = (0.8, -0.6).
TRIANGLES = SupportPoints(
    net_foot=(-1.0, 0.0),
    head=(0.0, 3.0),
    post_base=(0.0, 0.0),
    uphill_anchor=(-4.0, 0.0),
    downhill_anchor=(4.0, 0.0),
)


@pytest.mark.parametrize(
    ("pull", "lifts", "guy", "demands"),
    [
        ((16.0, 52.0), 40.0, 20.0, (160 / 3, 100 / 3)),
        ((0.0, 60.0), 60.0, 0.0, (50, 50)),
    ],
)
def test_lifted_head_by_hand(pull, lifts, guy, demands):
    """P = (16, 52): Tu = 16 / 0.8 = 20, Z = 52 - 0.6 * 20 = 40.

    Without the post Tu - Td = 16 / 0.8 and Tu + Td = 52 / 0.6: 53.33 and 33.33.
    P = (0, 60): the foot holds 60, or each guy 60 / (2 * 0.6) = 50.
    """
    held = compute_head_forces(pull, TRIANGLES)
    assert held.post_tension == pytest.approx(lifts, rel=1e-14)
    assert held.uphill_guy_tension == pytest.approx(guy, rel=1e-14)
    assert held.post_compression == held.downhill_guy_tension == 0.0
    assert held.guy_demands == pytest.approx(demands, rel=1e-14)


def test_forces_on_members_and_ground_by_hand():
    """Net foot and uphill guy apart: the base is drawn up, its plate not pressed."""
    found = compute_anchor_forces(
        TRIANGLES,
        foot_pull_per_m=(3.0, 4.0),
        head_pull_per_m=(8.0, 26.0),
        post_spacing=2.0,
    )
    assert (found.post_base.x, found.post_base.y) == pytest.approx((0.0, 40.0))
    assert found.head_pull == pytest.approx((16.0, 52.0), rel=1e-14)
    assert found.member_forces == pytest.approx(
        {
            Member.FOOT_ANCHOR: 10.0,
            Member.UPHILL_GUY: 160.0 / 3.0,
            Member.UPHILL_ANCHOR: 160.0 / 3.0,
            Member.DOWNHILL_GUY: 100.0 / 3.0,
            Member.DOWNHILL_ANCHOR: 100.0 / 3.0,
            Member.POST: 0.0,
            Member.POST_BASE: 0.0,
            Member.POST_FOOT: 40.0,
        },
        rel=1e-14,
    )


def draw_supports(seed, count=300):
    """Pulls on supports, one in four of them along the post or a guy."""
    draw = random.Random(seed)
    for _ in range(count):
        layout = SupportLayout(
            post_spacing=1.0,
            post_tilt=math.radians(draw.uniform(-29.0, 44.0)),
            uphill_anchor_distance=draw.choice([0.0, draw.uniform(0.1, 6.0)]),
            downhill_anchor_distance=draw.choice([0.0, draw.uniform(0.1, 6.0)]),
            post_base_distance=draw.choice([None, None, draw.uniform(-4.0, 6.0)]),
        )
        points = place_support(layout, (draw.uniform(-1, 3), draw.uniform(1.2, 4.4)))
        ends = (points.post_base, points.uphill_anchor, points.downhill_anchor)
        angle = draw.uniform(-math.pi, math.pi)
        x, y = math.cos(angle), math.sin(angle)
        if draw.random() < 0.25:
            end, sign = draw.choice(ends), draw.choice([-1.0, 1.0])
            x, y = (sign * (end[k] - points.head[k]) for k in (0, 1))
        size = 10.0 ** draw.uniform(0.0, 6.0)
        yield (size * x, size * y), points


def find_directions(points):
    ends = (points.post_base, points.uphill_anchor, points.downhill_anchor)
    every = np.array(ends) - points.head
    lengths = np.linalg.norm(every, axis=1)
    return (every / lengths[:, None]).tolist(), lengths


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


@pytest.mark.parametrize("seed", range(5))
def test_a_head_is_in_equilibrium_or_no_guy_can_pull_it_there(seed):
    """Members bear their sign; all that the net pulls comes to the ground."""
    seen = {"lifted": 0, "failed": 0, "uphill": 0, "downhill": 0}
    for pull, points in draw_supports(seed):
        foot, size = (0.7 * pull[1], 0.3 * pull[0]), 3.5 * math.hypot(*pull)
        found = compute_anchor_forces(
            points, foot_pull_per_m=foot, head_pull_per_m=pull, post_spacing=3.5
        )
        (post, *guys), _ = find_directions(points)
        held = [nnls(np.array([post]).T * [[1.0, -1.0]], -np.array(pull))]
        held += [
            nnls(np.array([post, np.negative(post), guy]).T, -np.array(pull))
            for guy in guys
            if abs(cross(post, guy)) >= math.sin(math.radians(1.0))
        ]
        holds = min(gap for _, gap in held) < 1e-9 * size
        assert isinstance(found, AnchorForces) == holds
        if not holds:
            seen["failed"] += 1
            assert found.outcome is Outcome.NO_EQUILIBRIUM
            continue
        head = found.head
        thrust = head.post_tension - head.post_compression
        tensions = (head.uphill_guy_tension, head.downhill_guy_tension)
        left = 3.5 * np.array(pull) + np.array([thrust, *tensions]) @ [post, *guys]
        assert np.linalg.norm(left) < 1e-12 * size
        assert min(*tensions, *found.member_forces.values()) >= 0.0
        assert min(tensions) == min(head.post_compression, head.post_tension) == 0.0
        ground = [found.foot_anchor, found.uphill_anchor, found.downhill_anchor]
        total = np.sum([(one.x, one.y) for one in (*ground, found.post_base)], axis=0)
        away = total - 3.5 * (np.array(foot) + pull)
        assert np.linalg.norm(away) < 1e-12 * size
        # (S4a): the slope holds down what the net does not lift
        steep = points.post_length / points.head[1]
        lifts = 3.5 * max(pull[1], 0.0) + 1e-11 * size
        assert head.post_tension <= lifts * steep
        seen["lifted"] += head.post_tension > 0.0
        for side, tension in zip(("uphill", "downhill"), tensions, strict=True):
            seen[side] += tension > 0.0
    assert min(seen.values()) > 20
    assert seen["lifted"] > 30


def solve_elastic(pull, directions, stiffness):
    """Forces of post (compression) and two guys, from the move of the head alone."""
    for active in product((True, False), repeat=2):
        bars = [(directions[0], stiffness[0])]
        bars += [
            (direction, k)
            for direction, k, on in zip(
                directions[1:], stiffness[1:], active, strict=True
            )
            if on
        ]
        matrix = sum(k * np.outer(e, e) for e, k in bars)
        if np.linalg.cond(matrix) > 1e12:
            continue
        move = np.linalg.solve(matrix, pull)
        stretched = [
            -k * float(np.dot(e, move))
            for e, k in zip(directions, stiffness, strict=True)
        ]
        agrees = all(
            (force > 0.0) is on for force, on in zip(stretched[1:], active, strict=True)
        )
        if agrees:
            return -stretched[0], [max(one, 0.0) for one in stretched[1:]]
    return None


@pytest.mark.parametrize("seed", range(5, 9))
def test_elastic_members_of_any_stiffness_stay_within_the_demands(seed):
    """Members without prestress: foot and guys never carry more than is counted."""
    draw, seen, both = random.Random(seed), 0, 0
    for pull, points in draw_supports(seed):
        directions, _ = find_directions(points)
        post, *guys = directions
        is_between = cross(post, guys[0]) * cross(post, guys[1]) < 0.0
        held = compute_head_forces(pull, points)
        if not isinstance(held, HeadForces) or not held.post_tension or not is_between:
            continue
        stiffness = [10.0 ** draw.uniform(-2.0, 2.0) for _ in range(3)]
        elastic = solve_elastic(pull, directions, stiffness)
        if elastic is None:  # on the border between two sets
            continue
        compression, tensions = elastic
        room = 1e-6 * math.hypot(*pull)
        assert compression <= room
        assert -compression <= held.post_tension + room
        for tension, demand in zip(tensions, held.guy_demands, strict=True):
            assert tension <= demand + room
        seen += 1
        both += min(tensions) > room
    assert seen > 15
    assert both > 5  # the answer is not the same for any stiffness


@pytest.mark.parametrize("seed", range(9, 12))
def test_forces_are_continuous_through_no_force_in_the_post(seed):
    """A pull along a guy, turned by a little to both sides."""
    turned = 0
    for _, points in draw_supports(seed, count=100):
        directions, _ = find_directions(points)
        for place in (1, 2):
            sine = cross(directions[0], directions[place])
            if abs(sine) < 0.1:
                continue
            pull = -1e3 * np.array(directions[place])
            sides = []
            for angle in (-1e-9, 1e-9):
                c, s = math.cos(angle), math.sin(angle)
                moved = (c * pull[0] - s * pull[1], s * pull[0] + c * pull[1])
                held = compute_head_forces(moved, points)
                assert isinstance(held, HeadForces)
                post = held.post_compression - held.post_tension
                sides.append((post, *held.guy_demands))
            step = 1e3 * 2e-9 * 57.3 / abs(sine)
            if cross(*directions[:2]) * cross(directions[0], directions[2]) < 0.0:
                assert sides[0] == pytest.approx(sides[1], abs=step)
                assert sides[0][0] * sides[1][0] < 0.0
                turned += 1
    assert turned > 30


@pytest.mark.parametrize("seed", range(12, 15))
def test_load_along_the_row_never_lifts_a_post_more(seed):
    draw, lifted = random.Random(seed), 0
    for pull, points in draw_supports(seed):
        flat = compute_head_forces(pull, points)
        weights = weigh_splay(points)
        if isinstance(flat, FailedSupport) or weights is None:
            continue
        (post, up, down), _ = find_directions(points)
        if min(abs(cross(post, up)), abs(cross(post, down))) < 0.02:
            continue
        splay, size = math.radians(draw.uniform(6.0, 59.0)), math.hypot(*pull)
        sideways = draw.uniform(0.0, 0.3) * size
        found = compute_splayed_head(pull, points, sideways=sideways, splay=splay)
        assert not isinstance(found, FailedSupport)
        assert found.post_tension <= flat.post_tension + 1e-9 * size
        # (S17) and (S18) with what the section brings
        held = sideways / math.tan(splay)
        counted = sum(flat.guy_demands)
        more = weights.post * max(held - counted, 0.0)
        assert found.post_compression <= flat.post_compression + more + 1e-9 * size
        for tension, demand, part in (
            (found.uphill_guy_tension, flat.guy_demands[0], weights.largest_uphill),
            (
                found.downhill_guy_tension,
                flat.guy_demands[1],
                weights.largest_downhill,
            ),
        ):
            most = demand / (2 * math.cos(splay)) + part * sideways / math.sin(splay)
            assert tension <= most + 1e-9 * size
        lifted += flat.post_tension > 0.0
    assert lifted > 10


def test_a_foot_anchor_that_is_shared_takes_the_guy_of_a_loose_foot():
    shared = SupportPoints(
        net_foot=(-4.0, 0.0),
        head=(0.0, 3.0),
        post_base=(0.0, 0.0),
        uphill_anchor=(-4.0, 0.0),
        downhill_anchor=(4.0, 0.0),
    )
    found = compute_anchor_forces(
        shared, foot_pull_per_m=(6.0, 8.0), head_pull_per_m=(16.0, 52.0), post_spacing=1
    )
    assert isinstance(found, AnchorForces)
    both = 10.0 + 160.0 / 3.0
    assert found.member_forces[Member.FOOT_ANCHOR] == pytest.approx(both, rel=1e-14)
    assert found.member_forces[Member.UPHILL_ANCHOR] == pytest.approx(both, rel=1e-14)
