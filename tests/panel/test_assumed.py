"""Panels that nobody gives: none as it may be built loads a member more."""

import math
import random
from dataclasses import replace
from itertools import product

import pytest

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene
from netdesign.envelope.panel_forces import PANEL_QUANTITIES, PanelForces
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import build_task, run_cases
from netdesign.panel.inputs import (
    CUTS,
    SAGS,
    STIFFNESSES,
    Panel,
    Rope,
    find_stiffness,
    list_panels,
)
from netdesign.panel.solve import FailedPanel
from netdesign.site.assumed import load_assumed
from netdesign.site.columns.all_tables import SHEETS
from netdesign.snow.ground import GroundLaw
from netdesign.snow.snowpack import Snowpack
from netdesign.structure.layout import SupportLayout
from tests.each import each
from tests.solving.small_scene import COARSE

SEEDS = (203, 204, 207, 211, 216, 218)


def draw_solver(seed):
    """Function that solves one drawn row with some panels, and its post spacing."""
    solve, _, spacing = draw_case(seed)
    return lambda panels: solve(panels).panel, spacing


def draw_case(seed):
    """Function that solves one drawn row with some panels, its net and post spacing."""
    draw = random.Random(seed)
    height, spacing = draw.uniform(2.0, 4.5), draw.uniform(2.5, 4.5)
    layout = SupportLayout(
        post_spacing=spacing,
        uphill_anchor_distance=height * draw.uniform(0.7, 1.4),
        downhill_anchor_distance=height * draw.uniform(0.7, 1.3),
    )
    snow = Snowpack(
        slope_angle=math.radians(draw.uniform(30.0, 50.0)),
        thickness=height * draw.uniform(0.8, 1.0),
        upslope_length=draw.uniform(6.0, 25.0),
        density=draw.uniform(250.0, 420.0),
    )
    net = Net(
        height_normal=height,
        inclination=math.radians(draw.uniform(24.0, 36.0)),
        stiffness_per_m=draw.uniform(4e6, 22e6),
        slack=draw.choice((0.0, draw.uniform(0.0, 0.12))),
        friction_angle=math.radians(draw.uniform(13.0, 45.0)),
    )
    ground = GroundLaw(kind=draw.choice(("free", "no-slip")))
    case = Case(density=0.0, friction_angle=0.0, inclination=0.0)

    def solve(panels, denser=1.0):
        dense = replace(snow, density=denser * snow.density)
        scene = Scene(snowpack=dense, ground=ground, net=net)
        task = build_task(case, lambda _: scene, (layout,), COARSE, tuple(panels))
        return run_cases([task])[0]

    return solve, net, spacing


def list_ends(spacing, mid):
    """Every combination of the ends of what is built, with or without mid-anchors."""
    for cut, *sags, ridge, lower in product(CUTS, SAGS, SAGS, STIFFNESSES, STIFFNESSES):
        yield Panel(
            post_spacing=spacing,
            upper=Rope(stiffness=ridge, sag=sags[0]),
            lower=Rope(stiffness=lower, sag=sags[1]),
            cut=cut,
            has_mid_anchors=mid,
        )


def assume_all(spacing, mid):
    return list_panels(
        spacing,
        sags=(None, None),
        stiffnesses=(STIFFNESSES, STIFFNESSES),
        has_mid_anchors=mid,
    )


def take_largest(result):
    """Largest force of each member on any of a case's panels."""
    return {name: result.member_forces[name].value for name in PANEL_QUANTITIES}


def find_excess(seed, mid):
    """Largest force of any panel over that of those that are assumed, by member."""
    solve, _, spacing = draw_case(seed)
    worst = take_largest(solve(assume_all(spacing, mid)))
    found = dict.fromkeys(worst, 0.0)
    for panel in list_ends(spacing, mid):
        one = solve([panel])
        if isinstance(one.panel, PanelForces):
            for name, force in take_largest(one).items():
                found[name] = max(found[name], force / max(worst[name], 10.0))
    return found


@pytest.mark.long
@each("mid", (False, True))
@each("seed", SEEDS)
def test_no_panel_as_it_may_be_built_loads_a_member_more(seed, mid):
    assert max(find_excess(seed, mid).values()) < 1.003


@pytest.mark.parametrize(
    ("stiffness", "breaking", "ends"),
    [
        (18e6, 250e3, (18e6, 18e6)),
        (None, None, (3e6, 150e6)),
        (None, 251e3, (6.275e6, 40.16e6)),
        (None, 17e3, (3e6, 3e6)),
        (None, 1360e3, (34e6, 150e6)),
    ],
)
def test_ends_of_a_ropes_stiffness(stiffness, breaking, ends):
    assert find_stiffness(stiffness, breaking) == pytest.approx(ends)


def test_what_is_given_is_kept_and_the_rest_assumed():
    panels = list_panels(
        3.7,
        sags=(0.043, None),
        stiffnesses=((17e6, 17e6), STIFFNESSES),
        has_mid_anchors=True,
    )
    assert {one.cut for one in panels} == set(CUTS)
    assert {one.upper for one in panels} == {Rope(stiffness=17e6, sag=0.043)}
    assert {one.lower.sag for one in panels} == set(SAGS)
    assert {one.has_mid_anchors for one in panels} == {True}


def test_a_stiffness_that_is_not_asked_about_lies_within_what_is_assumed():
    """Left empty it is never better than as it was typed; nor is a sag of those."""
    (ropes,) = (one for one in SHEETS if one.name == "Ropes")
    (nets,) = (one for one in SHEETS if one.name == "Nets")
    fields = {one.key: one for one in (*ropes.fields, *nets.fields)}
    usual = fields["axial_stiffness"].usual
    assert (1e3 * usual.least, 1e3 * usual.most) == STIFFNESSES
    for key in ("ridge_sag", "lower_sag"):
        assumed = load_assumed()[key]
        assert (assumed.low, assumed.high) == SAGS
        assert fields[key].usual.least <= SAGS[0] < SAGS[1] <= fields[key].usual.most
    for breaking in (21e3, 333e3, 1.4e6):
        low, high = find_stiffness(None, breaking)
        assert low <= max(25.0 * breaking, 3e6)
        assert high >= min(160.0 * breaking, 150e6)


def assume_cut(spacing, sag):
    """Panels of given sags, of which nobody gives the cut."""
    return list_panels(
        spacing,
        sags=(sag, sag),
        stiffnesses=(STIFFNESSES, STIFFNESSES),
        has_mid_anchors=False,
    )


@pytest.mark.parametrize("seed", [305, 340])
def test_an_assumed_panel_that_would_lie_on_the_ground_hangs_as_low_as_it_may(seed):
    """Of given sags the cuts that hang free count: no other is built."""
    solve, spacing = draw_solver(seed)
    panels = assume_all(spacing, False)
    found = solve(panels)
    raised = 0
    for own, panel in zip(found.solved.panels, panels, strict=True):
        if own == panel or own.cut != panel.cut:
            continue
        raised += 1
        assert SAGS[0] <= own.upper.sag <= panel.upper.sag
        assert SAGS[0] <= own.lower.sag <= panel.lower.sag
        assert isinstance(solve([own]), PanelForces)
        assert isinstance(solve([panel]), FailedPanel)
    assert raised
    assert isinstance(solve(assume_cut(spacing, SAGS[1])), PanelForces)
