"""Options without effect are refused where typed."""

from pathlib import Path

import pytest

LINE = "2003-01-01,10"


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
    "words",
    [
        ("check", "site.xlsx"),
        ("check", "--example"),
        ("winter", "site.xlsx"),
        ("winter", "--example"),
        ("snowpack", "site.xlsx"),
        ("map", "site.xlsx"),
    ],
)
def test_a_delimiter_beside_a_workbook(call, words):
    told = refuse(call, *words, "--delimiter", ";")
    assert told.split(": ")[1].strip() == "--delimiter"
    assert words[1] in told
    assert "is a workbook" in told


def test_a_delimiter_has_an_effect_where_a_csv_file_is_read(call, site):
    Path("heights.csv").write_text(f"date,HS [cm]\n{LINE}\n", encoding="utf-8")
    Path("folder").mkdir()
    for words in (
        ("winter", site, "--heights", "heights.csv"),
        ("winter", "--example", "--heights", "heights.csv"),
        ("snowpack", "heights.csv"),
        ("map", "site.csv"),
        ("check", "folder", "--dry-run"),
    ):
        assert call(*words, "--delimiter", ";").code != 2, words


@pytest.mark.parametrize(
    ("words", "needed"),
    [
        (("bench", "--jobs", "2"), "--stress or --errors"),
        (("snowpack", "heights.csv", "--layers"), "--json"),
        (("verify", "--jobs", "2"), "--study"),
        (("verify", "--site", "site.xlsx"), "--study"),
    ],
)
def test_options_that_belong_to_another_one(call, words, needed):
    assert refuse(call, *words).endswith(f"no effect without {needed}")


def test_jobs_beside_a_cluster(call):
    cluster = ("--executor", "dask://nowhere:1")
    for words in (("check", "--example"), ("winter", "--example"), ("envelope", "s")):
        told = refuse(call, *words, *cluster, "--jobs", "2")
        assert told.endswith("--jobs: no effect beside --executor")


def test_defaults_for_other_runs_are_no_fault(call, site):
    Path("netdesign.toml").write_text('[check]\ndelimiter = ";"\n', encoding="utf-8")
    ended = call("check", site, "--dry-run")
    assert (ended.code, ended.err.count("no effect")) == (0, 0)
