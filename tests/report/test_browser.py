"""The page in a real browser: complete, without a violated policy, printed on A4."""

import re
import subprocess
from dataclasses import replace

import pytest

from netdesign.report.page.html import render_html
from tests.programs import require_program
from tests.report.build_study import build_study
from tests.report.filled import list_sections

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
MINIMUM_PT = 595.0, 842.0  # A4


@pytest.fixture(scope="module")
def browser():
    return require_program(*NAMES)


def run(browser, folder, *arguments):
    done = subprocess.run(
        [
            browser,
            *("--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"),
            *("--enable-logging=stderr", f"--user-data-dir={folder}/profile"),
            *arguments,
            (folder / "report.html").as_uri(),
        ],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    messages = [line for line in done.stderr.splitlines() if ":CONSOLE" in line]
    assert messages == []  # a violated policy or a missing file would be told here
    return done.stdout


@pytest.mark.parametrize("language", ["en", "de"])
def test_page_opens_without_complaint(browser, tmp_path, language):
    study = build_study()
    page = render_html(study, language)
    (tmp_path / "report.html").write_text(page, encoding="utf-8")
    tree = run(browser, tmp_path, "--dump-dom")
    for name in list_sections(study):
        assert f'id="{name}"' in tree
    assert tree.count("<svg") == page.count("<svg")
    assert "<script" not in tree


@pytest.mark.parametrize("count", [2, 9])
def test_page_prints_on_a4(browser, tmp_path, count):
    study = build_study()
    rows = [replace(study.rows[k % 2], id=f"N{k}") for k in range(count)]
    page = render_html(replace(study, rows=rows))
    (tmp_path / "report.html").write_text(page, encoding="utf-8")
    target = tmp_path / "report.pdf"
    run(browser, tmp_path, f"--print-to-pdf={target}", "--no-pdf-header-footer")
    content = target.read_bytes()
    assert content.startswith(b"%PDF")
    boxes = re.findall(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", content)
    assert len(boxes) >= 3  # decision, schedule, rows
    for box in boxes:
        assert [float(side) for side in box] == pytest.approx(MINIMUM_PT, abs=1.5)
