import os
import sys
import threading
from contextlib import ExitStack
from pathlib import Path

import pytest

from netdesign.edge.input_files import LOCK_FILE, lock_folder
from netdesign.edge.output import require_free, write_files
from netdesign.outcome import OutputError


def listing(folder):
    return sorted(path.name for path in folder.rglob("*") if path.is_file())


@pytest.mark.parametrize(
    ("step", "at"), [("fsync", 1), ("chmod", 1), ("replace", 1), ("fsync", 2)]
)
def test_a_failing_write_leaves_no_trace(tmp_path, monkeypatch, step, at):
    """A full disk, at the first file or the second: nothing new appears alone."""
    old = tmp_path / "old.html"
    old.write_bytes(b"old")
    calls, owner = [], os if step == "fsync" else Path
    known = getattr(owner, step)

    def fail(*given, **named):
        calls.append(step)
        if len(calls) == at:
            raise OSError(28, "No space left on device")
        return known(*given, **named)

    monkeypatch.setattr(owner, step, fail)
    with pytest.raises(OutputError, match=r"cannot write: .*No space left"):
        write_files({old: b"new", tmp_path / "other.xlsx": b"new"}, overwrite=True)
    assert len(calls) == at
    assert listing(tmp_path) == ["old.html"]
    assert old.read_bytes() == b"old"


def test_every_taken_place_is_named(tmp_path):
    taken = [tmp_path / "a", tmp_path / "c"]
    for path in taken:
        path.write_bytes(b"")
    with pytest.raises(OutputError) as caught:
        require_free([taken[0], tmp_path / "b", taken[1]], overwrite=False)
    message = str(caught.value)
    assert f"{taken[0]}, {taken[1]};" in message
    assert str(tmp_path / "b") not in message
    assert "--force" in message


def test_a_place_without_leave_to_write_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda *_: False)
    with pytest.raises(OutputError, match="cannot be written to"):
        require_free([tmp_path / "new" / "a"], overwrite=False)


@pytest.mark.parametrize("overwrite", [True, False])
@pytest.mark.parametrize("kind", ["folder", "pipe", "device"])
def test_what_is_no_file_is_never_replaced(tmp_path, kind, overwrite):
    """Put in the place of a device, a file would take it away from the system."""
    place = tmp_path / "study.json"
    if kind == "folder":
        place.mkdir()
    elif sys.platform == "win32":
        pytest.skip("POSIX")
    elif kind == "pipe":
        os.mkfifo(place)
    else:
        place.symlink_to("/dev/null")
    for refuse in (require_free, write_given):
        with pytest.raises(OutputError, match=r"study\.json is there and is no file"):
            refuse([tmp_path / "a", place], overwrite=overwrite)
    assert place.exists()
    assert not place.is_file()
    assert listing(tmp_path) == []


def write_given(paths, *, overwrite):
    write_files(dict.fromkeys(paths, b"1"), overwrite=overwrite)


# --- two runs, and runs that were killed ---------------------------------------------


def test_a_file_that_appeared_meanwhile_is_not_replaced(tmp_path):
    """Another run without --force finished while this one was solving."""
    path = tmp_path / "study.json"
    require_free([path, tmp_path / "a"], overwrite=False)
    path.write_bytes(b"of the other")
    with pytest.raises(OutputError, match=r"exists already: .*study\.json;"):
        write_files({tmp_path / "a": b"1", path: b"mine"}, overwrite=False)
    assert path.read_bytes() == b"of the other"
    assert listing(tmp_path) == ["study.json"]


@pytest.mark.parametrize("failing", [1, 2, 3, 4, 5])
def test_old_files_come_back_if_a_new_one_cannot_be_placed(
    tmp_path, monkeypatch, failing
):
    """Two old files leave, three new ones come: whichever step fails, all is undone."""
    old = {tmp_path / "a": b"old a", tmp_path / "b": b""}
    for path, content in old.items():
        path.write_bytes(content)
    steps = []
    replace = Path.replace

    def fail_once(self, target):
        steps.append(target)
        if len(steps) == failing:
            raise OSError(5, "Input/output error")
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", fail_once)
    new = {tmp_path / name: b"new" for name in ("a", "c", "b")}
    with pytest.raises(OutputError, match="Input/output error"):
        write_files(new, overwrite=True)
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == old


def test_what_a_killed_run_left_is_removed_and_nothing_else(tmp_path):
    left = {".a.x1y2z3_4", ".a.x1y2z3_4.old", "..netdesign.json.x1y2z3_4.old"}
    others = {".a.x1y2z3_4.bak", ".b.x1y2z3_4", "a.x1y2z3_4", ".a.", ".a.json"}
    for name in left | others:
        (tmp_path / name).write_bytes(b"half")
    write_files({tmp_path / "a": b"whole"}, overwrite=False)
    assert set(listing(tmp_path)) == {"a"} | others


def test_a_run_waits_for_another_that_writes_to_the_same_folder(tmp_path):
    (tmp_path / ".a.other_is").write_bytes(b"half")  # in the hands of the other
    held = ExitStack()
    assert lock_folder(tmp_path, held)
    waiting = threading.Thread(
        target=write_files, args=({tmp_path / "a": b"1"},), kwargs={"overwrite": True}
    )
    waiting.start()
    waiting.join(0.2)
    assert waiting.is_alive()
    assert listing(tmp_path) == [".a.other_is", LOCK_FILE]
    held.close()
    waiting.join(10.0)
    assert listing(tmp_path) == ["a"]
