"""Searches of rows in the store: repeated, while nothing about them has changed."""

import math
import sqlite3
from dataclasses import fields, replace

import pytest

from netdesign.coupling.solution import FailedSolution
from netdesign.envelope import search as search_module
from netdesign.envelope.ranges import Case, Interval, Ranges
from netdesign.envelope.rows import RowTask
from netdesign.envelope.search import search_rows
from netdesign.outcome import Outcome
from netdesign.search.maxima import MaximaSearch, SearchSettings
from netdesign.solving import store as store_module
from netdesign.solving.identity import identify_program
from netdesign.solving.runner import Runner
from netdesign.solving.store import CaseStore, name_search
from netdesign.solving.workers import OwnProcess
from netdesign.words.message import say
from tests.search.synthetic import assert_same
from tests.solving.made_up_workers import Spoiling
from tests.solving.small_scene import COARSE, LAYOUT, PANEL, build_scene

RANGES = Ranges(
    intervals=(
        ("density", Interval(low=250.0, high=400.0)),
        ("friction_angle", Interval(low=math.radians(15), high=math.radians(45))),
    )
)
TASK = RowTask(
    scene=build_scene(Case(density=300.0, friction_angle=0.5, inclination=0.5)),
    ranges=RANGES,
    layout=LAYOUT,
    settings=COARSE,
    search=SearchSettings(gap=0.05),
    confirmed_by=None,
)

# Ends at the most cases, with the gap open.
OPEN = replace(TASK, search=SearchSettings(gap=1e-3, certainty=10.0, max_cases=13))


@pytest.mark.parametrize(
    "other",
    [
        replace(TASK, scene=replace(TASK.scene, net_contact="one-sided")),
        replace(TASK, ranges=Ranges(intervals=RANGES.intervals[:1])),
        replace(TASK, layout=None),
        replace(TASK, layout=replace(LAYOUT, post_spacing=math.nextafter(3.5, 4.0))),
        replace(TASK, settings=replace(COARSE, accuracy=0.05)),
        replace(TASK, search=replace(TASK.search, certainty=2.0)),
        replace(TASK, confirmed_by=COARSE),
        replace(TASK, build=replace(COARSE)),
        replace(TASK, panels=(PANEL,)),
        replace(TASK, panels=(replace(PANEL, cut="fitted"),)),
        replace(TASK, has_end=True),
    ],
)
def test_everything_that_is_given_is_in_the_name(other):
    assert name_search(other) != name_search(TASK)


def test_every_field_of_a_task_was_changed_above():
    assert {field.name for field in fields(RowTask)} == {
        *("scene", "ranges", "layout", "settings", "search", "confirmed_by", "build"),
        *("panels", "has_end"),
    }


def test_another_text_of_the_program_has_other_names(monkeypatch):
    before = name_search(TASK)
    monkeypatch.setattr(store_module, "identify_program", lambda: "9.9+feed")
    assert name_search(TASK) != before


def test_the_text_of_every_module_counts(tmp_path):
    """A copy of the package with one more sign in any part is another program."""
    names = set()
    for place in ("search/maxima.py", "structure/head.py", "units.py"):
        root = tmp_path / place
        for path in ("search/maxima.py", "structure/head.py", "units.py"):
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text("#" if path == place else "")
        names.add(identify_program(root))
    assert len(names) == 3


class Row:
    """The task of this test in a store, searched as often as wanted."""

    def __init__(self, path):
        self.path, self.said, self.searches = path, [], 0

    def search(self, task=TASK, workers=None):
        with CaseStore(self.path, self.said.append) as store:
            runner = Runner(store=store, workers=workers or OwnProcess())
            (found,) = search_rows([task], runner)
        return found, runner.counts

    def edit(self, order):
        base = sqlite3.connect(self.path)
        base.execute(order)
        base.commit()
        base.close()


@pytest.fixture
def row(tmp_path, monkeypatch):
    made = Row(tmp_path / "cases.sqlite")

    class Counted(MaximaSearch):
        def __init__(self, *args):
            made.searches += 1
            super().__init__(*args)

    monkeypatch.setattr(search_module, "MaximaSearch", Counted)
    return made


def assert_same_row(one, other):
    assert_same(one.maxima, other.maxima)
    assert [r.member_forces for r in one.results] == [
        r.member_forces for r in other.results
    ]
    for name in ("members", "quantities", "skipped", "skips_tested", "gap"):
        assert getattr(one, name) == getattr(other, name)


def test_a_second_run_searches_and_solves_nothing(row):
    first, _ = row.search()
    second, counts = row.search()
    assert (row.searches, counts.solved) == (1, 0)
    assert counts.reused > 0
    assert_same_row(first, second)
    assert row.said == []


def test_another_task_is_searched(row):
    row.search()
    wider = replace(TASK, layout=replace(LAYOUT, post_spacing=4.0))
    found, _ = row.search(wider)
    (fresh,) = search_rows([wider], Runner())
    assert row.searches == 3
    assert_same_row(found, fresh)


@pytest.mark.parametrize(
    "change",
    [
        "text = replace(text, 'is_closed\": false', 'is_closed\": true')",
        "text = replace(text, 'upper_bound\": [', 'upper_bound\": [0')",
        "seal = 'x'",
        "text = ''",
    ],
)
def test_a_damaged_search_is_told_and_made_anew(row, change):
    first, _ = row.search(OPEN)
    row.edit(f"UPDATE searches SET {change}")
    second, counts = row.search(OPEN)
    assert (row.searches, counts.solved) == (2, 0)
    assert "is damaged, made anew" in str(row.said[0])
    assert_same_row(first, second)
    row.search(OPEN)
    assert row.searches == 2


def test_an_open_gap_stays_open(row):
    for _ in range(2):
        found, _ = row.search(OPEN)
        assert "could still exceed" in str(found.gap)
    assert row.searches == 1


def lose_rough(job, end):
    lost = FailedSolution(
        outcome=Outcome.WORKER_FAILED, reason=say("text.as_given", text="lost")
    )
    return lost if job.scene.net.friction_angle > 0.7 else end


def test_cases_that_were_lost_and_are_solved_now_are_searched_anew(row):
    first, _ = row.search(workers=Spoiling(lose_rough))
    second, _ = row.search()
    assert "failed (lost)" in str(first.gap)
    assert row.searches == 2
    (fresh,) = search_rows([TASK], Runner())
    assert_same_row(second, fresh)


def test_a_task_without_a_name_is_searched_every_time(row):
    from netdesign.envelope.parameters import place_scene

    unnamed = replace(
        TASK,
        build=lambda case: place_scene(
            TASK.scene,
            {"density": case.density, "friction_angle": case.friction_angle},
        ),
    )
    (first, _), (second, counts) = row.search(unnamed), row.search(unnamed)
    assert (row.searches, counts.solved) == (2, 0)
    assert_same_row(first, second)
