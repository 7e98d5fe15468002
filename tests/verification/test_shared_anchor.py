"""Anchor that holds a guy of each of two posts: (S20) against both guys in space."""

import math
import random

import numpy as np
import pytest

from netdesign.calculation.quantity import leaf
from netdesign.checks.forces import (
    Support,
    bring_to_support,
    load_guy,
    load_shared_anchor,
    load_shared_anchor_in_line,
    place_end_support,
)
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportPoints
from netdesign.structure.splay import weigh_splay
from tests.structure.splayed_head import compute_splayed_head


def pull_both(flat, points, sideways, splay):
    """Pull of two guys on one uphill anchor, [N]: one of each of two equal posts."""
    found = compute_splayed_head(flat, points, sideways=sideways, splay=splay)
    if isinstance(found, FailedSupport):
        return None
    alone = compute_splayed_head(flat, points, sideways=0.0, splay=splay)
    tension = 2.0 * math.cos(splay) * alone.uphill_guy_tension
    loaded, other = found.uphill_guy_tension, 0.0
    if not found.is_one_sided:
        other = 2.0 * tension / (2.0 * math.cos(splay)) - loaded
    in_section = (loaded + other) * math.cos(splay)
    along = (loaded - other) * math.sin(splay)
    return tension, math.hypot(in_section, along)


def draw_head(draw):
    height = draw.uniform(2.0, 4.5)
    head = (height * math.tan(draw.uniform(0.3, 0.6)), height)
    base = head[0] - height * math.tan(draw.uniform(0.05, 0.4))
    points = SupportPoints(
        net_foot=(0.0, 0.0),
        head=head,
        post_base=(base, 0.0),
        uphill_anchor=(-draw.uniform(2.0, 5.0), 0.0),
        downhill_anchor=(base + draw.uniform(2.0, 5.0), 0.0),
    )
    size, angle = draw.uniform(10e3, 90e3), draw.uniform(-1.4, -0.2)
    return (size * math.cos(angle), size * math.sin(angle)), points


def test_no_two_guys_pull_more_than_the_formula_gives():
    draw, seen = np.random.default_rng(20261126), []
    for _ in range(4000):
        flat, points = draw_head(draw)
        splay = draw.uniform(math.radians(8), math.radians(58))
        sideways = draw.uniform(0.02, 0.6) * math.hypot(*flat)
        both, weights = pull_both(flat, points, sideways, splay), None
        if both is not None:
            weights = weigh_splay(points)
        if both is None or weights is None or both[0] <= 0.0:
            continue
        tension, exact = both
        added = weights.largest_uphill * sideways / math.sin(splay)
        bound = math.hypot(tension, 2.0 * added)
        assert exact <= bound * (1.0 + 1e-9)
        seen.append(exact / bound)
    assert len(seen) > 400
    assert max(seen) > 0.9


INSIDE = Support()
UNITS = {"E_s": "kN", "P": "kN", "β": "deg", "b": "m", "Δl": "m"}


def leaves_of(**values):
    return [leaf(x, value, UNITS.get(x, "-"), "here") for x, value in values.items()]


def bring(inside, load, support=INSIDE):
    (of_section,) = leaves_of(E_s=inside)
    return bring_to_support("E_k", of_section, load, support).value


OF_GUY = {"c": 0.57, "k": 0.1, "P": 83.0, "β": 24.0}
SHARED = load_shared_anchor(*leaves_of(n_g=2.0, **OF_GUY))


def test_inside_the_row_the_two_stand_square_to_each_other():
    across = 2.0 * 0.57 * 0.1 * 83.0 / math.sin(math.radians(24.0))
    assert bring(61.0, SHARED) == pytest.approx(math.hypot(61.0, across))


@pytest.mark.parametrize(
    ("length", "width"),
    # f_R 1.3: b_e = 1.75 + 1.3 l; that of a whole bay beside it, or its own
    [(0.4, (1.75 + 0.52 + 3.5) / 2), (1.9, 1.75 + 1.3 * 1.9)],
)
def test_at_the_end_an_anchor_has_a_guy_of_the_next_post(length, width):
    at_end = place_end_support(*leaves_of(b=3.5, f_R=1.3, Δl=length), is_shared=True)
    inside = bring(61.0, SHARED)
    assert bring(61.0, SHARED, at_end) == pytest.approx(inside * width / 3.5)


def test_pulls_that_are_added_as_numbers_are_those_of_both_guys():
    guy = bring(61.0, load_guy(*leaves_of(**OF_GUY)))
    both = load_shared_anchor_in_line(*leaves_of(n_h=2.0, **OF_GUY))
    assert bring(61.0, both) == pytest.approx(2.0 * guy)


def test_pulls_added_as_numbers_are_never_less_than_as_vectors():
    draw = random.Random(29)
    for _ in range(200):
        inside = draw.uniform(0.0, 300.0)
        drawn = {
            "c": draw.uniform(0.5, 1.0),
            "k": draw.uniform(0.0, 0.3),
            "P": draw.uniform(1.0, 300.0),
            "β": draw.uniform(5.0, 60.0),
        }
        vector = bring(inside, load_shared_anchor(*leaves_of(n_g=2.0, **drawn)))
        in_line = load_shared_anchor_in_line(*leaves_of(n_h=2.0, **drawn))
        scalar = bring(inside, in_line)
        assert scalar >= vector - 1e-9
