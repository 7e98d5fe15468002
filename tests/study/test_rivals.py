"""Bounds of rivals: none may hide a case that takes over, with made-up forces."""

import math
import random

import pytest

from netdesign.envelope.ranges import Case, Interval, Ranges
from netdesign.study.flips import find_height_change
from netdesign.study.rivals import bound_rival, put_outer_first
from netdesign.study.target import Move, Target
from tests.study.test_flips import ROW, MadeUpProbe

RANGES = Ranges.of(
    density=Interval(low=263.0, high=391.0),
    friction_angle=Interval(low=0.27, high=0.71),
    inclination=Interval(low=0.44, high=0.61),
)
ANGLES = (0.27, 0.41, 0.53, 0.71)
CASES = [
    Case(density=density, friction_angle=friction, inclination=inclination)
    for density in (263.0, 391.0)
    for inclination in (0.44, 0.52, 0.61)
    for friction in ANGLES
]


def build_target(used, force):
    results = [MadeUpProbe(force).solve(ROW, case) for case in CASES]
    largest = max(results, key=lambda one: one.member_forces["post"].high)
    scale = used / largest.member_forces["post"].high
    return Target(
        row=ROW,
        ranges=RANGES,
        member="post",
        scale=scale,
        governing=largest.case,
        results=results,
    )


def draw_force(seed):
    """Force whose cases grow apart: lines of inclination by powers of their own."""
    draw = random.Random(seed)
    powers = {0.44: draw.uniform(1.6, 2.5), 0.52: draw.uniform(1.6, 2.5), 0.61: 2.1}
    sizes = {0.44: draw.uniform(0.91, 0.99), 0.52: draw.uniform(0.91, 0.99), 0.61: 1.0}
    slopes = {one: draw.uniform(-0.03, 0.03) for one in sizes}

    def force(row, case):
        thickness = row.at(case).snow_thickness / 2.5
        size = sizes[case.inclination] * thickness ** powers[case.inclination]
        size *= 1.0 + slopes[case.inclination] * (case.friction_angle - 0.5)
        return size * (case.density / 391.0) ** 1.6

    return force


@pytest.mark.parametrize("seed", range(12))
def test_a_change_passes_in_every_case_that_was_not_asked(seed):
    force, used = draw_force(seed), random.Random(seed).uniform(0.91, 1.9)
    target, probe = build_target(used, force), MadeUpProbe(force)
    change = find_height_change(target, probe)
    move = Move(name="thickness", value=change.bound)
    every = target.solve(MadeUpProbe(force), CASES, move)
    largest = max(target.utilisation(one, move) for one in every)
    assert 0.98 < largest <= 1.0
    assert probe.count < len(CASES) - 4


@pytest.mark.parametrize("name", ["thickness", "density"])
@pytest.mark.parametrize("share", [0.87, 1.31])
def test_the_bound_of_a_rival_grows_with_the_way(name, share):
    target = build_target(1.2, draw_force(5))
    at = target.governing
    rival = next(one for one in CASES if one.inclination != at.inclination)
    if name == "density":
        rival = at.with_value("inclination", 0.44)
    now = target.find_value(at, name)
    near, far = (
        bound_rival(target, rival, Move(name=name, value=now * by), {at: 0.97})
        for by in (share**0.5, share)
    )
    ratio = target.compare(rival) / target.compare(at)
    if rival.density == at.density:
        assert 0.97 * ratio < near < far
    else:
        assert name == "thickness"
        assert near < far


def test_nothing_is_known_of_other_quantities_nor_of_another_value_of_this_one():
    target = build_target(1.2, draw_force(7))
    at = target.governing
    lighter = at.with_value("density", 263.0)
    for move, rival in (
        (Move(name="friction_angle", value=0.33), at.with_value("inclination", 0.44)),
        (Move(name="density", value=371.0), lighter),
    ):
        assert bound_rival(target, rival, move, {at: 0.5}) == math.inf


def test_what_lies_between_two_frictions_is_bounded_by_both():
    target = build_target(1.2, draw_force(3))
    line = [target.governing.with_value("friction_angle", one) for one in ANGLES]
    move = Move(name="thickness", value=1.31)  # a long way: by nothing else
    outer = {line[0]: 0.83, line[3]: 0.871}
    assert bound_rival(target, line[1], move, outer) == pytest.approx(0.871 * 1.002)
    del outer[line[3]]
    assert bound_rival(target, line[1], move, outer) > 0.871 * 1.002


def test_the_ends_of_every_line_are_asked_first_and_the_first_one_stays():
    given = [CASES[k] for k in (14, 13, 12, 15, 9, 10, 8, 11)]
    ordered = put_outer_first(given)
    assert sorted(ordered) == sorted(given)
    assert ordered[0] == given[0]
    assert {one.friction_angle for one in ordered[1:5]} == {ANGLES[0], ANGLES[3]}
    assert {one.friction_angle for one in ordered[5:]} <= {ANGLES[1], ANGLES[2]}
