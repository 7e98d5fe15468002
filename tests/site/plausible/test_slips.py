"""Slips of the pen are noticed: measured on drawn lists of eight rows.

Of 2,400 alterations at most 5 in 100 may be read without a word. What is left are
mostly numbers swapped between like rows, which nothing in a workbook can tell.
"""

from collections import Counter
from functools import lru_cache

import pytest

from netdesign.checks import load_standard
from netdesign.outcome import Verdict
from netdesign.site import reader
from netdesign.site.reader import read_site
from netdesign.solving.runner import Runner
from netdesign.study.judge import judge_site
from tests.grid import solve_site
from tests.make import write_site
from tests.site.plausible.office import draw_office
from tests.site.plausible.slips import FACTORS, is_noticed, list_known, list_slips
from tests.small_site import RUN

pytestmark = pytest.mark.long
MOST, MOST_BETTER = 0.05, 0.005
LIKE = "swapped with the next line"
SNOW_AND_N = {"Rows!C", "Rows!D"}
RANK = {Verdict.FAIL: 0, Verdict.NOT_PROVEN: 0, Verdict.DECLARED: 1, Verdict.PASS: 2}


@pytest.fixture
def measure(tmp_path, monkeypatch):
    """All slips of a list of eight rows, and those that are read without a word."""

    def measure_one(seed):
        path = write_site(tmp_path / f"{seed}.xlsx", draw_office(seed, rows=8))
        monkeypatch.setattr(reader, "read_cells", lru_cache(READ))
        known, slips = list_known(path), list(list_slips(path))
        return path, slips, [one for one in slips if not is_noticed(path, one, known)]

    return measure_one


READ = reader.read_cells


def test_few_slips_are_read_without_a_word(measure):
    kinds, unnoticed = Counter(), Counter()
    for seed in (3, 5, 7):
        _, slips, unread = measure(seed)
        kinds.update(one.kind for one in slips)
        unnoticed.update(one.kind for one in unread)
    table = {kind: f"{unnoticed[kind]} of {kinds[kind]}" for kind in kinds}
    assert kinds.total() > 2000
    told = unnoticed.total() - unnoticed[LIKE]
    assert told <= MOST * kinds.total(), table
    by_ten = sum(unnoticed[kind] for kind in FACTORS)
    assert by_ten <= MOST_BETTER * sum(kinds[kind] for kind in FACTORS), table


def judge(path, instead):
    site = read_site(path, instead=instead)
    standard = load_standard("nf-p-95-304-style")
    return judge_site(site, solve_site(site, RUN, Runner()), standard, RUN)


def is_better(study, before):
    """A verdict is better, or a utilisation lower by more than its interval."""
    for row, old in zip(study.rows, before.rows, strict=True):
        if RANK[row.verdict] > RANK[old.verdict]:
            return True
        known = {one.id: one for one in old.checks}
        for check in row.checks:
            was = known.get(check.id)
            if was is None or None in (check.utilisation, was.utilisation):
                continue
            low, high = was.utilisation_band
            if check.utilisation < was.utilisation - (high - low):
                return True
    return False


def test_no_slip_that_is_read_without_a_word_helps(measure):
    """But for numbers that nothing tells apart, and one of which gains by it.

    Those of like rows; snow height [m] and N of a row, which stand side by side.
    """
    path, slips, unread = measure(3)
    before = judge(path, {})
    better = [one for one in unread if is_better(judge(path, one.instead), before)]
    told = [one for one in better if one.kind != LIKE and not is_snow_for_n(one)]
    assert len(told) <= MOST_BETTER * len(slips), told


def is_snow_for_n(slip):
    return {place.rstrip("0123456789") for place in slip.instead} == SNOW_AND_N
