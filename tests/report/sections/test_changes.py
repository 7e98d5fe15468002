"""What would make a check pass, and how far single values may go, in words."""

from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.report.sections.checks import (
    describe_change,
    list_changes,
    list_limits,
    show_changes,
)
from netdesign.report.words import Words, show_check
from netdesign.study.records import ChangeRecord
from netdesign.study.remedies import CLOSE
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.report.build_study import build_study

ENGLISH = Words("en")
GAPS = dict.fromkeys(("limits", "one", "other"), "")
ROW = build_study().rows[0]
CHECK = next(one for one in ROW.checks if one.holds)


def limit(verdict, used, least, most, words=ENGLISH):
    """Limit of a check whose force is a share of its resistance."""
    hold = replace(CHECK.holds[0], least=least, most=most)
    steps = [
        replace(one, low=0.9 * used, high=used) if one.symbol == "μ" else one
        for one in CHECK.steps
    ]
    check = replace(CHECK, verdict=verdict, holds=[hold], steps=steps)
    (told,) = list_limits(check, words)
    return told


@pytest.mark.parametrize(
    ("verdict", "used", "least", "most", "told"),
    [
        (Verdict.PASS, 0.93, 0.0217, None, "passes while Slack ≥ 0.0217 (now 0.031)"),
        (Verdict.PASS, 1.0, 0.02, 0.093,
         "passes while Slack ≥ 0.02 and ≤ 0.093 (now 0.031)"),
        (Verdict.FAIL, 1.37, 0.0463, None,
         "would pass with Slack ≥ 0.0463 (now 0.031)"),
        (Verdict.FAIL, 1.2, 0.5, 0.01,
         "would pass with Slack ≥ 0.5 or ≤ 0.01 (now 0.031)"),
        (Verdict.NOT_PROVEN, 1.01, None, 0.01,
         "would pass with Slack ≤ 0.01 (now 0.031)"),
    ],
)  # fmt: skip
def test_limits_read_by_what_is_used(verdict, used, least, most, told):
    assert limit(verdict, used, least, most) == told


@each("language", LANGUAGES)
@each("verdict", Verdict)
def test_no_limit_that_is_met_would_make_a_check_pass(verdict, language):
    """The record decides by the force alone, whatever else withholds a pass."""
    words = Words(language)
    met = limit(verdict, 0.899, 0.0217, 0.093, words)
    missed = limit(verdict, 1.101, 0.093, 0.0217, words)
    passes, joined = (words(f"show.{key}", **GAPS) for key in ("turns", "both"))
    assert not met.startswith(passes[:10])
    assert missed.startswith(passes[:10])
    assert joined[1:-1] in met
    holds = words("show.holds", **GAPS)[:10]
    assert met.startswith(holds) is (verdict is Verdict.PASS)


def test_without_a_limit_nothing_is_told():
    bare = replace(CHECK, holds=[replace(CHECK.holds[0], least=None, most=None)])
    assert list_limits(bare, ENGLISH) == ()


def test_change_in_words():
    change = ChangeRecord(
        quantity="snow thickness",
        unit="m",
        now=2.5,
        bound=1.26,
        sense="at most",
        solves=9,
    )
    assert describe_change(change, ENGLISH) == "snow thickness ≤ 1.26 m"


@each("language", LANGUAGES)
@each("verdict", Verdict)
def test_a_row_shows_every_change_that_is_known(verdict, language):
    words, row = Words(language), replace(ROW, verdict=verdict)
    heading, (block,) = show_changes(row, words)
    passes = verdict in (Verdict.PASS, Verdict.DECLARED)
    assert (heading == words("heading.room_left")) is passes
    told = " ".join(block.items)
    for check in row.checks:
        for change in check.changes:
            if change.bound is not None:
                assert describe_change(change, words) in told
                assert show_check(words, check) in told


@each("language", LANGUAGES)
@each("verdict", Verdict)
@each("used", [None, 0.371, 0.8999, 0.9001, 1.07])
def test_a_row_without_changes_needs_none_only_where_all_is_well(
    verdict, used, language
):
    """An overtopped row has checks that are not proven, and no change for them."""

    def build(verdict, used):
        steps = [
            replace(one, value=used, low=None, high=None) if one.symbol == "μ" else one
            for one in ROW.checks[0].steps
        ]
        return replace(
            ROW.checks[0], verdict=verdict, steps=steps, changes=[], holds=[]
        )

    checks = [build(Verdict.PASS, 0.4), build(verdict, used)]
    words = Words(language)
    is_well = verdict is Verdict.PASS and (used is None or used < CLOSE)
    _, (block,) = show_changes(replace(ROW, checks=checks), words)
    key = "no_change_needed" if is_well else "no_change_alone"
    assert block.text == words(f"heading.{key}")
    key = "no_change" if is_well else "no_change_alone"
    pairs = [(ROW.id, one) for one in checks]
    assert list_changes(pairs, words) == [words(f"show.{key}")]
