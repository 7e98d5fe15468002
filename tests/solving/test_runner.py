"""Jobs through a runner: each case once, however often it is asked for."""

import pytest

from netdesign.solving.runner import Runner
from netdesign.solving.solve import encode_end
from netdesign.solving.store import CaseStore
from netdesign.solving.workers import solve_job
from tests.solving.made_up_workers import Recording
from tests.solving.test_workers import JOBS


@pytest.fixture
def runner():
    return Runner(workers=Recording())


def write(ends):
    return [encode_end(end) for end in ends]


def test_a_case_that_is_asked_for_twice_is_solved_once(runner):
    asked = [JOBS[0], JOBS[1], JOBS[0]]
    assert write(runner.solve(asked)) == write(map(solve_job, asked))
    assert runner.workers.waves == [[JOBS[0], JOBS[1]]]
    assert (runner.counts.solved, runner.counts.reused) == (2, 1)


def test_a_known_case_is_not_solved_again_and_keeps_its_place(runner, tmp_path):
    with CaseStore(tmp_path / "cases.sqlite", pytest.fail) as store:
        Runner(store=store).solve([JOBS[1]])
        runner.store = store
        found = write(runner.solve(JOBS[:3]))
        again = write(runner.solve(JOBS[:3]))
    assert found == again == write(map(solve_job, JOBS[:3]))
    assert runner.workers.waves == [[JOBS[0], JOBS[2]], []]
    assert (runner.counts.solved, runner.counts.reused) == (2, 1 + 3)
