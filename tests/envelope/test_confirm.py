"""Governing cases confirmed by histories: larger forces, failures never hidden."""

import math
from dataclasses import replace

import pytest

from netdesign.checks.result import Band
from netdesign.coupling.history.settings import TransientSettings
from netdesign.coupling.scene import SolverSettings
from netdesign.envelope import confirm
from netdesign.envelope.confirm import (
    build_history_settings,
    confirm_rows,
    find_governing,
    merge_history,
)
from netdesign.envelope.extremes import describe_gap
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult, CaseTask
from netdesign.outcome import Outcome
from netdesign.solving.workers import Job
from netdesign.structure.layout import SupportLayout
from tests.solving.small_scene import solve_case


def band(value, error=0.1):
    return Band(low=value - error, value=value, high=value + error)


def result(density, **forces):
    case = Case(density=density, friction_angle=0.5, inclination=0.5)
    member_forces = {member: band(value) for member, value in forces.items()}
    return CaseResult(case=case, outcome=Outcome.CONVERGED, member_forces=member_forces)


GRID = [result(300.0, post=1.0, guy=9.0), result(350.0, post=2.0, guy=5.0)]
IDLE = result(250.0, post=0.5, guy=0.5)


def test_every_governing_case_is_found_once():
    assert find_governing([IDLE, *GRID]) == [1, 2]
    assert find_governing([IDLE, result(400.0, post=3.0, guy=9.5), *GRID]) == [1]
    assert find_governing([]) == []


def test_slack_members_need_no_history():
    slack = replace(IDLE, member_forces={"guy": Band(low=0.0, value=0.0, high=0.0)})
    assert find_governing([slack]) == []


@pytest.mark.parametrize(
    ("history", "expected"), [(11.0, 11.0), (9.21, 9.21), (9.19, 9.0), (7.0, 9.0)]
)
def test_a_history_counts_if_it_is_surely_larger(history, expected):
    """By more than both errors, 0.1 each; else the steady state is the demand."""
    followed = result(300.0, post=0.5, guy=history)
    merged = merge_history(GRID[0], followed)
    reached = max(9.1, history + 0.1)  # what either may reach is never left out
    assert merged.member_forces["guy"] == replace(band(expected), high=reached)
    assert merged.member_forces["post"] == band(1.0)
    assert merged.is_converged
    assert merged.compared.steady is GRID[0]
    assert merged.compared.history is followed
    assert merged.compared.exceeds("guy") is (expected == history)
    assert not merged.compared.exceeds("post")


def test_histories_of_a_check_follow_the_creep_and_not_the_days():
    settings = build_history_settings(SolverSettings(accuracy=0.02))
    assert settings.start == "steady"
    assert settings.stops_at_plateau
    assert settings.accuracy == 0.02
    assert settings.horizon > 100 * 365 * 86400.0


def test_a_history_without_plateau_leaves_its_row_unproven(monkeypatch):
    lost = CaseResult(
        case=GRID[0].case,
        outcome=Outcome.PLATEAU_NOT_REACHED,
        reason=Outcome.PLATEAU_NOT_REACHED.message,
        member_forces={},
    )
    monkeypatch.setattr(confirm, "run_cases", lambda tasks, **_: [lost] * len(tasks))
    tasks = [[build_task(replace_case) for replace_case in GRID]]
    (row,) = confirm_rows(tasks, [GRID], TransientSettings())
    assert "came to no plateau" in str(describe_gap(row))
    assert "2 of 2 cases failed" in str(describe_gap(row))


def build_task(of, scene=None, settings=None):
    return CaseTask(
        case=of.case,
        job=Job(scene=scene, settings=settings or SolverSettings()),
        refusal="",
        layout=LAYOUT,
    )


LAYOUT = SupportLayout(
    post_spacing=3.0,
    uphill_anchor_distance=5.0,
    downhill_anchor_distance=3.0,
)


def test_tasks_of_idle_cases_are_not_followed(monkeypatch):
    seen = []

    def follow(tasks, **_):
        seen.extend(tasks)
        return [result(task.case.density, post=5.0, guy=5.0) for task in tasks]

    monkeypatch.setattr(confirm, "run_cases", follow)
    results = [IDLE, *GRID]
    tasks = [[build_task(one) for one in results]]
    settings = TransientSettings(accuracy=0.05)
    (row,) = confirm_rows(tasks, [results], settings)
    assert [task.case.density for task in seen] == [300.0, 350.0]
    assert {task.job.settings for task in seen} == {settings}
    assert row[0] is IDLE
    assert row[1].member_forces["post"] == band(5.0)


def test_a_case_with_history_settings_is_a_history(a_scene):
    scene = a_scene(inclination_deg=30.0, length_m=8.0, thickness_m=2.0)
    quick = TransientSettings(accuracy=0.1, horizon=1.0)
    task = build_task(GRID[0], scene, quick)
    short = solve_case(task)
    assert short.outcome is Outcome.PLATEAU_NOT_REACHED
    assert not short.member_forces
    whole = solve_case(
        task.solved_by(TransientSettings(accuracy=0.1, horizon=86400.0 * 30))
    )
    assert whole.outcome is Outcome.CONVERGED
    assert whole.solution.method == "transient"
    steady = solve_case(task.solved_by(SolverSettings(accuracy=0.01)))
    # section 6 of the theory: a history starts from the steady state and stays there
    foot = whole.member_forces["foot_anchor"].value
    assert foot == pytest.approx(steady.member_forces["foot_anchor"].value, rel=0.02)
    assert math.isfinite(foot)
