"""What would make a check pass, in words."""

from dataclasses import replace

from netdesign.checks.check import Change
from netdesign.outcome import Verdict
from netdesign.report.sections.checks import (
    describe_change,
    list_changes,
)
from netdesign.report.words import Words
from netdesign.study.remedies import CLOSE
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.report.build_study import build_study
from tests.turn import turn

ENGLISH = Words("en")
ROW = build_study().rows[0]


def test_change_in_words():
    change = Change(
        quantity="post spacing",
        unit="m",
        now=2.5,
        bound=1.26,
        sense="at most",
    )
    assert describe_change(change, ENGLISH) == "post spacing ≤ 1.26 m"


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
