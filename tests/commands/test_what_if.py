"""``check --size`` and ``--what-if``: never taken for the site as built."""

import json

import pytest

from netdesign.study.document import read_document, write_document
from tests.make import find_cell, write_rows

QUICK = ("--accuracy", "0.0512345678", "--jobs", "1", "--quiet")
BARE = ("--no-html", "--no-excel")
FOOT = find_cell("rows", "foot_anchor")  # of the one row
UNTESTED = 4  # line of the type that it has


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    return tmp_path_factory.mktemp("store") / "cases.sqlite"


@pytest.fixture
def site(tmp_path, monkeypatch, store):
    monkeypatch.setenv("NETDESIGN_STORE", str(store))
    write_rows(tmp_path / "site.xlsx", ["R6"])
    return tmp_path


def read_study(path):
    return json.loads(path.read_text(encoding="utf-8"))


@pytest.mark.long
def test_sizing_writes_the_study_that_a_what_if_makes(site, call):
    ended = call("check", "site.xlsx", *QUICK, "--size", "--out", "a", *BARE)
    assert ended.code == 4, ended.err  # of the site as built
    told = " ".join(ended.out.split())  # it is folded
    assert "smallest type of the workbook that passes is A28-tested" in told
    built, sized = (read_study(site / f"a/{n}study.json") for n in ("", "what-if-"))
    assert (built["verdict"], built["what_if"]) == ("not_proven", [])
    assert sized["verdict"] == "pass"
    assert sized["what_if"] == [
        {"cell": FOOT, "was": "A25-untested", "now": "A28-tested"}
    ]
    given = ("--what-if", f"{FOOT.replace('!', '.')}=A28-tested")
    ended = call("check", "site.xlsx", *QUICK, *given, "--out", "b", *BARE)
    assert ended.code == 4, ended.err  # it proves nothing of the site
    assert [path.name for path in (site / "b").glob("[!.]*")] == ["what-if-study.json"]
    assert read_study(site / "b/what-if-study.json")["rows"] == sized["rows"]
    options = ("--site", "site.xlsx", "--out", "c", "--no-excel")
    again = call("report", "a/what-if-study.json", *options)
    assert again.code == 4, again.err
    assert [path.name for path in (site / "c").glob("[!.]*")] == ["what-if-report.html"]


def test_a_what_if_cannot_be_passed_off_as_the_site(site, call):
    options = ("--what-if", f"{FOOT.replace('!', '.')}=A32-tested", *BARE)
    assert call("check", "site.xlsx", *QUICK, *options, "--out", "a").code == 4
    place = site / "a/what-if-study.json"
    study = read_study(place)
    altered = write_document(read_document(json.dumps(study | {"what_if": []})))
    place.write_text(altered, encoding="utf-8")
    refused = call("report", place, "--verify", "--site", "site.xlsx", "--out", "b")
    assert refused.code == 3, refused.err
    assert not (site / "b").exists()


def test_cells_that_need_each_other_are_read_together(site, call):
    """How it is proven means nothing without the pull-out resistance."""
    typed = {"pull_out": "373.7", "proven": "tests", "test_count": "5"}
    cells = {find_cell("anchor_types", key, UNTESTED): typed[key] for key in typed}
    given = [f"{cell.replace('!', '.')}={value}" for cell, value in cells.items()]
    options = [part for one in given for part in ("--what-if", one)]
    alone = call("check", "site.xlsx", *QUICK, *options[2:4], "--out", "a", *BARE)
    assert alone.code == 2
    both = call("check", "site.xlsx", *QUICK, *options, "--out", "b", *BARE)
    assert both.code == 4, both.err
    changed = read_study(site / "b/what-if-study.json")["what_if"]
    assert {one["cell"]: one["now"] for one in changed} == cells
