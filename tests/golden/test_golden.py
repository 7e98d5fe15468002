"""Studies of forty drawn sites: every number as it was, to a billionth."""

import pytest

from tests.golden.compare import read_gone
from tests.golden.drawn import SEEDS, compare_seed, load


@pytest.fixture(scope="module")
def stored():
    return load("lines"), load("numbers"), load("verdicts")


# Every third site; `python -m tests.golden` compares all forty.
@pytest.mark.parametrize("seed", SEEDS[::3])
def test_every_number_is_what_it_was(stored, seed):
    told = compare_seed(seed, *stored)
    assert not told, told[:10]


def test_what_is_gone_was_there(stored):
    _, numbers, _ = stored
    places = {place for study in numbers.values() for place in study}
    idle = [one.pattern for one in read_gone() if not any(map(one.fullmatch, places))]
    assert not idle


def test_the_sites_hold_all_verdicts_and_grounds(stored):
    _, numbers, _ = stored
    verdicts = {value for study in numbers.values() for key, value in study.items()
                if key.endswith("/verdict")}  # fmt: skip
    assert verdicts == {"pass", "fail", "not_proven", "declared"}
    words = {value for study in numbers.values() for value in study.values()}
    assert {"free", "sliding"} <= words
