"""Rating of a check, eased to the best ends of what is assumed."""

import math
import random

import pytest

from netdesign.checks.rating import Open, OpenKind, Rating, rate_utilisation
from netdesign.outcome import Verdict
from netdesign.words.message import say

MISSING = Open(kind=OpenKind.RESISTANCE_MISSING, message=say("check.fails"))
FAILS = Open(kind=OpenKind.FAILS, message=say("check.passes"))


@pytest.mark.parametrize("seed", range(12))
def test_a_lower_end_eases_and_a_higher_one_does_not(seed):
    draw = random.Random(seed)
    low = draw.uniform(1.01, 5.0)
    rating = Rating(low=low, high=low + draw.uniform(0.0, 3.0), demand=7.3)
    assert rating.verdict is Verdict.FAIL
    least = draw.uniform(0.0, 1.0)
    eased = rating.ease(least)
    assert eased.band == (least, rating.high)
    assert (eased.low, eased.demand, eased.verdict) == (low, 7.3, Verdict.NOT_PROVEN)
    assert eased.ease(draw.uniform(least, 9.0)) is eased
    assert rating.ease(low) is rating
    assert rating.ease(draw.uniform(low, 9.0)) is rating


@pytest.mark.parametrize("least", [0.0, 0.42, 3.1])
def test_nothing_left_to_resist_fails_no_longer_where_something_is_at_best(least):
    rating = Rating(low=None, high=None, open=(MISSING, FAILS))
    assert rating.is_unbounded
    assert rating.verdict is Verdict.FAIL
    eased = rating.ease(least)
    assert eased.open == [
        MISSING,
        Open(kind=OpenKind.ASSUMED_DECIDES, message=FAILS.message),
    ]
    assert (eased.eased, eased.verdict) == (least, Verdict.NOT_PROVEN)
    assert not eased.is_unbounded
    assert eased.band == (None, None)  # no utilisation, whatever is eased
    assert rating.ease(math.inf) is rating


def test_without_a_utilisation_nothing_is_eased():
    unknown = Rating(low=None, high=None, open=(MISSING,))
    assert unknown.ease(0.3) is unknown
    for ends in ((None, 0.4), (0.4, None)):
        assert rate_utilisation(*ends) is Verdict.NOT_PROVEN


def test_what_is_met_otherwise_stands_in_the_place_of_a_utilisation():
    for met in (Verdict.PASS, Verdict.NOT_PROVEN):
        assert Rating(low=2.0, high=2.5, met=met).verdict is met
