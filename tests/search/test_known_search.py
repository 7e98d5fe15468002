"""A search that is known is repeated, while nothing that it rests on has changed."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.search.known_search import (
    KnownSearch,
    Repetition,
    decode_search,
    encode_search,
)
from netdesign.search.maxima import Watched
from tests.search.synthetic import assert_same, drive, smooth

WATCHED = {0: Watched(), 2: Watched(resolution=0.1, floor=3.0)}


def repeat(known, response, watched=WATCHED):
    """End of a repetition whose questions the response answers; the cases asked."""
    repetition, asked = Repetition(known), []
    while points := repetition.ask():
        assert repetition.result is None
        asked += points
        repetition.tell([response(point) for point in points], watched)
    return repetition.result, asked


@pytest.fixture(scope="module")
def known():
    """Search over a made-up response, one case of which failed."""
    response = smooth(0)
    found = drive(
        lambda u: response(u) if tuple(u) != (0.0, 0.5, 1.0) else np.full(3, np.nan), 3
    )
    assert None in found.values
    return KnownSearch(maxima=found, watched=WATCHED)


def recall(known, changes=()):
    values = dict(zip(known.maxima.points, known.maxima.values, strict=True))
    return (values | dict(changes)).__getitem__


def test_a_search_survives_the_way_to_disk_and_back_bit_by_bit(known):
    back = decode_search(encode_search(known))
    assert back.watched == known.watched
    assert_same(back.maxima, known.maxima)


def test_equal_answers_to_the_same_questions_give_the_maxima_of_then(known):
    found, asked = repeat(known, recall(known))
    assert found is known.maxima
    assert tuple(asked) == known.maxima.points


@pytest.mark.parametrize("place", [0, 20, -1])
@pytest.mark.parametrize("quantity", [0, 2])
def test_an_answer_that_differs_in_its_last_bit_ends_it(known, place, quantity):
    point, value = known.maxima.points[place], list(known.maxima.values[place])
    value[quantity] = math.nextafter(value[quantity], math.inf)
    found, asked = repeat(known, recall(known, {point: tuple(value)}))
    assert found is None
    assert asked == list(known.maxima.points[: len(asked)])


def test_a_case_that_fails_now_or_no_longer_ends_it(known):
    failed = known.maxima.points[known.maxima.values.index(None)]
    for changes in ({failed: (1.0, 1.0, 1.0)}, {known.maxima.points[-1]: None}):
        assert repeat(known, recall(known, changes))[0] is None


@pytest.mark.parametrize(
    "watched",
    [
        {0: Watched()},
        {0: Watched(), 2: Watched(resolution=0.1, floor=math.nextafter(3.0, 4.0))},
        {0: Watched(), 2: Watched(resolution=0.0, floor=3.0)},
    ],
)
def test_other_questions_to_the_bounds_end_it(known, watched):
    assert repeat(known, recall(known), watched)[0] is None


def test_a_log_that_lacks_cases_never_answers(known):
    short = replace(known.maxima, log=known.maxima.log[:-1])
    cut = replace(known, maxima=short)
    assert repeat(cut, recall(known))[0] is None


def test_a_doubt_that_differs_ends_it(known):
    """The bounds hold for values that are known as well as they were."""
    place = 7  # after the one that failed
    doubt = tuple(1e-3 * abs(one) for one in known.maxima.values[place])
    doubts = list(known.maxima.doubts)
    doubts[place] = doubt
    rough = replace(known, maxima=replace(known.maxima, doubts=tuple(doubts)))
    assert repeat(rough, recall(rough))[0] is None
    back = decode_search(encode_search(rough)).maxima
    assert back.doubts == rough.maxima.doubts
    assert back.surrogate.doubts[place - 1] == pytest.approx(doubt)
