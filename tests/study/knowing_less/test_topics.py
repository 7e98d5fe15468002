"""A topic more never makes a verdict better: drawn sites with all of it, and less."""

import random
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.checks.schema import ScopeTable
from netdesign.outcome import Verdict
from netdesign.study.judge import judge_site
from tests.grid import solve_site
from tests.make import read_tables
from tests.study.knowing_less.drawn_tables import DEFAULT, draw_tables, give_strength
from tests.study.knowing_less.test_knowing_less import RUN, list_alike

TOPICS = tuple(ScopeTable.model_fields)
ORDER = (Verdict.FAIL, Verdict.NOT_PROVEN, Verdict.DECLARED, Verdict.PASS)
SITES_IN_SUITE, SITES = 6, 200


@pytest.mark.parametrize(
    "seed",
    [
        pytest.param(seed, marks=() if seed < SITES_IN_SUITE else pytest.mark.slow)
        for seed in range(SITES)
    ],
)
def test_a_topic_more_never_makes_anything_better(seed):
    tables = draw_tables(4000 + seed, is_placed=True)
    give_strength(random.Random(f"ground {seed}"), tables)
    site = read_tables(tables)
    solved = solve_site(site, RUN)
    standard = load_standard(site.project.standard or DEFAULT)
    draw = random.Random(f"topics {seed}")
    everything = judge_site(site, solved, standard, RUN)
    for count in (1, 2, len(TOPICS)):
        left_out = tuple(draw.sample(TOPICS, count))
        less = replace(standard, not_checked=left_out)
        study = judge_site(site, solved, less, RUN)
        for all_of_it, some in zip(everything.rows, study.rows, strict=True):
            assert ORDER.index(all_of_it.verdict) <= ORDER.index(some.verdict)
            checks = {one.id: one for one in all_of_it.checks}
            for check in some.checks:
                # a second support that the end's check covers is told there
                names = [check.id] if check.id in checks else list_alike(check)
                alike = [checks[x] for x in names if x in checks]
                if all(map(has_no_steel, alike)):
                    continue
                told = [ORDER.index(one.verdict) for one in alike]
                assert min(told) <= ORDER.index(check.verdict), check.id


def has_no_steel(check):
    """Whether nothing is known to be left of the steel: no number that could fail."""
    keys = {one.message.key for one in check.open}
    return check.utilisation is None and "corrosion.lacks" in keys
