import os
import re
import sys
import threading
from contextlib import ExitStack
from pathlib import Path

import click
import pytest

from netdesign import cli
from netdesign.edge.locks import LOCK_FILE, lock_folder
from netdesign.edge.output import require_free, write_files
from netdesign.outcome import OutputError
from tests.small_scene import SMALL_SCENE
from tests.tiny_site import write_site


def listing(folder):
    return sorted(path.name for path in folder.rglob("*") if path.is_file())


def test_files_are_written_with_their_folders(tmp_path):
    contents = {
        tmp_path / "new" / "deep" / "a.json": b"{}",
        tmp_path / "new" / "b.html": b"<p>\r\n",
    }
    write_files(contents, overwrite=True)
    assert {path: path.read_bytes() for path in contents} == contents
    assert listing(tmp_path) == ["a.json", "b.html"]


def test_written_files_are_as_readable_as_others(tmp_path):
    write_files({tmp_path / "a": b""}, overwrite=True)
    assert (tmp_path / "a").stat().st_mode & 0o777 == 0o644


def test_existing_files_are_replaced_whole(tmp_path):
    path = tmp_path / "a"
    path.write_bytes(b"long old content")
    write_files({path: b"new"}, overwrite=True)
    assert path.read_bytes() == b"new"


@pytest.mark.parametrize("step", ["fsync", "chmod", "replace"])
def test_a_failing_write_leaves_no_trace(tmp_path, monkeypatch, step):
    """A full disk, seen at three places: old files stay, nothing new appears."""
    old = tmp_path / "old.html"
    old.write_bytes(b"old")
    failures = []

    def fail(*_, **__):
        failures.append(step)
        raise OSError(28, "No space left on device")

    owner = os if step == "fsync" else Path
    monkeypatch.setattr(owner, step, fail)
    with pytest.raises(OutputError, match=r"cannot write: .*No space left"):
        write_files({old: b"new", tmp_path / "other.xlsx": b"new"}, overwrite=True)
    assert failures == [step]
    assert listing(tmp_path) == ["old.html"]
    assert old.read_bytes() == b"old"


def test_nothing_is_put_in_place_before_all_is_written(tmp_path, monkeypatch):
    """The second of two files fails: the first must not appear alone."""
    calls = []
    real = os.fsync

    def fail_at_second(handle):
        calls.append(handle)
        if len(calls) == 2:
            raise OSError(28, "No space left on device")
        real(handle)

    monkeypatch.setattr(os, "fsync", fail_at_second)
    with pytest.raises(OutputError, match="No space left"):
        write_files({tmp_path / "a": b"1", tmp_path / "b": b"2"}, overwrite=True)
    assert len(calls) == 2
    assert listing(tmp_path) == []


def test_a_file_in_the_place_of_a_folder_is_told(tmp_path):
    (tmp_path / "out").write_bytes(b"")
    with pytest.raises(OutputError, match="cannot write"):
        write_files({tmp_path / "out" / "a": b"1"}, overwrite=True)
    assert listing(tmp_path) == ["out"]


def test_free_places_are_accepted(tmp_path):
    require_free([tmp_path / "new" / "deep" / "a"], overwrite=False)
    require_free([], overwrite=False)
    assert list(tmp_path.iterdir()) == []


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


def test_taken_places_are_accepted_if_asked(tmp_path):
    path = tmp_path / "a"
    path.write_bytes(b"kept")
    require_free([path], overwrite=True)
    assert path.read_bytes() == b"kept"


@pytest.mark.parametrize("overwrite", [True, False])
def test_a_file_in_the_way_is_refused_before_any_work(tmp_path, overwrite):
    (tmp_path / "out").write_bytes(b"")
    with pytest.raises(OutputError, match="out is not a folder"):
        require_free([tmp_path / "out" / "deep" / "a"], overwrite=overwrite)


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


def list_commands(group=cli.cli, prefix=()):
    for name, command in group.commands.items():
        if isinstance(command, click.Group):
            yield from list_commands(command, (*prefix, name))
        else:
            yield (*prefix, name), command


# What makes each command write to a place that is taken; {} is that place.
WRITING = {
    ("init",): "init {}/site.xlsx",
    ("map",): "map {}/site.xlsx",
    ("check",): "check --example --out {}",
    ("check", "annotate"): "check {}/site.xlsx --annotate {}/copy.xlsx",
    ("solve",): "solve {}/scene.toml --out {}",
    ("envelope",): "envelope {}/scene.toml --density 250:300 --friction 20:30 "
    "--inclination 25:30 --out {}",
    ("bench",): "bench --quick --plot {}/plot.svg",
    ("paper",): "paper --out {}",
    ("winter",): "winter --example --out {}",
    ("validate",): "validate --out {}",
    ("standards", "copy"): "standards copy eurocode {}/mine",
    ("terrain",): "terrain --example --out {}/ground.xlsx",
}


TAKEN = (
    "site.map.toml",
    *("study.json", "copy.xlsx", "solution.json", "envelope.json", "plot.svg"),
    *("paper.html", "index.html", "mine/document.toml"),
    *("winter.json", "validation.html", "form.xlsx", "rows.geojson"),
)


@pytest.mark.parametrize("name", list(WRITING), ids="-".join)
def test_no_option_is_advised_that_a_command_lacks(name, call, tmp_path):
    """`init` advised --out, which it never had; `standards copy` had no --force."""
    place = tmp_path / "taken"
    (place / "mine").mkdir(parents=True)
    for file in TAKEN:
        (place / file).write_bytes(b"kept")
    write_site(place / "site.xlsx")
    (place / "scene.toml").write_text(SMALL_SCENE)
    ended = call(*WRITING[name].format(place, place).split())
    assert ended.code == 2, ended.err
    assert "exists already" in ended.err
    command = dict(list_commands())[tuple(part for part in name if part != "annotate")]
    options = {opt for param in command.params for opt in param.opts}
    assert set(re.findall(r"--[a-z-]+", ended.err)) <= options


def test_every_command_that_writes_is_asked_above():
    places = {"out", "force", "plot", "annotate"}
    writing = {
        name
        for name, command in list_commands()
        if places & {param.name for param in command.params}
    }
    assert writing - set(WRITING) <= {("report",)}  # which writes as check does


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
