"""Batches through a runner: each case once, none that sticking snow answers for."""

import pytest

from netdesign.solving.runner import Runner
from netdesign.solving.solve import encode_end
from netdesign.solving.store import CaseStore
from netdesign.solving.workers import solve_batch
from tests.solving.made_up_workers import Recording
from tests.solving.test_workers import build_line

LOW, MIDDLE, HIGH, TOP = 10.0, 20.0, 30.0, 40.0  # degrees; the snow sticks from HIGH


@pytest.fixture
def runner():
    return Runner(workers=Recording())


def count_jobs(runner):
    """Of each batch of each wave."""
    return [[len(batch) for batch in wave] for wave in runner.workers.waves]


def write(found):
    return [[encode_end(end) for end in ends] for ends in found]


def solve_each(*batches):
    return write(solve_batch(batch) for batch in batches)


def test_a_case_in_two_batches_is_solved_once(runner):
    """The second waits for the first, and then needs what lay beyond its end."""
    batches = [
        build_line(300.0, LOW, HIGH, TOP),
        build_line(300.0, LOW, MIDDLE),
        build_line(300.0, TOP),
    ]
    found = write(runner.solve_batches(batches))
    assert found == solve_each(*batches)
    assert count_jobs(runner) == [[3], [1, 1]]
    assert (runner.counts.solved, runner.counts.reused) == (4, 1)


def test_a_known_case_that_sticks_ends_a_batch_before_workers_see_it(runner, tmp_path):
    (known,) = build_line(300.0, HIGH)
    batch = build_line(300.0, LOW, MIDDLE, HIGH, TOP)
    with CaseStore(tmp_path / "cases.sqlite", pytest.fail) as store:
        Runner(store=store).solve([known])
        runner.store = store
        found = write(runner.solve_batches([batch]))
        again = write(runner.solve_batches([batch]))
    assert found == again == solve_each(batch)
    assert count_jobs(runner) == [[2]]
    assert (runner.counts.solved, runner.counts.reused) == (2, 1 + 3)


def test_what_a_batch_did_not_need_is_not_kept(runner, tmp_path):
    line = build_line(300.0, HIGH, TOP)
    with CaseStore(tmp_path / "cases.sqlite", pytest.fail) as store:
        runner.store = store
        (ends,) = runner.solve_batches([line])
        assert len(ends) == 1
        assert (runner.counts.solved, runner.counts.reused) == (1, 0)
        runner.solve([line[1]])
        assert (runner.counts.solved, runner.counts.reused) == (2, 0)
