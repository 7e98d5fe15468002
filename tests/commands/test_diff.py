import sys
from dataclasses import replace

import pytest

from netdesign import cli
from netdesign.study.document import write_document
from tests.make import write_tiny
from tests.report.build_study import build_study

STUDY = build_study(rows=1)
NOT_VERIFIED = "not verified: values as stored, not solved again"


@pytest.fixture
def files(tmp_path):
    revised = replace(STUDY, project=replace(STUDY.project, revision="C"))
    for name, study in (("old", STUDY), ("new", revised)):
        path = tmp_path / f"{name}.json"
        path.write_text(write_document(study), encoding="utf-8")
    return tmp_path


def test_changes_are_shown_by_area(call, files):
    ended = call("diff", files / "old.json", files / "new.json")
    assert ended.code == 0
    assert ended.out.splitlines() == [NOT_VERIFIED, "project", "  revision: B -> C"]


def weaken(tables):
    tables["posts"][0]["bearing"] = 5.0


@pytest.fixture(scope="module")
def real(tmp_path_factory):
    """Folder with two sites, whose net row passes and fails, and their studies."""
    folder = tmp_path_factory.mktemp("turned")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        patch.setenv("NETDESIGN_STORE", str(folder / "cases.sqlite"))
        write_tiny(folder / "passes.xlsx")
        write_tiny(folder / "fails.xlsx", weaken)
        for name in ("passes", "fails"):
            words = ["--out", name, "--no-html", "--no-excel", "--jobs", "1"]
            asked = ["netdesign", "check", f"{name}.xlsx", "--accuracy", "0.05"]
            patch.setattr(sys, "argv", [*asked, *words])
            with pytest.raises(SystemExit):
                cli.main()
    return folder


def test_a_turned_verdict_ends_with_1_in_text_and_document(call, real):
    passes, fails = (real / name / "study.json" for name in ("passes", "fails"))
    assert call("diff", fails, passes, "--json").code == 1
    shown = call("diff", passes, fails)
    assert shown.code == 1
    first = [NOT_VERIFIED, "verdict", "  verdict: pass -> fail"]
    assert shown.out.splitlines()[:3] == first
