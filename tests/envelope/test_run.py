import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from netdesign.envelope.run import run_cases
from netdesign.outcome import Outcome
from netdesign.structure.anchors import compute_anchor_forces
from netdesign.structure.layout import place_support
from tests.solving.small_scene import LAYOUT, solve_case

MEMBERS = {
    *("foot_anchor", "uphill_guy", "uphill_anchor", "downhill_guy", "downhill_anchor"),
    *("post", "post_base", "mesh", "post_foot"),
}


def sizes(result):
    return {member: band.value for member, band in result.member_forces.items()}


def densities(results):
    return [result.case.density for result in results]


def test_a_solved_case_names_every_member_with_its_band(task):
    result = solve_case(task(300.0))
    assert result.is_converged
    assert result.reason is None
    assert set(result.member_forces) == MEMBERS
    for band in result.member_forces.values():
        assert 0.0 <= band.low <= band.value <= band.high
    assert sizes(result) == {
        **result.anchors.member_forces,
        "mesh": result.solution.tension_max,
    }
    foot = result.member_forces["foot_anchor"]
    assert foot.low < foot.value < foot.high
    expected = result.solution.foot.size * LAYOUT.post_spacing
    assert foot.value == pytest.approx(expected, rel=1e-12)


def forces_of_moved_pulls(one, solution, foot_angle, head_angle):
    """Member forces with each end pull moved by its error in some direction."""
    foot, head = (
        (
            pull.x + pull.error * math.cos(angle),
            pull.y + pull.error * math.sin(angle),
        )
        for pull, angle in ((solution.foot, foot_angle), (solution.head, head_angle))
    )
    return compute_anchor_forces(
        place_support(one.layouts[0], tuple(one.job.scene.net.head)),
        foot_pull_per_m=foot,
        head_pull_per_m=head,
        post_spacing=one.layouts[0].post_spacing,
    ).member_forces


SHARED = replace(LAYOUT, post_tilt=math.radians(20.0), uphill_anchor_distance=0.0)


@pytest.mark.parametrize("layout", [LAYOUT, SHARED])
def test_bands_hold_every_pull_within_its_error(task, layout):
    """Each end pull goes round a circle of its error, whatever the other does."""
    one = task(300.0, layout=layout)
    result = solve_case(one)
    angles = np.linspace(0.0, 2.0 * math.pi, 16, endpoint=False)
    for foot_angle, head_angle in product(angles, angles):
        moved = forces_of_moved_pulls(one, result.solution, foot_angle, head_angle)
        for member, force in moved.items():
            band = result.member_forces[member]
            rounding = 1e-12 * band.high
            assert band.low - rounding <= force <= band.high + rounding, member


def test_a_refused_scene_is_a_named_failure_not_a_gap(task):
    """Ice has no creep law of snow: the scene cannot even be built."""
    refused = task(917.0)
    assert refused.job is None
    results = run_cases([task(300.0), refused, task(350.0)])
    assert densities(results) == [300.0, 917.0, 350.0]
    outcomes = [result.outcome for result in results]
    assert outcomes == [
        Outcome.CONVERGED,
        Outcome.OUT_OF_VALIDITY,
        Outcome.CONVERGED,
    ]
    assert "snow density = 917.0" in str(results[1].reason)
    assert results[1].member_forces == {}
    assert results[1].solution is None


def test_a_support_that_cannot_stand_fails_by_name(task):
    """Post leaning far over, guys at the net's foot and the post's base."""
    layout = replace(
        SHARED, post_tilt=math.radians(-30.0), downhill_anchor_distance=0.0
    )
    result = solve_case(task(300.0, layout=layout))
    assert result.outcome is Outcome.NO_EQUILIBRIUM
    assert "no equilibrium" in str(result.reason)
    assert result.member_forces == {}
