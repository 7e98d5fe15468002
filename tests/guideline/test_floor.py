"""The guideline's load as floor: scan, corners, and where it is not available."""

import math
import random
from dataclasses import replace
from itertools import pairwise, product

import pytest

from netdesign.checks import load_standard
from netdesign.guideline.comparison import (
    NetGeometry,
    list_load_cases,
    solve_load_case,
)
from netdesign.guideline.floor import (
    SCAN_STEP,
    LoadedNet,
    find_floor,
    list_inclinations,
)
from netdesign.guideline.load_model import read_load_model
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import Member
from netdesign.words.catalogue import render

MODEL = read_load_model(load_standard("swiss-guideline-2007"))
RANGE = (math.radians(24.3), math.radians(36.1))


def a_net(**changes):
    values = {
        "slope_angle": math.radians(43.7),
        "snow_thickness": 3.37,
        "net_height": 3.61,
        "inclination": 0.0,
        "stiffness": 1.17e6,
        "slack": 0.031,
        "layout": SupportLayout(
            post_spacing=3.73, uphill_anchor_distance=3.2, downhill_anchor_distance=3.9
        ),
    }
    return NetGeometry(**(values | changes))


def draw_net(draw):
    """A practical net with an untidy number everywhere."""
    thickness = draw.uniform(1.4, 4.6)
    height = thickness * draw.uniform(1.0, 1.3)
    tilt = math.radians(draw.uniform(0.0, 25.0))
    return a_net(
        slope_angle=math.radians(draw.uniform(28.0, 52.0)),
        snow_thickness=thickness,
        net_height=height,
        stiffness=10.0 ** draw.uniform(5.3, 7.2),
        slack=draw.uniform(0.0, 0.11),
        layout=SupportLayout(
            post_spacing=draw.uniform(2.2, 5.1),
            post_tilt=tilt,
            uphill_anchor_distance=height * draw.uniform(0.6, 1.7),
            downhill_anchor_distance=height * draw.uniform(0.6, 1.7),
            post_base_distance=draw.choice([None, height * draw.uniform(0.0, 0.4)]),
        ),
    )


def solve(net, glide, altitude, inclination):
    """Member forces of both load cases at one inclination [N]."""
    net = replace(net, inclination=inclination)
    for case in list_load_cases(MODEL, net, altitude):
        yield solve_load_case(MODEL, net, case, glide).anchors.member_forces


def find(nets, altitude=None, inclinations=RANGE):
    return find_floor(MODEL, nets, inclinations=inclinations, altitude=altitude)


def test_foot_of_a_short_snowpack_by_hand():
    """psi 45, D 4 m, N 2.4 at 30 degrees, chord and cable worked by hand."""
    thickness, spacing, delta = 4.0, 3.3, math.radians(30.0)
    net = a_net(
        slope_angle=math.radians(45.0),
        snow_thickness=thickness,
        net_height=thickness,
        slack=0.05,
        stiffness=9.1e6,
        layout=replace(a_net().layout, post_spacing=spacing),
    )
    floor = find([LoadedNet(net=net, glide_factor=2.4)], inclinations=(delta, delta))
    expected = []
    for rho, share in ((0.27, 1.0), (0.40, 0.77)):
        height = share * thickness / math.cos(math.radians(45.0))
        creep = 0.54 + 1.06 * rho - 1.86 * rho**2 + 2.5 * rho**3
        along = 0.8 * rho * 10.0 * height**2 / 2.0 * creep * 2.4
        prism = rho * 10.0 * (share * thickness) ** 2 / 2.0 * math.tan(delta)
        down = along * 0.35 / 2.4 + prism * math.sqrt(0.5)
        along += prism * math.sqrt(0.5)
        across = along * math.cos(delta) + down * math.sin(delta)
        v1, v2 = 1.0 - share / 2.0, share / 2.0
        square = share * (v1**2 - v1 * v2 + v2**2) / 3.0 + (1.0 - share) * v2**2
        pull = 1.0
        for _ in range(200):  # of (G8), stretch on the right side
            pull = across * math.sqrt(0.5 * square / (0.05 + 1.05 * pull / 9100.0))
        foot = math.hypot(
            v1 * along + pull * math.sin(delta), -v1 * down + pull * math.cos(delta)
        )
        expected.append(spacing * foot)
    found = floor.find(Member.FOOT_ANCHOR)
    assert found.force / 1e3 == pytest.approx(max(expected), rel=1e-6)
    assert found.case.name == "load_case_2"
    assert max(expected) == expected[1] > 1.05 * expected[0]


def test_scan_misses_less_than_a_hundred_thousandth():
    """Four times as many inclinations find no force that is larger by 1e-5.

    Over wide ranges, so that some forces are largest inside them.
    """
    draw, inside = random.Random(3), 0
    for _ in range(24):
        net, glide = draw_net(draw), draw.uniform(1.05, 3.2)
        low = math.radians(draw.uniform(0.0, 20.0))
        ends = (low, low + math.radians(draw.uniform(10.0, 35.0)))
        floor = find([LoadedNet(net=net, glide_factor=glide)], 1873.0, ends)
        assert floor.reason is None
        fine = math.ceil(4.0 * (ends[1] - ends[0]) / SCAN_STEP)
        for k in range(fine + 1):
            at = ends[0] + (ends[1] - ends[0]) * k / fine
            for forces in solve(net, glide, 1873.0, at):
                for member, force in forces.items():
                    assert force <= floor.find(member).force * (1.0 + 1e-5)
        places = {one.at.net.inclination for one in floor.forces if one.force > 0.0}
        inside += len(places - set(ends))
    assert inside >= 5


def test_largest_force_is_that_of_its_own_case_inclination_and_net():
    glide, altitude = 2.37, 2130.0
    floor = find([LoadedNet(net=a_net(), glide_factor=glide)], altitude)
    assert {one.member for one in floor.forces} == set(Member) - {Member.NET}
    for one in floor.forces:
        names = ("load_case_1", "load_case_2")
        again = dict(
            zip(names, solve(a_net(), glide, altitude, one.at.net.inclination),
                strict=True)
        )  # fmt: skip
        assert again[one.case.name][one.member] == one.force
        assert RANGE[0] <= one.at.net.inclination <= RANGE[1]
        assert all(forces[one.member] <= one.force for forces in again.values())


def test_altitude_counts_in_load_case_1_alone():
    nets = [LoadedNet(net=a_net(), glide_factor=2.37)]
    low, high = find(nets, 1500.0), find(nets, 2990.0)
    assert find(nets, None) == low
    for below, above in zip(low.forces, high.forces, strict=True):
        assert above.force >= below.force
    assert high.find(Member.UPHILL_GUY).case.name == "load_case_1"
    ratio = high.find(Member.UPHILL_GUY).force / low.find(Member.UPHILL_GUY).force
    assert 1.2 < ratio < 1.5


def test_corners_of_the_other_ranges_bound_what_lies_between():
    """Slack, stiffness, glide factor and height: corners, against 30 points inside."""
    draw, spans = random.Random(7), 0
    for _ in range(12):
        net = draw_net(draw)
        ends = {
            "slack": (net.slack, net.slack + draw.uniform(0.01, 0.05)),
            "stiffness": (net.stiffness, net.stiffness * draw.uniform(1.2, 3.0)),
            "snow_thickness": (net.snow_thickness * 0.7, net.snow_thickness),
            "glide": (draw.uniform(1.1, 2.0), draw.uniform(2.1, 3.2)),
        }
        corners = [dict(zip(ends, one, strict=True)) for one in product(*ends.values())]
        floor = find([build(net, **one) for one in corners], 1742.0)
        if floor.reason is not None:
            continue
        spans += 1
        for _ in range(30):
            inside = {key: draw.uniform(*pair) for key, pair in ends.items()}
            at = draw.uniform(*RANGE)
            one = build(net, **inside)
            for forces in solve(one.net, one.glide_factor, 1742.0, at):
                for member, force in forces.items():
                    assert force <= floor.find(member).force * (1.0 + 1e-4)
    assert spans >= 6


def build(net, glide, **changes):
    return LoadedNet(net=replace(net, **changes), glide_factor=glide)


def test_inclinations_are_close_and_hold_both_ends():
    low, high = RANGE
    found = list_inclinations(low, high)
    assert (found[0], found[-1]) == (low, high)
    steps = [b - a for a, b in pairwise(found)]
    assert 0.0 < min(steps) <= max(steps) <= SCAN_STEP * (1.0 + 1e-9)
    assert list_inclinations(low, low) == [low]


def test_where_the_closed_forms_fail_there_is_no_floor_but_a_reason():
    """A slope beyond what the load model takes; a support that cannot stand."""
    steep = a_net(slope_angle=1.52)
    floor = find([LoadedNet(net=a_net(), glide_factor=2.0),
                  LoadedNet(net=steep, glide_factor=2.0)])  # fmt: skip
    assert floor.forces == ()
    assert floor.find(Member.POST) is None
    told = render(floor.reason, "en")
    assert "load case 1 at a net inclination of 24.3 degrees" in told
    no_guy = replace(
        a_net().layout, post_base_distance=6.0, uphill_anchor_distance=0.0,
        downhill_anchor_distance=0.0,
    )  # fmt: skip
    fallen = find([LoadedNet(net=a_net(layout=no_guy), glide_factor=2.0)])
    assert fallen.forces == ()
    assert "floor of every demand" in render(fallen.reason, "en")


def test_force_is_in_proportion_to_the_post_spacing():
    wide = replace(a_net().layout, post_spacing=2.0 * 3.73)
    one = find([LoadedNet(net=a_net(), glide_factor=2.2)])
    two = find([LoadedNet(net=a_net(layout=wide), glide_factor=2.2)])
    for narrow, twice in zip(one.forces, two.forces, strict=True):
        assert twice.force == pytest.approx(2.0 * narrow.force, rel=1e-12)
