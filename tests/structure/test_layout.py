"""Guards and signs of the support's geometry."""

import math

import pytest

from netdesign.outcome import ModelError
from netdesign.structure.layout import SupportLayout, place_support
from tests.each import each


def a_layout(**changes: float) -> SupportLayout:
    values = {
        "post_spacing": 4.0,
        "post_tilt": math.radians(15),
        "uphill_anchor_distance": 3.0,
        "downhill_anchor_distance": 2.0,
    }
    return SupportLayout(**(values | changes))


def test_points_lie_where_the_layout_says():
    points = place_support(a_layout(), head=(1.5, 3.0))
    x_base = 1.5 - 3.0 * math.tan(math.radians(15))
    assert points.net_foot == (0.0, 0.0)
    assert points.head == (1.5, 3.0)
    assert points.post_base == pytest.approx((x_base, 0.0), rel=1e-15)
    assert points.uphill_anchor == (-3.0, 0.0)
    assert points.downhill_anchor == pytest.approx((x_base + 2.0, 0.0), rel=1e-15)


@pytest.mark.parametrize("degrees", [-30, -5, 0, 15, 45])
def test_post_leans_by_its_tilt_with_the_head_downslope(degrees):
    points = place_support(a_layout(post_tilt=math.radians(degrees)), head=(1.0, 2.5))
    run = points.head[0] - points.post_base[0]
    rise = points.head[1] - points.post_base[1]
    assert math.degrees(math.atan2(run, rise)) == pytest.approx(degrees, abs=1e-12)


def test_uphill_anchor_may_stand_at_the_foot():
    points = place_support(a_layout(uphill_anchor_distance=0.0), head=(1.0, 2.0))
    assert points.uphill_anchor == points.net_foot


RANGES = {
    "post_spacing": (5e-324, 1e3),
    "post_tilt": (math.radians(-30), math.radians(45)),
    "uphill_anchor_distance": (0.0, 100.0),
    "downhill_anchor_distance": (0.0, 100.0),
}


@each("field", RANGES)
def test_layout_takes_the_ends_of_its_ranges_and_nothing_beyond(field):
    low, high = RANGES[field]
    beyond = [math.nextafter(low, -math.inf), -4.0, math.nan, math.inf, -math.inf]
    if field != "post_spacing":
        beyond.append(math.nextafter(high, math.inf))
    for value in (low, high):
        assert getattr(a_layout(**{field: value}), field) == value
    for value in beyond:
        with pytest.raises(ModelError, match=field.replace("_", " ")):
            a_layout(**{field: value})


def test_base_by_its_position_stays_where_it_is():
    """The tilt follows the head: 3 m high, 0.8 m across."""
    for head in ((1.4, 3.0), (1.7, 3.0), (2.1, 3.0)):
        points = place_support(a_layout(post_base_distance=0.9), head)
        assert points.post_base == (0.9, 0.0)
        assert points.downhill_anchor == pytest.approx((2.9, 0.0), rel=1e-15)
