"""Pages for those who cannot see them, or not well: axe, contrast, words for pictures.

axe leaves the inside of drawings alone: they are pictures with a text of their own. The
contrast of their words is measured here.
"""

import random
import re
from itertools import product
from xml.etree import ElementTree

import pytest

from netdesign.report.page import render_html
from netdesign.report.words import Words
from netdesign.words.catalogue import LANGUAGES
from tests.report.accessible import list_violations, measure_contrast
from tests.report.build_study import build_study
from tests.report.drawing.drawn import draw_all
from tests.report.printing import PHONE_PX

LEAST_CONTRAST = 4.5  # of text below 18 pt, WCAG 2 level AA
TEXT = "{http://www.w3.org/2000/svg}text"
SNOW = (0xF3, 0xF5, 0xF7)  # ground of some labels


PAGES = list(product(LANGUAGES, [False, True], [PHONE_PX, 1100]))
IN_SUITE = [("fr", True, 1100), ("de", False, PHONE_PX)]


@pytest.mark.parametrize(
    ("rows", "page"),
    [
        *(pytest.param(1, one, marks=pytest.mark.long) for one in IN_SUITE),
        *(pytest.param(3, one, marks=pytest.mark.robustness) for one in PAGES),
    ],
)
def test_axe_finds_no_violation(rows, page, tmp_path):
    """All pages: python -m pytest -m robustness tests/report/test_accessible.py."""
    language, has_annexes, width = page
    shown = render_html(build_study(rows=rows), language, has_annexes=has_annexes)
    assert list_violations(shown, tmp_path, width) == []


def test_words_in_drawings_have_contrast():
    rng = random.Random(5)
    for svg in draw_all(rng, Words("en")):
        for colour in list_colours(svg):
            assert measure_contrast(colour, SNOW) >= LEAST_CONTRAST, colour
    assert measure_contrast("#7d838b") < LEAST_CONTRAST


def list_colours(svg):
    """Colours of the words of a drawing; without one of their own they are ink."""
    found = set()
    for text in ElementTree.fromstring(svg).iter(TEXT):
        look = f"{text.get('fill', '')} {text.get('style', '')}"
        found |= set(re.findall(r"#[0-9a-f]{6}", look))
    return found


def test_words_for_a_picture_have_its_numbers():
    for svg in draw_all(random.Random(7), Words("fr")):
        (told,) = re.findall(r'aria-label="([^"]*)"', svg)
        assert re.search(r"\d", told), told
