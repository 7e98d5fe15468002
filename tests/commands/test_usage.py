"""Refused command lines say option, value and what is accepted, in every language."""

from pathlib import Path

import pytest

OTHERS = ("fr", "de")
ACCEPTED = {
    "1 to 256": {"fr": "un nombre entier de 1 à 256", "de": "ganze Zahl von 1 bis 256"},
    "from 1": {"fr": "un nombre entier à partir de 1", "de": "eine ganze Zahl ab 1"},
    "share": {"fr": "un nombre de 0.0001 à 0.1", "de": "eine Zahl von 0.0001 bis 0.1"},
    "folder": {"fr": "le chemin d'un dossier", "de": "der Pfad eines Ordners"},
    "file": {"fr": "le chemin d'un fichier", "de": "der Pfad einer Datei"},
}


def plain(text):
    """Text without the spaces that keep words together."""
    return text.replace("\N{NO-BREAK SPACE}", " ").replace(
        "\N{NARROW NO-BREAK SPACE}", " "
    )


@pytest.mark.parametrize("language", OTHERS)
@pytest.mark.parametrize(
    ("words", "option", "value", "accepted"),
    [
        (["check", "s.xlsx", "--jobs", "0"], "--jobs", "0", "1 to 256"),
        (["check", "s.xlsx", "--jobs=2.5"], "--jobs", "2.5", "1 to 256"),
        (["check", "s.xlsx", "--accuracy", "0,01"], "--accuracy", "0,01", "share"),
        (["bench", "--stress", "-3"], "--stress", "-3", "from 1"),
        (["check", "s.xlsx", "--out", "there"], "--out", "there", "folder"),
        (["winter", "--heights", "/"], "--heights", "/", "file"),
    ],
)
def test_a_value_is_named_with_what_is_accepted(
    call, language, words, option, value, accepted
):
    Path("there").touch()
    ended = call(*words, "--language", language)
    last = plain(ended.err).splitlines()[-1]
    assert ended.code == 2
    assert f"'{option}'" in last
    assert f"'{value}'" in last
    assert last.endswith(ACCEPTED[accepted][language])


@pytest.mark.parametrize("language", OTHERS)
def test_of_several_values_the_refused_one_is_named(call, language):
    known = ("--known", "slack", "--known", "snow")
    last = call("winter", "s.xlsx", *known, "--language", language).err.splitlines()[-1]
    assert "'snow'" in last
    assert "'slack'" not in last
    assert "slip, density, height, slack, friction" in last


@pytest.mark.parametrize("language", OTHERS)
def test_a_value_of_a_variable_is_named(call, monkeypatch, language):
    monkeypatch.setenv("NETDESIGN_CHECK_JOBS", "many")
    last = call("check", "s.xlsx", "--language", language).err.splitlines()[-1]
    assert "'many'" in last
    assert "'--jobs'" in last


@pytest.mark.parametrize("language", OTHERS)
def test_a_value_in_a_command_below_a_command_is_named(call, language):
    ended = call("standards", "copy", "--language", language, "a", "b", "c", "d")
    assert "c, d" in ended.err.splitlines()[-1]
    last = call("completion", "fsh", "--language", language).err.splitlines()[-1]
    assert "'fsh'" in last
    assert "bash, zsh, fish, powershell" in last


@pytest.mark.parametrize("language", OTHERS)
def test_an_option_without_its_value_says_what_is_accepted(call, language):
    last = call("check", "s.xlsx", "--language", language, "--jobs").err
    assert plain(last).strip().endswith(ACCEPTED["1 to 256"][language])
    assert "--jobs" in last
    flag = call("check", "s.xlsx", "--language", language, "--json=3").err
    assert "--json" in flag
    assert "'3'" in flag


@pytest.mark.parametrize("language", ["en", *OTHERS])
def test_a_wrong_delimiter_is_named(call, language):
    refused = call("check", "s.csv", "--delimiter", "xy", "--language", language)
    assert refused.code == 2
    assert "'xy'" in refused.err.splitlines()[-1]


@pytest.mark.parametrize("language", OTHERS)
def test_words_too_many_are_named_alone(call, language):
    last = call("check", "a.xlsx", "b", "c", "--language", language).err.splitlines()[
        -1
    ]
    assert last.endswith("b, c")
    assert "a.xlsx" not in last
