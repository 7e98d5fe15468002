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
        (spoil(0, 6, demand_high_kN=1.0), "the member is not slack"),
        (spoil(0, 0, demand_kN=None, demand_high_kN=None), "its utilisation is None"),
        (spoil(0, 0, demand_low_kN=1e4), "below zero or outside its band"),
        (spoil(0, 0, demand_low_kN=-1.0), "below zero or outside its band"),
        (spoil(0, 0, resistance_factor=None, resistance_kN=None), "is None"),
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


def with_action(**changes):
    action = build_study().rows[0].checks[0].action
    return spoil(0, 0, action=replace(action, **changes))


def with_floor_at(share):
    """The first check with a floor at a share of its action, said as it follows."""
    check = build_study().rows[0].checks[0]
    least = share * check.action_kN
    governs = "guideline" if least >= check.action.coupled_kN else "coupled"
    return with_action(guideline_kN=least, governs=governs)


def test_a_demand_below_the_guideline_is_refused():
    check = build_study().rows[0].checks[0]
    low = check.demand_low_kN / check.demand_kN
    assert require_consistent(with_floor_at(0.999 * low)) is None
    for share in (1.001 * low, 1.001, 1.7):
        with pytest.raises(NetDesignError, match="below the guideline's load"):
            require_consistent(with_floor_at(share))


def test_the_wrong_governing_load_is_refused():
    with pytest.raises(NetDesignError, match="names the wrong load"):
        require_consistent(with_action(governs="guideline"))


def test_a_pass_without_its_floor_is_refused_unless_the_profile_takes_none():
    study = build_study()
    row = next(k for k, r in enumerate(study.rows) if r.checks[0].verdict == "pass")
    action = replace(study.rows[row].checks[0].action, guideline_kN=None)
    bare = spoil(row, 0, action=action)
    with pytest.raises(NetDesignError, match="passes without the guideline's load"):
        require_consistent(bare)
    profile = replace(bare.profile, floor="none")
    assert require_consistent(replace(bare, profile=profile)) is None
