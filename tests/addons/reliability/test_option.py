"""``check --reliability``: told beside the verdict, which is the same without it."""

import json

from tests.make import write_rows

QUICK = ("--jobs", "1", "--accuracy", "0.05", "--no-cache", "--quiet", "--no-excel")


def test_exit_code_and_verdicts_are_the_same_and_its_study_is_verified(
    tmp_path, monkeypatch, call
):
    monkeypatch.chdir(tmp_path)
    write_rows(tmp_path / "site.xlsx", ["R2"], leans=True)
    bare = call("check", "site.xlsx", *QUICK, "--out", "a", "--no-html")
    told = call("check", "site.xlsx", *QUICK, "--out", "b", "--reliability")
    assert (bare.code, bare.err) == (told.code, told.err)
    (row,) = json.loads((tmp_path / "a" / "study.json").read_text())["rows"]
    (again,) = json.loads((tmp_path / "b" / "study.json").read_text())["rows"]
    found = again.pop("reliability")
    assert row.pop("reliability", None) is None
    assert row == again
    assert 2.0 < found["beta"] < 7.0
    (line,) = set(told.out.splitlines()) - set(bare.out.splitlines())
    assert line.startswith("Notional reliability")
    page = (tmp_path / "b" / "report.html").read_text(encoding="utf-8")
    assert 'id="annex-reliability"' in page
    verified = call("verify", "--study", "b/study.json", "--site", "site.xlsx")
    assert verified.code == 0, verified.out + verified.err
