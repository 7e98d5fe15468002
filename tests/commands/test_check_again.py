"""A check that is run again: rows from the store, the same files to the last byte."""

from types import SimpleNamespace
from unittest import mock

import numpy as np
import pytest

from netdesign.addons.evidence.benchmark.scenes import write_site
from netdesign.commands import report
from netdesign.commands.report import read_own_site
from netdesign.edge.input_files import make_printable
from netdesign.study import check_site as use_case
from tests.each import each

SITE = ("check", "site", "--accuracy", "0.1", "--jobs", "1", "--explain")
BARE = ("--no-html", "--no-excel")


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    monkeypatch.setenv("NETDESIGN_STORE", str(tmp_path / "cases.sqlite"))
    monkeypatch.chdir(tmp_path)
    write_site(tmp_path / "site", 1)
    return tmp_path


@pytest.fixture
def judged(monkeypatch):
    ids, real = [], use_case._judge_row

    def judge(job, row, *rest):
        ids.append(row.id)
        return real(job, row, *rest)

    monkeypatch.setattr(use_case, "_judge_row", judge)
    return ids


def read_outputs(folder):
    return {path.name: path.read_bytes() for path in folder.glob("[!.]*")}


@pytest.mark.long
def test_a_second_run_gives_the_same_bytes_and_words(place, call, judged):
    ended = [
        call(*SITE, "--out", name, *more)
        for name, more in {"bare": ["--no-cache"], "kept": [], "again": []}.items()
    ]
    assert judged == ["R1.1"] * 2  # --no-cache neither keeps nor finds
    assert len({(one.code, one.out) for one in ended}) == 1
    outputs = read_outputs(place / "bare")
    assert set(outputs) == {"study.json", "report.html", "report.xlsx"}
    assert read_outputs(place / "kept") == read_outputs(place / "again") == outputs
    call(*SITE, "--out", "last", "--no-cache")
    assert judged == ["R1.1"] * 3


def test_a_time_of_its_own_stands_in_each_run(place, call, judged, monkeypatch):
    call(*SITE, *BARE, "--out", "one")
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1600000000")
    call(*SITE, *BARE, "--out", "two")
    assert b"2020-09-13T12:26:40" in (place / "two" / "study.json").read_bytes()
    assert judged == ["R1.1"]


def test_its_own_files_are_replaced_and_no_others(place, call, judged):
    call(*SITE, "--no-excel")
    assert call(*SITE, "--no-excel").code != 2
    page = place / "netdesign-out" / "report.html"
    page.write_text("signed", encoding="utf-8")
    refused = call(*SITE, "--no-excel")
    assert refused.code == 2
    assert "--force" in refused.err
    assert "report.html" in refused.err
    assert "study.json" not in refused.err
    assert page.read_text(encoding="utf-8") == "signed"
    assert judged == ["R1.1"]


# --- fault 19: a name of a file with signs that steer a terminal ----------------------


@each("seed", range(30))
def test_a_site_is_found_by_its_name_whatever_signs_it_has(tmp_path_factory, seed):
    """Drawn names: line ends, marks of direction, escapes, no-break spaces."""
    folder = tmp_path_factory.mktemp("site")
    rng = np.random.default_rng([61, 19, seed])
    signs = [*"ab 1.", "\n", "\r", "\u202e", "\u2028", "\x1b", "\u00a0", "é", "\u200b"]
    name = "s" + "".join(rng.choice(signs, 8)) + "x.xlsx"
    site = folder / name
    site.write_bytes(b"")
    (folder / "other.xlsx").write_bytes(b"")
    provenance = SimpleNamespace(site_file=make_printable(name))
    study = SimpleNamespace(provenance=provenance)
    with mock.patch.object(report, "_read_again", lambda _, path: path):
        assert read_own_site(study, folder / "study.json", None) == site
        out = folder / "out" / "study.json"
        out.parent.mkdir()
        assert read_own_site(study, out, None) == site
