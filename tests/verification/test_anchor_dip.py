"""Dip of a borehole below the horizontal, beside its direction turned in space."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.structure.members import EndMember, Member
from netdesign.structure.row_position import (
    find_axis_at_dip,
    find_dip,
    measure_angle,
    measure_fall,
    turn_down,
)

ANGLES = st.floats(math.radians(-30.0), math.radians(90.0))
SLOPES = st.floats(math.radians(20.0), math.radians(60.0))
# Ways of an anchor along the slope, down the row's X.
ALONG = {
    Member.FOOT_ANCHOR: (-1.0, 0.0, 0.0),
    Member.UPHILL_ANCHOR: (-1.0, 0.0, 0.0),
    Member.DOWNHILL_ANCHOR: (1.0, 0.0, 0.0),
    EndMember.LATERAL_ANCHOR: (0.0, 0.0, -1.0),
}


def turn_level(way, slope):
    """Way in axes of which the second points straight up, by a rotation."""
    cosine, sine = math.cos(slope), math.sin(slope)
    turn = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    return turn @ np.array(way)


@given(axis=ANGLES, slope=SLOPES, anchor=st.sampled_from(list(ALONG)))
def test_dip_is_that_of_the_direction_turned_by_the_slope(axis, slope, anchor):
    way = math.cos(axis) * np.array(ALONG[anchor]) - [0.0, math.sin(axis), 0.0]
    falls = -turn_level(way, slope)[1]
    assert math.sin(find_dip(axis, slope, anchor)) == pytest.approx(falls, abs=1e-12)


@pytest.mark.parametrize(
    ("slope", "axis"), [(30.0, 17.4), (40.0, 19.7), (45.0, 21.5), (50.0, 23.7)]
)
def test_flattest_lateral_anchor_of_15_degrees(slope, axis):
    found = find_axis_at_dip(
        math.radians(15.0), math.radians(slope), EndMember.LATERAL_ANCHOR
    )
    assert math.degrees(found) == pytest.approx(axis, abs=0.05)


@given(
    dip=st.floats(math.radians(5.0), math.radians(29.0)),
    slope=SLOPES,
    anchor=st.sampled_from(list(ALONG)),
)
def test_axis_at_a_dip_has_it(dip, slope, anchor):
    axis = find_axis_at_dip(dip, slope, anchor)
    assert find_dip(axis, slope, anchor) == pytest.approx(dip, abs=1e-12)


WAYS = st.tuples(st.floats(-0.9, 0.9), st.floats(-1.0, -0.05), st.just(-1.0))


@given(way=WAYS, slope=SLOPES)
def test_a_bore_too_flat_turns_down_in_its_vertical_plane_and_no_farther(way, slope):
    way = tuple(np.array(way) / np.linalg.norm(way))
    least = math.radians(15.0)
    found = turn_down(way, slope, least)
    assert np.linalg.norm(found) == pytest.approx(1.0)
    dip = math.asin(measure_fall(way, slope))
    before, after = turn_level(way, slope), turn_level(found, slope)
    assert math.sin(dip) == pytest.approx(-before[1], abs=1e-12)
    assert -after[1] == pytest.approx(math.sin(max(dip, least)))
    assert before[0] * after[2] == pytest.approx(before[2] * after[0], abs=1e-9)
    turned = max(0.0, least - dip)
    assert measure_angle(way, found) == pytest.approx(turned, abs=1e-7)
