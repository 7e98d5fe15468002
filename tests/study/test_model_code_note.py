"""Mean density by the JCSS model code, as a note that decides nothing."""

import math

import pytest

from netdesign.envelope.ranges import Interval
from netdesign.study.notes import describe_model_code
from netdesign.words.catalogue import LANGUAGES, render
from tests.small_site import build_row

# 3 m of snow, measured vertically: 361.9 kg/m3
ROW = build_row("R7", snow_thickness=3.0 * math.cos(math.radians(38.0)))


def note(low, high):
    return describe_model_code(ROW, Interval(low=low, high=high))


def test_note_has_the_vertical_height_and_the_range():
    told = note(241.0, 417.0)
    assert told.key == "row.model_code"
    assert told.arguments["height"] == pytest.approx(3.0)
    assert told.arguments["density"] == pytest.approx(361.9, abs=0.05)
    assert (told.arguments["low"], told.arguments["high"]) == (241.0, 417.0)


@pytest.mark.parametrize(
    ("low", "high", "is_above"),
    [(241.0, 361.0, True), (241.0, 362.0, False), (380.0, 420.0, False)],
)
def test_note_says_where_the_range_ends_below(low, high, is_above):
    assert (note(low, high).key == "row.model_code_above") is is_above


@pytest.mark.parametrize("language", LANGUAGES)
def test_note_shows_both_in_each_language(language):
    told = render(note(241.0, 353.0), language)
    for shown in ("362", "241", "353", "JCSS"):
        assert shown in told
