"""Table of the end effect over gap and glide factor."""

from dataclasses import replace

import pytest

from netdesign.report.view.end_tables import build_end_effects
from netdesign.report.words import Words
from netdesign.study.support_records import EndEffectRecord
from netdesign.words.numerals import set_marks
from tests.report.build_study import build_study

EFFECT = EndEffectRecord(
    gap_m=None,
    glide_factor=2.37,
    is_own=True,
    end_length_m=1.43,
    profile_factor=3.91,
    profile_width_m=5.59,
    free_factor=1.47,
    free_width_m=2.11,
    pulled_factor=3.26,
    pulled_width_m=4.08,
)


@pytest.mark.parametrize(
    ("language", "no_gap", "own"),
    [("en", "none", "this row"), ("de", "keines", "diese Reihe")],
)
def test_each_effect_is_a_line_with_all_its_numbers(language, no_gap, own):
    row = replace(
        build_study().rows[0],
        end_effects=[EFFECT, replace(EFFECT, gap_m=1.25, is_own=False)],
    )
    table = build_end_effects(row, Words(language))
    first, second = ([cell.text for cell in line] for line in table.rows)
    numbers = ["2.37", "1.43", "3.91", "5.59", "1.47", "2.11", "3.26", "4.08"]
    shown = [set_marks(one, language) for one in ("1.25", *numbers)]
    assert first == [no_gap, *shown[1:], own]
    assert second[:-1] == shown
    assert len(table.columns) == len(first)


def test_row_without_an_end_has_no_line():
    row = replace(build_study().rows[0], end_effects=[])
    assert build_end_effects(row, Words("fr")).rows == ()
