"""Which members carry the post head, and what is refused."""

import dataclasses
import math
import random

import pytest

from netdesign.outcome import ModelError, Outcome
from netdesign.structure.head import (
    MIN_GUY_ANGLE,
    HeadForces,
    compute_head_forces,
    find_direction,
    hold_head,
    resolve_signed,
)
from netdesign.structure.layout import SupportPoints
from tests.each import each

KN = 1e3


def some_points(**changes: tuple[float, float]) -> SupportPoints:
    """Upright post of 4 m, both guys at 3 : 4 : 5."""
    values = {
        "net_foot": (-2.0, 0.0),
        "head": (0.0, 4.0),
        "post_base": (0.0, 0.0),
        "uphill_anchor": (-3.0, 0.0),
        "downhill_anchor": (3.0, 0.0),
    }
    return SupportPoints(**(values | changes))


@each(
    "pull, uphill, downhill, post",
    [
        ((30.0, 0.0), 50.0, 0.0, 40.0),
        ((-30.0, -10.0), 0.0, 50.0, 50.0),
        ((0.0, -70.0), 0.0, 0.0, 70.0),
        ((70e-14, -70.0), 0.0, 0.0, 70.0),  # rounding tightens no guy
        ((-70e-14, -70.0), 0.0, 0.0, 70.0),
        ((0.0, 0.0), 0.0, 0.0, 0.0),
    ],
)
def test_forces_by_hand(pull, uphill, downhill, post):
    """Guys at 3 : 4 : 5; where the net's foot stands does not matter."""
    for points in (some_points(), some_points(net_foot=(-3.0, 0.0))):
        forces = compute_head_forces((pull[0] * KN, pull[1] * KN), points)
        guys = (forces.uphill_guy_tension, forces.downhill_guy_tension)
        assert guys == pytest.approx((uphill * KN, downhill * KN), rel=1e-14, abs=0)
        assert forces.post_compression == pytest.approx(post * KN, rel=1e-14, abs=0)


@pytest.mark.parametrize("guy", [(0.0, 0.0), (0.0, -1.0), (-0.6, -0.8)])
def test_a_head_without_a_pull_is_held_whatever_its_guys(guy):
    assert hold_head((0.0, 0.0), (0.0, -1.0), guy, guy).is_held


@pytest.mark.parametrize("sign", [1, -1])
def test_more_than_rounding_across_the_post_tightens_one_guy(sign):
    forces = compute_head_forces((sign * 1e-12 * 70 * KN, -70 * KN), some_points())
    tight, slack = forces.uphill_guy_tension, forces.downhill_guy_tension
    if sign < 0:
        tight, slack = slack, tight
    assert tight == pytest.approx(1e-12 * 70 * KN * 5 / 3, rel=1e-12)
    assert slack == 0.0


def test_the_size_of_a_support_does_not_matter_its_angles_do():
    """A model at 1 : 100, all of its members shorter than a metre."""
    small = SupportPoints(
        **{
            field.name: tuple(
                0.01 * part for part in getattr(some_points(), field.name)
            )
            for field in dataclasses.fields(SupportPoints)
        }
    )
    forces = compute_head_forces((30 * KN, 0.0), small)
    assert forces.uphill_guy_tension == pytest.approx(50 * KN, rel=1e-14)
    assert forces.post_compression == pytest.approx(40 * KN, rel=1e-14)


def test_pull_along_the_guy_leaves_the_post_at_zero_not_below():
    steep = [4.0 * math.tan(math.radians(1.0 + k / 37)) for k in range(1, 300)]
    for run in (*steep, *(k / 7 for k in range(1, 50))):  # some round below zero
        points = some_points(uphill_anchor=(-run, 0.0))
        forces = compute_head_forces((run * KN, 4.0 * KN), points)
        assert 0.0 <= forces.post_compression <= 1e-12 * KN
        expected = KN * math.hypot(run, 4.0)
        assert forces.uphill_guy_tension == pytest.approx(expected, rel=1e-12)
        assert forces.post_tension == forces.loose_uphill == 0.0


def test_pull_along_a_guy_close_to_a_tilted_post_is_told_from_tension():
    """Close to the smallest angle rounding is largest, and still no tension."""
    for degrees in range(1, 90):
        tilt, between = math.radians(degrees), 1.0001 * MIN_GUY_ANGLE
        guy = (-math.sin(tilt + between), -math.cos(tilt + between))
        head = (4.0 * math.sin(tilt), 4.0 * math.cos(tilt))
        points = some_points(
            head=head, uphill_anchor=(head[0] + 5.0 * guy[0], head[1] + 5.0 * guy[1])
        )
        for share in (1.0, 1.7, 3.1):
            pull = (-share * KN * guy[0], -share * KN * guy[1])
            forces = compute_head_forces(pull, points)
            assert 0.0 <= forces.post_compression <= 1e-11 * KN
            assert forces.uphill_guy_tension == pytest.approx(share * KN, rel=1e-11)
            assert forces.post_tension == 0.0


@pytest.mark.parametrize("size", [0.3, 300 * KN])
def test_what_presses_the_post_loosens_nothing_however_small(size):
    held = compute_head_forces((1.2 * size, 0.6 * size), some_points())
    assert held.post_compression == pytest.approx(size)
    assert held.post_tension == held.loose_uphill == held.loose_downhill == 0.0
    lifted = compute_head_forces((0.0, size), some_points())
    assert lifted.post_tension == pytest.approx(size)


# Both guys on one side: a flat one at 3 : 4 : 5, and a steep one. Beside the flat one
# the post has 4/3 f_x - f_y of compression, beside the steep one 4 f_x - f_y.
FLAT, STEEP = (-3.0, 0.0), (-1.0, 0.0)


@pytest.mark.parametrize(
    ("uphill", "downhill", "lift", "works", "compression"),
    [
        (STEEP, FLAT, 2.0, "uphill", 2.0),  # the uphill one first, where it presses
        (FLAT, STEEP, 2.0, "downhill", 2.0),
        (FLAT, STEEP, 5.0, "uphill", 4.0 / 3.0 - 5.0),  # the larger tension of two
        (STEEP, FLAT, 5.0, "downhill", 4.0 / 3.0 - 5.0),
    ],
)
def test_of_two_guys_on_one_side_one_works(uphill, downhill, lift, works, compression):
    points = some_points(uphill_anchor=uphill, downhill_anchor=downhill)
    held = compute_head_forces((KN, lift * KN), points)
    guys = {
        "uphill": held.uphill_guy_tension,
        "downhill": held.downhill_guy_tension,
    }
    assert [name for name, tension in guys.items() if tension] == [works]
    in_post = held.post_compression - held.post_tension
    assert in_post == pytest.approx(compression * KN)


def test_guys_on_one_side_of_a_loose_foot_have_what_each_has_with_the_post():
    """The two alone cannot hold it: the flat one would have to push."""
    points = some_points(uphill_anchor=FLAT, downhill_anchor=STEEP)
    held = compute_head_forces((KN, 5 * KN), points)
    assert held.loose_uphill == pytest.approx(KN / 0.6)
    assert held.loose_downhill == pytest.approx(KN * math.sqrt(17.0))


def test_guys_along_one_line_may_have_all_of_it_each():
    points = some_points(uphill_anchor=FLAT, downhill_anchor=FLAT)
    held = compute_head_forces((KN, 5 * KN), points)
    assert held.loose_uphill == held.loose_downhill == pytest.approx(KN * 26**0.5)


NO_GUY = "guy nothing holds sideways"


@each(
    "pull, changes, outcome, told",
    [
        ((-1, -10), {"downhill_anchor": (0, 0)}, Outcome.NO_EQUILIBRIUM, NO_GUY),
        ((1, 0), {"uphill_anchor": (0, 4)}, Outcome.NO_EQUILIBRIUM, NO_GUY),
        ((1, 0), {"post_base": (0, 4)}, Outcome.OUT_OF_VALIDITY, "has no length"),
    ],
)
def test_what_holds_nothing_is_told_once(pull, changes, outcome, told):
    """A guy along the post, one without length, a post without length."""
    failed = compute_head_forces(
        tuple(KN * one for one in pull), some_points(**changes)
    )
    assert failed.outcome is outcome
    assert str(failed.reason).count(told) == 1
    (side,) = {key.split("_")[0] for key in changes}
    assert told != NO_GUY or f"{side} {told}" in str(failed.reason)


def test_guy_along_the_post_does_not_disturb_the_other():
    points = some_points(downhill_anchor=(0.0, 0.0))
    forces = compute_head_forces((30 * KN, 0.0), points)
    assert forces.uphill_guy_tension == pytest.approx(50 * KN, rel=1e-14)


@pytest.mark.parametrize(("share", "holds"), [(0.999, False), (1.001, True)])
def test_smallest_angle_between_guy_and_post(share, holds):
    run = 4.0 * math.tan(share * MIN_GUY_ANGLE)
    points = some_points(uphill_anchor=(-run, 0.0))
    result = compute_head_forces((1 * KN, 0.0), points)
    assert isinstance(result, HeadForces) == holds


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_what_is_no_number_gives_no_forces(bad):
    for pull in ((bad, 0.0), (0.0, bad)):
        failed = compute_head_forces(pull, some_points())
        assert failed.outcome is Outcome.NONFINITE
        assert str(failed.reason) == (
            "the pull on the post head or a point of the support is no number"
        )
    for place in ("head", "post_base", "uphill_anchor", "downhill_anchor"):
        failed = compute_head_forces((1.0, 0.0), some_points(**{place: (bad, 0.0)}))
        assert failed.outcome is Outcome.NONFINITE


@each(
    "pull, force",
    [
        ((0.0, -1.7e308), "post compression = inf"),
        ((1.7e308, -1.7e308), "uphill guy tension = nan"),
    ],
)
def test_forces_too_large_for_a_number_are_refused(pull, force):
    with pytest.raises(ModelError, match=f"^{force}: must lie between 0 and inf"):
        compute_head_forces(pull, some_points(head=(1.0, 1.0), post_base=(0.0, 0.0)))


@each("seed", range(20))
def test_signed_post_and_guy_hold_a_pull_of_any_direction(seed):
    """Their forces and the pull are in balance on the head."""
    draw = random.Random(seed)
    head, anchor = (draw.uniform(-1.0, 1.0), 3.0), (draw.uniform(2.0, 5.0), 0.1)
    pull = (draw.uniform(-9e3, 9e3), draw.uniform(-9e3, 9e3))
    compression, tension = resolve_signed(
        pull, find_direction(head, (0.0, 0.0)), find_direction(head, anchor)
    )
    reach = math.dist(head, anchor), math.dist(head, (0.0, 0.0))
    for axis in (0, 1):
        to_anchor = (anchor[axis] - head[axis]) / reach[0]
        to_base = -head[axis] / reach[1]
        rest = pull[axis] + tension * to_anchor - compression * to_base
        assert abs(rest) < 1e-9 * math.hypot(*pull)
