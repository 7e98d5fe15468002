"""Limits of single values as rows of words."""

from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.report.view.hold_tables import build_holds, list_limits
from netdesign.report.words import Words
from tests.report.build_study import build_study

ENGLISH = Words("en")
ROW = build_study().rows[0]
CHECK = next(one for one in ROW.checks if one.holds)


def line(verdict, least, most):
    hold = replace(CHECK.holds[0], least=least, most=most)
    check = replace(CHECK, verdict=verdict, holds=[hold])
    (cells,) = build_holds(replace(ROW, checks=[check]), ENGLISH).rows
    return [cell.text for cell in cells]


@pytest.mark.parametrize(
    ("verdict", "least", "most", "told"),
    [
        (Verdict.PASS, 0.0217, None, "holds while Slack ≥ 0.0217 (now 0.031)"),
        (Verdict.PASS, 0.02, 0.093, "holds while Slack ≥ 0.02 and ≤ 0.093 (now 0.031)"),
        (Verdict.FAIL, 0.0463, None, "would pass with Slack ≥ 0.0463 (now 0.031)"),
        (Verdict.FAIL, 0.5, 0.1, "would pass with Slack ≥ 0.5 or ≤ 0.1 (now 0.031)"),
        (Verdict.NOT_PROVEN, None, 0.01, "would pass with Slack ≤ 0.01 (now 0.031)"),
    ],
)
def test_limits_read_by_the_verdict(verdict, least, most, told):
    cells = line(verdict, least, most)
    assert cells[1:] == [told, "-", "5"]


@pytest.mark.parametrize("verdict", Verdict)
def test_without_a_limit_the_search_is_told(verdict):
    assert line(verdict, None, None)[1:3] == ["-", "Slack: 0 to 0.131"]


def test_every_check_with_single_values_has_one_line():
    rows = build_holds(ROW, ENGLISH).rows
    assert len(rows) == sum(bool(check.holds) for check in ROW.checks) > 1
    first = [cell.text for cell in rows[0]]
    assert "Slack" in first[1]
    assert first[2].startswith("Glide factor: 1.01 to 2.4")
    assert "without" in first[2]


def test_the_governing_check_has_its_limits_in_short():
    (told,) = list_limits(CHECK, ENGLISH)
    assert "Slack ≥ 0.0217" in told
    assert list_limits(None, ENGLISH) == ()
