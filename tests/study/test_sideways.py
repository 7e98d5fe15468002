"""What the load along the row adds to each member, now and where the snow grows."""

import math
import random

import pytest

from netdesign.checks import Band
from netdesign.structure.members import Member
from netdesign.study.sideways import Sideways

DRAWN = [random.Random(seed) for seed in range(40)]


def draw(random_numbers):
    """Load on a head; in about half of the draws the guys' tension holds it."""
    pull = random_numbers.uniform(3.1e4, 3.7e5)
    splay = math.radians(random_numbers.uniform(11.3, 43.7))
    share = random_numbers.uniform(0.03, 0.17)
    held = share * pull / math.tan(splay)
    return Sideways(
        share=share,
        splay=splay,
        pull=Band(low=pull * 0.993, value=pull, high=pull * 1.0071),
        least_tension=held * random_numbers.uniform(0.0, 2.0),
        uphill=random_numbers.uniform(0.1, 0.9),
        downhill=random_numbers.uniform(0.1, 0.9),
        post=random_numbers.uniform(0.2, 1.6),
    )


@pytest.mark.parametrize("random_numbers", DRAWN)
def test_rise_bounds_what_a_larger_pull_adds(random_numbers):
    """Also to a post that nothing is added to now: the guys' tension holds it yet."""
    now = draw(random_numbers)
    for member in (Member.POST, Member.POST_BASE, Member.UPHILL_GUY):
        load = now.load(member)
        for growth in (1.0, 1.37, 2.41):
            grown = Sideways(
                share=now.share,
                splay=now.splay,
                pull=now.pull.times(growth),
                least_tension=now.least_tension,
                uphill=now.uphill,
                downhill=now.downhill,
                post=now.post,
            ).load(member)
            most = load.added.high + (growth - 1.0) * load.rise
            assert grown.added.high <= most * (1.0 + 1e-12)
            assert load.pull == now.pull.value


def test_some_posts_are_loaded_only_when_the_pull_grows():
    """The draws above hold both kinds."""
    posts = [draw(random.Random(seed)).load(Member.POST) for seed in range(40)]
    assert {load.added.high > 0.0 for load in posts} == {True, False}
    assert all(load.rise > 0.0 for load in posts)
