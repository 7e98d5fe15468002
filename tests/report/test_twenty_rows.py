"""Twenty net rows: below 2 MB, below 3 s, page and workbook together."""

import time
from dataclasses import replace

import pytest
from build_study import build_study

from netdesign.report.excel import render_workbook
from netdesign.report.html import render_html
from netdesign.report.language import load_words


@pytest.mark.parametrize("language", ["en", "fr"])
def test_twenty_rows_are_quick_and_small(language):
    study = build_study()
    rows = [replace(study.rows[k % 3], id=f"Row {k}") for k in range(20)]
    study = replace(study, rows=rows)
    words = load_words(language)
    render_html(build_study(rows=1), words)  # imports are not what is measured
    start = time.process_time()
    page, book = render_html(study, words), render_workbook(study, words)
    assert time.process_time() - start < 3.0
    assert len(page.encode()) < 2_000_000
    assert len(book) < 1_000_000
