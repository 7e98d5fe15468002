"""Help in groups, its short lists of options, and folders that stand for a study."""

import shlex
from itertools import groupby

import click
import pytest

from netdesign import cli
from netdesign.commands.options import STUDY
from tests.each import each

GROUPS = {
    "Office": "init map check table report diff verify standards doctor",
    "Add-ons": "winter terrain",
    "Research": "solve envelope snowpack bench paper validate",
}
COMMANDS = " ".join(GROUPS.values()).split()
MOST = 12


def list_options(text):
    """Long names in a help text."""
    lines = text.partition("\nOptions:\n")[2].splitlines()
    words = (line.split() for line in lines if line.startswith("  -"))
    return [next(w for w in line if w.startswith("--")).rstrip(",") for line in words]


def test_each_command_stands_once_in_its_group(call):
    lines = call("--help").out.splitlines()
    blocks = [list(found) for is_text, found in groupby(lines, key=bool) if is_text]
    shown = {head: [x.split()[0] for x in lines] for head, *lines in blocks}
    assert {
        head[:-1]: names for head, names in shown.items() if head[:-1] in GROUPS
    } == {title: names.split() for title, names in GROUPS.items()}
    assert sorted(cli.cli.commands) == sorted(COMMANDS)


@each("name", COMMANDS)
def test_a_help_is_short_and_another_has_all(call, name):
    command = cli.cli.commands[name]
    known = {
        max(one.opts, key=len)
        for one in command.params
        if isinstance(one, click.Option) and not one.hidden
    }
    short = list_options(call(name, "--help").out)
    assert len(short) <= MOST
    if "--help-all" not in known:
        assert set(short) == {*known, "--help"}
        return
    whole = list_options(call(name, "--help-all").out)
    assert set(whole) == {*known, "--help"}
    assert set(short) < set(whole)


@pytest.mark.parametrize("words", [("a b.xlsx",), ("Liste.CSV", "--quiet")])
def test_a_site_instead_of_a_command_says_what_to_type(call, words):
    ended = call(*words)
    assert ended.code == 2
    typed = ended.err.splitlines()[-1].partition("type: ")[2]
    assert shlex.split(typed) == ["netdesign", "check", *words]


@pytest.mark.parametrize(
    ("there", "found"),
    [
        (["study.json"], "study.json"),
        (["part-study.json"], "part-study.json"),
        (["study.json", "what-if-study.json"], "study.json"),
        (["part-study.json", "what-if-study.json"], "study.json"),
        ([], "study.json"),
    ],
)
def test_a_folder_stands_for_the_study_in_it(tmp_path, there, found):
    for name in there:
        (tmp_path / name).touch()
    assert STUDY.convert(str(tmp_path), None, None) == tmp_path / found
    file = tmp_path / "any.json"
    assert STUDY.convert(str(file), None, None) == file
