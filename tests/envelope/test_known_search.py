"""A search that is known is repeated, while nothing that it rests on has changed."""

import math
import sqlite3
from dataclasses import fields, replace

import numpy as np
import pytest

from netdesign.envelope import search as search_module
from netdesign.envelope import store as store_module
from netdesign.envelope.adaptive import Maxima, SearchSettings, Watched
from netdesign.envelope.grid import Case, Interval
from netdesign.envelope.known_search import KnownSearch, decode_search, encode_search
from netdesign.envelope.parameters import Box
from netdesign.envelope.runner import Runner
from netdesign.envelope.search import RowTask, search_rows
from netdesign.envelope.state import CaseEnd
from netdesign.envelope.store import CaseStore, name_search
from netdesign.envelope.surrogate import Surrogate
from netdesign.envelope.workers import OwnProcess
from netdesign.outcome import Outcome
from netdesign.words.message import say
from tests.envelope.made_up_workers import Spoiling
from tests.envelope.small_scene import COARSE, LAYOUT, build_scene
from tests.envelope.synthetic import drive, smooth

WATCHED = {0: Watched(), 2: Watched(worth=0.1, floor=3.0)}
BOX = Box(
    intervals=(
        ("density", Interval(low=250.0, high=400.0)),
        ("friction_angle", Interval(low=math.radians(15), high=math.radians(45))),
    )
)
TASK = RowTask(
    scene=build_scene(Case(density=300.0, friction_angle=0.5, inclination=0.5)),
    box=BOX,
    layout=LAYOUT,
    settings=COARSE,
    search=SearchSettings(gap=0.05),
    confirmed_by=None,
)

# Ends at the most cases, with the gap open.
OPEN = replace(TASK, search=SearchSettings(gap=1e-3, certainty=10.0, max_cases=13))


def assert_same(one: Maxima, other: Maxima):
    """Bit by bit, the model included; NaN predictions of the first design are equal."""
    assert repr(replace(one, surrogate=None)) == repr(replace(other, surrogate=None))
    for field in fields(Surrogate):
        left, right = (getattr(m.surrogate, field.name) for m in (one, other))
        assert np.array_equal(left, right), field.name


def answer(known, response, watched=WATCHED):
    """End of a repetition whose questions the response answers; the cases asked."""
    repetition, asked = known.repeat(lambda: watched), []
    points = next(repetition)
    while True:
        asked += points
        try:
            points = repetition.send([response(point) for point in points])
        except StopIteration as end:
            return end.value, asked


@pytest.fixture(scope="module")
def known():
    """Search over a made-up response, one case of which failed."""
    response = smooth(0)
    found = drive(
        lambda u: response(u) if tuple(u) != (0.0, 0.5, 1.0) else np.full(3, np.nan), 3
    )
    assert None in found.values
    return KnownSearch(maxima=found, watched=WATCHED)


def recall(known, changes=()):
    values = dict(zip(known.maxima.points, known.maxima.values, strict=True))
    return (values | dict(changes)).__getitem__


def test_a_search_survives_the_way_to_disk_and_back_bit_by_bit(known):
    back = decode_search(encode_search(known))
    assert back.watched == known.watched
    assert_same(back.maxima, known.maxima)


def test_equal_answers_to_the_same_questions_give_the_maxima_of_then(known):
    found, asked = answer(known, recall(known))
    assert found is known.maxima
    assert tuple(asked) == known.maxima.points


@pytest.mark.parametrize("place", [0, 20, -1])
@pytest.mark.parametrize("quantity", [0, 2])
def test_an_answer_that_differs_in_its_last_bit_ends_it(known, place, quantity):
    point, value = known.maxima.points[place], list(known.maxima.values[place])
    value[quantity] = math.nextafter(value[quantity], math.inf)
    found, asked = answer(known, recall(known, {point: tuple(value)}))
    assert found is None
    assert asked == list(known.maxima.points[: len(asked)])


def test_a_case_that_fails_now_or_no_longer_ends_it(known):
    failed = known.maxima.points[known.maxima.values.index(None)]
    for changes in ({failed: (1.0, 1.0, 1.0)}, {known.maxima.points[-1]: None}):
        assert answer(known, recall(known, changes))[0] is None


@pytest.mark.parametrize(
    "watched",
    [
        {0: Watched()},
        {0: Watched(), 2: Watched(worth=0.1, floor=math.nextafter(3.0, 4.0))},
        {0: Watched(), 2: Watched(worth=0.0, floor=3.0)},
    ],
)
def test_other_questions_to_the_bounds_end_it(known, watched):
    assert answer(known, recall(known), watched)[0] is None


def test_a_log_that_lacks_cases_never_answers(known):
    short = replace(known.maxima, log=known.maxima.log[:-1])
    cut = replace(known, maxima=short)
    assert answer(cut, recall(known))[0] is None


@pytest.mark.parametrize(
    "other",
    [
        replace(TASK, scene=replace(TASK.scene, net_contact="one-sided")),
        replace(TASK, box=Box(intervals=BOX.intervals[:1])),
        replace(TASK, layout=None),
        replace(TASK, layout=replace(LAYOUT, post_spacing=math.nextafter(3.5, 4.0))),
        replace(TASK, settings=replace(COARSE, accuracy=0.05)),
        replace(TASK, search=replace(TASK.search, certainty=2.0)),
        replace(TASK, confirmed_by=COARSE),
        replace(TASK, build=replace(COARSE)),
    ],
)
def test_everything_that_is_given_is_in_the_name(other):
    assert name_search(other) != name_search(TASK)


def test_every_field_of_a_task_was_changed_above():
    assert {field.name for field in fields(RowTask)} == {
        *("scene", "box", "layout", "settings", "search", "confirmed_by", "build")
    }


def test_another_text_of_the_program_has_other_names(monkeypatch):
    before = name_search(TASK)
    monkeypatch.setattr(store_module, "identify_program", lambda: "9.9+feed")
    assert name_search(TASK) != before


def test_the_text_of_every_module_counts(tmp_path, monkeypatch):
    """A copy of the package with one more sign in any part is another program."""
    names = set()
    for place in ("envelope/adaptive.py", "structure/head.py", "guards.py"):
        root = tmp_path / place
        for path in ("envelope/adaptive.py", "structure/head.py", "guards.py"):
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text("#" if path == place else "")
        monkeypatch.setattr(store_module, "__file__", str(root / "envelope/store.py"))
        store_module._identify.cache_clear()
        names.add(store_module.identify_program())
    store_module._identify.cache_clear()
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
    real = search_module.search_maxima

    def count(*args):
        made.searches += 1
        return real(*args)

    monkeypatch.setattr(search_module, "search_maxima", count)
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
    lost = CaseEnd(
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
