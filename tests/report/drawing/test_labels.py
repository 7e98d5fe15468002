"""Labels of all drawings in a real browser: none meets another, none leaves the paper.

The rows are drawn at random, untidier than any site: boxes are those that the browser
gives the text in its own font.
"""

import random

import pytest

from netdesign.report.drawing.section_figure import draw_section
from netdesign.report.words import Words
from netdesign.words.catalogue import LANGUAGES
from tests.report.build_study import build_section
from tests.report.drawing.drawn import (
    draw_all,
)
from tests.report.printing import list_meeting

SEED, ROWS = 20261122, 8


@pytest.mark.long
@pytest.mark.parametrize("language", LANGUAGES)
def test_no_label_meets_another_or_leaves_its_drawing(language, tmp_path):
    rng, words = random.Random(SEED), Words(language)
    drawings = [svg for _ in range(ROWS) for svg in draw_all(rng, words)]
    drawings.append(draw_section(build_section(rng), [], {}, words))
    assert all(drawings)
    assert list_meeting(drawings, tmp_path) == []
