"""End guy in space, (S24): its pull on the head, and where its anchor stands."""

import math

import numpy as np
import pytest

from netdesign.structure.layout import SupportLayout, SupportPoints, place_support
from netdesign.structure.splay import EndGuy

# Built-in example: b, D_K and tilt; both anchors a net height from foot and base.
HEIGHTS = {"R1": 2.5, "R4": 3.5, "R5": 4.0}


def place(row, inclination, tilt=15.0):
    height = HEIGHTS[row]
    layout = SupportLayout(
        post_spacing=3.0,
        post_tilt=math.radians(tilt),
        uphill_anchor_distance=height,
        downhill_anchor_distance=height,
    )
    return place_support(layout, (height * math.tan(math.radians(inclination)), height))


@pytest.mark.parametrize("from_base", [None, -1.0, 0.0, 0.4, 3.0])
@pytest.mark.parametrize("angle", [5.0, 30.0, 62.0])
def test_the_guy_ends_at_its_anchor_and_meets_the_row_at_its_angle(angle, from_base):
    points = place("R4", 31.0)
    guy = EndGuy(angle=math.radians(angle), from_base=from_base)
    way, anchor = np.array(guy.find_way(points)), np.array(guy.find_anchor(points))
    head = np.array([*points.head, 0.0])
    assert np.linalg.norm(way) == pytest.approx(1.0)
    span = anchor - head
    assert way == pytest.approx(span / np.linalg.norm(span))
    assert math.degrees(math.acos(-way[2])) == pytest.approx(angle)
    assert anchor[1] == 0.0
    x = points.head[0] if from_base is None else points.post_base[0] + from_base
    assert anchor[0] == pytest.approx(x)


def test_abreast_of_the_head_it_stands_where_it_meets_the_ground_from_there():
    points = place("R5", 25.0)
    x, y, z = EndGuy(angle=math.radians(30.0)).find_anchor(points)
    assert (x, y) == (points.head[0], 0.0)
    assert -z == pytest.approx(4.0 / math.tan(math.radians(30.0)))


def test_a_guy_along_the_row_ends_far_away():
    points = SupportPoints(
        net_foot=(0.0, 0.0),
        head=(2.0, 3.0),
        post_base=(1.2, 0.0),
        uphill_anchor=(-3.0, 0.0),
        downhill_anchor=(4.2, 0.0),
    )
    guy = EndGuy(angle=0.0)
    assert guy.find_way(points) == pytest.approx((0.0, 0.0, -1.0))
    assert guy.find_anchor(points)[2] < -1e3
