"""``check --scope``: the exit code is that of the scopes that are asked for."""

import json

import pytest

from netdesign.outcome import EXIT_CODES, Verdict
from tests.make import write_rows

QUICK = ("--accuracy", "0.0512345678", "--jobs", "1", "--quiet", "--no-html")
NAMES = ("anchors", "structure", "siting")
ORDER = ("fail", "not_proven", "declared", "pass")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("scopes")
    write_rows(folder / "site.xlsx", ["R6"])  # anchors not proven
    return folder


def test_the_worst_of_the_scopes_that_are_asked_for_ends_the_run(
    folder, monkeypatch, call
):
    monkeypatch.chdir(folder)
    ended = call("check", "site.xlsx", *QUICK, "--out", "all", "--no-excel")
    document = json.loads((folder / "all" / "study.json").read_text())
    verdicts = {name: document["scopes"][name]["verdict"] for name in NAMES}
    assert verdicts["anchors"] != verdicts["siting"]
    worst = min(verdicts.values(), key=ORDER.index)
    assert ended.code == EXIT_CODES[Verdict(worst)]
    for number, asked in enumerate([("anchors",), ("siting",), ("anchors,siting",)]):
        options = [part for one in asked for part in ("--scope", one)]
        told = call("check", "site.xlsx", *QUICK, *options, "--out", f"o{number}",
                    "--no-excel")  # fmt: skip
        named = ",".join(asked).split(",")
        worst = min((verdicts[one] for one in named), key=ORDER.index)
        assert told.code == EXIT_CODES[Verdict(worst)]
        again = json.loads((folder / f"o{number}" / "study.json").read_text())
        assert again["scopes"] == document["scopes"]  # the study is whole


def test_what_is_no_scope_is_refused(folder, monkeypatch, call):
    monkeypatch.chdir(folder)
    ended = call("check", "site.xlsx", "--scope", "anchors,roof")
    assert ended.code == 2
    assert "roof" in ended.err
