"""Corners of what is assumed of a row: the worst counts, and inside is no more."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.checks import load_standard
from netdesign.outcome import Verdict
from netdesign.site.assumed import assume
from netdesign.structure.splay import Guys
from netdesign.study.cases import search_site
from netdesign.study.judge import judge_row
from netdesign.study.row_to_check import list_layouts, list_variants, place_variant
from tests.small_site import RUN, build_row, build_site, resist

STANDARD = load_standard("swiss-guideline-2007")
KEYS = (
    *("post_tilt", "uphill_anchor_distance", "downhill_anchor_distance"),
    *("guy_count", "guy_splay"),
)
WORSE = (Verdict.PASS, Verdict.NOT_PROVEN, Verdict.FAIL)


def assume_all(row, keys=KEYS):
    """The row, of which nobody gives these."""
    factor = row.net_height
    of_row = (assume(one, factor if "distance" in one else 1.0) for one in keys)
    return replace(row, assumed=tuple(of_row))


def judge(row):
    site = build_site(row)
    (solved,) = search_site(site, RUN)
    return judge_row(site, row, solved, STANDARD, RUN)


ROW = build_row("R1", resistances=resist(2.5e5))
OPEN = assume_all(ROW)


@pytest.fixture(scope="module")
def judged():
    return {one.id: one for one in judge(OPEN).checks}


def draw_values(rng):
    """Values inside what is assumed, by their keys."""
    values = {}
    for one in OPEN.assumed:
        whole = one.key == "guy_count"
        values[one.key] = (
            float(rng.integers(one.low, one.high + 1))
            if whole
            else rng.uniform(one.low, one.high)
        )
    return values


def test_a_row_has_its_corners_once():
    variants, layouts = list_variants(OPEN), list_layouts(OPEN)
    assert len(layouts) == 8
    assert len(variants) == 8 * 3  # a single guy has no splay
    assert len(set(layouts)) == 8
    for one in variants:
        assert not any(x.is_range for x in one.assumed)
        assert list_variants(one) == (one,)
        assert one.layout in layouts
    assert list_variants(ROW) == (ROW,)
    assert list_layouts(ROW) == (ROW.layout,)


@pytest.mark.parametrize("seed", range(6))
def test_no_check_is_better_than_with_any_value_inside(judged, seed):
    values = draw_values(np.random.default_rng(700 + seed))
    if values["guy_count"] < 2:
        values.pop("guy_splay")
    typed = replace(place_variant(ROW, values), assumed=())
    for check in judge(typed).checks:
        worst = judged[check.id]
        if check.verdict is not Verdict.FAIL:  # one that no value passes fails, too
            assert WORSE.index(check.verdict) <= WORSE.index(worst.verdict), check.id
        else:
            assert worst.verdict is not Verdict.PASS, check.id
        if check.utilisation_band[1] is not None:
            high = worst.utilisation_band[1]
            assert check.utilisation_band[1] <= 1.003 * high, (check.id, values)


def test_a_single_guy_that_is_assumed_leaves_the_load_along_the_row_open(judged):
    assert judged["post.lateral"].verdict is Verdict.NOT_PROVEN
    two = replace(OPEN, guys=Guys(count=2, are_shared=True))
    two = replace(two, assumed=tuple(x for x in two.assumed if x.key != "guy_count"))
    (lateral,) = (one for one in judge(two).checks if one.id == "post.lateral")
    assert lateral.verdict is Verdict.PASS
