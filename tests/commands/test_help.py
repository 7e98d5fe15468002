"""Help in French and German: every text, nothing idle, the same shape as in English."""

import inspect
import re

import click
import pytest

from netdesign.cli import cli
from netdesign.commands.help_texts import load_help
from netdesign.words.catalogue import load_texts
from tests.words.english import find_words, list_words

LANGUAGES = ["fr", "de"]
COMMANDS = [
    (),
    *((name,) for name in cli.commands),
    *(("standards", name) for name in cli.commands["standards"].commands),
]
# Of click itself; typed as they are; names of what is typed in their place.
OF_CLICK = {"Usage", "Options", "Commands", "Show this message and exit."}
TYPED = re.compile(
    r"netdesign \S.*?(?=   |$)|eval .*?(?=   |$)|[`]netdesign [^`]*`|--?[a-z][a-z-]*|"
    r"\S*\w[._/:\\]\w\S*|\[[a-z|-]+\]|\b[A-Z_]{2,}\b|\b(transient|summary|figures|"
    r"extra|ignore|tab|figures|hs2swe|delta-snow(-ageing)?|steady|guideline)\b",
    re.MULTILINE,
)


def list_commands(command):
    yield command
    for one in getattr(command, "commands", {}).values():
        yield from list_commands(one)


def list_english():
    """Every text of help that the commands have, by paragraphs and columns."""
    for command in list_commands(cli):
        told = [command.help or "", command.epilog or ""]
        told += [one.help or "" for one in command.params if hasattr(one, "help")]
        for text in told:
            for paragraph in inspect.cleandoc(text).split("\n\n"):
                if paragraph.startswith("\b"):
                    lines = paragraph.split("\n")[1:]
                    yield from (part for one in lines for part in one.split("   ")[1:])
                else:
                    yield " ".join(paragraph.split())


ENGLISH = {text.strip() for text in list_english()} - {""}


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_text_of_help_is_there_and_none_is_idle(language):
    assert len(ENGLISH) > 100
    assert set(load_help(language).texts) == ENGLISH | OF_CLICK


def test_both_languages_tell_the_same_signs():
    french, german = map(load_help, LANGUAGES)
    assert set(french.signs) == set(german.signs)
    assert set(french.extras) == set(german.extras)


@pytest.mark.parametrize("language", LANGUAGES)
def test_options_and_files_stay_as_they_are_typed(language):
    kept = re.compile(r"--[a-z-]+|\w+\.(?:toml|json|html|xlsx|csv)|NETDESIGN_\w+|\d+")
    for english, text in load_help(language).texts.items():
        assert sorted(kept.findall(text)) == sorted(kept.findall(english)), english


@pytest.mark.long
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_help_speaks_the_language(call, monkeypatch, language, command):
    monkeypatch.setenv("NETDESIGN_LANGUAGE", language)
    told = call(*command, "--help")
    assert (told.code, told.err) == (0, "")
    plain = TYPED.sub(" ", told.out)
    assert find_words(plain, ["en"]) == set()
    known = list_words(" ".join(load_help(language).texts.values()))
    known |= set().union(*map(list_words, load_texts(language).values()))
    english = set().union(*map(list_words, ENGLISH))
    known |= {name for one in COMMANDS for name in one}
    assert list_words(plain) & english - known == set()


def test_english_reads_no_file(call, monkeypatch):
    monkeypatch.setattr("tomllib.loads", lambda _: pytest.fail("a file was read"))
    assert not load_help("en").texts
    told = call("check", "--help").out
    assert told.startswith("Usage: netdesign check [OPTIONS] [SITE_FILE]\n")
    assert "[default: 0.01; 0.0001<=x<=0.1]" in told


@pytest.mark.parametrize(
    ("variables", "arguments", "start"),
    [
        ({}, ["check", "--help", "--language", "de"], "Aufruf: netdesign check"),
        ({}, ["--language", "fr", "--help"], "Utilisation\u00a0: netdesign ["),
        ({}, ["standards", "-h", "--language=de"], "Aufruf: netdesign standards"),
        ({"NETDESIGN_LANGUAGE": "de"}, ["-h"], "Aufruf: netdesign"),
        (
            {"NETDESIGN_LANGUAGE": "de", "NETDESIGN_CHECK_LANGUAGE": "fr"},
            ["check", "-h"],
            "Utilisation\u00a0: netdesign check",
        ),
        (
            {"NETDESIGN_LANGUAGE": "de"},
            ["check", "-h", "--language", "en"],
            "Usage: netdesign check",
        ),
    ],
)
def test_the_language_of_help_is_found_where_others_are(
    call, monkeypatch, variables, arguments, start
):
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    assert call(*arguments).out.startswith(start)


def test_a_line_without_a_command_gets_help(call, monkeypatch):
    monkeypatch.setenv("NETDESIGN_LANGUAGE", "fr")
    assert "Vérifier chaque ancrage d'un site" in call().err
    assert "Énumérer les profils" in call("standards").err


def test_one_variable_holds_for_all_commands(call, monkeypatch):
    monkeypatch.setenv("NETDESIGN_LANGUAGE", "de")
    assert "gibt es" in call("check", "none.xlsx").err
    assert "Grenzwertprofil" in call("standards", "show", "eurocod").err
    assert call("init", "site.xlsx").code == 0


def test_a_language_before_the_command_is_refused_with_the_right_line(call):
    told = call("--language", "de", "standards", "list")
    assert told.code == 2
    assert "netdesign standards --language de" in told.err


@pytest.mark.parametrize("shell", ["zsh", "fish", "powershell"])
def test_completion_tells_in_the_language(call, monkeypatch, shell):
    monkeypatch.setenv("NETDESIGN_LANGUAGE", "fr")
    monkeypatch.setenv("_NETDESIGN_COMPLETE", f"{shell}_complete")
    joint = "\n" if shell == "powershell" else " "
    monkeypatch.setenv("COMP_WORDS", joint.join(["netdesign", "wint"]))
    monkeypatch.setenv("COMP_CWORD", "1" if shell == "zsh" else "wint")
    told = " ".join(call().out.split())
    assert "Suivre les hauteurs de neige d'une station sur les lignes" in told


def test_help_is_wrapped_at_no_sign_of_french(call):
    lines = call("winter", "--help", "--language", "fr").out.splitlines()
    assert [one for one in lines if re.match(r"\s*[:;?!»]", one)] == []


def test_a_click_command_of_nobody_is_told_in_english():
    """What has no text stays: no key error hides help."""
    told = load_help("de")
    assert told.tell("A text that nobody has written.").startswith("A text")
    assert told.tell("Cut short...") == "Cut short..."
    assert isinstance(cli, click.Group)
