"""The forces on a post head close for every geometry, and so do those on the ground."""

import math
import random

import pytest

from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.layout import SupportLayout, place_support
from tests.each import each

DRAW = random.Random(20261121)


def draw_case():
    layout = SupportLayout(
        post_spacing=DRAW.uniform(2.0, 5.0),
        post_tilt=math.radians(DRAW.uniform(-10.0, 30.0)),
        uphill_anchor_distance=DRAW.uniform(0.5, 6.0),
        downhill_anchor_distance=DRAW.uniform(0.5, 6.0),
    )
    height = DRAW.uniform(2.0, 5.0)
    head = (height * math.tan(math.radians(DRAW.uniform(20.0, 40.0))), height)
    foot_pull = (DRAW.uniform(5e3, 9e4), DRAW.uniform(5e3, 9e4))
    head_pull = (DRAW.uniform(-5e4, 5e4), DRAW.uniform(-9e4, -2e4))
    return layout, head, foot_pull, head_pull


@each("case", [draw_case() for _ in range(60)])
def test_head_and_ground_are_in_equilibrium(case):
    layout, head, foot_pull, head_pull = case
    points = place_support(layout, head)
    found = compute_anchor_forces(
        points,
        foot_pull_per_m=foot_pull,
        head_pull_per_m=head_pull,
        post_spacing=layout.post_spacing,
    )
    assert isinstance(found, AnchorForces)
    size = layout.post_spacing * math.hypot(*head_pull)
    at_head = [layout.post_spacing * part for part in head_pull]
    for force in (found.post_base, found.uphill_anchor, found.downhill_anchor):
        at_head = [at_head[0] - force.x, at_head[1] - force.y]
    assert math.hypot(*at_head) < 1e-12 * size
    assert found.uphill_anchor.size == 0.0 or found.downhill_anchor.size == 0.0


def test_base_by_its_position_stays_where_it_is():
    """With a base by position the tilt follows the head: 3 m high, 0.8 m across."""
    layout = SupportLayout(
        post_spacing=4.0,
        uphill_anchor_distance=3.0,
        downhill_anchor_distance=2.0,
        post_base_distance=0.9,
    )
    for head in ((1.4, 3.0), (1.7, 3.0), (2.1, 3.0)):
        points = place_support(layout, head)
        assert points.post_base == (0.9, 0.0)
        assert points.downhill_anchor == pytest.approx((2.9, 0.0), rel=1e-15)
