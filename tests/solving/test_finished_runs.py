"""Whole runs in the store: found as they were kept, or told as damaged and left out."""

import json
import sqlite3
import sys
import zlib
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import replace

import pytest

from netdesign.solving import finished_runs as module
from netdesign.solving.finished_runs import (
    FinishedRun,
    find_run,
    identify_installation,
    keep_run,
    name_run,
)
from netdesign.solving.store import CaseStore, seal_entry

RUN = FinishedRun(
    text='{"told": "Wächte \u2028 +3,7 kN"}',
    files={"study.json": b"\x00\xff{}" * 371, "a/report.html": b"", "x": b"\x17"},
)


@pytest.fixture
def said():
    return []


@pytest.fixture
def path(tmp_path, said):
    place = tmp_path / "cases.sqlite"
    CaseStore(place, said.append).__exit__(None, None, None)
    return place


def change(path, statement, *values):
    with closing(sqlite3.connect(path)) as base:
        base.execute(statement, values)
        base.commit()


def count(path):
    with closing(sqlite3.connect(path)) as base:
        return base.execute("SELECT count(*) FROM runs").fetchone()[0]


def test_what_is_kept_is_found_as_it_was(path, said):
    keep_run(path, "a", RUN)
    keep_run(path, "b", FinishedRun(text="", files={}))
    assert find_run(path, "a", said.append) == RUN
    assert list(find_run(path, "a", said.append).files) == list(RUN.files)
    assert find_run(path, "b", said.append) == FinishedRun(text="", files={})
    assert find_run(path, "c", said.append) is None
    assert said == []


def test_the_store_still_takes_cases(path, said):
    keep_run(path, "a", RUN)
    with CaseStore(path, said.append) as store:
        assert store.find(["a"]) == {}
    assert find_run(path, "a", said.append) == RUN
    assert said == []


@pytest.mark.parametrize(
    ("statement", "value"),
    [
        ("UPDATE runs SET text = replace(text, '1484', '1483')", None),
        ("UPDATE runs SET text = ?", "{}"),
        ("UPDATE runs SET text = ?", 5),
        ("UPDATE runs SET files = ?", zlib.compress(b"\x00\xff{}" * 371 + b"\x18")),
        ("UPDATE runs SET files = substr(files, 2)", None),
        ("UPDATE runs SET files = ?", "text"),
        ("UPDATE runs SET seal = upper(seal)", None),
        ("UPDATE runs SET name = 'b'", None),
    ],
)
def test_a_changed_entry_is_told_and_left_out(path, said, statement, value):
    keep_run(path, "a", RUN)
    change(path, statement, *(() if value is None else (value,)))
    name = "b" if "name" in statement else "a"
    assert find_run(path, name, said.append) is None
    assert [one.key for one in said] == ["store.run_damaged"]
    keep_run(path, name, RUN)
    assert find_run(path, name, said.append) == RUN


@pytest.mark.parametrize(
    ("sizes", "content"),
    [
        ({"x": 3}, bytes(10**6)),  # more than it says: no more than that is unpacked
        ({"x": 10**12}, b"abc"),
        ({"x": -1, "y": 0}, b"abc"),
        ({"x": 4}, b"abc"),
        ([3], b"abc"),
        ({"x": "3"}, b"abc"),
    ],
)
def test_a_sealed_entry_that_is_none_is_left_out(path, said, sizes, content):
    keep_run(path, "a", RUN)
    text, packed = json.dumps({"text": "", "sizes": sizes}), zlib.compress(content)
    change(
        path,
        "UPDATE runs SET text = ?, files = ?, seal = ?",
        *(text, packed, seal_entry("a", text, packed)),
    )
    assert find_run(path, "a", said.append) is None
    assert [one.key for one in said] == ["store.run_damaged"]


@pytest.mark.parametrize("there", [None, b"", b"no database", "folder"])
def test_where_no_store_can_be_read_nothing_is_known(tmp_path, said, there):
    path = tmp_path / "store"
    if there == "folder":
        path.mkdir()
    elif there is not None:
        path.write_bytes(there)
    assert find_run(path, "a", said.append) is None
    assert said == []
    assert path.exists() is (there is not None)


def test_the_newest_few_are_kept(path, said):
    most = module._MOST_RUNS
    for k in range(most + 3):
        keep_run(path, str(k), RUN)
    keep_run(path, str(most), RUN)  # again: the newest now, and no second one
    assert count(path) == most
    assert find_run(path, "2", said.append) is None
    assert find_run(path, "3", said.append) == RUN


def test_runs_take_no_more_room_than_is_theirs(path, said, monkeypatch):
    size = len(zlib.compress(b"".join(RUN.files.values()), 1))
    monkeypatch.setattr(module, "_MOST_BYTES", 3 * size)
    for name in "abcd":
        keep_run(path, name, RUN)
    assert count(path) == 3
    assert find_run(path, "a", said.append) is None
    monkeypatch.setattr(module, "_MOST_BYTES", size - 1)
    keep_run(path, "e", RUN)
    assert find_run(path, "e", said.append) is None
    assert count(path) == 3  # one that is too large sends no other away
    monkeypatch.setattr(module, "_MOST_BYTES", 3 * size)
    monkeypatch.setattr(module, "_MOST_UNPACKED", 1484)
    keep_run(path, "e", RUN)
    assert find_run(path, "e", said.append) is None


def test_runs_that_end_at_once_do_no_harm(path, said):
    names = [f"{k % 4}" for k in range(24)]
    with ThreadPoolExecutor(6) as pool:
        list(pool.map(lambda name: keep_run(path, name, RUN), names))
    assert count(path) == 4
    assert all(find_run(path, name, said.append) == RUN for name in names)


@pytest.mark.parametrize("content", [b"", b"no database"])
def test_what_is_no_store_is_not_made_one(tmp_path, content):
    (tmp_path / "other").write_bytes(content)
    with pytest.raises(sqlite3.Error):
        keep_run(tmp_path / "other", "a", RUN)
    assert (tmp_path / "other").read_bytes() == content


def test_a_store_that_cannot_take_it_says_so(path):
    with closing(sqlite3.connect(path)) as base:
        base.execute("CREATE VIEW runs AS SELECT 1 AS number")
        base.commit()
    with pytest.raises(sqlite3.Error):
        keep_run(path, "a", RUN)


def test_a_run_without_a_name_is_refused():
    with pytest.raises(TypeError):
        name_run([RUN, lambda: None])
    assert name_run([RUN]) == name_run([replace(RUN)])
    assert name_run([RUN]) != name_run([replace(RUN, text="other")])


@pytest.fixture
def resources(tmp_path, monkeypatch):
    """Folders of profiles and templates that a test may change."""
    for name in ("standards", "templates"):
        (tmp_path / name / "one").mkdir(parents=True)
        (tmp_path / name / "one" / "file.txt").write_bytes(b"text")
    monkeypatch.setattr(module, "find_resource", lambda name: tmp_path / name)
    return tmp_path


def test_the_same_installation_is_known_again(resources):
    assert identify_installation() == identify_installation()


@pytest.mark.parametrize("name", ["standards", "templates"])
def test_a_changed_profile_or_template_is_another_installation(resources, name):
    before = identify_installation()
    place = resources / name / "one" / "file.txt"
    place.write_bytes(b"texT")
    after = identify_installation()
    place.rename(place.with_name("other.txt"))
    assert len({before, after, identify_installation()}) == 3


@pytest.mark.parametrize(
    "variable", ["OPENBLAS_CORETYPE", "OMP_NUM_THREADS", "PYTHONHASHSEED", "NPY_X"]
)
def test_a_variable_that_could_move_a_digit_counts(resources, monkeypatch, variable):
    monkeypatch.delenv(variable, raising=False)
    before = identify_installation()
    monkeypatch.setenv(variable, "7")
    assert identify_installation() != before


def test_one_that_only_shows_does_not_count(resources, monkeypatch):
    before = identify_installation()
    for name in ("COLUMNS", "NO_COLOR", "TERM", "NETDESIGN_CHECK_QUIET"):
        monkeypatch.setenv(name, "1")
    assert identify_installation() == before


def test_every_library_counts_also_those_that_others_need(
    resources, monkeypatch, tmp_path
):
    monkeypatch.setattr(sys, "path", [*sys.path, str(tmp_path / "more")])
    place = tmp_path / "more" / "markupsafe-3.0.0.dist-info"
    place.mkdir(parents=True)
    before = identify_installation()
    place.rename(place.with_name("markupsafe-3.0.1.dist-info"))
    assert identify_installation() != before


def test_another_program_or_python_is_another_installation(resources, monkeypatch):
    found = {identify_installation()}
    with monkeypatch.context() as patch:
        patch.setattr(module, "identify_program", lambda: "9.9+feed")
        found.add(identify_installation())
    monkeypatch.setattr(sys, "version", "3.99")
    assert len(found | {identify_installation()}) == 3
