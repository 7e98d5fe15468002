"""Net rows in the store: found as they were kept, or told as damaged and left out."""

import json
import sqlite3
import zlib
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing

import pytest

from netdesign.solving import store as module
from netdesign.solving.runner import Runner
from netdesign.solving.store import CaseStore

ROW = ['{"told": "W\u00e4chte \u2028 +3,7 kN"}', "", "1" * 371]


@pytest.fixture
def said():
    return []


@pytest.fixture
def store(tmp_path, said):
    with CaseStore(tmp_path / "cases.sqlite", said.append) as one:
        yield one


def change(store, statement, *values):
    with closing(sqlite3.connect(store.path)) as base:
        base.execute(statement, values)
        base.commit()


def count(store):
    with closing(sqlite3.connect(store.path)) as base:
        return base.execute("SELECT count(*) FROM rows").fetchone()[0]


def test_what_is_kept_is_found_as_it_was(store, said):
    store.keep_row("a", ROW)
    store.keep_row("b", [])
    assert store.find_row("a") == ROW
    assert store.find_row("b") == []
    assert store.find_row("c") is None
    assert said == []


@pytest.mark.parametrize(
    ("statement", "value"),
    [
        ("UPDATE rows SET packed = ?", zlib.compress(json.dumps(ROW[1:]).encode())),
        ("UPDATE rows SET packed = substr(packed, 2)", None),
        ("UPDATE rows SET packed = ?", "text"),
        ("UPDATE rows SET packed = ?", 5),
        ("UPDATE rows SET seal = upper(seal)", None),
        ("UPDATE rows SET name = 'b'", None),
    ],
)
def test_a_changed_entry_is_told_and_left_out(store, said, statement, value):
    store.keep_row("a", ROW)
    change(store, statement, *(() if value is None else (value,)))
    name = "b" if "name" in statement else "a"
    assert store.find_row(name) is None
    assert [one.key for one in said] == ["store.row_damaged"]
    store.keep_row(name, ROW)
    assert store.find_row(name) == ROW


def test_the_newest_are_kept_as_far_as_there_is_room(store, monkeypatch):
    size = len(zlib.compress(json.dumps(ROW).encode(), 1))
    monkeypatch.setattr(module, "_MOST_BYTES", 3 * size)
    for name in "abcd":
        store.keep_row(name, ROW)
    store.keep_row("b", ROW)  # again: the newest now, and no second one
    assert count(store) == 3
    assert [store.find_row(name) for name in "abcd"] == [None, ROW, ROW, ROW]
    store.keep_row("e", ROW)
    assert store.find_row("c") is None
    assert store.find_row("b") == ROW


def test_rows_that_end_at_once_do_no_harm(store, said):
    names = [f"{k % 4}" for k in range(24)]

    def keep(name):
        with CaseStore(store.path, said.append, is_open=True) as own:
            own.keep_row(name, ROW)

    with ThreadPoolExecutor(6) as pool:
        list(pool.map(keep, names))
    assert count(store) == 4
    assert all(store.find_row(name) == ROW for name in names)
    assert said == []


def test_a_store_that_fails_is_told_once_and_the_run_goes_on(store, said):
    change(store, "DROP TABLE rows")
    runner = Runner(store=store, tell=said.append)
    assert runner.find_row("a") is None
    runner.keep_row("a", ROW)
    assert [one.key for one in said] == ["store.failed"]
    assert runner.store is None
