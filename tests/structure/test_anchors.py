"""What one support does to the ground: signs, sums, directions."""

import math

import pytest

from netdesign.outcome import ModelError, Outcome
from netdesign.structure.anchors import (
    AnchorForces,
    FailedSupport,
    compute_anchor_forces,
)
from netdesign.structure.layout import SupportLayout, SupportPoints, place_support

SPACING = 4.0
FOOT = (30e3, 10e3)  # net pulls the foot anchor downslope and out of the ground


def some_points(uphill_anchor_distance: float = 3.0) -> SupportPoints:
    layout = SupportLayout(
        post_spacing=SPACING,
        post_tilt=math.radians(10),
        uphill_anchor_distance=uphill_anchor_distance,
        downhill_anchor_distance=3.0,
    )
    return place_support(layout, head=(1.8, 3.0))


def forces_for(head_pull, foot_pull=FOOT, points=None) -> AnchorForces | FailedSupport:
    return compute_anchor_forces(
        points or some_points(),
        foot_pull_per_m=foot_pull,
        head_pull_per_m=head_pull,
        post_spacing=SPACING,
    )


def measure(force):
    """Angle of a force from downslope, positive out of the ground [rad]."""
    return math.atan2(force.y, force.x)


def test_ground_is_pulled_towards_the_head_and_pressed_along_the_post():
    down, up = forces_for((20e3, -30e3)), forces_for((-40e3, -30e3))
    downhill_x = some_points().downhill_anchor[0]
    for force, size, direction in (
        (
            down.uphill_anchor,
            down.head.uphill_guy_tension,
            math.atan2(3.0, 1.8 + 3.0),
        ),
        (
            up.downhill_anchor,
            up.head.downhill_guy_tension,
            math.atan2(3.0, 1.8 - downhill_x),
        ),
        (
            down.post_base,
            down.head.post_compression,
            -math.pi / 2 - math.radians(10),
        ),
    ):
        assert force.size == pytest.approx(size, rel=1e-15)
        assert measure(force) == pytest.approx(direction, rel=1e-14)
    slack = down.downhill_anchor
    assert (slack.x, slack.y, slack.size) == (0.0, 0.0, 0.0)


def test_member_forces_are_those_of_the_members():
    forces = forces_for((20e3, -30e3))
    assert not forces.is_foot_shared
    assert forces.member_forces == {
        "foot_anchor": pytest.approx(4.0 * math.hypot(*FOOT), rel=1e-15),
        "uphill_guy": forces.head.uphill_guy_tension,
        "uphill_anchor": forces.uphill_anchor.size,
        "downhill_guy": 0.0,
        "downhill_anchor": 0.0,
        "post": forces.head.post_compression,
        "post_base": -forces.post_base.y,
        "post_foot": 0.0,
    }


def test_anchor_shared_by_net_and_guy_takes_both():
    forces = forces_for((20e3, -30e3), points=some_points(uphill_anchor_distance=0.0))
    demands = forces.member_forces
    both = forces.foot_anchor.size + forces.uphill_anchor.size
    assert forces.is_foot_shared
    assert forces.uphill_anchor.size > 0.0
    assert demands["foot_anchor"] == demands["uphill_anchor"] == both
    assert demands["uphill_guy"] == forces.head.uphill_guy_tension < both


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_pull_that_is_no_number_gives_no_anchor_forces(bad):
    failures = [
        forces_for((20e3, -30e3), foot_pull=(bad, 0.0)),
        forces_for((20e3, -30e3), foot_pull=(0.0, bad)),
        forces_for((bad, -30e3)),
    ]
    assert [f.outcome for f in failures] == [Outcome.NONFINITE] * 3


@pytest.mark.parametrize("bad", [0.0, -4.0, math.nan, math.inf])
def test_spacing_must_be_a_length(bad):
    with pytest.raises(ModelError, match="post spacing"):
        compute_anchor_forces(
            some_points(),
            foot_pull_per_m=FOOT,
            head_pull_per_m=(20e3, -30e3),
            post_spacing=bad,
        )
