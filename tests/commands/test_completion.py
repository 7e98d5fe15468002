import shutil
import subprocess

import pytest


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_every_shell_gets_its_script(call, shell):
    ended = call("completion", shell)
    assert ended.code == 0
    assert f"_NETDESIGN_COMPLETE={shell}_complete" in ended.out


def test_the_script_is_sound_bash(call, tmp_path):
    if shutil.which("bash") is None:
        pytest.skip("bash is not installed")
    script = call("completion", "bash").out
    result = subprocess.run(
        ["bash", "-c", f"{script}\ncomplete -p netdesign"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0
    assert "_netdesign_completion netdesign" in result.stdout


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


def test_an_unknown_shell_ends_with_2(call):
    assert call("completion", "tcsh").code == 2
