"""The page in a real browser: complete, without a violated policy."""

import re
from dataclasses import replace

from netdesign.report.page import render_html
from tests.report.build_study import build_study
from tests.report.printing import run_browser


def test_page_opens_without_complaint(tmp_path):
    """A violated policy or a missing file would be told on the console."""
    study = build_study()
    rows = [replace(study.rows[k % 2], id=f"N{k}") for k in range(9)]
    page = render_html(replace(study, rows=rows), "de")
    path = tmp_path / "report.html"
    path.write_text(page, encoding="utf-8")
    ended = run_browser(path, "--enable-logging=stderr", "--dump-dom")
    assert [line for line in ended.stderr.splitlines() if ":CONSOLE" in line] == []
    tree = ended.stdout
    for name in re.findall(r'<section id="([^"]*)"', page):
        assert f'id="{name}"' in tree
    assert tree.count("<svg") == page.count("<svg") > 0
    assert "<script" not in tree
