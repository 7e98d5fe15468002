"""``check --row``: some net rows alone, never taken for the whole site."""

import json

import pytest

from tests.make import write_rows

QUICK = ("--accuracy", "0.0512345678", "--jobs", "1", "--quiet", "--no-excel")


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    return tmp_path_factory.mktemp("store") / "cases.sqlite"


@pytest.fixture
def site(tmp_path, monkeypatch, store):
    monkeypatch.setenv("NETDESIGN_STORE", str(store))
    write_rows(tmp_path / "site.xlsx", ["R1", "R6"])
    return tmp_path


def read_study(path):
    return json.loads(path.read_text(encoding="utf-8"))


def test_a_row_that_passes_leaves_the_site_not_proven(site, call):
    ended = call("check", "site.xlsx", *QUICK, "--row", "R1", "--out", "a")
    assert ended.code == 4, ended.err
    study = read_study(site / "a" / "part-study.json")
    assert [row["id"] for row in study["rows"]] == ["R1"]
    assert study["rows"][0]["verdict"] == "pass"
    assert (study["verdict"], study["left_out"]) == ("not_proven", ["R6"])
    assert "Left out here" in " ".join(ended.out.split())  # it is folded
    page = (site / "a" / "part-report.html").read_text(encoding="utf-8")
    assert "Left out here" in page


def test_its_report_is_sound_and_an_altered_one_is_refused(site, call):
    call("check", "site.xlsx", *QUICK, "--row", "R1", "--out", "a", "--no-html")
    options = ("--site", "site.xlsx", "--no-excel")
    assert call("report", "a/part-study.json", *options, "--out", "b").code == 4
    study = read_study(site / "a" / "part-study.json")
    for altered in ({"left_out": []}, {"left_out": [], "verdict": "pass"}):
        (site / "c.json").write_text(json.dumps(study | altered), encoding="utf-8")
        refused = call("report", "c.json", *options, "--out", "d")
        assert refused.code == 3, refused.err


def test_it_is_verified_by_a_new_solve(site, call):
    call("check", "site.xlsx", *QUICK, "--row", "R6", "--out", "a", "--no-html")
    ended = call("verify", "--study", "a/part-study.json", "--site", "site.xlsx")
    assert ended.code == 4, ended.out  # not all of the site
    assert "same bytes" in ended.out
    assert "not verified: net rows R1, which were left out" in ended.out


def test_rows_are_those_of_the_whole_study(site, call):
    call("check", "site.xlsx", *QUICK, "--out", "whole", "--no-html")
    call("check", "site.xlsx", *QUICK, "--row", "R6", "--out", "one", "--no-html")
    whole = read_study(site / "whole" / "study.json")
    one = read_study(site / "one" / "part-study.json")
    assert one["rows"] == [row for row in whole["rows"] if row["id"] == "R6"]
