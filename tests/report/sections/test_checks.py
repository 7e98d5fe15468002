"""Checks on lines, and what would make them pass: nothing is lost."""

from dataclasses import replace

from netdesign.outcome import Verdict
from netdesign.report.sections.checks import (
    describe_briefly,
    list_changes,
)
from netdesign.report.words import Words
from netdesign.study.member_checks import CLOSE
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.report.build_study import build_study
from tests.turn import turn

STUDY = build_study()


@each("language", LANGUAGES)
@each("row", STUDY.rows)
def test_a_row_that_does_not_pass_says_why_in_few_words(row, language):
    told = describe_briefly(row, Words(language))
    assert bool(told) is (row.verdict is not Verdict.PASS)
    assert len(told.split()) <= 14


ROW = build_study().rows[0]


USED = (None, 0.371, 0.8999, 0.9001, 1.07)
PAIRS = [  # of a verdict and a utilisation that allows it
    (verdict, used)
    for verdict in Verdict
    for used in USED
    if not used or (used > 1.0) is (verdict is Verdict.FAIL)
]


@each("language", LANGUAGES)
@each("verdict, used", PAIRS)
def test_a_row_without_changes_needs_none_only_where_all_is_well(
    verdict, used, language
):
    """An overtopped row has checks that are not proven, and no change for them."""

    steps = [replace(one, low=None, high=None) for one in ROW.checks[0].steps]
    check = replace(ROW.checks[0], steps=steps, changes=[])
    bare = next(one for one in ROW.checks if not one.is_of_force)
    checks = [
        turn(check, Verdict.PASS, utilisation=0.4),
        turn(check, verdict, utilisation=used) if used else turn(bare, verdict),
    ]
    words = Words(language)
    is_well = verdict is Verdict.PASS and (used is None or used < CLOSE)
    key = "no_change" if is_well else "no_change_alone"
    pairs = [(ROW.id, one) for one in checks]
    assert list_changes(pairs, words) == [words(f"show.{key}")]
