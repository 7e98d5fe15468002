"""The workbook on paper: printed by LibreOffice, read as a printer would."""

import itertools
import re
import statistics
import subprocess
import zlib
from dataclasses import dataclass, replace

import numpy as np
import pytest

from netdesign.report.workbook.excel import SHEETS, render_workbook
from netdesign.report.workbook.pages import (
    Line,
    choose_paper,
    find_height,
    place_breaks,
)
from tests.programs import require_program
from tests.report.build_study import build_study

_STREAM = re.compile(rb"stream\r?\n(.*?)\r?\nendstream", re.DOTALL)
_STEP = re.compile(
    rb"^(?:([\d.]+) ([\d.]+) Td|(?:\S+ ){4}([\d.]+) ([\d.]+) Tm)"
    rb" /F\d+ ([\d.]+) Tf(.*?)T[jJ]$",
    re.MULTILINE,
)
LEAST_LINES = 8  # of text on a page, without its footer
SMALLEST_PT = 7.3


@dataclass(frozen=True)
class Printed:
    """Text of a page: sizes of its letters [pt], heights of its lines [pt]."""

    sizes: list[float]
    lines: set[float]


def print_pages(content, folder):
    """Pages of a workbook as LibreOffice prints them."""
    soffice = require_program("soffice")
    source = folder / "report.xlsx"
    source.write_bytes(content)
    profile = f"-env:UserInstallation=file://{folder}/profile"
    options = ("--headless", "--convert-to", "pdf", "--outdir", str(folder))
    subprocess.run(
        [soffice, profile, *options, str(source)],
        check=True,
        capture_output=True,
        timeout=180,
    )
    return list(list_pages((folder / "report.pdf").read_bytes()))


def list_pages(pdf):
    """Pages of a PDF: each that has a footer."""
    for stream in _STREAM.findall(pdf):
        try:
            steps = _STEP.findall(zlib.decompress(stream))
        except zlib.error:
            continue
        found = [(float(y or v), float(size), text) for _, y, _, v, size, text in steps]
        body = [one for one in found if one[0] > 40.0]
        if len(body) < len(found):
            sizes = [s for _, s, text in body for _ in range(text.count(b"<"))]
            yield Printed(sizes, {round(y) for y, *_ in body})


@pytest.mark.long
def test_every_page_is_legible_and_none_is_nearly_empty(tmp_path):
    study = build_study(rows=2)  # in German, whose words are the longest
    again = [replace(row, id=f"{row.id}{k}") for k in range(3) for row in study.rows]
    content = render_workbook(replace(study, rows=again), "de")
    pages = print_pages(content, tmp_path)
    assert len(SHEETS) <= len(pages) <= 75
    for number, page in enumerate(pages, 1):
        assert statistics.median(page.sizes) >= SMALLEST_PT, number
        assert len(page.lines) >= LEAST_LINES, number


def draw_lines(rng, count):
    """Lines with headings among them, each of which keeps the three below it."""
    heads = {int(k) for k in rng.choice(count, size=count // 30, replace=False)}
    kept = {k for head in heads for k in range(head, head + 3)}
    return [Line(float(rng.uniform(11.0, 40.0)), k in kept) for k in range(count)]


@pytest.mark.parametrize("seed", range(6))
def test_pages_hold_what_fits_and_keep_headings(seed):
    rng = np.random.default_rng(seed)
    lines, height, repeated = draw_lines(rng, 400), 500.0, 26.0
    breaks = place_breaks(lines, height, repeated)
    ends = [0, *breaks, len(lines)]
    for start, end in itertools.pairwise(ends):
        above = repeated if start else 0.0
        assert above + sum(line.height for line in lines[start:end]) <= height
        assert not lines[start - 1].is_kept or start == 0
    assert sum(line.height for line in lines[ends[-2] :]) >= height / 4


def test_a_page_that_would_hold_a_line_or_two_takes_more():
    lines = [Line(10.0)] * 102
    (_, last) = place_breaks(lines, 500.0)
    assert 102 - last >= 16


def test_lines_that_all_stay_together_are_cut_where_the_page_ends():
    (start,) = place_breaks([Line(10.0, is_kept=True)] * 80, 500.0)
    assert start == 50


def test_wide_sheets_take_more_paper_and_stay_legible():
    """Widths in digits of 10 pt, 5.56 pt wide; a page has 798 pt, or 1147 pt on A3."""
    for widths in ([9.0] * 9, [9.0] * 16, [9.0] * 25, [14.0] * 21, [20.0] * 20):
        paper, across = choose_paper(widths)
        room = {9: 798.0, 8: 1147.0}[paper] * across
        wide = 5.56 * sum(width + 0.7 for width in widths)
        wide += 5.56 * (across - 1) * sum(widths[:2])
        assert 9.0 * room / wide >= SMALLEST_PT or across == 2
        assert find_height(widths, paper, across) >= 516.0
