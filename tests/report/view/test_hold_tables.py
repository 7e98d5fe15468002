"""Limits of single values as rows of words."""

from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.report.view.hold_tables import build_holds, list_holds
from netdesign.report.words import Words
from tests.report.build_study import build_study

ENGLISH = Words("en")
ROW = build_study().rows[0]
CHECK = next(one for one in ROW.checks if one.holds)


def limit(verdict, least, most):
    hold = replace(CHECK.holds[0], least=least, most=most)
    check = replace(CHECK, verdict=verdict, holds=[hold])
    line = build_holds(replace(ROW, checks=[check]), ENGLISH).rows[0]
    return line[4].text


@pytest.mark.parametrize(
    ("verdict", "least", "most", "told"),
    [
        (Verdict.PASS, 0.0217, None, "holds while ≥ 0.0217"),
        (Verdict.PASS, 0.0217, 0.093, "holds while ≥ 0.0217 and ≤ 0.093"),
        (Verdict.PASS, None, None, "holds from 0 to 0.131, as far as searched"),
        (Verdict.FAIL, 0.0463, None, "would pass with ≥ 0.0463"),
        (Verdict.FAIL, 0.0463, 0.0021, "would pass with ≥ 0.0463 or ≤ 0.0021"),
        (Verdict.FAIL, None, None, "does not pass from 0 to 0.131, as far as searched"),
        (Verdict.NOT_PROVEN, None, 0.0021, "would pass with ≤ 0.0021"),
    ],
)
def test_limits_read_by_the_verdict(verdict, least, most, told):
    assert limit(verdict, least, most) == told


def test_every_single_value_of_every_check_has_a_line():
    table = build_holds(ROW, ENGLISH)
    assert len(table.rows) == sum(len(check.holds) for check in ROW.checks) > 1
    assert table.rows[0][2].text == "Slack"
    assert table.rows[0][3].number == 0.031


def test_the_governing_check_has_them_in_short():
    assert list_holds(CHECK, ENGLISH)[0].startswith("Slack: ")
    assert list_holds(None, ENGLISH) == ()
