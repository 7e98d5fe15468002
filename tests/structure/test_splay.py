"""Head under a pull and a load along the row: equilibrium in space, and the bounds."""

import math
import random
from dataclasses import replace

import numpy as np
import pytest

from netdesign.outcome import ModelError, Outcome
from netdesign.structure.head import FailedSupport, compute_head_forces
from netdesign.structure.layout import SupportPoints
from netdesign.structure.splay import Guys, is_held_sideways, weigh_splay
from tests.structure.splayed_head import compute_splayed_head

POINTS = SupportPoints(
    net_foot=(0.0, 0.0),
    head=(1.9, 3.2),
    post_base=(1.1, 0.0),
    uphill_anchor=(-3.4, 0.0),
    downhill_anchor=(4.9, 0.0),
)
BETA = math.radians(27.0)


def unit(end, head=POINTS.head):
    x, y = end[0] - head[0], end[1] - head[1]
    length = math.hypot(x, y)
    return x / length, y / length


def rest_in_space(pull, sideways, found):
    """Sum of all forces on the head, (x, y, along the row); zero in equilibrium."""
    post = unit(POINTS.post_base)
    uphill, downhill = unit(POINTS.uphill_anchor), unit(POINTS.downhill_anchor)
    cosine, sine = math.cos(BETA), math.sin(BETA)
    up, down = [found.uphill_guy_tension], [found.downhill_guy_tension]
    for pair in (up, down):  # the other guy of a pair in force closes the row's part
        is_pair = not found.is_one_sided and pair[0] > 0.0
        pair.append(pair[0] - sideways / sine if is_pair else 0.0)
    x, y = (
        pull[i]
        - found.post_compression * post[i]
        + cosine * (sum(up) * uphill[i] + sum(down) * downhill[i])
        for i in (0, 1)
    )
    row = sideways - sine * (up[0] - up[1] + down[0] - down[1])
    return x, y, row, min(up[1], down[1])


@pytest.mark.parametrize(
    ("pull", "share", "is_one_sided"),
    [
        ((31.0, -97.0), 0.1, False),
        ((-14.0, -88.0), 0.1, True),
        ((-30.5, -90.2), 0.1, True),
        ((-71.0, -60.0), 0.07, False),
        ((9.0, -101.0), 0.31, True),
    ],
)
def test_all_forces_on_the_head_are_in_balance(pull, share, is_one_sided):
    sideways = share * math.hypot(*pull)
    found = compute_splayed_head(pull, POINTS, sideways=sideways, splay=BETA)
    assert found.is_one_sided is is_one_sided
    *rest, least = rest_in_space(pull, sideways, found)
    assert rest == pytest.approx([0.0, 0.0, 0.0], abs=1e-10)
    assert least >= -1e-10  # no guy pushes


def test_post_that_does_not_stand_between_its_guys_is_not_held():
    beside = SupportPoints(
        net_foot=(0.0, 0.0),
        head=(1.9, 3.2),
        post_base=(1.1, 0.0),
        uphill_anchor=(-3.4, 0.0),
        downhill_anchor=(1.0, 0.0),  # upslope of the base
    )
    assert weigh_splay(beside) is None
    found = compute_splayed_head((14.0, -97.0), beside, sideways=30.0, splay=BETA)
    assert isinstance(found, FailedSupport)
    assert found.outcome is Outcome.NO_EQUILIBRIUM
    assert not is_held_sideways(
        np.array([[14.0], [-97.0]]), [beside], np.array([0]), share=0.3, splay=BETA
    )


@pytest.mark.parametrize("degrees", [0.0, 4.9, 60.1, math.nan])
def test_splay_out_of_range_is_refused(degrees):
    with pytest.raises(ModelError, match="splay"):
        Guys(count=2, splay=math.radians(degrees))


def test_bounds_of_checks_hold_for_drawn_pulls():
    """(S17) and (S18) against the equilibrium in space, in 3 000 drawn scenes."""
    draw = random.Random(20261122)
    near = {"uphill": 0.0, "downhill": 0.0, "post": 0.0}
    one_sided = 0
    for _ in range(3000):
        points = SupportPoints(
            net_foot=(0.0, 0.0),
            head=(draw.uniform(0.8, 2.8), draw.uniform(2.0, 4.5)),
            post_base=(draw.uniform(0.3, 1.6), 0.0),
            uphill_anchor=(-draw.uniform(1.0, 6.0), 0.0),
            downhill_anchor=(draw.uniform(3.0, 8.0), 0.0),
        )
        pull = (draw.uniform(-70.0, 70.0), -draw.uniform(60.0, 120.0))
        splay = math.radians(draw.uniform(5.0, 60.0))
        sideways = draw.uniform(0.02, 0.2) * math.hypot(*pull)
        flat = compute_head_forces(pull, points)
        weights = weigh_splay(points)
        if isinstance(flat, FailedSupport) or weights is None:
            continue
        found = compute_splayed_head(pull, points, sideways=sideways, splay=splay)
        if isinstance(found, FailedSupport):
            continue
        one_sided += found.is_one_sided
        both = flat.uphill_guy_tension + flat.downhill_guy_tension
        held = sideways / math.tan(splay)
        guys = sideways / math.sin(splay)
        bounds = {
            "uphill": flat.uphill_guy_tension / (2 * math.cos(splay))
            + weights.largest_uphill * guys,
            "downhill": flat.downhill_guy_tension / (2 * math.cos(splay))
            + weights.largest_downhill * guys,
            "post": flat.post_compression + weights.post * max(held - both, 0.0),
        }
        exact = {
            "uphill": found.uphill_guy_tension,
            "downhill": found.downhill_guy_tension,
            "post": found.post_compression,
        }
        for member, bound in bounds.items():
            assert exact[member] <= bound * (1.0 + 1e-12)
            near[member] = max(near[member], exact[member] / bound)
    assert one_sided > 500
    assert all(ratio > 0.999 for ratio in near.values()), near  # none is idle


def test_heads_are_held_where_each_of_them_is():
    draw, told = random.Random(7), []
    for _ in range(900):
        base = draw.uniform(0.3, 1.9)
        points = replace(
            POINTS,
            post_base=(base, 0.0),
            downhill_anchor=(base + draw.uniform(-1.0, 6.0), 0.0),
        )
        splay, share = draw.uniform(0.1, 1.0), draw.uniform(0.02, 0.6)
        pull = (draw.uniform(-70.0, 70.0), draw.uniform(-120.0, 20.0))
        sideways = share * math.hypot(*pull)
        found = compute_splayed_head(pull, points, sideways=sideways, splay=splay)
        is_held = not isinstance(found, FailedSupport) and weigh_splay(points)
        states = np.array([pull, (31.0, -97.0)]).T  # one that is held beside it
        answer = is_held_sideways(
            states, [points, POINTS], np.array([0, 1]), share=share, splay=splay
        )
        assert answer is bool(is_held)
        told.append(answer)
    assert 100 < sum(told) < 800
