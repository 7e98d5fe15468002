"""``--docx`` and ``--template`` of the commands that write reports."""

import pytest

docx = pytest.importorskip("docx")

from netdesign.report.document import template  # noqa: E402
from netdesign.study.document import write_document  # noqa: E402
from tests.report.build_study import build_study  # noqa: E402

ONLY = ("--no-html", "--no-excel")


@pytest.fixture
def study_file(tmp_path, monkeypatch):
    """Stored study of no site; what it says is not compared with one."""
    path = tmp_path / "study.json"
    path.write_text(write_document(build_study()), encoding="utf-8")
    return path


def test_a_template_is_a_wish_for_a_document(call, study_file, tmp_path):
    own = docx.Document()
    own.sections[0].footer.paragraphs[0].text = "ours"
    own.save(tmp_path / "own.docx")
    ended = call("report", study_file, "--template", "own.docx", *ONLY)
    assert ended.code == 1
    written = docx.Document(tmp_path / "netdesign-out" / "report.docx")
    assert written.sections[0].footer.paragraphs[0].text == "ours"
    assert {p.text for p in written.paragraphs} >= {"Basis"}


@pytest.mark.parametrize("name", ["report", "check"])
def test_what_is_no_template_is_refused_before_anything_is_done(
    call, study_file, tmp_path, name
):
    (tmp_path / "page.docx").write_text("<html>")
    of = {"report": study_file, "check": "--example"}[name]
    ended = call(name, of, "--template", "page.docx")
    assert ended.code == 2
    assert "page.docx is no template" in ended.err
    assert not (tmp_path / "netdesign-out").exists()


def test_a_lack_of_the_extra_is_told(call, study_file, monkeypatch):
    monkeypatch.setattr(template, "find_spec", lambda _name: None)
    ended = call("report", study_file, "--docx", "--language", "fr")
    assert ended.code == 2
    assert 'pip install "netdesign[docx]"' in ended.err
