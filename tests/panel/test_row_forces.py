"""Forces on a support at the end of a row."""

import math

import pytest

from netdesign.outcome import ModelError
from netdesign.panel.inputs import Panel, Rope
from netdesign.panel.row_end import compute_end_forces
from netdesign.panel.solve import solve_panel
from netdesign.structure.anchors import compute_anchor_forces
from netdesign.structure.layout import SupportLayout, place_support

ROPE = Rope(stiffness=17e6, sag=0.052)
PANEL = Panel(post_spacing=3.6, lower=ROPE, upper=ROPE, cut="fitted")
LAYOUT = SupportLayout(
    post_spacing=3.6, uphill_anchor_distance=3.9, downhill_anchor_distance=4.2
)


@pytest.fixture
def panel(solved):
    section = solved(inclination_deg=30.0, slack=0.03, ground="no-slip")
    return solve_panel(section, PANEL)


@pytest.fixture
def points():
    return place_support(LAYOUT, (4.0 * math.tan(math.radians(30)), 4.0))


def resolve_bay(panel, points):
    """Forces of a support inside the row, which takes a bay."""
    return compute_anchor_forces(
        points, foot_pull_per_m=panel.foot, head_pull_per_m=panel.head, post_spacing=1.0
    )


@pytest.mark.parametrize("degrees", [0.0, 33.0, 45.0])
def test_at_the_end_half_a_bay_and_both_ropes(panel, points, degrees):
    inside = resolve_bay(panel, points)
    end = compute_end_forces(panel, points, math.radians(degrees))
    half = (panel.foot[0] / 2, panel.foot[1] / 2, panel.lower.along)
    assert end.foot == pytest.approx(half)
    assert end.foot_size == pytest.approx(math.dist(half, (0, 0, 0)))
    assert end.head_along == panel.upper.along
    # the guy's parts: along the row all that the rope pulls, across it the rest
    assert end.guy_tension * math.cos(math.radians(degrees)) == pytest.approx(
        panel.upper.along
    )
    assert math.hypot(end.across, end.head_along) == pytest.approx(end.guy_tension)
    # the post leans on its uphill guy: C = V cos(alpha) / cos(tau + alpha), by hand
    (head_x, head_y), (up_x, _) = points.head, points.uphill_anchor
    tilt = math.atan2(head_x - points.post_base[0], head_y - points.post_base[1])
    fall = math.atan2(head_y, head_x - up_x)
    added = end.post_compression - inside.head.post_compression / 2
    by_hand = end.across * math.cos(fall) / math.cos(tilt + fall)
    assert added == pytest.approx(by_hand)


@pytest.mark.parametrize("degrees", [-0.1, 80.1, math.nan])
def test_guy_that_holds_nothing_is_refused(panel, points, degrees):
    with pytest.raises(ModelError, match="end guy angle"):
        compute_end_forces(panel, points, math.radians(degrees))
