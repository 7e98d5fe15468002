"""Limits of single values as rows of words."""

from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.report.view.hold_tables import build_holds, list_limits
from netdesign.report.words import Words, show_check
from netdesign.words.catalogue import LANGUAGES
from tests.report.build_study import build_study

ENGLISH = Words("en")
GAPS = dict.fromkeys(("quantity", "limit", "now", "one", "other"), "")
ROW = build_study().rows[0]
CHECK = next(one for one in ROW.checks if one.holds)


def line(verdict, used, least, most, words=ENGLISH):
    """Cells of a check whose force is a share of its resistance."""
    hold = replace(CHECK.holds[0], least=least, most=most)
    steps = [
        replace(one, low=0.9 * used, high=used) if one.symbol == "μ" else one
        for one in CHECK.steps
    ]
    check = replace(CHECK, verdict=verdict, holds=[hold], steps=steps)
    (cells,) = build_holds(replace(ROW, checks=[check]), words).rows
    return [cell.text for cell in cells]


@pytest.mark.parametrize(
    ("verdict", "used", "least", "most", "told"),
    [
        (Verdict.PASS, 0.93, 0.0217, None, "holds while Slack ≥ 0.0217 (now 0.031)"),
        (Verdict.PASS, 1.0, 0.02, 0.093,
         "holds while Slack ≥ 0.02 and ≤ 0.093 (now 0.031)"),
        (Verdict.FAIL, 1.37, 0.0463, None,
         "would pass with Slack ≥ 0.0463 (now 0.031)"),
        (Verdict.FAIL, 1.2, 0.5, 0.01,
         "would pass with Slack ≥ 0.5 or ≤ 0.01 (now 0.031)"),
        (Verdict.NOT_PROVEN, 1.01, None, 0.01,
         "would pass with Slack ≤ 0.01 (now 0.031)"),
    ],
)  # fmt: skip
def test_limits_read_by_what_is_used(verdict, used, least, most, told):
    cells = line(verdict, used, least, most)
    assert cells[1:] == [told, "-", "5"]


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("verdict", Verdict)
def test_no_limit_that_is_met_would_make_a_check_pass(verdict, language):
    """The record decides by the force alone, whatever else withholds a pass."""
    words = Words(language)
    met = line(verdict, 0.899, 0.0217, 0.093, words)[1]
    missed = line(verdict, 1.101, 0.093, 0.0217, words)[1]
    passes, joined = (words(f"show.{key}", **GAPS) for key in ("turns", "both"))
    assert not met.startswith(passes[:10])
    assert missed.startswith(passes[:10])
    assert joined[1:-1] in met
    holds = words("show.holds", **GAPS)[:10]
    assert met.startswith(holds) is (verdict is Verdict.PASS)


@pytest.mark.parametrize("verdict", Verdict)
def test_without_a_limit_the_search_is_told(verdict):
    assert line(verdict, 0.8, None, None)[1:3] == ["-", "Slack: 0 to 0.131"]


def test_every_check_with_single_values_is_named_in_one_line():
    rows = build_holds(ROW, ENGLISH).rows
    held = [show_check(ENGLISH, check) for check in ROW.checks if check.holds]
    named = "; ".join(cells[0].text for cells in rows)
    assert len(held) > 1
    for name in held:
        assert named.count(f"{name};") + named.endswith(name) >= 1, name
    first = [cell.text for cell in rows[0]]
    assert "Slack" in first[1]
    assert first[2].startswith("Glide factor: 1.010 to 2.400")
    assert "without" in first[2]


def test_the_governing_check_has_its_limits_in_short():
    (told,) = list_limits(CHECK, ENGLISH)
    assert "Slack ≥ 0.0217" in told
    assert list_limits(None, ENGLISH) == ()
