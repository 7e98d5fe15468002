import json
from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.site.model import Project
from netdesign.study.document import write_document
from netdesign.study.records import SCHEMA, ProfileRecord, Provenance, Study

STUDY = Study(
    schema=SCHEMA,
    verdict=Verdict.NOT_PROVEN,
    project=Project(name="Combe", revision="A"),
    profile=ProfileRecord(id="p", title="", edition="1", sha256="", values=[]),
    rows=[],
    range_inputs=[],
    notes=[],
    provenance=Provenance(
        version="1",
        command="",
        started="",
        site_file="site.xlsx",
        site_sha256="",
        settings={},
        libraries={},
    ),
)


@pytest.fixture
def files(tmp_path):
    revised = replace(STUDY, project=replace(STUDY.project, revision="B"))
    for name, study in (("old", STUDY), ("new", revised)):
        path = tmp_path / f"{name}.json"
        path.write_text(write_document(study), encoding="utf-8")
    return tmp_path


def test_changes_are_shown_by_area(call, files):
    ended = call("diff", files / "old.json", files / "new.json")
    assert ended.code == 0
    assert ended.out.splitlines() == ["project", "  revision: A -> B"]


def test_json_is_one_document(call, files):
    ended = call("diff", files / "old.json", files / "new.json", "--json")
    (change,) = json.loads(ended.out)["changes"]
    assert (change["old"], change["new"]) == ("A", "B")


def test_equal_studies_say_so(call, files):
    ended = call("diff", files / "old.json", files / "old.json")
    assert ended.out == "the two studies are the same but for time and command\n"


@pytest.mark.parametrize("content", ["{}", None])
def test_what_is_no_study_ends_with_3(call, files, content):
    path = files / "broken.json"
    if content is not None:
        path.write_text(content)
    assert call("diff", files / "old.json", path).code == 3


def test_a_turned_verdict_ends_with_1_in_text_and_document(call, files):
    turned = replace(STUDY, verdict=Verdict.FAIL)
    path = files / "turned.json"
    path.write_text(write_document(turned), encoding="utf-8")
    for options in ((), ("--json",)):
        assert call("diff", files / "old.json", path, *options).code == 1
        assert call("diff", path, files / "old.json", *options).code == 1
    shown = call("diff", files / "old.json", path).out.splitlines()
    assert shown == ["verdict", "  verdict: not proven -> fail"]
