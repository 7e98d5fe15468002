"""End guy in space, (S24) to (S26): its pull, what it adds; shares by a truss.

Forces of the members and the truss itself are redone in test_rows_redone.py.
"""

import math
from itertools import product

import numpy as np
import pytest

from netdesign.structure.layout import SupportLayout, place_support
from netdesign.structure.splay import EndGuy, EndHead, hold_end_guy, share_with_end_guy
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


# Uphill, downhill and end guy [mm].
DIAMETERS = {"R1": (18, 18, 28), "R4": (24, 24, 36), "R5": (24, 24, 40)}


def stretch(row):
    """EA of uphill, downhill and end guy by 0.46 d^2 x 100 GPa, and of the post [N]."""
    ropes = [0.46 * (1e-3 * one) ** 2 * 100e9 for one in DIAMETERS[row]]
    return (*ropes, 210e9 * AREAS[row] * 1e-4)


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
