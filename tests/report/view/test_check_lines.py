"""Checks on lines: nothing is lost, and what does not pass is always there."""

import random
from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.report.view.check_lines import (
    choose_lines,
    list_lines,
    list_requirements,
)
from netdesign.report.view.check_view import view_check
from netdesign.report.words import Words
from netdesign.words.catalogue import LANGUAGES
from netdesign.words.message import say
from tests.report.build_study import build_study

ENGLISH = Words("en")
STUDY = build_study()
SEED = 1122


def list_places(lines):
    return [one for line in lines for one in (line.inside, line.end) if one]


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("row", STUDY.rows, ids=lambda row: f"row {row.verdict}")
def test_every_check_stands_once(row, language):
    words = Words(language)
    shown = list_places(list_lines(row.checks, words))
    shown += list_requirements(row.checks, words)
    assert sorted(one.title for one in shown) == sorted(
        view_check(one, words).title for one in row.checks
    )


def pair(inside=Verdict.PASS, end=Verdict.PASS, **changes):
    """One check inside the row, and the same at its end with other values."""
    given = next(one for one in STUDY.rows[0].checks if one.is_of_force)
    first = replace(given, position="intermediate", verdict=inside)
    return [first, replace(given, position="edge", verdict=end, **changes)]


def test_inside_and_end_of_one_resistance_share_a_line():
    (line,) = list_lines(pair(), ENGLISH)
    assert line.inside
    assert line.end
    assert "end of the row" not in line.title


@pytest.mark.parametrize(
    "changes",
    [
        {"resistance_kN": 61.7},
        {"resistance_type": "another"},
        {"resistance_cell": "Anchors!B17"},
        {"resistance_basis": "computed"},
    ],
)
def test_another_resistance_has_its_own_line(changes):
    inside, end = list_lines(pair(**changes), ENGLISH)
    assert inside.end is None
    assert end.inside is None


def test_three_of_one_resistance_never_share_a_line():
    first, last = pair()
    assert len(list_lines([first, first, last], ENGLISH)) == 3


@pytest.mark.parametrize("worst", [v for v in Verdict if v is not Verdict.PASS])
@pytest.mark.parametrize("is_end", [True, False])
def test_the_worse_of_both_places_is_the_line_s(worst, is_end):
    why = say("check.not_proven", gaps=())
    verdicts = {"end" if is_end else "inside": worst}
    first, last = pair(**verdicts)
    first, last = replace(first, reason=say("check.passes")), replace(last, reason=why)
    if not is_end:
        first, last = (
            replace(first, reason=why),
            replace(last, reason=say("check.passes")),
        )
    (line,) = list_lines([first, last], ENGLISH)
    assert line.verdict.word == ENGLISH(f"verdict.{worst}")
    assert not line.is_met
    place = ENGLISH("heading.at_end" if is_end else "heading.inside")
    assert [one.startswith(place) for one in line.remarks] == [True]


def test_a_summary_has_all_that_do_not_pass_and_the_most_used():
    draw = random.Random(SEED)
    given = next(one for one in STUDY.rows[0].checks if one.is_of_force)
    for _ in range(50):
        checks = [
            replace(
                given,
                resistance_type=f"T{k}",
                verdict=draw.choice(list(Verdict)),
                demand_kN=draw.uniform(1.0, 90.0),
                utilisation=draw.choice([None, draw.uniform(0.0, 2.7)]),
            )
            for k in range(draw.randint(1, 9))
        ]
        lines = list_lines(checks, ENGLISH)
        chosen = choose_lines(lines)
        assert [line for line in lines if not line.is_met] == [
            line for line in chosen if not line.is_met
        ]
        most = max(lines, key=lambda line: line.most_used)
        assert most in chosen
        left = [line.most_used for line in lines if line not in chosen]
        assert max(left, default=0.0) <= min(
            sorted((line.most_used for line in lines), reverse=True)[:3]
        )
