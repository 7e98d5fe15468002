"""Checks on lines: nothing is lost, and what does not pass says why."""

from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.report.sections.checks import (
    describe_briefly,
    describe_cause,
    describe_resistance,
    list_lines,
)
from netdesign.report.words import Words, show_check
from netdesign.study.governing import find_governing, find_highest
from netdesign.words.catalogue import LANGUAGES
from netdesign.words.message import say
from tests.digits import write_force
from tests.each import each
from tests.report.build_study import build_row, build_study
from tests.turn import turn

ENGLISH = Words("en")
STUDY = build_study()


def test_governing_check_is_the_worst_verdict_then_the_largest_ratio():
    row = build_row("A", 2, scale=0.62, missing_resistance=True)
    assert find_governing(row.checks).id == "downhill_anchor.pull_out"
    assert find_highest(row.checks).id == "foot_anchor.pull_out"
    failing = build_row("B", 2, scale=0.72)
    assert find_governing(failing.checks).id == "foot_anchor.pull_out"


@each("language", LANGUAGES)
@each("row", STUDY.rows)
def test_every_check_of_a_force_stands_once(row, language):
    words = Words(language)
    shown = [one for line in list_lines(row.checks) for one in line.checks]
    wanted = [one for one in row.checks if one.is_of_force]
    assert sorted(show_check(words, one) for one in shown) == sorted(
        show_check(words, one) for one in wanted
    )


def pair(inside=Verdict.PASS, end=Verdict.PASS, reason=None, **changes):
    """One check inside the row, and the same at its end with other values."""
    given = next(one for one in STUDY.rows[0].checks if one.is_of_force)
    first, last = (
        turn(given, one, reason=None if one is Verdict.PASS else reason)
        for one in (inside, end)
    )
    first = replace(first, position="intermediate")
    return [first, replace(last, position="edge", **changes)]


def test_inside_and_end_of_one_resistance_share_a_line():
    (line,) = list_lines(pair())
    assert line.inside
    assert line.end
    assert "end of the row" not in line.name(ENGLISH)


@pytest.mark.parametrize(
    "changes",
    [
        {"resistance_type": "another"},
        {"resistance_cell": "Anchors!B17"},
        {"resistance_basis": "computed"},
    ],
)
def test_another_resistance_has_its_own_line(changes):
    inside, end = list_lines(pair(**changes))
    assert inside.end is None
    assert end.inside is None


def test_three_of_one_resistance_never_share_a_line():
    first, last = pair()
    assert len(list(list_lines([first, first, last]))) == 3


@each("worst", [v for v in Verdict if v is not Verdict.PASS])
@each("is_end", [True, False])
def test_the_worse_of_both_places_is_the_line_s(worst, is_end):
    why = say("bores.flat", dip=-7.83, least=10.0)
    verdicts = {"end" if is_end else "inside": worst}
    (line,) = list_lines(pair(**verdicts, reason=why))
    assert line.verdict is worst
    place = ENGLISH("heading.at_end" if is_end else "heading.inside")
    assert [one.startswith(place) for one in line.list_remarks(ENGLISH)] == [True]


@each("language", LANGUAGES)
@each("row", STUDY.rows)
def test_a_row_that_does_not_pass_says_why_in_few_words(row, language):
    told = describe_briefly(row, Words(language))
    assert bool(told) is (row.verdict is not Verdict.PASS)
    assert len(told.split()) <= 14


def test_a_cause_is_the_gap_alone_or_both_design_values():
    check = STUDY.rows[0].checks[0]
    type_ = say("check.type", type="A25")
    what = say("check.of_cell", what=type_, cell="Anchors!C6")
    gap = say("check.no_resistance", what=what)
    lacking = turn(check, Verdict.NOT_PROVEN, reason=gap)
    assert lacking.reason.key == "load.reason"
    assert describe_cause(lacking, ENGLISH) == ENGLISH.show(gap)
    row = replace(STUDY.rows[2], checks=[lacking])
    assert "Anchors!C6" not in describe_briefly(row, ENGLISH)
    failing = turn(check, Verdict.FAIL)
    known = (failing.demand_kN, failing.resistance_kN)
    shown = [f"{write_force(one)} kN" for one in known]
    assert all(one in describe_cause(failing, ENGLISH) for one in shown)


def test_a_resistance_names_type_basis_and_cell():
    check = next(one for one in STUDY.rows[0].checks if one.resistance_cell)
    told = describe_resistance(check, ENGLISH)
    assert check.resistance_cell in told
    assert check.resistance_type in told


@each("language", LANGUAGES)
def test_a_failure_says_only_what_its_numbers_do_not(language):
    words, gap = Words(language), say("bores.flat", dip=-7.83, least=10.0)
    for reason, told in ((None, []), (gap, [words.show(gap)])):
        (line,) = list_lines(pair(Verdict.FAIL, Verdict.FAIL, reason))
        assert line.list_remarks(words) == told
