"""``--docx`` of the commands that write reports."""

import pytest

docx = pytest.importorskip("docx")

from netdesign.report.document import styles  # noqa: E402
from netdesign.study.document import write_document  # noqa: E402
from tests.report.build_study import build_study  # noqa: E402


def test_a_lack_of_the_extra_is_told(call, tmp_path, monkeypatch):
    path = tmp_path / "study.json"
    path.write_text(write_document(build_study()), encoding="utf-8")
    monkeypatch.setattr(styles, "find_spec", lambda _name: None)
    ended = call("report", path, "--docx", "--language", "fr")
    assert ended.code == 2
    assert 'pip install "netdesign[docx]"' in ended.err
