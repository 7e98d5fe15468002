"""``check --floor``: against the profile, said wherever a verdict is read."""

import json

import pytest

from netdesign.words.catalogue import load_texts
from tests.make import write_rows

QUICK = ("--accuracy", "0.0512345678", "--jobs", "1", "--quiet")


@pytest.fixture
def site(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_rows(tmp_path / "site.xlsx", ["R1"])
    return tmp_path


def read_profile(folder):
    return json.loads((folder / "study.json").read_text())["profile"]


def test_no_floor_is_said(site, call):
    options = ("--floor", "none", "--out", "a", "--language", "fr", "--no-excel")
    ended = call("check", "site.xlsx", *QUICK, *options)
    assert ended.code in (0, 1, 4), ended.err
    profile = read_profile(site / "a")
    assert (profile["floor"], profile["is_floor_overruled"]) == ("none", True)
    said = load_texts("fr")["floor.none_chosen"]
    assert " ".join(said.split()) in " ".join(ended.out.split())  # it is folded
    page = (site / "a" / "report.html").read_text(encoding="utf-8")
    card = page[page.index('id="decision"') : page.index('id="basis"')]
    assert "--floor" in card
    assert said in card.replace("&#39;", "'")


@pytest.mark.long
def test_a_study_without_a_floor_is_verified(site, call):
    options = ("--floor", "none", "--out", "a", "--no-html", "--no-excel")
    assert call("check", "site.xlsx", *QUICK, *options).code in (0, 1, 4)
    assert call("verify", "--study", "a/study.json", "--site", "site.xlsx").code == 0
    again = call("report", "a/study.json", "--site", "site.xlsx", "--out", "b")
    assert (again.code, again.err.count("audit")) == (0, 0)


def test_a_study_cannot_say_that_its_floor_was_chosen(site, call):
    """Nor that it was not: the digest aside, the profile says otherwise."""
    for options, overruled in ((("--floor", "none"), False), ((), True)):
        assert call("check", "site.xlsx", *QUICK, *options, "--out", "a", "--no-html",
                    "--no-excel", "--force").code in (0, 1, 4)  # fmt: skip
        document = json.loads((site / "a" / "study.json").read_text())
        document["profile"]["is_floor_overruled"] = overruled
        (site / "a" / "study.json").write_text(json.dumps(document))
        refused = call("report", "a/study.json", "--site", "site.xlsx", "--out", "b")
        assert refused.code != 0
        assert not (site / "b").exists()
