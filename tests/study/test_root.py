"""The largest value at which one case passes: against closed forms."""

import math
import random

import pytest

from netdesign.study.root import Root, round_down
from netdesign.words.message import Message
from tests.study.test_flips import ROW, MadeUpProbe, a_target

STEP = 0.01


def build_root(force, used, probe=None, limits=(1.25, 3.0)):
    target = a_target(used, force)
    probe = probe or MadeUpProbe(force)
    return Root(target, probe, "thickness", target.governing, limits, 2.0, STEP), probe


def draw_force(seed):
    """Force with a bent curve of the thickness, 1 N as the row is."""
    draw = random.Random(seed)
    power, bend = draw.uniform(0.7, 4.3), draw.uniform(-0.4, 0.4)

    def force(row, case):
        way = math.log(row.at(case).snow_thickness / 2.5)
        return math.exp(power * way + bend * way * way) * case.density / 400.0

    return force


@pytest.mark.parametrize("seed", range(10))
def test_the_last_step_that_passes_is_found(seed):
    force = draw_force(seed)
    used = random.Random(seed).uniform(0.92, 1.4)
    root, _ = build_root(force, used)
    found = round_down(root.find(2.5), STEP)
    target = a_target(used, force)

    def use(thickness):
        at = target.governing.with_value("thickness", thickness)
        return used * force(ROW, at)

    assert use(found) <= 1.0
    assert use(found + 2.0 * STEP) > 1.0 or found == 3.0


@pytest.mark.parametrize("seed", range(10))
def test_points_that_other_cases_have_solved_spare_steps(seed):
    """Ends of the search in a case that carries less, and grows a little otherwise."""
    force, used = draw_force(seed), random.Random(seed).uniform(1.03, 1.4)

    def lagging(row, case):
        lag = (row.at(case).snow_thickness / 2.5) ** 0.05
        return force(row, case) * (0.93 * lag if case.friction_angle > 0.6 else 1.0)

    target, probes = a_target(used, lagging), [MadeUpProbe(lagging) for _ in range(2)]
    other = target.governing.with_value("friction_angle", math.radians(45))
    probes[1].solve_moved(ROW, [(other, "thickness", at) for at in (1.25, 3.0)])
    probes[1].count = 0
    values = [build_root(lagging, used, one)[0].find(2.5) for one in probes]
    assert round_down(values[0], STEP) == pytest.approx(
        round_down(values[1], STEP), abs=1.01 * STEP
    )
    assert probes[1].count <= probes[0].count
    assert probes[1].count <= 3


def test_an_end_that_is_no_step_is_reached():
    root, _ = build_root(draw_force(1), 0.5, limits=(1.25, 2.7183))
    assert root.find(2.5) == 2.7183


def test_a_force_that_no_value_makes_small_enough_is_told():
    root, _ = build_root(draw_force(1), 90.0)
    found = root.find(2.5)
    assert isinstance(found, Message)
    assert found.key == "change.not_even"


def test_misleading_points_do_not_end_the_search():
    """The other case falls where this one rises: its points are no curve."""
    force = draw_force(4)

    def falling(row, case):
        if case.friction_angle > 0.6:
            return 0.95 * (row.at(case).snow_thickness / 2.5) ** -1.7
        return force(row, case)

    target, probe = a_target(1.2, falling), MadeUpProbe(falling)
    other = target.governing.with_value("friction_angle", math.radians(45))
    probe.solve_moved(ROW, [(other, "thickness", at) for at in (1.25, 3.0)])
    plain, _ = build_root(falling, 1.2)
    found = build_root(falling, 1.2, probe)[0].find(2.5)
    assert round_down(found, STEP) == round_down(plain.find(2.5), STEP)
