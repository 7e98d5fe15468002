"""Pulls against the axis of an anchor: signs, angles, parts."""

import math

import pytest

from netdesign.errors import ModelError
from netdesign.structure.axis import (
    PullRange,
    find_pull_range,
    measure_pull,
    resolve_on_axis,
    turn_sideways,
)
from netdesign.structure.members import Member

UPHILL = (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR)


@pytest.mark.parametrize("anchor", UPHILL)
def test_anchors_above_the_post_are_pulled_downslope_and_out(anchor):
    assert measure_pull(7.0, 7.0, anchor) == pytest.approx(math.radians(45))
    assert measure_pull(-7.0, 7.0, anchor) == pytest.approx(math.radians(135))


def test_downhill_anchor_is_pulled_upslope_and_out():
    assert measure_pull(-3.1, 5.369, Member.DOWNHILL_ANCHOR) == pytest.approx(
        math.radians(60), abs=1e-4
    )


@pytest.mark.parametrize(
    ("x", "y", "axis_deg"), [(83.0, 41.0, 12.0), (-5.0, 9.0, 90.0)]
)
def test_parts_make_up_the_force_and_the_angle(x, y, axis_deg):
    axis = math.radians(axis_deg)
    found = resolve_on_axis(x, y, axis, Member.FOOT_ANCHOR)
    along = x * math.cos(axis) + y * math.sin(axis)  # dot and cross product
    across = abs(x * math.sin(axis) - y * math.cos(axis))
    assert found.along == pytest.approx(along, rel=1e-12)
    assert found.across == pytest.approx(across, rel=1e-12)
    assert math.tan(found.angle) == pytest.approx(across / along, rel=1e-12)


def test_push_into_the_ground_is_against_the_axis():
    found = resolve_on_axis(-4.0, -4.0, math.radians(45), Member.UPHILL_ANCHOR)
    assert found.angle == pytest.approx(math.pi)
    assert found.along == pytest.approx(-math.hypot(4.0, 4.0))


@pytest.mark.parametrize("degrees", [-30.0, 90.0])
def test_axis_may_reach_its_bounds(degrees):
    assert resolve_on_axis(1.0, 0.0, math.radians(degrees), Member.FOOT_ANCHOR)


@pytest.mark.parametrize("degrees", [-30.1, 90.1, math.nan])
def test_axis_beyond_its_bounds_is_refused(degrees):
    with pytest.raises(ModelError, match="axis inclination"):
        resolve_on_axis(1.0, 0.0, math.radians(degrees), Member.FOOT_ANCHOR)


def test_range_of_directions_and_its_largest_angle():
    found = find_pull_range([0.71, 0.32, 0.55])
    assert found == PullRange(least=0.32, largest=0.71)
    assert found.mean == pytest.approx(0.515)
    assert found.find_largest_angle(0.4) == pytest.approx(0.31)
    assert found.find_largest_angle(found.mean) == pytest.approx(0.195)
    assert find_pull_range([]) is None


@pytest.mark.parametrize("share", [0.0, 0.1, 0.37])
def test_sideways_part_turns_the_pull_in_space(share):
    """Angle of (cos d, sin d, k) against (1, 0, 0), from the vectors themselves."""
    angle = 0.23
    vector = (math.cos(angle), math.sin(angle), share)
    expected = math.acos(vector[0] / math.sqrt(sum(one * one for one in vector)))
    assert turn_sideways(angle, share) == pytest.approx(expected, rel=1e-12)
