"""Independent checks of a real solution: met as it is, not met when it is spoilt."""

import math
from dataclasses import replace

import pytest

from netdesign.study.judge import record_independent
from netdesign.study.row_to_check import CaseSolver
from tests.grid import build_cases
from tests.small_site import RANGES, ROWS, RUN

ROW = ROWS[1]


@pytest.fixture(scope="module")
def solved():
    solver = CaseSolver(RUN.settings, RUN.creep_law)
    (result,) = solver.solve_all([(ROW, build_cases(RANGES)[-1], solver.law)])
    return result


def check(result):
    return {one.name: one for one in record_independent(ROW, result)}


def test_a_sound_solution_meets_all(solved):
    found = check(solved)
    assert set(found) == {
        *("global_balance", "friction_excess", "end_direction", "capstan_ratio"),
        *("tension_share", "head_balance"),
    }
    assert all(one.is_met for one in found.values())
    assert 1.0 < found["capstan_ratio"].value <= found["capstan_ratio"].limit


def test_capstan_bound_is_that_of_a_smooth_contact(solved):
    """Nodes tend to exp(tan phi * turning); the turning is that of the two ends."""
    x, y = solved.solution.net_curve
    angles = [math.atan2(y[k + 1] - y[k], x[k + 1] - x[k]) for k in (0, len(x) - 2)]
    smooth = math.exp(math.tan(solved.case.friction_angle) * abs(angles[1] - angles[0]))
    assert check(solved)["capstan_ratio"].limit == pytest.approx(smooth, rel=0.05)


def test_spoilt_solutions_are_found(solved):
    solution = solved.solution
    turned = replace(solution, foot=replace(solution.foot, x=-solution.foot.x))
    assert not check(replace(solved, solution=turned))["end_direction"].is_met
    third = replace(
        solution.balance, smallest_tension=solution.balance.smallest_tension / 3
    )
    uneven = replace(solution, balance=third)
    assert not check(replace(solved, solution=uneven))["capstan_ratio"].is_met
    none = replace(solution.balance, smallest_tension=0.0, relative_residual=0.1)
    found = check(replace(solved, solution=replace(solution, balance=none)))
    for name in ("global_balance", "capstan_ratio", "tension_share"):
        assert not found[name].is_met
    base = replace(solved.anchors.post_base, x=-solved.anchors.post_base.x)
    open_head = replace(solved, anchors=replace(solved.anchors, post_base=base))
    assert not check(open_head)["head_balance"].is_met


def test_without_a_solution_there_is_nothing(solved):
    assert record_independent(ROW, replace(solved, solution=None)) == []
