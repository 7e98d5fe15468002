"""Dip of a borehole below the horizontal, beside its direction turned in space."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.structure.anchors import find_dip
from netdesign.structure.members import Member

ANGLES = st.floats(math.radians(-30.0), math.radians(90.0))
SLOPES = st.floats(math.radians(20.0), math.radians(60.0))
UPSLOPE = (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR)


@given(axis=ANGLES, slope=SLOPES, anchor=st.sampled_from(UPSLOPE))
def test_dip_is_that_of_the_direction_turned_by_the_slope(axis, slope, anchor):
    along, down = math.cos(axis), math.sin(axis)  # upslope, and into the ground
    falls = down * math.cos(slope) - along * math.sin(slope)
    assert math.sin(find_dip(axis, slope, anchor)) == pytest.approx(falls, abs=1e-12)


@given(axis=ANGLES, slope=SLOPES)
def test_anchor_below_the_post_goes_down_with_the_slope(axis, slope):
    falls = math.sin(axis) * math.cos(slope) + math.cos(axis) * math.sin(slope)
    dip = find_dip(axis, slope, Member.DOWNHILL_ANCHOR)
    assert math.sin(dip) == pytest.approx(falls, abs=1e-12)


def test_an_anchor_along_the_slope_rises_with_it_and_one_across_it_dips():
    slope = math.radians(41.3)
    assert find_dip(0.0, slope, Member.UPHILL_ANCHOR) == -slope
    across = find_dip(0.5 * math.pi, slope, Member.FOOT_ANCHOR)
    assert math.degrees(across) == pytest.approx(48.7)
