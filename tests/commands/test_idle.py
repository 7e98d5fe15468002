"""Options without effect are refused where typed; variables are told."""

import ast
import re
from pathlib import Path

import pytest

from netdesign.commands.config import _OF_ALL
from tests.sources import walk_package

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
    "typed",
    [
        ("--noise", "0.1"),
        ("--cell-error", "0.1"),
        ("--rope-kelvin", "3"),
        ("--known", "slack"),
    ],
)
def test_options_of_a_fit_without_a_fit(call, typed):
    told = refuse(call, "winter", "--example", *typed)
    assert typed[0] in told
    assert "no effect without --fit" in told


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
        (("bench", "--jobs", "2"), "--stress or --errors or --lines"),
        (("snowpack", "heights.csv", "--layers"), "--json"),
        (("verify", "--jobs", "2"), "--study"),
        (("verify", "--site", "site.xlsx"), "--study"),
    ],
)
def test_options_that_belong_to_another_one(call, words, needed):
    assert refuse(call, *words).endswith(f"no effect without {needed}")


def test_jobs_beside_a_cluster(call, monkeypatch):
    cluster = ("--executor", "dask://nowhere:1")
    for words in (("check", "--example"), ("winter", "--example"), ("envelope", "s")):
        told = refuse(call, *words, *cluster, "--jobs", "2")
        assert told.endswith("--jobs: no effect beside --executor")
    monkeypatch.setenv("NETDESIGN_CHECK_JOBS", "2")
    err = call("check", "--example", "--dry-run", *cluster).err
    assert "note: NETDESIGN_CHECK_JOBS: no effect beside --executor" in err


def test_defaults_for_other_runs_are_no_fault(call, site, monkeypatch):
    """A variable is told, a file of defaults is not."""
    Path("netdesign.toml").write_text('[check]\ndelimiter = ";"\n', encoding="utf-8")
    ended = call("check", site, "--dry-run")
    assert (ended.code, ended.err.count("no effect")) == (0, 0)
    monkeypatch.setenv("NETDESIGN_CHECK_DELIMITER", ";")
    ended = call("check", site, "--dry-run")
    assert ended.code == 0
    assert ended.err.splitlines()[0] == (
        "note: NETDESIGN_CHECK_DELIMITER: no effect, since site.xlsx is a workbook "
        "and no csv file"
    )


def test_a_variable_that_names_no_command_is_told(call, monkeypatch):
    monkeypatch.setenv("NETDESIGN_JOBS", "2")
    ended = call("check", "--example", "--dry-run")
    assert ended.code == 0
    line = ended.err.splitlines()[0]
    assert line.startswith("note: the variable NETDESIGN_JOBS has no effect; that of")
    assert line.endswith("NETDESIGN_CHECK_JOBS")


def test_variables_that_are_read_are_not_told(call, monkeypatch):
    monkeypatch.setenv("NETDESIGN_WINTER_JOBS", "2")
    monkeypatch.setenv("NETDESIGN_SUITE_NEED_PROGRAMS", "1")
    monkeypatch.setenv("NETDESIGN_LANGUAGE", "en")
    assert "no effect" not in call("check", "--example", "--dry-run").err
    monkeypatch.setenv("NETDESIGN_HOME", "2")
    err = call("standards", "list").err
    assert err == "note: the variable NETDESIGN_HOME has no effect\n"


def test_a_variable_of_a_command_without_such_an_option_is_refused(call, monkeypatch):
    monkeypatch.setenv("NETDESIGN_MAP_JOBS", "2")
    assert "NETDESIGN_MAP_JOBS" in refuse(call, "map", "site.xlsx")
    monkeypatch.setenv("NETDESIGN_STANDARDS_JOBS", "2")
    assert "NETDESIGN_STANDARDS_JOBS" in refuse(call, "standards", "list")


def test_every_variable_of_the_program_is_known():
    texts = {
        node.value
        for _, node in walk_package()
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    named = {one for one in texts if re.fullmatch(r"NETDESIGN_[A-Z]+", one)}
    assert named == set(_OF_ALL)
