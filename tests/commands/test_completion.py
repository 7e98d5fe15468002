import pytest


@pytest.mark.parametrize(
    ("words", "completions"),
    [
        ("netdesign ch", {"check"}),
        ("netdesign init --lang", {"--language"}),
        ("netdesign init --language d", {"de"}),
        ("netdesign standards v", {"validate"}),
    ],
)
def test_commands_options_and_choices_are_completed(
    call, monkeypatch, words, completions
):
    monkeypatch.setenv("_NETDESIGN_COMPLETE", "bash_complete")
    monkeypatch.setenv("COMP_WORDS", words)
    monkeypatch.setenv("COMP_CWORD", str(len(words.split()) - 1))
    ended = call()
    assert {line.partition(",")[2] for line in ended.out.splitlines()} == completions
