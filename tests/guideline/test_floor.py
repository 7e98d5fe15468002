"""The guideline's load as floor: what a search may miss, and where there is none."""

import math
import random
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from netdesign.checks import load_standard
from netdesign.guideline.floor import SCAN_STEP, NetRanges, find_floors
from netdesign.guideline.load_cases import (
    NetGeometry,
    find_glide_factor,
    find_pulls,
    list_load_cases,
    place_head,
    solve_load_case,
)
from netdesign.guideline.load_model import read_load_model
from netdesign.snow.ground import GroundLaw
from netdesign.structure.anchors import compute_member_forces
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import CARRYING_MEMBERS, Member, NetPart
from netdesign.structure.splay import find_ways
from netdesign.words.catalogue import render
from tests.each import each
from tests.guideline.one_floor import find_floor

MODEL = read_load_model(load_standard("swiss-guideline-2007"))
DOWNHILL = Member.DOWNHILL_GUY
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


def build_ranges(net=None, glide=2.37, **changes):
    """Ranges of one net over the inclinations, and over what is changed."""
    net = net or a_net()
    values = {
        "net": net,
        "inclinations": RANGE,
        "thicknesses": (net.snow_thickness, net.snow_thickness),
        "stiffnesses": (net.stiffness, net.stiffness),
        "slacks": (net.slack, net.slack),
        "find_glide_factors": lambda d: (0.0 * d + glide, 0.0 * d + glide),
    }
    return NetRanges(**(values | changes))


def find(ranges, altitude=1742.0):
    return find_floor(MODEL, ranges, altitude)


def draw_ranges(draw):
    """Wide ranges of all at once: N by itself, or by a slip length and the snow."""
    net, low = draw_net(draw), math.radians(draw.uniform(0.0, 20.0))
    thickness, tight = net.snow_thickness, draw.uniform(0.0, 0.11)
    least, largest = draw.uniform(1.2, 2.0), draw.uniform(2.1, 3.2)
    grounds = [
        GroundLaw(kind="sliding", slip_length=draw.uniform(*pair))
        for pair in ((0.05, 2.0), (2.0, 9.0))
    ]
    by_slip = draw.random() < 0.5

    def find_glide_factors(d):
        if by_slip:
            return tuple(find_glide_factor(one, d, (1.2, 3.2)) for one in grounds)
        return 0.0 * d + least, 0.0 * d + largest

    return NetRanges(
        net=net,
        inclinations=(low, low + math.radians(draw.uniform(10.0, 35.0))),
        thicknesses=(thickness * draw.uniform(0.3, 0.8), thickness),
        stiffnesses=(net.stiffness, net.stiffness * draw.uniform(1.2, 10.0)),
        slacks=(tight, tight + draw.uniform(0.01, 0.08)),
        find_glide_factors=find_glide_factors,
    )


def solve_dense(ranges, altitude, counts, at_ends=2):
    """Largest values over a dense grid, slack and stiffness within theirs, too."""
    spans = (ranges.inclinations, ranges.thicknesses, (0.0, 1.0))
    axes = [np.linspace(*span, n) for span, n in zip(spans, counts, strict=True)]
    lean, d, share = (one.ravel() for one in np.meshgrid(*axes))
    least, largest = ranges.find_glide_factors(d)
    slack = np.linspace(*ranges.slacks, at_ends)
    stiffness = np.linspace(*ranges.stiffnesses, at_ends)
    slack, stiffness = (one.reshape(-1, 1) for one in np.meshgrid(slack, stiffness))
    net = replace(
        ranges.net,
        inclination=lean,
        snow_thickness=d,
        slack=slack,
        stiffness=stiffness,
    )
    found = {}
    for case in list_load_cases(MODEL, net, altitude):
        _, pull = find_pulls(MODEL, net, case, least + share * (largest - least))
        forces, is_held = compute_member_forces(
            find_ways([net.layout], tuple(x[None, None] for x in place_head(net))),
            foot_pull_per_m=pull.foot,
            head_pull_per_m=pull.head,
            post_spacing=net.layout.post_spacing,
            is_foot_shared=net.layout.is_foot_shared,
        )
        if not is_held.all():
            return None
        turn = np.arctan2(pull.foot[1], pull.foot[0])
        values = {
            **forces,
            "pull": net.layout.post_spacing * np.hypot(*pull.head),
            "turn": turn,
            "less turn": -turn,
            NetPart.MESH: pull.largest_tension,
        }
        for name, value in values.items():
            found[name] = max(found.get(name, -math.inf), value.max())
    return found


def require_largest(floor, dense, small):
    """Refuse a value of the dense grid that is above the floor by a share."""
    post = floor.find(Member.POST).force
    for one in floor.forces:
        assert dense[one.member] <= one.force * (1.0 + small) + 1e-9 * post
    head = floor.head
    assert dense["pull"] <= head.pull * (1.0 + small)
    assert dense["turn"] <= head.foot_largest + small
    assert -dense["less turn"] >= head.foot_least - small


def require_reached(head, dense, small):
    """Refuse a span at head and foot that goes beyond that of the dense grid."""
    assert head.pull <= dense["pull"] * (1.0 + small)
    assert head.foot_largest <= dense["turn"] + small
    assert head.foot_least >= -dense["less turn"] - small


def test_foot_of_a_short_snowpack_by_hand():
    """psi 45, D 4 m, N 2.4 at 30 degrees, chord and cable worked by hand.

    Both cases have the load of case 1; of the shares 0.2, 0.35, 0.5 the last counts.
    """
    thickness, spacing, delta = 4.0, 3.3, math.radians(30.0)
    net = a_net(
        slope_angle=math.radians(45.0),
        snow_thickness=thickness,
        net_height=thickness,
        slack=0.05,
        stiffness=9.1e6,
        layout=replace(a_net().layout, post_spacing=spacing),
    )
    floor = find(build_ranges(net, 2.4, inclinations=(delta, delta)), 1500.0)
    expected, rho = [], 0.27
    for normal, share in product((0.2, 0.35, 0.5), (1.0, 0.77)):
        height = thickness / math.cos(math.radians(45.0))
        creep = 0.54 + 1.06 * rho - 1.86 * rho**2 + 2.5 * rho**3
        along = 0.8 * rho * 10.0 * height**2 / 2.0 * creep * 2.4
        prism = rho * 10.0 * thickness**2 / 2.0 * math.tan(delta)
        down = along * normal / 2.4 + prism * math.sqrt(0.5)
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
    assert (found.case.name, found.case.normal_share) == ("load_case_2", 0.5)
    assert max(expected) == expected[-1] > 1.05 * expected[-2]


@pytest.mark.parametrize(("degrees", "count"), [(11.81, 13), (0.1, 3), (0.0, 1)])
def test_grid_has_the_distances_that_theory_tells(degrees, count):
    """A degree at most, eight parts of the others."""
    tried, glides = [], [1.3, 2.7]

    def find_glide_factors(d):
        tried.append(d)
        return 0.0 * d + glides[0], 0.0 * d + glides[1]

    ends = (0.43, 0.43 + math.radians(degrees))
    net = a_net()
    for most in (2.7, 1.3):
        tried.clear()
        glides[1] = most
        wide = (0.5 * net.snow_thickness, net.net_height)
        find(
            build_ranges(
                net,
                inclinations=ends,
                thicknesses=wide,
                find_glide_factors=find_glide_factors,
            )
        )
        _, grid, *_ = tried
        assert grid.size == count * 9 * (9 if most > 1.3 else 1)
        assert {grid.min(), grid.max()} == set(wide)
        assert np.unique(grid).size == 9


def test_search_over_inclinations_misses_less_than_a_hundred_thousandth():
    """Sixty-four times as many inclinations find no force that is larger by 1e-5.

    Over wide ranges, so that some forces are largest inside them.
    """
    draw, inside = random.Random(3), 0
    for _ in range(160):
        low = math.radians(draw.uniform(0.0, 20.0))
        ends = (low, low + math.radians(draw.uniform(10.0, 35.0)))
        ranges = build_ranges(draw_net(draw), draw.uniform(1.2, 3.2), inclinations=ends)
        floor = find(ranges, 1873.0)
        assert floor.reason is None
        fine = math.ceil(64.0 * (ends[1] - ends[0]) / SCAN_STEP)
        require_largest(floor, solve_dense(ranges, 1873.0, (fine + 1, 1, 1), 1), 1e-5)
        places = {one.net.inclination for one in floor.forces if one.force > 0.0}
        inside += len(places - set(ends))
    assert inside >= 15


def test_search_over_all_ranges_misses_less_than_a_hundred_thousandth():
    """Four times finer in all directions find no force that is larger by 1e-5."""
    draw, inside, tried = random.Random(5), set(), 0
    for _ in range(16):
        ranges = draw_ranges(draw)
        floor, dense = find(ranges), solve_dense(ranges, 1742.0, (61, 33, 33))
        assert (floor.reason is None) == (dense is not None)
        if dense is None:
            continue
        tried += 1
        require_largest(floor, dense, 1e-5)
        require_reached(floor.head, dense, 1e-4)
        for one in floor.forces:
            d = one.net.snow_thickness
            is_end = d in ranges.thicknesses
            inside |= set() if is_end or one.force == 0.0 else {one.member}
    assert tried >= 10
    assert DOWNHILL in inside  # corners alone would miss it


def test_ends_of_slack_and_stiffness_bound_what_lies_between():
    """As proven in THEORY: five of each, at any inclination, thickness and N."""
    draw, tried = random.Random(23), 0
    for _ in range(40):
        ranges = draw_ranges(draw)
        one = replace(ranges, inclinations=ranges.inclinations[:1] * 2,
                      thicknesses=ranges.thicknesses[1:] * 2)  # fmt: skip
        floor, dense = find(one), solve_dense(one, 1742.0, (1, 1, 17), 5)
        if floor.reason is None:
            tried += 1
            require_largest(floor, dense, 1e-6)
    assert tried >= 30


def test_inside_of_the_thicknesses_exceeds_all_corners():
    """The downhill guy: thin snow brings little, thick snow presses the head down."""
    net = a_net(slack=0.02, stiffness=3e6)
    wide = build_ranges(net, 1.9, thicknesses=(0.4 * 3.37, 3.37))

    def find_at(d):
        return find(replace(wide, thicknesses=(d, d))).find(DOWNHILL).force

    floor = find(wide).find(DOWNHILL)
    at = floor.net.snow_thickness
    assert floor.force > 1.1 * max(find_at(d) for d in wide.thicknesses) > 0.0
    assert wide.thicknesses[0] < at < wide.thicknesses[1]
    assert find_at(at) == pytest.approx(floor.force, rel=1e-6)
    assert max(find_at(0.97 * at), find_at(1.03 * at)) < floor.force


def test_largest_force_is_that_of_its_own_case_inclination_and_net():
    """All that stands at a force gives it again, by the scalar closed forms."""
    draw = random.Random(17)
    for ranges in (build_ranges(), *(draw_ranges(draw) for _ in range(6))):
        floor = find(ranges, 2130.0)
        if floor.reason is not None:
            continue
        members = {one.member for one in floor.forces}
        assert members == {*CARRYING_MEMBERS, NetPart.MESH}
        for one in floor.forces:
            net = one.net
            cases = list_load_cases(MODEL, net, 2130.0)
            again = [
                solve_load_case(MODEL, net, case, one.glide_factor) for case in cases
            ]
            forces = [
                {
                    **k.anchors.member_forces,
                    NetPart.MESH: k.pull.largest_tension,
                }[one.member]
                for k in again
            ]
            of_case = forces[cases.index(one.case)]
            assert of_case == pytest.approx(one.force, rel=1e-12)
            assert max(forces) <= of_case * (1.0 + 1e-12)
            low, high = ranges.inclinations
            assert low <= net.inclination <= high
            assert net.slack in ranges.slacks
            assert net.stiffness in ranges.stiffnesses
            least, most = ranges.find_glide_factors(np.array(net.snow_thickness))
            assert least - 1e-12 <= one.glide_factor <= most + 1e-12


def test_altitude_counts_in_both_load_cases():
    low, high = (find(build_ranges(), altitude) for altitude in (1500.0, 2990.0))
    for below, above in zip(low.forces, high.forces, strict=True):
        assert above.force >= below.force
    for member, case in (
        (Member.UPHILL_GUY, "load_case_1"),
        ("foot_anchor", "load_case_2"),
    ):
        assert high.find(member).case.name == case
        assert 1.2 < high.find(member).force / low.find(member).force < 1.5


def test_altitude_that_is_not_known_gets_the_largest_factor():
    """f_c of 3000 m and above, from the numbers of the profile."""
    assert find(build_ranges(), None) == find(build_ranges(), 3000.0)
    assert find(build_ranges(), None) == find(build_ranges(), 4810.0)
    other = replace(MODEL, altitude_top=2000.0)
    lower = find_floor(other, build_ranges(), None).find(Member.UPHILL_GUY)
    assert lower.case.density == pytest.approx(270.0 * 1.1, rel=1e-12)
    assert lower.force < find(build_ranges(), None).find(Member.UPHILL_GUY).force


def test_where_the_closed_forms_fail_there_is_no_floor_but_a_reason():
    """A slope beyond what the load model takes; a support that cannot stand."""
    floor = find(build_ranges(a_net(slope_angle=1.52)))
    assert (floor.forces, floor.head) == ((), None)
    assert floor.find(Member.POST) is None
    told = render(floor.reason, "en")
    assert "load case 1 at a net inclination of 24.3 degrees" in told
    assert "slope angle" in told
    no_guy = replace(
        a_net().layout, post_base_distance=6.0, uphill_anchor_distance=0.0,
        downhill_anchor_distance=0.0,
    )  # fmt: skip
    fallen = find(build_ranges(a_net(layout=no_guy)))
    assert fallen.forces == ()
    assert "minimum load of every check" in render(fallen.reason, "en")
    # only the thinnest settled snow covers too little of the net
    thin = find(build_ranges(thicknesses=(0.055 * 3.61, 3.37)))
    assert "load case 2" in render(thin.reason, "en")


def test_force_is_in_proportion_to_the_post_spacing():
    wide = replace(a_net().layout, post_spacing=2.0 * 3.73)
    one, two = find(build_ranges()), find(build_ranges(a_net(layout=wide)))
    for narrow, twice in zip(one.forces, two.forces, strict=True):
        # a strip of the mesh one metre wide does not mind the spacing
        times = 1.0 if narrow.member == NetPart.MESH else 2.0
        assert twice.force == pytest.approx(times * narrow.force, rel=1e-12)
    assert two.head.pull == pytest.approx(2.0 * one.head.pull, rel=1e-12)
    assert two.head.foot_least == pytest.approx(one.head.foot_least, rel=1e-12)


@each("seed", range(20))
def test_floors_of_several_layouts_have_the_forces_of_each_alone(seed):
    draw = random.Random(7000 + seed)
    net = draw_net(draw)
    layouts = [net.layout]
    for _ in range(draw.randrange(1, 5)):
        tilt, uphill, downhill = (draw.uniform(0.7, 1.3) for _ in range(3))
        other = replace(
            net.layout,
            post_tilt=math.radians(15.0 * tilt),
            uphill_anchor_distance=net.net_height * uphill,
            downhill_anchor_distance=net.net_height * downhill,
        )
        layouts.append(other)
    ranges = build_ranges(net, slacks=(0.02, 0.08), stiffnesses=(2e6, 3e7))
    together = find_floors(MODEL, ranges, 1987.0, layouts)
    for layout, found in zip(layouts, together, strict=True):
        alone = find_floor(
            MODEL, replace(ranges, net=replace(net, layout=layout)), 1987.0
        )
        assert found.head.pull == pytest.approx(alone.head.pull, rel=3e-6)
        for one in found.forces:
            force = alone.find(one.member).force
            assert one.force == pytest.approx(force, rel=3e-6, abs=1.0)
