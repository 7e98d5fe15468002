"""Options that need another one are refused without it."""

import pytest


def refuse(call, *words):
    ended = call(*words)
    assert ended.code == 2
    assert ended.out == ""
    return ended.err.splitlines()[-1]


@pytest.mark.parametrize(
    ("words", "needed"),
    [
        (("bench", "--jobs", "2"), "--stress or --errors"),
        (("snowpack", "heights.csv", "--layers"), "--json"),
        (("verify", "--jobs", "2"), "STUDY"),
        (("verify", "--site", "site.xlsx"), "STUDY"),
    ],
)
def test_options_that_belong_to_another_one(call, words, needed):
    assert refuse(call, *words).endswith(f"no effect without {needed}")
