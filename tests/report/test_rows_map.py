"""A report with the map of its rows: links, caption, nothing of the places."""

import random
import re
import zipfile
from io import BytesIO

import pytest

from netdesign.report.document.word import render_document
from netdesign.report.page.html import render_html
from netdesign.words.catalogue import LANGUAGES
from tests.report.build_study import build_study
from tests.report.drawing.test_rows_map import draw_places

EAST, NORTH, HEIGHT = 2_712_345.0, 1_167_890.0, 1987.0


@pytest.fixture(scope="module")
def study():
    return build_study()


def build_places(study, more=()):
    names = [*(row.id for row in study.rows), *more]
    return draw_places(random.Random(8), names, EAST, NORTH, HEIGHT)


@pytest.mark.parametrize("language", LANGUAGES)
def test_names_on_the_map_lead_to_the_pages_of_rows(study, language):
    page = render_html(study, language, "full", build_places(study))
    drawn = page.split('<section id="map"')[1].split("</section>")[0]
    links = re.findall(r'<a href="#(row-\d+)">', drawn)
    assert sorted(links) == sorted(f"row-{k}" for k in range(1, len(study.rows) + 1))
    assert all(f'id="{one}"' in page for one in links)
    assert '<a href="#map">' in page  # in the contents
    assert "slope.asc" in drawn
    assert "ab" * 32 in drawn


def test_a_row_of_the_map_alone_is_named(study):
    page = render_html(study, "en", "full", build_places(study, more=["Z9"]))
    drawn = page.split('<section id="map"')[1].split("</section>")[0]
    assert "Not in this report: Z9." in drawn
    others = render_html(study, "en", "full", build_places(study))
    assert "Not in this report" not in others


def test_no_report_holds_a_coordinate(study):
    places = build_places(study)
    page = render_html(study, "en", "full", places)
    document = zipfile.ZipFile(BytesIO(render_document(study, places=places)))
    parts = [document.read(one).decode("latin-1") for one in document.namelist()
             if not one.endswith(".png")]  # fmt: skip
    for text in (page, *parts):
        for number in ("27123", "2 712", "11678", "1 167", f"{HEIGHT:.0f}"):
            assert number not in text, number
