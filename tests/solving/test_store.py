import math
import sqlite3
from dataclasses import fields, replace
from functools import cache

import numpy as np
import pytest

from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import FailedSolution, SolvedState
from netdesign.envelope.ranges import Case
from netdesign.outcome import Outcome
from netdesign.solving import store as module
from netdesign.solving.runner import Runner
from netdesign.solving.solve import CaseEnd
from netdesign.solving.store import CaseStore, name_case
from netdesign.solving.workers import Job, solve_job
from netdesign.words.message import say
from tests.solving.small_scene import COARSE, build_scene

CASE = Case(density=300.0, friction_angle=math.radians(30), inclination=0.5)
SCENE = build_scene(CASE)
JOB = Job(scene=SCENE, settings=COARSE)


@cache
def solve_one() -> CaseEnd:
    return solve_job(JOB)


def assert_same(one, other):
    assert (one.outcome, one.reason) == (other.outcome, other.reason)
    for field in fields(SolvedState):
        left, right = (getattr(end, field.name) for end in (one, other))
        if isinstance(left, np.ndarray):
            assert left.dtype == right.dtype
            assert np.array_equal(left, right)
        else:
            assert left == right, field.name


@pytest.fixture
def said():
    return []


@pytest.fixture
def opened(tmp_path, said):
    """Open the store of this test, as often as wanted."""
    return lambda: CaseStore(tmp_path / "cases.sqlite", said.append)


def test_what_is_kept_is_found_by_a_later_run(opened, said):
    with opened() as one:
        one.keep("a", solve_one())
    with opened() as other:
        found = other.find(["a", "b"])
    assert set(found) == {"a"}
    assert_same(found["a"], solve_one())
    assert said == []


@pytest.mark.parametrize("lost", [Outcome.WORKER_FAILED, Outcome.PROGRAM_FAULT])
def test_a_case_lost_with_its_worker_or_by_a_fault_is_not_kept(opened, lost):
    with opened() as one:
        one.keep("a", FailedSolution(outcome=lost, reason=say("worker.died")))
        assert one.find(["a"]) == {}


@pytest.mark.parametrize(
    "other",
    [
        Job(scene=build_scene(replace(CASE, density=math.nextafter(300.0, 400.0))),
            settings=COARSE),
        Job(scene=SCENE, settings=replace(COARSE, accuracy=0.05)),
        Job(scene=SCENE, settings=replace(COARSE, levels=SolverSettings().levels)),
        Job(scene=replace(SCENE, net_contact="one-sided"), settings=COARSE),
    ],
)  # fmt: skip
def test_everything_that_could_change_the_result_changes_the_name(other):
    assert name_case(other.scene, other.settings) != name_case(SCENE, COARSE)


def test_a_store_of_another_version_is_set_aside_and_said_so(
    opened, said, tmp_path, monkeypatch
):
    with opened() as one:
        one.keep("a", solve_one())
    monkeypatch.setattr(module, "identify_solver", lambda: "9.9+feed")
    with opened() as other:
        assert other.find(["a"]) == {}
        other.keep("a", solve_one())
    text = str(said[0])
    assert "belongs to version" in text
    assert "9.9+feed" in text
    assert "cases.sqlite.aside-1" in text
    assert (tmp_path / "cases.sqlite.aside-1").exists()
    with opened() as again:
        assert set(again.find(["a"])) == {"a"}


@pytest.mark.parametrize(
    "content", [b"no database at all, " * 300, b"SQLite format 3\0"]
)
def test_a_damaged_store_is_set_aside_and_rebuilt(opened, said, tmp_path, content):
    (tmp_path / "cases.sqlite").write_bytes(content)
    with opened() as one:
        one.keep("a", solve_one())
        assert set(one.find(["a"])) == {"a"}
    assert len(said) == 1
    assert "set aside as cases.sqlite.aside-1" in str(said[0])
    assert (tmp_path / "cases.sqlite.aside-1").read_bytes() == content


def test_a_case_that_holds_no_number_is_solved_anew(opened, said):
    end = solve_one()
    spoilt = replace(end, foot=replace(end.foot, x=math.nan))
    with opened() as one:
        one.keep("a", spoilt)
        assert one.find(["a"]) == {}
    assert "case a is damaged" in str(said[0])


def test_a_damaged_entry_is_told_and_solved_anew(opened, said, tmp_path):
    with opened() as one:
        one.keep("a", solve_one())
        one.keep("b", solve_one())
    base = sqlite3.connect(tmp_path / "cases.sqlite")
    base.execute(
        "UPDATE cases SET numbers = replace(numbers, '\"x\": ', '\"x\": 1') "
        "WHERE name = 'a'"
    )
    base.commit()
    base.close()
    with opened() as other:
        assert set(other.find(["a", "b"])) == {"b"}
    assert len(said) == 1
    assert "case a is damaged" in str(said[0])


def test_a_store_that_breaks_under_way_costs_its_use_not_the_run(opened, said):
    with opened() as kept:
        kept._base.close()
        runner = Runner(store=kept, tell=said.append)
        (end,) = runner.solve([JOB])
    assert end.outcome is Outcome.CONVERGED
    assert runner.store is None
    assert "going on without it" in str(said[0])


def test_cases_of_two_versions_of_the_solver_are_told_apart(monkeypatch):
    """Both may have one file open: the second to come began it anew."""
    own = name_case(SCENE, COARSE)
    monkeypatch.setattr(module, "identify_solver", lambda: "another+0123")
    assert name_case(SCENE, COARSE) != own
