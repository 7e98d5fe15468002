"""Links between rope and anchor against numbers worked by hand."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.resistance.steel import Link, find_direction_factor, resist_link

FACTORS = {"on_action": 1.5, "on_resistance": 1.35}


def a_link(**special):
    values = {"kind": "eye", "breaking": None, "limit": None, "count": 1}
    return Link(**(values | {"angle": None, "source": "Links!C2"} | special))


def test_strengths_of_links_side_by_side_add_up():
    assert resist_link(a_link(breaking=83e3, count=3), pulled=1.0, **FACTORS) == 249e3


def test_a_working_load_limit_is_met_by_the_characteristic_force():
    limit = 47.0e3
    found = resist_link(a_link(limit=limit), pulled=0.0, **FACTORS)
    # utilisation 1: 1.5 E / (R / 1.35) = 1 at E = WLL
    assert 1.5 * limit / (found / 1.35) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("degrees", "most"), [(0, 1.0), (45, 0.7), (90, 0.5), (30, 0.75), (20, 0.85)]
)
def test_no_shackle_has_more_than_its_maker_prints(degrees, most):
    assert find_direction_factor(math.radians(degrees)).value <= most
    assert find_direction_factor(0.0).value == 1.0


def test_between_two_angles_the_factor_is_linear():
    # 36.4 degrees: 0.70 - 0.10 * 6.4 / 15
    expected = 0.70 - 0.10 * 6.4 / 15.0
    assert find_direction_factor(math.radians(36.4)).value == pytest.approx(expected)


@given(st.floats(0.0, 1.57), st.floats(0.0, 0.4))
def test_a_shackle_farther_from_its_line_bears_no_more(angle, more):
    link = a_link(kind="shackle", breaking=120e3)
    least, most = (
        resist_link(link, pulled=one, **FACTORS) for one in (angle + more, angle)
    )
    assert 0.5 * 120e3 <= least <= most <= 120e3


@pytest.mark.parametrize(
    ("pulled", "given", "meant"),
    [(0.3, 0.0, 0.3), (0.0, 1.1, 0.0), (None, 0.4, 0.4), (None, None, math.pi / 2)],
)
def test_the_pull_tells_the_angle_then_the_workbook_then_the_worst(
    pulled, given, meant
):
    link = a_link(kind="shackle", breaking=120e3, angle=given)
    found = resist_link(link, pulled=pulled, **FACTORS)
    assert found == pytest.approx(120e3 * find_direction_factor(meant).value)


def test_only_shackles_mind_the_direction():
    plate = a_link(kind="plate", breaking=61e3)
    assert resist_link(plate, pulled=1.2, **FACTORS) == 61e3
