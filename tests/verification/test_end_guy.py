"""End guy in space, (S24) to (S26): its pull, what it adds, a truss that shares it."""

import math
import random
from itertools import product

import numpy as np
import pytest

from netdesign.calculation.quantity import leaf
from netdesign.checks.forces import calculate_force
from netdesign.structure.layout import SupportLayout, SupportPoints, place_support
from netdesign.structure.splay import (
    EndGuy,
    EndHead,
    hold_end_guy,
    share_with_end_guy,
)
from tests.each import each

# D_K, distances of uphill and downhill anchor [m]; post's area [cm2].
ROWS = {"R1": (2.5, 2.5, 2.5), "R4": (3.5, 4.0, 3.5), "R5": (4.0, 4.5, 4.0)}
AREAS = {"R1": 34.0, "R4": 54.25, "R5": 78.08}
ANGLE, SPLAY = math.radians(30.0), math.radians(25.0)
GUY = EndGuy(angle=ANGLE)


def place(row, inclination, tilt=15.0, uphill=1.0):
    height, above, below = ROWS[row]
    layout = SupportLayout(
        post_spacing=3.0,
        post_tilt=math.radians(tilt),
        uphill_anchor_distance=uphill * above,
        downhill_anchor_distance=below,
    )
    return place_support(layout, (height * math.tan(math.radians(inclination)), height))


@pytest.mark.parametrize("angle", [5.0, 30.0, 62.0])
def test_the_guy_ends_at_its_anchor_and_meets_the_row_at_its_angle(angle):
    points = place("R4", 31.0)
    guy = EndGuy(angle=math.radians(angle))
    way, anchor = np.array(guy.way), np.array(guy.find_anchor(points))
    head = np.array([*points.head, 0.0])
    assert np.linalg.norm(way) == pytest.approx(1.0)
    span = anchor - head
    assert way == pytest.approx(span / np.linalg.norm(span))
    assert math.degrees(math.acos(-way[2])) == pytest.approx(angle)
    assert anchor[1] == 0.0
    assert anchor[0] == pytest.approx(points.head[0])


def test_a_guy_along_the_row_ends_far_away():
    points = SupportPoints(
        net_foot=(0.0, 0.0),
        head=(2.0, 3.0),
        post_base=(1.2, 0.0),
        uphill_anchor=(-3.0, 0.0),
        downhill_anchor=(4.2, 0.0),
    )
    guy = EndGuy(angle=0.0)
    assert guy.way == pytest.approx((0.0, 0.0, -1.0))
    assert guy.find_anchor(points)[2] < -1e3


# Fall of the uphill guy [deg], C / V and T / V by row and inclination.
OF_HEAD = {
    ("R1", 25): (34.293, 1.2668, 0.3968),
    ("R1", 35): (30.462, 1.2290, 0.3690),
    ("R4", 25): (31.858, 1.2421, 0.3785),
    ("R4", 35): (28.483, 1.2114, 0.3567),
    ("R5", 25): (32.146, 1.2449, 0.3805),
    ("R5", 35): (28.718, 1.2134, 0.3581),
}


@each("row, inclination", list(OF_HEAD))
def test_post_and_uphill_guy_hold_what_the_end_guy_pulls_down(row, inclination):
    """T / V = sin tau / cos(tau + alpha), C / V = cos alpha / cos(tau + alpha)."""
    points, expected = place(row, inclination), OF_HEAD[row, inclination]
    fall = math.atan2(points.head[1], points.head[0] - points.uphill_anchor[0])
    assert math.degrees(fall) == pytest.approx(expected[0], abs=5e-4)
    held = hold_end_guy(points)
    assert held.post_compression == pytest.approx(expected[1], abs=5e-5)
    assert held.uphill_guy_tension == pytest.approx(expected[2], abs=5e-5)
    assert held.downhill_guy_tension == 0.0
    tilt = math.radians(15.0)
    assert held.uphill_guy_tension == pytest.approx(
        math.sin(tilt) / math.cos(tilt + fall)
    )


def hold_head(points, guy, pull, along):
    """Post, uphill guys and end guy by the sums of forces in three directions [kN]."""
    head = np.array([*points.head, 0.0])
    base, anchor = np.array([[*points.post_base, 0.0], [*points.uphill_anchor, 0.0]])
    ways = np.array([head - base, anchor - head, guy.way])
    lengths = np.linalg.norm(ways, axis=1, keepdims=True)
    return np.linalg.solve((ways / lengths).T, [-pull[0], -pull[1], -along])


@each("seed", range(30))
def test_the_last_head_is_in_equilibrium_under_the_section_s_pull_and_the_rope(seed):
    """(S24a); b_e / b = (2 + 1.5 * 2/3) / 4, (P8) with 1.5 * 2/3 / 4."""
    draw = random.Random(seed)
    points = place(draw.choice([*ROWS]), draw.uniform(25.0, 35.0))
    guy = EndGuy(angle=math.radians(draw.uniform(10.0, 50.0)))
    pull = np.array([draw.uniform(20.0, 90.0), -draw.uniform(60.0, 260.0)])
    rope = draw.uniform(40.0, 400.0)
    held = hold_end_guy(points)
    inside = hold_head(points, guy, pull, 0.0)
    at_end = hold_head(points, guy, 0.75 * pull, 1.25 * rope)
    assert at_end[2] == pytest.approx(1.25 * rope / math.cos(guy.angle))
    for number, part in enumerate((held.post_compression, held.uphill_guy_tension)):
        values = {"E_s": inside[number], "T_r": rope, "e": part, "b": 4.0, "f_R": 1.5}
        values |= {"Δl": 2.0 / 3.0, "γ": math.degrees(guy.angle)}
        leaves = {
            name: leaf(name, value, UNITS.get(name, "-"), "here")
            for name, value in values.items()
        }
        force = calculate_force(leaves).coupled.value
        assert force == pytest.approx(at_end[number], rel=1e-9)


def test_both_grow_with_the_tilt_and_with_a_steeper_guy():
    """Tilt 10 to 20 deg, e_1 0.75 to 1.25 D_K: 0.227 to 0.672, 1.132 to 1.519."""
    found = np.array(
        [
            [
                (one.uphill_guy_tension, one.post_compression)
                for uphill in np.linspace(1.25, 0.75, 11)
                for one in [hold_end_guy(place("R1", 25.0, tilt, uphill))]
            ]
            for tilt in np.linspace(10.0, 20.0, 11)
        ]
    )
    assert found[0, 0] == pytest.approx((0.227, 1.132), abs=5e-4)
    assert found[-1, -1] == pytest.approx((0.672, 1.519), abs=5e-4)
    for axis in (0, 1):
        assert (np.diff(found, axis=axis) > 0.0).all()


UNITS = {"β": "deg", "γ": "deg", "b": "m", "Δl": "m"}
UNITS |= dict.fromkeys(("E_s", "E_p0", "E_t", "P", "T_r", "T_min"), "kN")


def leaves_of(**values):
    return {
        name: leaf(name, value, UNITS.get(name, "-"), "here")
        for name, value in values.items()
    }


# b, f_R; panel's uphill guy and post, c, w, P and T_min; ridge rope inside [kN].
SOLVED = {
    "R1": (4.0, 0.85, 49.792, 101.259, 0.54443, 0.69814, 97.764, 0.0, 123.542),
    "R4": (3.0, 1.045, 75.276, 153.890, 0.53267, 0.68146, 128.447, 5.887, 182.106),
    "R5": (3.0, 1.24, 139.634, 266.622, 0.53401, 0.68343, 216.372, 16.786, 309.422),
}
# Guy, its shared anchor and post at the end; V [kN].
AT_END = {
    "R1": (39.20, 60.23, 242.1, 75.87),
    "R4": (59.14, 89.98, 369.2, 116.1),
    "R5": (107.3, 163.9, 643.2, 200.8),
}


def take_end(row, **more):
    spacing, factor, *_, rope = SOLVED[row]
    told = {"b": spacing, "f_R": factor, "Δl": 0.3, "E_s": 0.0, "γ": 30.0}
    return calculate_force(leaves_of(**told, T_r=rope, k=0.1, β=25.0, **more))


@each("row", list(AT_END))
def test_guy_anchor_and_post_of_the_example_s_ends(row):
    guy, anchor, post, across = AT_END[row]
    _, _, of_guy, of_post, part, weight, pull, least, _ = SOLVED[row]
    held = hold_end_guy(place(row, 25.0))
    tension = {"E_p0": of_guy, "c": part, "P": pull, "e": held.uphill_guy_tension}
    found = take_end(row, **tension)
    assert found.action.value == pytest.approx(guy, rel=3e-4)
    shared = take_end(row, n_g=2.0, **tension)
    assert shared.action.value == pytest.approx(anchor, rel=3e-4)
    in_line = take_end(row, n_h=2.0, **tension)
    assert shared.action.value <= in_line.action.value
    pressed = {"E_p0": of_post, "w": weight, "T_min": least}
    # the value of P there, not its upper end
    pressed |= {"P": pull / {"R1": 1.00765, "R4": 1.00791, "R5": 1.0089}[row]}
    load = take_end(row, e=held.post_compression, **pressed)
    assert 1.5 * load.action.value == pytest.approx(post, rel=3e-4)
    push = load.push.value / held.post_compression
    assert push == pytest.approx(across, rel=5e-4)


# Pull of the net on the end's head by the case of the largest uphill guy of the panel,
# half a bay and end effect, and H [kN]; diameters of uphill, downhill and end guy [mm].
TRUSS = {
    "R1": ((8.41595, -39.32387), 131.4179, (18, 18, 28)),
    "R4": ((14.61165, -65.69138), 201.1355, (24, 24, 36)),
    "R5": ((30.87496, -113.74145), 347.7905, (24, 24, 40)),
}
# Outer uphill guy and end guy.
SHARED = {"R1": (58.0, 124.0), "R4": (89.3, 189.0), "R5": (149.9, 337.0)}


def stretch(row):
    """EA of uphill, downhill and end guy by 0.46 d^2 x 100 GPa, and of the post [N]."""
    ropes = [0.46 * (1e-3 * one) ** 2 * 100e9 for one in TRUSS[row][2]]
    return (*ropes, 210e9 * AREAS[row] * 1e-4)


@each("row", list(TRUSS))
def test_a_linear_truss_shares_the_ridge_rope_s_pull(row):
    pull, along, _ = TRUSS[row]
    x, y = (1e3 * one for one in pull)
    head = EndHead(points=place(row, 25.0), pull=(x, y), along=1e3 * along)
    outer, end = SHARED[row]
    ((found,),) = share_with_end_guy(
        [head], splay=SPLAY, guy=GUY, stiffness=[stretch(row)]
    )
    assert found[0] / 1e3 == pytest.approx(outer, abs=0.055)
    assert found[4] / 1e3 == pytest.approx(end, abs=0.55)


def test_many_states_and_stiffnesses_are_each_of_them_alone():
    states = [
        EndHead(points=place(row, 25.0), pull=(9e3, -50e3), along=1e5 * k)
        for k, row in enumerate(ROWS, 1)
    ]
    ways = [stretch(row) for row in ROWS]
    many = share_with_end_guy(states, splay=SPLAY, guy=GUY, stiffness=ways)
    assert many.shape == (3, 3, 5)
    for k, state in enumerate(states):
        for m, way in enumerate(ways):
            one = share_with_end_guy([state], splay=SPLAY, guy=GUY, stiffness=[way])
            assert many[k, m] == pytest.approx(one[0, 0], rel=1e-12, abs=1e-6)


def test_stiffer_guys_take_more_and_none_of_it_jumps():
    state = EndHead(points=place("R5", 25.0), pull=(31e3, -114e3), along=348e3)
    _, down, end, post = stretch("R5")
    ways = [(one, down, end, post) for one in np.linspace(5e6, 100e6, 200)]
    found = share_with_end_guy([state], splay=SPLAY, guy=GUY, stiffness=ways)[0]
    # alike while the three members at work are determined by equilibrium
    assert (np.diff(found[:, 0]) > -1e-6).all()
    assert np.abs(np.diff(found, axis=0)).max() < 0.05 * 348e3


def test_no_stiffness_between_the_ends_loads_an_outer_guy_more():
    draw, reached = np.random.default_rng(3), []
    spans = np.array([(10e6, 64e6), (9e6, 56e6), (12e6, 78e6), (1e8, 4.2e9)])
    for _ in range(20):
        points = place(draw.choice(list(ROWS)), draw.uniform(25, 35))
        pull = (draw.uniform(0.0, 35e3), -draw.uniform(20e3, 120e3))
        state = EndHead(points=points, pull=pull, along=draw.uniform(50e3, 350e3))
        inside = np.exp(draw.uniform(*np.log(spans).T, size=(200, 4)))
        at_ends, between = (
            share_with_end_guy([state], splay=SPLAY, guy=GUY, stiffness=ways)[0]
            for ways in (list(product(*spans)), inside)
        )
        for outer in (0, 2):
            most = at_ends[:, outer].max()
            assert between[:, outer].max() <= most + 1e-6
            reached.append(between[:, outer].max() / max(most, 1.0))
    assert max(reached) > 0.9
