"""Leaves of the load along the row: what it adds now and where the snow grows."""

import math
import random
from dataclasses import replace

import pytest

from netdesign.addons.reliability.check_by_case import _find_rise
from netdesign.checks import load_standard
from netdesign.checks.schema import LATERAL_SHARE
from netdesign.structure.members import Member
from netdesign.study.case_records import HeldSidewaysRecord
from netdesign.study.guideline_load import find_effects
from netdesign.study.member_force import RowForces, _MemberAt
from tests.each import each
from tests.small_site import RANGES, build_row

DRAWN = [random.Random(seed) for seed in range(40)]
ROW, STANDARD = build_row("R1"), load_standard("eurocode")


def draw(random_numbers):
    """Load on a head; in about half of the draws the guys' tension holds it."""
    pull = random_numbers.uniform(31.0, 370.0)
    splay = random_numbers.uniform(11.3, 43.7)
    share = random_numbers.uniform(0.03, 0.17)
    held = share * pull / math.tan(math.radians(splay))
    least = held * random_numbers.uniform(0.0, 2.0)
    return HeldSidewaysRecord(
        share=share,
        splay_deg=splay,
        pull_low_kN=pull * 0.993,
        pull_kN=pull,
        pull_high_kN=pull * 1.0071,
        least_tension_kN=least,
        uphill_part=random_numbers.uniform(0.1, 0.9),
        downhill_part=random_numbers.uniform(0.1, 0.9),
        post_part=random_numbers.uniform(0.2, 1.6),
    )


def add(held, member):
    """Upper end of what is added to a member, and its rise [kN]."""
    values = [
        replace(one, value=held.share) if one.id == LATERAL_SHARE else one
        for one in STANDARD.values
    ]
    standard = replace(STANDARD, values=tuple(values))
    forces = RowForces(
        site=None,
        row=ROW,
        standard=standard,
        effects=find_effects(ROW, standard, RANGES),
        largest={},
        floor=None,
        held=held,
        tilt=0.0,
    )
    at = _MemberAt(forces=forces, member=member, width=forces.effects.supports[0])
    return at.load.added.high, _find_rise(forces, member)


def grow(held, growth):
    return replace(
        held,
        pull_low_kN=growth * held.pull_low_kN,
        pull_kN=growth * held.pull_kN,
        pull_high_kN=growth * held.pull_high_kN,
    )


@each("random_numbers", DRAWN)
def test_rise_bounds_what_a_larger_pull_adds(random_numbers):
    """Also to a post that nothing is added to now: the guys' tension holds it yet."""
    now = draw(random_numbers)
    for member in (Member.POST, Member.POST_BASE, Member.UPHILL_GUY):
        high, rise = add(now, member)
        for growth in (1.0, 1.37, 2.41):
            grown, _ = add(grow(now, growth), member)
            assert grown <= (high + (growth - 1.0) * rise) * (1.0 + 1e-12)
            if member == Member.UPHILL_GUY:
                assert grown == pytest.approx(growth * high, rel=1e-12)


def test_some_posts_are_loaded_only_when_the_pull_grows():
    """The draws above hold both kinds."""
    posts = [add(draw(random.Random(seed)), Member.POST) for seed in range(40)]
    assert {high > 0.0 for high, _ in posts} == {True, False}
    assert all(rise > 0.0 for _, rise in posts)
