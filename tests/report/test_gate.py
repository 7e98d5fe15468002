import re
from dataclasses import replace

import pytest

from netdesign.calculation.quantity import Kind
from netdesign.outcome import NetDesignError, Verdict
from netdesign.report.gate import require_consistent
from netdesign.study.records import IndependentRecord
from netdesign.words.catalogue import render
from tests.each import each
from tests.report.build_study import build_study
from tests.words.english import find_words

STUDY = build_study()


def spoil(row_number, check_number, **changes):
    """Study with one check changed and the verdicts above it left alone."""
    rows = list(STUDY.rows)
    checks = list(rows[row_number].checks)
    checks[check_number] = replace(checks[check_number], **changes)
    rows[row_number] = replace(rows[row_number], checks=checks)
    return replace(STUDY, rows=rows)


def test_the_sound_study_passes():
    assert require_consistent(STUDY) is None


def alter(row_number, check_number, symbol, **changes):
    """Study with one step of one check's calculation changed."""
    steps = STUDY.rows[row_number].checks[check_number].steps
    changed = [replace(x, **changes) if x.symbol == symbol else x for x in steps]
    return spoil(row_number, check_number, steps=changed)


NOTHING = {"value": None, "low": None, "high": None}


@each(
    "study, message",
    [
        (spoil(0, 0, utilisation=0.5), "utilisation is 0.5, but .* follows"),
        (spoil(0, 0, utilisation=None), "utilisation is None, but .* follows"),
        (spoil(0, 0, demand_kN=1.0), "demand_kN is 1.0, but .* follows"),
        (spoil(0, 0, demand_kN=None), "demand_kN is None, but .* follows"),
        (spoil(0, 0, resistance_kN=9.0), "resistance_kN is 9.0, but .* follows"),
        (spoil(0, 0, steps=[]), "demand_kN is .*, but None follows"),
        (alter(0, 0, "γ_R", value=1.0), "R_d is .*, but .* follows"),
        (alter(0, 0, "γ_R", **NOTHING), "R_d is .*, but None follows"),
        (alter(0, 0, "R_k", **NOTHING), "R_d is .*, but None follows"),
        (alter(0, 0, "E_d", high=1e4), "E_d is .*, but .* follows"),
        (alter(0, 0, "μ", high=None), "μ is .*, but .* follows"),
        (alter(0, 0, "E_s", value=1.0, low=1.0, high=1.0), "E_c is .* follows"),
        (alter(0, 0, "E_d", low=1e4), "below zero or outside its band"),
        (alter(0, 0, "E_d", low=-1.0), "below zero or outside its band"),
        (alter(0, 0, "R_k", value=-9.0), "below zero or outside its band"),
        (alter(0, 0, "γ_R", value=-1.35), "not above zero"),
        (alter(0, 0, "γ_E", value=-1.5), "not above zero"),
        (alter(0, 0, "γ_E", value=0.0), "not above zero"),
        (alter(0, 0, "γ_R", value=0.0), "not above zero"),
        (alter(0, 0, "μ", formula="E_d / R_k"), "is not the rule of a check"),
        (alter(0, 0, "R_d", formula=""), "is not the rule of a check"),
        (alter(0, 0, "E_c", formula="E_s * 7 ** 2"), "no formula of the quantities"),
        (spoil(2, 3, verdict=Verdict.PASS), "high end of its utilisation is None"),
        (spoil(0, 0, verdict=Verdict.FAIL), "says PASS, but its parts give FAIL"),
        (replace(STUDY, verdict=Verdict.PASS), "says PASS, but its parts"),
        (replace(STUDY, verdict=Verdict.NOT_PROVEN), "its parts give FAIL"),
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


def with_floor_at(share):
    """The first check with a floor at a share of what the section gives."""
    check = build_study().rows[0].checks[0]
    least = share * check.read("E_c")
    _, high = check.read_band("E_c")
    governs = "guideline" if least >= high else "coupled"
    steps = [
        replace(one, value=least, low=None, high=None, formula="", kind=Kind.SOLVED)
        if one.symbol == "E_g"
        else one
        for one in check.steps
    ]
    return spoil(0, 0, steps=steps, governs=governs)


def test_a_demand_below_the_guideline_is_refused():
    check = build_study().rows[0].checks[0]
    low = check.read_band("E_c")[0] / check.read("E_c")
    assert require_consistent(with_floor_at(0.999 * low)) is None
    for share in (1.001 * low, 1.001, 1.7):  # a maximum that leaves the floor out
        with pytest.raises(NetDesignError, match=r"below the guideline's load|E_k is"):
            require_consistent(with_floor_at(share))
    study = with_floor_at(1.7)
    steps = [
        replace(one, formula="E_c") if one.symbol == "E_k" else one
        for one in study.rows[0].checks[0].steps
    ]
    with pytest.raises(NetDesignError, match="below the guideline's load"):
        require_consistent(spoil(0, 0, steps=steps, governs="guideline"))


def test_the_wrong_governing_load_is_refused():
    for load in ("guideline", "panel", ""):
        with pytest.raises(NetDesignError, match="names the wrong load"):
            require_consistent(spoil(0, 0, governs=load))


def test_a_pass_without_its_floor_is_refused_unless_the_profile_takes_none():
    study = build_study()
    row = next(k for k, r in enumerate(study.rows) if r.checks[0].verdict == "pass")
    steps = [
        replace(one, formula="E_c") if one.symbol == "E_k" else one
        for one in study.rows[row].checks[0].steps
        if one.symbol != "E_g"
    ]
    bare = spoil(row, 0, steps=steps)
    with pytest.raises(NetDesignError, match="passes without the guideline's load"):
        require_consistent(bare)
    profile = replace(bare.profile, floor="none")
    assert require_consistent(replace(bare, profile=profile)) is None
