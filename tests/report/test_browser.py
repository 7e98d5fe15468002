"""The page in a real browser: complete, without a violated policy, printed on A4."""

import re
import subprocess
from dataclasses import replace

import pytest

from netdesign.report.page.html import render_html
from tests.programs import require_program
from tests.report.build_study import build_study

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")


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


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The page of nine rows as a file, with the profile of the one browser."""
    place = tmp_path_factory.mktemp("browser")
    study = build_study()
    rows = [replace(study.rows[k % 2], id=f"N{k}") for k in range(9)]
    page = render_html(replace(study, rows=rows), "de")
    (place / "report.html").write_text(page, encoding="utf-8")
    return place


def test_page_opens_without_complaint(browser, folder):
    page = (folder / "report.html").read_text(encoding="utf-8")
    tree = run(browser, folder, "--dump-dom")
    for name in re.findall(r'<section id="([^"]*)"', page):
        assert f'id="{name}"' in tree
    assert tree.count("<svg") == page.count("<svg") > 0
    assert "<script" not in tree
