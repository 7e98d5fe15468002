"""Tables of a searched envelope as rows of words."""

from dataclasses import replace

import pytest

from netdesign.report.view.envelope_tables import build_drivers
from netdesign.report.words import Words, show_check
from netdesign.study.envelope_records import (
    BoundRecord,
    DriverRecord,
    EnvelopeRecord,
    FlipRecord,
)
from netdesign.words.catalogue import LANGUAGES
from netdesign.words.numerals import set_marks
from tests.report.build_study import build_study

ROW = build_study().rows[0]
DRIVER = DriverRecord(
    key="density_kg_m3",
    at_low_kN=31.7,
    at_high_kN=44.3,
    least_kN=31.7,
    most_kN=44.3,
    first_order=0.71,
    total=0.83,
)


def build_envelope(flips):
    bound = BoundRecord(
        quantity="foot_anchor",
        max_kN=44.3,
        upper_bound_kN=44.9,
        case={"density_kg_m3": 391.3},
        coincident_kN={},
        unexplained=0.01,
        drivers=[DRIVER],
        flips=flips,
        lines=[],
        maps=[],
        confirmation=None,
    )
    return EnvelopeRecord(
        axes=[],
        is_per_metre=False,
        is_closed=True,
        gap_asked_percent=0.5,
        certainty=3.0,
        resolved_share=0.1,
        cases=41,
        skipped=0,
        skips_tested=0,
        failed=0,
        bounds=[bound],
        log=[],
    )


@pytest.mark.parametrize("language", LANGUAGES)
def test_where_checks_flip_they_have_their_names(language):
    """Every check of a row, also of its end."""
    checks = [
        replace(one, id=f"{one.id}{end}", position=position)
        for one in ROW.checks
        for end, position in (("", "intermediate"), (".end", "edge"))
    ]
    flips = [
        FlipRecord(check=one.id, key=key, value=392.41)
        for one in checks
        for key in ("density_kg_m3", "friction_deg")
    ]
    row = replace(ROW, checks=checks, envelope=build_envelope(flips))
    words = Words(language)
    (cells,) = build_drivers(row, words).rows
    number = set_marks("392.4", language)
    told = [f"{number} ({show_check(words, one)})" for one in checks]
    assert cells[-1].text == words.join(told)
    assert "_" not in cells[-1].text
