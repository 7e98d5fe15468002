"""First design of a search: rough first, then again where it may matter."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.solution import EndPull, FailedSolution
from netdesign.envelope.rows import build_point_task
from netdesign.envelope.search import search_rows
from netdesign.envelope.signed_forces import SIGNED, read_signed
from netdesign.outcome import Outcome
from netdesign.solving.runner import Runner
from netdesign.words.message import say
from tests.each import each
from tests.envelope.tasks import build_row
from tests.solving.made_up_workers import Recording, Spoiling
from tests.solving.small_scene import LAYOUT, solve_case

SETTINGS = SolverSettings(accuracy=0.004, levels=MESH_LEVELS[:4])
TASK = build_row((253.0, 418.0), (14.3, 44.1), gap=0.004, settings=SETTINGS)


def show(result):
    return {member: band.value for member, band in result.member_forces.items()}


@pytest.fixture(scope="module")
def workers():
    return Recording()


@pytest.fixture(scope="module")
def found(workers):
    (one,) = search_rows([TASK], Runner(workers=workers))
    assert one.gap is None
    return one


def list_rough(found):
    return [
        (point, result)
        for point, result, doubt in zip(
            found.maxima.points, found.results, found.maxima.doubts, strict=True
        )
        if doubt.any()
    ]


def test_only_what_lies_far_below_the_largest_forces_stays_rough(found):
    rough = list_rough(found)
    assert 3 <= len(rough) <= len(found.results) - 10
    largest = {m: one.force.value for m, one in found.extremes.items()}
    for _, result in rough:
        for member, band in result.member_forces.items():
            assert band.high < 0.9 * largest[member] or largest[member] == 0.0
        pulls = (result.solution.foot, result.solution.head)
        assert any(pull.error > 0.004 * pull.size for pull in pulls)


def test_rough_results_are_converged_and_state_errors_that_hold(found):
    for point, result in list_rough(found):
        assert result.is_converged
        assert result.solution.balance.relative_residual <= 1e-8
        exact = solve_case(build_point_task(TASK, point))
        assert exact.solution.cost.elements > result.solution.cost.elements
        for member, band in exact.member_forces.items():
            own = result.member_forces[member]
            assert abs(own.value - band.value) <= own.high - own.value


def test_all_others_are_solved_as_the_row_asks_for(found):
    rough = {point for point, _ in list_rough(found)}
    others = [
        (point, result)
        for point, result in zip(found.maxima.points, found.results, strict=True)
        if point not in rough
    ]
    assert found.skipped == 0
    for point, result in others[::4]:
        exact = solve_case(build_point_task(TASK, point))
        assert show(exact) == show(result)


def test_the_bound_holds_for_cases_that_are_all_solved_accurately(found):
    for point in np.random.default_rng(3).uniform(size=(40, 2)):
        result = solve_case(build_point_task(TASK, tuple(point.tolist())))
        for place, member in enumerate(found.members):
            force = result.member_forces[member].value
            assert force <= found.maxima.upper_bound[place] * (1.0 + 1e-9)


def test_what_fails_roughly_is_solved_again():
    """Also where its force would not matter; the search never sees the failure."""

    def spoil(job, end):
        if job.settings == SETTINGS or job.scene.snowpack.density > 260.0:
            return end
        reason = say("text.as_given", text="too coarse")
        return FailedSolution(outcome=Outcome.MAX_ITERATIONS, reason=reason)

    (found,) = search_rows([TASK], Runner(workers=Spoiling(spoil)))
    assert found.gap is None
    assert all(result.case.density > 260.0 for _, result in list_rough(found))


def name_signed(result):
    """Signed forces of the section, and their errors, by name."""
    own = SIGNED[: len(SIGNED) // 2]
    return [
        dict(zip(own, numbers[0], strict=False))
        for numbers in read_signed([result], [LAYOUT])
    ]


@each("seed", range(6))
def test_signed_errors_bound_what_errors_of_the_pulls_do(seed):
    rng = np.random.default_rng(seed)
    result = solve_case(build_point_task(TASK, tuple(rng.uniform(size=2).tolist())))
    before, errors = name_signed(result)
    state, angle = result.solution, rng.uniform(0.0, 2.0 * math.pi)
    shift = np.array([math.cos(angle), math.sin(angle)]) * state.head.error
    moved = replace(
        state,
        head=EndPull(
            x=state.head.x + shift[0],
            y=state.head.y + shift[1],
            error=state.head.error,
        ),
    )
    after, _ = name_signed(replace(result, solution=moved))
    changes = {name: abs(after[name] - before[name]) for name in before}
    assert any(change > 0.1 * errors[name] for name, change in changes.items())
    for name, change in changes.items():
        assert change <= errors[name] * (1.0 + 1e-9)
    foot = state.foot.error * LAYOUT.post_spacing
    assert errors["signed foot"] == pytest.approx(foot)
    shared = errors["signed foot"] + errors["signed uphill guy"]
    assert errors["signed foot and uphill guy"] == pytest.approx(shared)
