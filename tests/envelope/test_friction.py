"""The skip of cases that friction cannot change, on made-up ends."""

from dataclasses import replace

import pytest

from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.solution import EndPull
from netdesign.envelope.search import FrictionSkip
from netdesign.solving.workers import Job, solve_job
from tests.solving.test_store import solve_one

AXES = ("density", "friction_angle")
LOW, MIDDLE, HIGH = (0.3, 0.0), (0.3, 0.5), (0.3, 1.0)


@pytest.fixture(scope="module")
def end():
    """One real end; what matters of it is changed by ``sticking``."""
    return solve_one()


def sticking(end, *, sticks=True, foot=1e5):
    slides = end.net_slides.copy()
    slides[:] = not sticks
    pull = EndPull(x=foot, y=0.0, error=1.0)
    return replace(end, net_slides=slides, foot=pull)


def needs_solve(skip, point):
    return skip.choose([point]) == [point]


def after_two_tests(end, **second):
    """Skip that was tested twice, the second time with an end of its own."""
    skip = FrictionSkip(AXES)
    for line, other in ((0.1, {}), (0.2, second)):
        skip.learn((line, 0.0), sticking(end))
        assert needs_solve(skip, (line, 1.0))
        skip.learn((line, 1.0), sticking(end, **other))
    return skip


def test_a_test_that_disagrees_ends_the_skipping(end):
    skip = after_two_tests(end, foot=1e5 * (1.0 + 1e-5))
    skip.learn(LOW, sticking(end))
    assert needs_solve(skip, HIGH)


def test_sliding_snow_answers_for_nothing(end):
    skip = after_two_tests(end)
    skip.learn(LOW, sticking(end, sticks=False))
    assert needs_solve(skip, MIDDLE)
    skip.learn(MIDDLE, sticking(end))
    assert not needs_solve(skip, HIGH)
    assert needs_solve(skip, LOW)  # less friction than what is known to stick


def test_the_solver_does_not_feel_friction_where_snow_sticks(a_scene):
    """What the skip relies on, on the real thing: rough ground, an upright net."""
    settings = SolverSettings(accuracy=0.1, levels=MESH_LEVELS[:2])
    ends = [
        solve_job(Job(scene=a_scene(friction_deg=phi, slack=0.05), settings=settings))
        for phi in (30.0, 45.0)
    ]
    assert all(end.sticks for end in ends)
    low, high = ends
    assert (low.foot, low.head) == (high.foot, high.head)


def test_friction_hardly_matters_where_snow_slips_by_the_foot_only(a_scene):
    scenes = [a_scene(inclination_deg=30.0, friction_deg=phi) for phi in (36.0, 45.0)]
    low, high = (
        solve_job(Job(scene=scene, settings=SolverSettings())) for scene in scenes
    )
    assert low.net_slides.any()
    assert low.sticks
    for one, other in ((low.foot, high.foot), (low.head, high.head)):
        assert abs(one.x - other.x) + abs(one.y - other.y) <= 0.1 * one.error
