"""Bounds of a post that pulls, over pulls that are known everywhere in a box."""

import math
from itertools import product
from types import SimpleNamespace

import pytest

from netdesign.checks import Band
from netdesign.coupling.solution import EndPull
from netdesign.envelope.panel_forces import POST_PULLS
from netdesign.envelope.ranges import Case
from netdesign.envelope.result_reader import bound_lifted
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Outcome
from netdesign.search.maxima import SearchSettings
from netdesign.structure.anchors import compute_anchor_forces
from netdesign.structure.layout import SupportLayout, place_support
from netdesign.structure.members import Member

LAYOUT = SupportLayout(
    post_spacing=3.0,
    post_tilt=math.radians(12.0),
    uphill_anchor_distance=3.0,
    downhill_anchor_distance=2.5,
)
GUYS = (
    *(Member.UPHILL_GUY, Member.UPHILL_ANCHOR),
    *(Member.DOWNHILL_GUY, Member.DOWNHILL_ANCHOR),
)
HEAD = (1.4, 3.2)
SETTINGS = SearchSettings()
COARSE = list(product((0.0, 0.3, 0.6, 0.9), repeat=2))  # not up to the corners at 1


def give(point, rise):
    """Case whose net pulls the head more out of the slope, the larger both shares."""
    size = 2e4 * (1.0 + 0.5 * point[0])
    angle = -0.9 + rise * (point[0] + point[1] ** 2)
    return give_pull((size * math.cos(angle), size * math.sin(angle)))


def give_pull(pull):
    """Case whose net pulls the head so [N/m]."""
    anchors = compute_anchor_forces(
        place_support(LAYOUT, HEAD),
        foot_pull_per_m=(1e4, 1e4),
        head_pull_per_m=pull,
        post_spacing=LAYOUT.post_spacing,
    )
    forces = anchors.member_forces
    return CaseResult(
        case=Case(density=300.0, friction_angle=0.5, inclination=0.4),
        outcome=Outcome.CONVERGED,
        member_forces={k: Band(low=v, value=v, high=v) for k, v in forces.items()},
        anchors=anchors,
        solution=SimpleNamespace(
            head_point=HEAD,
            foot=EndPull(x=1e4, y=1e4, error=0.0),
            head=EndPull(x=pull[0], y=pull[1], error=0.0),
        ),
    )


def bound(rise, points=COARSE):
    return bound_lifted([LAYOUT], points, [give(one, rise) for one in points], SETTINGS)


def find_largest(rise):
    """Largest forces of all states in which the post is lifted."""
    dense = product([k / 40 for k in range(41)], repeat=2)
    every = [give(point, rise).member_forces for point in dense]
    lifted = [one for one in every if one[Member.POST_FOOT].value > 0.0]
    return {
        name: max((one[name].value for one in lifted), default=0.0) for name in every[0]
    }


@pytest.mark.parametrize("rise", [0.0, 0.2, 0.4])
def test_no_post_pulls_where_the_net_pulls_its_head_down_everywhere(rise):
    assert find_largest(rise)[Member.POST_FOOT] == 0.0
    assert bound(rise) == {}


@pytest.mark.parametrize("rise", [0.8, 0.85, 1.0, 1.25])
def test_no_force_in_the_box_exceeds_its_bound(rise):
    """Also where no case of the search lifts the post, and a corner between does."""
    largest, upper = find_largest(rise), bound(rise)
    assert largest[Member.POST_FOOT] > 0.0
    for member in (*GUYS, Member.POST_FOOT):
        assert 0.0 < largest[member] <= upper[member] * (1.0 + 1e-9), member
    assert upper[POST_PULLS[0]] == upper[POST_PULLS[1]]


def test_a_pull_up_the_post_is_bounded_closely():
    """No guy shares in it: the foot has all of it, (S4a)."""
    base = place_support(LAYOUT, HEAD).post_base
    up = (HEAD[0] - base[0], HEAD[1] - base[1])

    def give_up(share):
        return give_pull((share * up[0], share * up[1]))

    results = [give_up(1e4 * (1.0 + x + y * y)) for x, y in COARSE]
    upper = bound_lifted([LAYOUT], COARSE, results, SETTINGS)[Member.POST_FOOT]
    largest = 3e4 * math.hypot(*up) * LAYOUT.post_spacing
    assert largest <= upper <= 1.02 * largest


def test_a_lift_that_no_case_has_shown_is_bounded():
    rise = 0.85
    cases = [give(point, rise) for point in COARSE]
    assert max(one.member_forces[Member.POST_FOOT].value for one in cases) == 0.0
    assert bound(rise)[Member.POST_FOOT] > 0.0


def test_failed_cases_tell_nothing_and_few_cases_no_bound():
    failed = CaseResult(
        case=give((0.0, 0.0), 0.0).case,
        outcome=Outcome.DIVERGED,
        member_forces={},
    )
    results = [give(one, 1.0) for one in COARSE]
    with_failed = bound_lifted(
        [LAYOUT], [*COARSE, (1.0, 1.0)], [*results, failed], SETTINGS
    )
    assert with_failed == bound(1.0)
    assert bound(1.0, COARSE[:6]) == {}
    assert bound_lifted([], COARSE, results, SETTINGS) == {}
