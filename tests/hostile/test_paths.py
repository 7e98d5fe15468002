"""What is wrong with a path that was given is no bug; a file of ours that lacks is."""

import os
import tempfile

import pytest

from netdesign.site.template import example as template

LONG = "9" * 400


@pytest.mark.parametrize(
    "command",
    [
        ("check", LONG),
        ("check", f"{LONG}.csv"),
        ("check", f"{LONG}/site.xlsx"),
        ("check", "site.csv", "--annotate", f"{LONG}.xlsx"),
        ("check", "--example", "--out", LONG),
        ("check", "--example", "--standard", LONG),
        ("bench", "--plot", LONG),
        ("paper", "--out", LONG),
        ("report", LONG),
        ("diff", LONG, LONG),
        ("solve", LONG),
        ("standards", "show", LONG),
        ("standards", "validate", LONG),
        ("standards", "copy", "eurocode", LONG),
        ("init", LONG),
        ("init", f"{LONG}/site.xlsx"),
    ],
)
def test_a_name_too_long_for_a_file_is_no_bug(call, tmp_path, command):
    (tmp_path / "site.csv").write_text("id;slope\n1;2\n")
    ended = call(*command)
    assert ended.code in (2, 3)
    assert "internal" not in ended.err
    assert LONG in ended.err.replace("\n", "")
    assert [path.name for path in tmp_path.iterdir()] == ["site.csv"]


UNSEARCHABLE = [
    ("check", "locked/site.xlsx"),
    ("check", "locked/site.csv"),
    ("check", "locked"),
    ("check", "site.csv", "--annotate", "locked/copy.xlsx"),
    ("check", "--example", "--out", "locked"),
    ("check", "--example", "--out", "locked/out"),
    ("check", "--example", "--standard", "locked"),
    ("check", "--example", "--standard", "locked/profile"),
    ("report", "locked/study.json"),
    ("verify", "--study", "locked/study.json"),
    ("solve", "locked/scene.toml"),
    ("standards", "copy", "eurocode", "locked/profile"),
    ("standards", "validate", "locked"),
    ("init", "locked/site.xlsx"),
]


@pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may look anywhere"
)
@pytest.mark.parametrize("command", UNSEARCHABLE)
def test_a_folder_that_may_not_be_searched_is_no_bug(call, locked, tmp_path, command):
    (tmp_path / "site.csv").write_text("id;slope\n1;2\n")
    ended = call(*command)
    assert ended.code in (2, 3)
    assert "internal" not in ended.err
    assert "locked" in ended.err


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
