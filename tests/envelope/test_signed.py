"""Signed forces against the members that carry: any pull, any support."""

import math
import random

import pytest

from netdesign.envelope.signed_forces import SIGNED, name_sources
from netdesign.structure.anchors import compute_anchor_forces
from netdesign.structure.head import FailedSupport, list_directions, resolve_signed
from netdesign.structure.layout import SupportLayout, place_support
from netdesign.structure.members import CARRYING_MEMBERS, name_in_panel
from tests.each import each

HEAD = (1.5, 3.0)


def draw(seed):
    rng = random.Random(seed)
    layout = SupportLayout(
        post_spacing=1.0,
        post_tilt=math.radians(rng.uniform(-10.0, 25.0)),
        uphill_anchor_distance=rng.uniform(1.0, 5.0),
        downhill_anchor_distance=rng.uniform(1.0, 5.0),
    )
    angle = rng.uniform(-math.pi, 0.0)  # the net pulls its head down
    return layout, (math.cos(angle), math.sin(angle))


@each("seed", range(300))
def test_members_are_the_largest_of_the_signed_forces_behind_them(seed):
    layout, pull = draw(seed)
    points = place_support(layout, HEAD)
    anchors = compute_anchor_forces(
        points, foot_pull_per_m=(1.0, 1.0), head_pull_per_m=pull, post_spacing=1.0
    )
    post, *guys = list_directions(points)
    pairs = [resolve_signed(pull, post, guy) for guy in guys]
    if isinstance(anchors, FailedSupport) or math.isnan(sum(map(sum, pairs))):
        return
    (post_up, uphill), (post_down, downhill) = pairs
    forces = anchors.member_forces
    assert forces["uphill_guy"] == pytest.approx(max(0.0, uphill), abs=1e-9)
    assert forces["downhill_guy"] == pytest.approx(max(0.0, downhill), abs=1e-9)
    assert forces["post"] == pytest.approx(max(post_up, post_down), abs=1e-9)


def test_a_guy_along_the_post_gives_nothing():
    forces = resolve_signed((0.0, -1.0), (0.0, -1.0), (0.0, -1.0))
    assert all(map(math.isnan, forces))


@pytest.mark.parametrize("is_shared", [False, True])
def test_what_stands_behind_a_member_is_a_signed_force(is_shared):
    for member in (*CARRYING_MEMBERS, *map(name_in_panel, CARRYING_MEMBERS)):
        assert set(name_sources(member, is_shared=is_shared)) <= set(SIGNED)
    assert name_sources("something_new", is_shared=is_shared) == ()


def test_a_shared_anchor_takes_the_guy_where_it_pulls():
    alone = name_sources("foot_anchor", is_shared=False)
    assert len(alone) == 1
    assert set(alone) < set(name_sources("foot_anchor", is_shared=True))
