"""``check --reliability``: told beside the verdict, which is the same without it."""

import json

import pytest

from tests.make import write_rows

QUICK = ("--jobs", "1", "--no-cache", "--quiet", "--no-excel")


@pytest.fixture
def site(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_rows(tmp_path / "site.xlsx", ["R2"], leans=True)
    return tmp_path


def test_exit_code_and_verdicts_are_the_same(site, call):
    bare = call("check", "site.xlsx", *QUICK, "--out", "a", "--no-html")
    told = call("check", "site.xlsx", *QUICK, "--out", "b", "--reliability")
    assert (bare.code, bare.err) == (told.code, told.err)
    (row,) = json.loads((site / "a" / "study.json").read_text())["rows"]
    (again,) = json.loads((site / "b" / "study.json").read_text())["rows"]
    found = again.pop("reliability")
    assert row.pop("reliability", None) is None
    assert row == again
    assert 2.0 < found["beta"] < 7.0
    (line,) = set(told.out.splitlines()) - set(bare.out.splitlines())
    assert line.startswith("Notional reliability")
    page = (site / "b" / "report.html").read_text(encoding="utf-8")
    assert 'id="annex-reliability"' in page


def test_a_study_with_it_is_verified(site, call):
    options = ("--reliability", "--out", "a", "--no-html")
    assert call("check", "site.xlsx", *QUICK, *options).code in (0, 1, 4)
    verified = call("verify", "--study", "a/study.json", "--site", "site.xlsx")
    assert verified.code == 0, verified.out + verified.err
