"""The workbook on paper: printed by LibreOffice, read as a printer would."""

import re
import statistics
import zlib
from dataclasses import dataclass, replace

import pytest

from netdesign.report.workbook.excel import SHEETS, render_workbook
from netdesign.report.workbook.writer import choose_paper
from tests.programs import convert
from tests.report.build_study import build_study

_STREAM = re.compile(rb"stream\r?\n(.*?)\r?\nendstream", re.DOTALL)
_STEP = re.compile(
    rb"^(?:([\d.]+) ([\d.]+) Td|(?:\S+ ){4}([\d.]+) ([\d.]+) Tm)"
    rb" /F\d+ ([\d.]+) Tf(.*?)T[jJ]$",
    re.MULTILINE,
)
SMALLEST_PT = 7.3


@dataclass(frozen=True)
class Printed:
    """Text of a page: sizes of its letters [pt]."""

    sizes: list[float]


def print_pages(content, folder):
    """Pages of a workbook as LibreOffice prints them."""
    source = folder / "report.xlsx"
    source.write_bytes(content)
    convert("pdf", folder, source)
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
            yield Printed(sizes)


@pytest.mark.long
def test_every_page_is_legible(tmp_path):
    study = build_study(rows=2)  # in German, whose words are the longest
    again = [replace(row, id=f"{row.id}{k}") for k in range(3) for row in study.rows]
    content = render_workbook(replace(study, rows=again), "de")
    pages = print_pages(content, tmp_path)
    assert len(SHEETS) <= len(pages) <= 75
    for number, page in enumerate(pages, 1):
        assert statistics.median(page.sizes) >= SMALLEST_PT, number


def test_wide_sheets_take_more_paper_and_stay_legible():
    """Widths in digits of 10 pt, 5.56 pt wide; a page has 798 pt, or 1147 pt on A3."""
    for widths in ([9.0] * 9, [9.0] * 16, [9.0] * 25, [14.0] * 21, [20.0] * 20):
        paper, across = choose_paper(widths)
        room = {9: 798.0, 8: 1147.0}[paper] * across
        wide = 5.56 * sum(width + 0.7 for width in widths)
        wide += 5.56 * (across - 1) * sum(widths[:2])
        assert 9.0 * room / wide >= SMALLEST_PT or across == 2
