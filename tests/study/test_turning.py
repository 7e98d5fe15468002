"""Value at which a check turns: with made-up forces that grow as drawn."""

import math
import random

import pytest

from netdesign.envelope.ranges import Case, Interval, Ranges
from netdesign.study.check_by_case import (
    CheckByCase,
    CheckLine,
    NoResultError,
    Point,
    list_near,
)
from netdesign.study.remedies import find_height_remedy
from tests.each import each
from tests.study.test_remedies import ROW, MadeUpSolver, a_check

STEP = 0.01  # of three digits
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


def build_line(check, force, ends=(1.25, 3.0), **solver):
    return CheckLine(
        check=check,
        quantity="thickness",
        cases=list_near(check),
        ends=ends,
        solver=MadeUpSolver(force, **solver),
    )


def draw_bent_force(seed):
    """Force with a bent curve of the thickness, 1 N as the row is."""
    draw = random.Random(seed)
    power, bend = draw.uniform(0.7, 4.3), draw.uniform(-0.4, 0.4)

    def force(row, case):
        way = math.log(row.at(case).snow_thickness / 2.5)
        return math.exp(power * way + bend * way * way) * case.density / 400.0

    return force


@each("seed", range(10))
def test_the_last_value_that_passes_is_found(seed):
    """Up to half a percent of the utilisation, or a step, whichever is more."""
    force = draw_bent_force(seed)
    used = random.Random(seed).uniform(0.92, 1.4)
    line = build_line(a_check(used, force), force)
    low, high = (line.find_use(end) for end in line.ends)
    assert low.passes
    if high.passes:
        return
    found = line.find_turn(low, high)
    assert found == round(found, 3)
    assert line.find_use(found).used <= 1.0
    above = line.find_use(found + 2.0 * STEP).used
    assert above > 1.0 or line.find_use(found).used > 0.995


def test_a_kink_does_not_end_the_search():
    """A floor that takes over on the way: flat, then steep."""

    def kinked(row, case):
        thickness = row.at(case).snow_thickness
        return max(0.2 * thickness / 2.5, (thickness / 2.5) ** 9)

    line = build_line(a_check(1.31, kinked), kinked)
    found = line.find_turn(*(line.find_use(end) for end in line.ends))
    assert found == pytest.approx(2.5 * 1.31 ** (-1 / 9), abs=2.0 * STEP)
    assert line.find_use(found).passes


def test_a_step_that_jumps_is_bracketed():
    def jump(row, case):
        return 0.5 if row.at(case).snow_thickness < 2.1234 else 1.7

    line = build_line(a_check(1.0, jump), jump)
    found = line.find_turn(*(line.find_use(end) for end in line.ends))
    assert 2.1234 - 2.0 * STEP <= found < 2.1234


def test_a_case_without_a_result_ends_the_search():
    force = draw_bent_force(1)
    check = a_check(1.2, force)
    line = build_line(check, force, fails=lambda *_: True)
    with pytest.raises(NoResultError) as none:
        line.find_turn(Point(value=1.25, used=0.4), Point(value=2.4, used=1.2))
    assert 1.25 < none.value.value < 2.4


def test_nothing_that_passes_is_none():
    """The point that was said to pass does not, in a case near to governing."""
    force = draw_bent_force(1)
    line = build_line(a_check(60.0, force), force)
    now = Point(value=2.5, used=60.0)
    assert line.find_turn(Point(value=1.25, used=0.999), now) is None


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


def build_check(used, force):
    results = [MadeUpSolver(force).solve(ROW, case) for case in CASES]
    largest = max(results, key=lambda one: one.member_forces["post"].high)
    return CheckByCase(
        row=ROW,
        ranges=RANGES,
        member="post",
        scale=used / largest.member_forces["post"].high,
        governing=largest.case,
        results=results,
    )


@each("seed", range(12))
def test_a_remedy_passes_in_every_case_of_the_search(seed):
    force, used = draw_force(seed), random.Random(seed).uniform(0.91, 1.9)
    check = build_check(used, force)
    change = find_height_remedy(check, MadeUpSolver(force))
    highest = change.bound
    worst = max(force(ROW, case.with_value("thickness", highest)) for case in CASES)
    assert check.scale * worst <= 1.0
    above = min(highest + 2.0 * STEP, ROW.net_height)
    worst = max(force(ROW, case.with_value("thickness", above)) for case in CASES)
    assert check.scale * worst > 0.993 or above == ROW.net_height


def test_a_quantity_at_zero_is_rounded_too():
    """A slack of nothing has no first digit."""
    check = a_check(1.0)
    line = CheckLine(
        check=check,
        quantity="slack",
        cases=list_near(check),
        ends=(0.0, 0.137),
        solver=MadeUpSolver(),
    )
    assert line.find_step(0.0) == 1e-4
    found = line.find_turn(Point(value=0.0, used=1.0), Point(value=0.1, used=1.2))
    assert found is None or line.find_use(found).passes
