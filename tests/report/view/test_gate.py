import re
from dataclasses import replace

import pytest

from netdesign.errors import NetDesignError
from netdesign.outcome import Verdict
from netdesign.report.view.gate import require_consistent, require_sections
from netdesign.study.records import IndependentRecord
from netdesign.words.catalogue import render
from tests.report.build_study import build_study
from tests.words.english import find_words


def spoil(row_number, check_number, **changes):
    """Study with one check changed and the verdicts above it left alone."""
    study = build_study()
    rows = list(study.rows)
    checks = list(rows[row_number].checks)
    checks[check_number] = replace(checks[check_number], **changes)
    rows[row_number] = replace(rows[row_number], checks=checks)
    return replace(study, rows=rows)


def test_the_sound_study_passes():
    assert require_consistent(build_study()) is None


@pytest.mark.parametrize(
    ("study", "message"),
    [
        (spoil(0, 0, utilisation=0.5), "utilisation is 0.5, but .* follows"),
        (spoil(0, 0, demand_kN=1.0), "demand_kN is 1.0, but .* follows"),
        (spoil(0, 0, resistance_factor=1.0), "resistance_kN is .* follows"),
        (spoil(0, 0, demand_high_kN=1e4), "high end of its utilisation is"),
        (spoil(0, 0, demand_high_kN=None), "high end of its utilisation is None"),
        (spoil(2, 3, verdict=Verdict.PASS), "high end of its utilisation is None"),
        (
            spoil(0, 6, resistance_characteristic_kN=None, resistance_kN=None),
            "utilisation is 0.0, but None follows",
        ),
        (
            spoil(
                *(0, 6),
                resistance_characteristic_kN=None,
                resistance_kN=None,
                utilisation=None,
            ),
            "high end of its utilisation is None",
        ),
        (spoil(0, 0, demand_kN=None, demand_high_kN=None), "but None follows"),
        (spoil(0, 0, demand_low_kN=1e4), "below zero or outside its band"),
        (spoil(0, 0, demand_low_kN=-1.0), "below zero or outside its band"),
        (spoil(0, 0, resistance_factor=None, resistance_kN=None), "but None follows"),
        (
            spoil(0, 0, resistance_characteristic_kN=None, resistance_kN=-9.0),
            "not above zero",
        ),
        (spoil(0, 0, resistance_factor=-1.35, resistance_kN=-1.0), "not above zero"),
        (spoil(0, 0, action_factor=-1.5), "not above zero"),
        (spoil(0, 0, action_factor=0.0), "not above zero"),
        (spoil(0, 0, resistance_factor=0.0), "not above zero"),
        (spoil(0, 0, resistance_factor=None), "a design resistance without its parts"),
        (
            spoil(0, 0, resistance_characteristic_kN=None),
            "a design resistance without its parts",
        ),
        (spoil(0, 0, verdict=Verdict.FAIL), "says PASS, but its parts give FAIL"),
        (replace(build_study(), verdict=Verdict.PASS), "says PASS, but its parts"),
        (replace(build_study(), verdict=Verdict.NOT_PROVEN), "its parts give FAIL"),
    ],
)
def test_a_contradiction_is_refused(study, message):
    with pytest.raises(NetDesignError, match=message) as caught:
        require_consistent(study)
    for language in ("fr", "de"):
        told = render(caught.value.message, language)
        assert find_words(re.sub("'[^']*'", "", told), ["en"]) == set()


def test_a_law_that_is_not_met_holds_a_pass_back():
    study = build_study(rows=1)
    law = IndependentRecord(name="end_direction", value=0.3, limit=0.02, is_met=False)
    row = replace(study.rows[0], independent=[law])
    with pytest.raises(NetDesignError, match="but its parts give NOT PROVEN"):
        require_consistent(replace(study, rows=[row]))


def test_a_pass_may_be_held_back():
    study = build_study(rows=1)
    row = replace(study.rows[0], verdict=Verdict.NOT_PROVEN, reasons=["A reason."])
    held_back = replace(study, rows=[row], verdict=Verdict.NOT_PROVEN)
    assert require_consistent(held_back) is None


def test_a_section_needs_more_than_its_heading():
    page = '<section id="a"><h2>Head</h2><p>none</p></section><section id="b">'
    require_sections(page + "<h2>Head</h2></section>", ["a"])
    with pytest.raises(NetDesignError, match="nothing in section b, c"):
        require_sections(page + "<h2>Head</h2></section>", ["a", "b", "c"])
