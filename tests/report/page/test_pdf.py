from importlib.util import find_spec

import pytest

from netdesign.outcome import NetDesignError
from netdesign.report import files
from tests.report.build_study import build_study


def test_without_the_library_the_wish_is_refused(monkeypatch):
    monkeypatch.setattr(files, "find_spec", lambda _name: None)
    with pytest.raises(NetDesignError, match=r'pip install "netdesign\[pdf\]"'):
        files.require_pdf()


@pytest.mark.skipif(
    find_spec("weasyprint") is None, reason="WeasyPrint, extra pdf, is not installed"
)
@pytest.mark.filterwarnings("ignore")  # of the library's own
def test_page_becomes_a_pdf():
    content = files.render_kind(".pdf", build_study(rows=1), files.ReportStyle())
    assert content.startswith(b"%PDF")
