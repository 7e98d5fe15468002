"""Rows judged in worker processes: the same studies, faults and counts as in turn."""

import math
import os
import random
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.outcome import Fault, describe_fault
from netdesign.snow.ground import GroundLaw
from netdesign.solving.runner import Counts, Runner
from netdesign.solving.store import CaseStore
from netdesign.solving.workers import ProcessPool
from netdesign.study import check_site as use_case
from netdesign.study.check_site import check_site, judge_away
from tests.small_site import RUN, WEAK, build_row, build_site, resist

DRAWN = random.Random(2411)
STANDARDS = [load_standard(name) for name in ("nf-p-95-304-style", "eurocode")]
RANGES = Ranges.of(
    density=Interval(low=271.3, high=398.7),
    friction_angle=Interval(low=math.radians(27.1), high=math.radians(27.1)),
    inclination=Interval(low=math.radians(28.9), high=math.radians(28.9)),
)
DYING = "R2"


def draw_site():
    """Four rows of four kinds, and one that differs from the first by its anchors."""
    kinds = (
        GroundLaw(kind="free"),
        GroundLaw(kind="no-slip"),
        GroundLaw(kind="sliding", slip_length=DRAWN.uniform(0.7, 2.9)),
        GroundLaw(kind="no-slip"),
    )
    rows = [
        build_row(
            f"R{k}",
            ground=kind,
            snow_thickness=DRAWN.uniform(1.9, 2.5),
            upslope_length=DRAWN.uniform(4.1, 6.3),
            slope_angle=math.radians(DRAWN.uniform(33.0, 41.0)),
        )
        for k, kind in enumerate(kinds, 1)
    ]
    again = replace(rows[0], id="R5", resistances=resist(9.0 * WEAK))
    return build_site(*rows, again, ranges=RANGES)


SITE = draw_site()


def die_of_one(job):
    """As a worker that the case of a row kills."""
    if any(row.id == DYING for row in job.site.rows):
        os._exit(9)
    return judge_away(job)


@pytest.fixture(scope="module")
def in_turn(tmp_path_factory):
    """Studies made in this process, and what its runner counted."""
    with CaseStore(tmp_path_factory.mktemp("store") / "one.sqlite", print) as store:
        runner = Runner(store=store)
        return check_site(SITE, STANDARDS, RUN, runner), runner.counts


@pytest.fixture
def pool(monkeypatch):
    monkeypatch.setattr(ProcessPool, "pool", property(lambda self: self))
    pool = ProcessPool(2)
    yield pool
    pool.close()


@pytest.mark.long
def test_workers_make_the_same_studies_and_keep_what_they_solved(
    in_turn, pool, tmp_path
):
    studies, counts = in_turn
    told, done, rows = [], [], []
    with CaseStore(tmp_path / "cases.sqlite", told.append) as store:
        runner = Runner(
            workers=pool, store=store, on_done=done.append, tell=told.append
        )
        watch = Counting(rows)
        assert check_site(SITE, STANDARDS, RUN, runner, watch) == studies
        assert runner.counts == counts
        assert len(done) == counts.solved + counts.reused
        assert len(rows) == len(SITE.rows)
        again = Runner(store=store)
        assert check_site(SITE, STANDARDS, RUN, again) == studies
        assert again.counts.solved == 0
    assert told == []


def test_a_row_that_kills_its_worker_is_judged_again(in_turn, pool, monkeypatch):
    monkeypatch.setattr(use_case, "judge_away", die_of_one)
    studies, _ = in_turn
    assert check_site(SITE, STANDARDS, RUN, Runner(workers=pool)) == studies


def test_what_fails_in_a_worker_is_told_as_if_it_failed_here(pool):
    """A profile that no check can be judged by; the place is that of the fault."""
    spoilt = [replace(STANDARDS[0], values=(None,))]
    with pytest.raises(AttributeError) as here:
        check_site(SITE, spoilt, RUN)
    with pytest.raises(AttributeError) as there:
        check_site(SITE, spoilt, RUN, Runner(workers=pool))
    assert describe_fault(there.value).place == describe_fault(here.value).place


def test_what_a_worker_counted_and_met_is_counted_once_more():
    done = []
    runner = Runner(on_done=done.append, counts=Counts(solved=3, reused=1))
    fault = Fault(kind="ValueError", message="spoilt", place="snow/mesh.py:88")
    runner.keep_fault(fault, "R7")
    runner.take(Counts(solved=5, reused=2, lost=3), {fault: {"R2"}})
    assert runner.counts == Counts(solved=8, reused=3, lost=3)
    assert runner.faults == {fault: {"R2", "R7"}}
    assert len(done) == 7


class Counting:
    """A watch that counts rows."""

    def __init__(self, rows):
        self.count_piece = lambda: rows.append(1)

    def enter(self, key, words=None):
        """No phase is told."""


def test_a_row_is_sent_without_the_others(pool, monkeypatch):
    """All rows of a large site, sent with each of them, would cost more than solves."""
    sent = []

    def spread(_, work, waiting):
        sent.extend([row.id for row in job.site.rows] for _, job in waiting)
        yield from ((place, work(job)) for place, job in waiting)

    monkeypatch.setattr(ProcessPool, "spread", spread)
    check_site(SITE, STANDARDS, RUN, Runner(workers=pool))
    assert sorted(sent) == [["R1", "R5"], ["R2"], ["R3"], ["R4"]]
