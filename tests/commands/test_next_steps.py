"""What to do when a row fails: told where one does, in every language."""

import click
import pytest

from netdesign.commands.running import list_next_steps, print_next_steps
from netdesign.outcome import Verdict
from netdesign.words.catalogue import LANGUAGES, load_texts
from tests.report.build_study import build_study


def keys(*verdicts, is_sized=False):
    steps = list_next_steps(set(verdicts), "my site.xlsx", is_sized=is_sized)
    return [one.key.partition(".")[2] for one in steps]


def test_each_verdict_has_its_own_steps():
    assert keys(Verdict.PASS) == []
    assert keys(Verdict.PASS, Verdict.DECLARED) == []
    assert keys(Verdict.FAIL) == ["inputs", "size", "again"]
    assert keys(Verdict.NOT_PROVEN) == ["inputs", "again"]
    both = keys(Verdict.FAIL, Verdict.NOT_PROVEN, is_sized=True)
    assert both == ["inputs", "again"]


def test_the_command_can_be_copied():
    steps = list_next_steps({Verdict.FAIL}, "my site.xlsx", is_sized=False)
    told = "\n".join(map(str, steps))
    assert "netdesign check 'my site.xlsx' --size" in told


@pytest.mark.parametrize("language", LANGUAGES)
def test_they_are_told_in_the_language_of_the_run(language, capsys):
    verdicts = {row.verdict for row in build_study().rows}
    with click.Context(click.Command("check")) as context:
        context.params["language"] = language
        print_next_steps(verdicts, "site.xlsx", is_sized=False)
    told = capsys.readouterr()
    assert told.out == ""
    texts = load_texts(language)
    for key in ("next.inputs", "next.again"):
        assert texts[key] in told.err
    print_next_steps({Verdict.PASS}, "site.xlsx", is_sized=False)
    assert capsys.readouterr().err == ""
