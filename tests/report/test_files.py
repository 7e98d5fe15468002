"""Contents of a study's files, together and each on its own."""

import pickle
from importlib.util import find_spec
from pathlib import Path

import pytest

from netdesign.outcome import NetDesignError
from netdesign.report import files
from netdesign.report.blocks import write_csv
from netdesign.report.document import styles
from netdesign.report.files import ReportStyle, render_files, render_kind
from netdesign.study.document import write_document
from tests.report.build_study import build_study

KINDS = (".html", ".xlsx", ".csv", ".json")
STUDY = build_study(rows=1)


def test_another_process_can_make_each_file():
    """From what was pickled comes what one process makes of all files together."""
    style = ReportStyle(language="fr")
    paths = [Path(f"one{kind}") for kind in KINDS]
    together = render_files(dict.fromkeys(paths, STUDY), style)
    assert set(together) == set(paths)
    render, study, other = pickle.loads(pickle.dumps((render_kind, STUDY, style)))
    alone = {path: render(path.suffix, study, other) for path in paths}
    assert alone == together


def test_csv_keeps_every_digit_and_leaves_gaps_empty():
    content = write_csv(["a", "b"], [[0.1 + 0.2, None]])
    assert content == b"a,b\n0.30000000000000004,\n"


def test_a_lack_of_an_extra_is_told(call, tmp_path, monkeypatch):
    monkeypatch.setattr(files, "find_spec", lambda _name: None)
    with pytest.raises(NetDesignError, match=r'pip install "netdesign\[pdf\]"'):
        files.require_pdf()
    path = tmp_path / "study.json"
    path.write_text(write_document(STUDY), encoding="utf-8")
    monkeypatch.setattr(styles, "find_spec", lambda _name: None)
    ended = call("report", path, "--docx", "--language", "fr")
    assert ended.code == 2
    assert 'pip install "netdesign[docx]"' in ended.err


@pytest.mark.skipif(
    find_spec("weasyprint") is None, reason="WeasyPrint, extra pdf, is not installed"
)
@pytest.mark.filterwarnings("ignore")  # of the library's own
def test_page_becomes_a_pdf():
    assert render_kind(".pdf", STUDY, ReportStyle()).startswith(b"%PDF")
