"""Pulls against the axis of an anchor: signs, angles."""

import math

import pytest

from netdesign.structure.anchors import (
    PullRange,
    find_pull_range,
    measure_pull,
    turn_by_splay,
    turn_sideways,
)
from netdesign.structure.members import Member
from tests.each import each

UPHILL = (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR)


@pytest.mark.parametrize("anchor", UPHILL)
def test_anchors_above_the_post_are_pulled_downslope_and_out(anchor):
    assert measure_pull(7.0, 7.0, anchor) == pytest.approx(math.radians(45))
    assert measure_pull(-7.0, 7.0, anchor) == pytest.approx(math.radians(135))


def test_downhill_anchor_is_pulled_upslope_and_out():
    assert measure_pull(-3.1, 5.369, Member.DOWNHILL_ANCHOR) == pytest.approx(
        math.radians(60), abs=1e-4
    )


def test_range_of_directions_and_its_largest_angle():
    found = find_pull_range([0.71, 0.32, 0.55])
    assert found == PullRange(least=0.32, largest=0.71)
    assert found.mean == pytest.approx(0.515)
    assert found.find_largest_angle(0.4) == pytest.approx(0.31)
    assert found.find_largest_angle(found.mean) == pytest.approx(0.195)
    assert find_pull_range([]) is None


@pytest.mark.parametrize("share", [0.0, 0.1, 0.37, 1.73])
def test_sideways_part_turns_the_pull_in_space(share):
    """Angle of (cos d, sin d, k) against (1, 0, 0), from the vectors themselves."""
    angle = 0.23
    vector = (math.cos(angle), math.sin(angle), share)
    expected = math.acos(vector[0] / math.sqrt(sum(one * one for one in vector)))
    assert turn_sideways(angle, share) == pytest.approx(expected, rel=1e-12)


@each("splay", [0.0, 0.31, 0.77])
@each("inclination", [0.42, 1.57, 2.13])
def test_a_splayed_guy_is_flatter_than_its_section(inclination, splay):
    """Its line in space, from the vector itself; one that leans back stays so."""
    x, y = math.cos(inclination), math.sin(inclination)
    vector = (x, y, math.tan(splay))  # as long in the section as it was
    rise = vector[1] / math.sqrt(sum(one * one for one in vector))
    found = turn_by_splay(inclination, splay)
    assert math.sin(found) == pytest.approx(rise, rel=1e-12)
    assert (found > math.pi / 2) == (inclination > math.pi / 2)
    assert turn_by_splay(inclination, 0.0) == pytest.approx(inclination, rel=1e-9)
