"""Post head against the closing triangle of forces."""

import math

import numpy as np
import pytest
from scipy.optimize import nnls

from netdesign.outcome import Outcome
from netdesign.structure.anchors import compute_anchor_forces
from netdesign.structure.head import FailedSupport, HeadForces, compute_head_forces
from netdesign.structure.layout import SupportLayout, SupportPoints, place_support

HEIGHT = 3.0
PULL = 80e3


def points_from_angles(tilt: float, uphill: float, downhill: float) -> SupportPoints:
    """Post tilted by ``tilt`` from the normal, guys at these angles to the ground."""
    return SupportPoints(
        net_foot=(0.0, 0.0),
        head=(1.5, HEIGHT),
        post_base=(1.5 - HEIGHT * math.tan(tilt), 0.0),
        uphill_anchor=(1.5 - HEIGHT / math.tan(uphill), 0.0),
        downhill_anchor=(1.5 + HEIGHT / math.tan(downhill), 0.0),
    )


def a_pull(angle: float) -> tuple[float, float]:
    """Pull of size PULL, ``angle`` from downslope, positive out of the ground."""
    return (PULL * math.cos(angle), PULL * math.sin(angle))


UPHILL_CASES = [(15, 40, -50), (0, 45, 0), (-10, 30, -20), (25, 55, -80), (15, 40, 20)]


@pytest.mark.parametrize(("tilt", "guy", "pull"), np.radians(UPHILL_CASES))
def test_law_of_sines_with_the_uphill_guy(tilt, guy, pull):
    forces = compute_head_forces(a_pull(pull), points_from_angles(tilt, guy, 0.7))
    push_angle = math.pi / 2 - tilt  # of the post on the head
    guy_angle = math.pi + guy  # of the guy on the head
    # Lami: each force is to the sine of the angle between the other two.
    ratio = PULL / math.sin(guy_angle - push_angle)
    post = ratio * math.sin(pull + 2 * math.pi - guy_angle)
    tension = ratio * math.sin(push_angle - pull)
    assert forces.post_compression == pytest.approx(post, rel=1e-13)
    assert forces.uphill_guy_tension == pytest.approx(tension, rel=1e-13)
    assert forces.downhill_guy_tension == 0.0


DOWNHILL_CASES = [(15, 40, -130), (0, 45, 180), (-10, 30, -170), (25, 60, -150)]


@pytest.mark.parametrize(("tilt", "guy", "pull"), np.radians(DOWNHILL_CASES))
def test_law_of_sines_with_the_downhill_guy(tilt, guy, pull):
    forces = compute_head_forces(a_pull(pull), points_from_angles(tilt, 0.6, guy))
    push_angle = math.pi / 2 - tilt
    guy_angle = -guy
    ratio = PULL / math.sin(push_angle - guy_angle)
    post = ratio * math.sin(guy_angle - pull)
    tension = ratio * math.sin(pull - push_angle)
    assert forces.post_compression == pytest.approx(post, rel=1e-13)
    assert forces.downhill_guy_tension == pytest.approx(tension, rel=1e-13)
    assert forces.uphill_guy_tension == 0.0


@pytest.mark.parametrize(("tilt", "guy", "pull"), np.radians(UPHILL_CASES))
def test_law_of_cosines_closes_the_triangle(tilt, guy, pull):
    forces = compute_head_forces(a_pull(pull), points_from_angles(tilt, guy, 0.7))
    post, tension = forces.post_compression, forces.uphill_guy_tension
    between = math.pi / 2 + guy + tilt
    closing = post**2 + tension**2 + 2 * post * tension * math.cos(between)
    assert math.sqrt(closing) == pytest.approx(PULL, rel=1e-13)


@pytest.mark.parametrize("tilt", np.radians([-30, -10, 0, 15, 45]))
def test_pull_down_the_post_is_held_by_the_post_alone(tilt):
    forces = compute_head_forces(
        a_pull(-math.pi / 2 - tilt), points_from_angles(tilt, 0.6, 0.7)
    )
    assert forces.post_compression == pytest.approx(PULL, rel=1e-14)
    assert forces.uphill_guy_tension == forces.downhill_guy_tension == 0.0


def random_supports(count: int = 400):
    """Random pulls on random supports: (pull, points)."""
    rng = np.random.default_rng(20040917)
    for _ in range(count):
        layout = SupportLayout(
            post_spacing=4.0,
            post_tilt=rng.uniform(*np.radians([-30, 45])),
            uphill_anchor_distance=rng.uniform(0, 8),
            downhill_anchor_distance=rng.uniform(0, 8),
        )
        inclination, chord = rng.uniform(0, 0.7), rng.uniform(1.5, 6)
        head = (chord * math.sin(inclination), chord * math.cos(inclination))
        size, angle = 10 ** rng.uniform(0, 6), rng.uniform(-math.pi, math.pi)
        pull = (size * math.cos(angle), size * math.sin(angle))
        yield pull, place_support(layout, head)


def directions(points: SupportPoints) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Unit vectors of what post, uphill and downhill guy do to the head."""
    head = np.array(points.head)
    towards = [
        head - np.array(points.post_base),
        np.array(points.uphill_anchor) - head,
        np.array(points.downhill_anchor) - head,
    ]
    post, uphill, downhill = (v / np.linalg.norm(v) for v in towards)
    return post, uphill, downhill


def test_random_heads_are_in_equilibrium_with_members_that_bear_their_sign():
    slack_uphill = slack_downhill = 0
    for pull, points in random_supports():
        forces = compute_head_forces(pull, points)
        if isinstance(forces, FailedSupport):
            continue
        post, uphill, downhill = directions(points)
        sizes = (
            forces.post_compression,
            forces.uphill_guy_tension,
            forces.downhill_guy_tension,
        )
        thrust = forces.post_compression - forces.post_tension
        residual = pull + thrust * post + sizes[1] * uphill + sizes[2] * downhill
        assert np.linalg.norm(residual) < 1e-12 * math.hypot(*pull)
        assert min(sizes) >= 0.0
        assert min(sizes[1:]) == 0.0
        slack_uphill += sizes[1] == 0.0
        slack_downhill += sizes[2] == 0.0
    assert slack_uphill > 80  # both branches were walked
    assert slack_downhill > 80


def test_random_heads_fail_only_where_no_guy_can_pull():
    """A post of either sign: what is left has nothing that holds it sideways."""
    failures = 0
    for pull, points in random_supports():
        result = compute_head_forces(pull, points)
        post, uphill, downhill = directions(points)
        gaps = [
            nnls(np.column_stack([post, -post, guy]), -np.array(pull))[1]
            for guy in (uphill, downhill)
            if abs(np.linalg.det([post, guy])) >= math.sin(math.radians(1))
        ]
        holds = min(gaps, default=math.inf) < 1e-9 * math.hypot(*pull)
        assert isinstance(result, HeadForces) == holds
        if isinstance(result, FailedSupport):
            assert result.outcome is Outcome.NO_EQUILIBRIUM
            failures += 1
    assert failures > 8


def test_random_supports_pass_all_that_the_net_pulls_to_the_ground():
    checked = 0
    for head_pull, points in random_supports():
        foot_pull = (0.7 * head_pull[1], 0.3 * head_pull[0])
        forces = compute_anchor_forces(
            points,
            foot_pull_per_m=foot_pull,
            head_pull_per_m=head_pull,
            post_spacing=3.5,
        )
        if isinstance(forces, FailedSupport):
            continue
        parts = (
            forces.foot_anchor,
            forces.uphill_anchor,
            forces.downhill_anchor,
            forces.post_base,
        )
        total = np.array([sum(f.x for f in parts), sum(f.y for f in parts)])
        expected = 3.5 * (np.array(foot_pull) + np.array(head_pull))
        size = 3.5 * math.hypot(*head_pull)
        assert np.linalg.norm(total - expected) < 1e-12 * size
        checked += 1
    assert checked > 150
