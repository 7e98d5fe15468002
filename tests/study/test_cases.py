"""A site searched on two coarse meshes."""

import math
import random
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.outcome import Verdict
from netdesign.solving.runner import Runner
from netdesign.study.cases import list_phases, search_site
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CaseSolver
from tests.read_check import compare_support
from tests.small_site import ROWS, RUN, build_row, build_site, resist

RANGES = Ranges.of(
    density=Interval(low=270.0, high=400.0),
    friction_angle=Interval(low=math.radians(15), high=math.radians(45)),
    inclination=Interval(low=math.radians(30), high=math.radians(30)),
)
SITE = build_site(*ROWS, ranges=RANGES)


@pytest.fixture(scope="module")
def standard():
    return load_standard("nf-p-95-304-style")


@pytest.fixture(scope="module")
def envelopes():
    return search_site(SITE, RUN)


def judge(standard, envelopes, site=SITE):
    return judge_site(site, envelopes, standard, RUN)


def test_what_may_hide_is_in_the_demand_that_is_checked(standard, envelopes):
    """A resistance between the largest case and the bound's end proves nothing."""
    study = judge(standard, envelopes)
    check = next(c for c in study.rows[0].checks if c.id == "foot_anchor.tendon")
    assert check.read_band("E_d")[1] > check.demand_kN
    band = envelopes[0].extremes["foot_anchor"].widened
    factor = compare_support(check) * check.read("γ_E") * check.read("γ_R")
    between = 0.5 * (band.value + band.high) * factor
    row = build_row("R1", resistances=resist(foot_anchor__tendon=between))
    site = build_site(row, ranges=RANGES)
    again = judge(standard, envelopes[:1], site)
    check = next(c for c in again.rows[0].checks if c.id == "foot_anchor.tendon")
    assert check.verdict is Verdict.NOT_PROVEN


def test_an_open_gap_never_passes(standard, envelopes):
    opened = [
        replace(one, maxima=replace(one.maxima, is_closed=False)) for one in envelopes
    ]
    study = judge(standard, opened)
    assert study.verdict is Verdict.NOT_PROVEN
    assert all(
        check.verdict is not Verdict.PASS
        for row in study.rows
        for check in row.checks
        if check.mode != "inclination" and check.read("E_k")
    )


# --- what is promised beforehand -----------------------------------------------------


def draw_site(seed):
    """One or two rows of any strength, over untidy ranges."""
    draw = random.Random(seed)

    def spread(low, high, widest):
        start = draw.uniform(low, high)
        return Interval(low=start, high=start + draw.uniform(0.2, 1) * widest)

    def row(name):
        thickness = draw.uniform(1.6, 3.9)
        return build_row(
            name,
            slope_angle=math.radians(draw.uniform(28.0, 48.0)),
            snow_thickness=thickness,
            net_height=thickness * draw.uniform(1.0, 1.2),
            upslope_length=draw.uniform(5.0, 18.0),
            slack=draw.uniform(0.01, 0.08),
            resistances=resist(10.0 ** draw.uniform(4.3, 6.3)),
        )

    ranges = Ranges.of(
        density=spread(230.0, 330.0, 140.0),
        friction_angle=spread(0.1, 0.5, 0.3),
        inclination=spread(0.35, 0.5, 0.12),
    )
    return build_site(*map(row, ("R1", "R2")[: draw.randint(1, 2)]), ranges=ranges)


SLOW = [pytest.param(seed, marks=pytest.mark.slow) for seed in (0, *range(2, 30))]


@pytest.mark.parametrize("seed", [1, *SLOW])
def test_each_phase_solves_no_more_than_was_promised(standard, seed):
    """Never more than the upper figure; of a row that passes not even the usual."""
    site, runner, asked = draw_site(seed), Runner(), []
    runner.on_ask = asked.extend
    promised = {one.key: one for one in list_phases(site)}
    solved = search_site(site, RUN, runner)
    of_envelope = runner.counts.solved
    solver = CaseSolver(RUN.settings, RUN.creep_law, runner)
    study = judge_site(site, solved, standard, RUN, solver)
    beside = runner.counts.solved - of_envelope
    assert 0 < of_envelope <= promised["envelope"].cases
    assert 0 < beside <= promised["checks"].cases
    if study.verdict is Verdict.PASS:
        assert beside <= promised["checks"].cases
    assert len(asked) >= of_envelope + beside
