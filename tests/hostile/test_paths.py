"""What is wrong with a path that was given is no bug; a file of ours that lacks is."""

import os
import tempfile

import pytest

from netdesign.site.template import office_workbook as template

LONG = "9" * 400


# Commands that are given a place, or something in it.
COMMANDS = [
    ("check", "{}/site.xlsx"),
    ("check", "{}/site.csv"),
    ("check", "{}"),
    ("check", "site.csv", "--annotate", "{}/copy.xlsx"),
    ("check", "--example", "--out", "{}"),
    ("check", "--example", "--out", "{}/out"),
    ("check", "--example", "--standard", "{}"),
    ("check", "--example", "--standard", "{}/profile"),
    ("report", "{}/study.json"),
    ("verify", "--study", "{}/study.json"),
    ("solve", "{}/scene.toml"),
    ("standards", "copy", "eurocode", "{}/profile"),
    ("standards", "validate", "{}"),
    ("init", "{}/site.xlsx"),
]
OF_FILES = [
    ("check", "{}.csv"),
    ("check", "site.csv", "--annotate", "{}.xlsx"),
    ("bench", "--plot", "{}"),
    ("paper", "--out", "{}"),
    ("report", "{}"),
    ("diff", "{}", "{}"),
    ("solve", "{}"),
    ("standards", "show", "{}"),
    ("standards", "copy", "eurocode", "{}"),
    ("init", "{}"),
]


def refuse(call, folder, command, place):
    (folder / "site.csv").write_text("id;slope\n1;2\n")
    ended = call(*(word.format(place) for word in command))
    assert ended.code in (2, 3)
    assert "internal" not in ended.err
    assert place in ended.err.replace("\n", "")


@pytest.mark.parametrize("command", [*COMMANDS, *OF_FILES])
def test_a_name_too_long_for_a_file_is_no_bug(call, tmp_path, command):
    refuse(call, tmp_path, command, LONG)
    assert [path.name for path in tmp_path.iterdir()] == ["site.csv"]


@pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may look anywhere"
)
@pytest.mark.parametrize("command", COMMANDS)
def test_a_folder_that_may_not_be_searched_is_no_bug(call, locked, tmp_path, command):
    refuse(call, tmp_path, command, "locked")


@pytest.fixture
def locked(tmp_path):
    folder = tmp_path / "locked"
    folder.mkdir(mode=0)
    yield folder
    folder.chmod(0o700)


def test_no_room_for_the_example_is_no_bug(call, monkeypatch):
    def refuse():
        raise OSError(28, "No space left on device", "/tmp/example")

    monkeypatch.setattr(tempfile, "TemporaryDirectory", refuse)
    ended = call("check", "--example")
    assert ended.code == 2
    assert "No space left on device: '/tmp/example'" in ended.err


def test_a_file_of_the_program_that_lacks_is_a_bug(call, monkeypatch):
    monkeypatch.setattr(template, "INPUT_EXAMPLE_FILE", "lacks.toml")
    ended = call("init", "site.xlsx", "--example")
    assert ended.code == 5
    assert "internal error, please report it: FileNotFoundError" in ended.err
    assert "lacks.toml" in ended.err
