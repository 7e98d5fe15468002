"""Options without effect are refused where typed."""

import pytest


@pytest.fixture
def site(call):
    call("init", "site.xlsx", "--example")
    return "site.xlsx"


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


def test_jobs_beside_a_cluster(call):
    cluster = ("--executor", "dask://nowhere:1")
    for words in (("check", "--example"), ("winter", "--example"), ("envelope", "s")):
        told = refuse(call, *words, *cluster, "--jobs", "2")
        assert told.endswith("--jobs: no effect beside --executor")
