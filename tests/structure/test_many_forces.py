"""Many supports at once: the same forces as of each alone, failing ones included."""

import math
import random

import numpy as np

from netdesign.structure.anchors import compute_anchor_forces, compute_member_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportLayout, place_support
from netdesign.structure.members import CARRYING_MEMBERS
from netdesign.structure.splay import find_ways
from tests.each import each

COUNT = 90


def draw_layout(draw):
    """A layout, also with a guy at the foot, along the post, or of both on one side."""
    return SupportLayout(
        post_spacing=draw.uniform(2.2, 5.1),
        post_tilt=math.radians(draw.uniform(-29.0, 44.0)),
        uphill_anchor_distance=draw.choice([0.0, draw.uniform(0.1, 6.0)]),
        downhill_anchor_distance=draw.choice([0.0, draw.uniform(0.1, 6.0)]),
        post_base_distance=draw.choice([None, draw.uniform(-3.0, 6.0)]),
    )


def draw_pulls(draw, layout, heads):
    """Pulls per metre [N/m]: any, none, along the post, along a guy."""
    found = []
    for head in heads:
        points = place_support(layout, head)
        to = draw.choice([points.post_base, points.uphill_anchor, None, None, None])
        x, y = draw.uniform(-7e4, 7e4), draw.uniform(-7e4, 7e4)
        if to is not None:
            size = draw.choice([-1e4, 1e4])
            x, y = (size * (to[k] - head[k]) for k in (0, 1))
        found.append(draw.choice([(x, y), (x, y), (x, y), (0.0, 0.0)]))
    return found


def draw_supports(seed):
    draw = random.Random(seed)
    layout = draw_layout(draw)
    heads = [(draw.uniform(-1.0, 3.5), draw.uniform(1.2, 4.4)) for _ in range(COUNT)]
    feet = [(draw.uniform(-4e4, 4e4), draw.uniform(0.0, 9e4)) for _ in range(COUNT)]
    return layout, heads, feet, draw_pulls(draw, layout, heads)


def solve_each(layout, heads, feet, pulls):
    return [
        compute_anchor_forces(
            place_support(layout, head),
            foot_pull_per_m=foot,
            head_pull_per_m=pull,
            post_spacing=layout.post_spacing,
        )
        for head, foot, pull in zip(heads, feet, pulls, strict=True)
    ]


@each("seed", range(24))
def test_forces_of_many_are_those_of_each(seed):
    layout, heads, feet, pulls = draw_supports(seed)
    forces, is_held = compute_member_forces(
        find_ways([layout], tuple(np.array(heads).T)),
        foot_pull_per_m=tuple(np.array(feet).T),
        head_pull_per_m=tuple(np.array(pulls).T),
        post_spacing=layout.post_spacing,
        is_foot_shared=layout.is_foot_shared,
    )
    shape = (1, COUNT)
    forces = {name: np.broadcast_to(force, shape) for name, force in forces.items()}
    for k, one in enumerate(solve_each(layout, heads, feet, pulls)):
        assert is_held[0, k] == (not isinstance(one, FailedSupport))
        if isinstance(one, FailedSupport):
            continue
        pull = layout.post_spacing * math.hypot(*pulls[k])
        foot = layout.post_spacing * math.hypot(*feet[k])
        rounding = 1e-13 * 60.0 * (pull + foot)  # 1 / sin(1 degree) is 57
        for member in CARRYING_MEMBERS:
            expected = one.member_forces[member]
            assert abs(forces[member][0, k] - expected) <= rounding
