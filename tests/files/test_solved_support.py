"""Support of a solved scene against the panel's own functions and plain statics."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.scene import SolverSettings
from netdesign.files.cases import resolve_support, write_support
from netdesign.files.scene import SceneSupport
from netdesign.files.solution import write_solution_document
from netdesign.panel.inputs import Panel, Rope
from netdesign.panel.row_end import compute_end_forces
from netdesign.panel.solve import solve_panel
from netdesign.structure.anchors import compute_anchor_forces
from netdesign.structure.layout import SupportLayout, place_support

SETTINGS = SolverSettings(accuracy=0.1)
LAYOUT = SupportLayout(
    post_spacing=3.6, uphill_anchor_distance=3.3, downhill_anchor_distance=2.7
)
PANEL = Panel(
    post_spacing=3.6,
    lower=Rope(stiffness=21e6, sag=0.037),
    upper=Rope(stiffness=16e6, sag=0.062),
    cut="upper",
)


@pytest.fixture
def section(solved):
    return solved(inclination_deg=30.0, slack=0.03, ground="no-slip")


def write(section, **given):
    support = SceneSupport(layout=LAYOUT, **given)
    solved = resolve_support(section, SETTINGS, support)
    document = write_solution_document(
        section, SETTINGS, 0.1, support=write_support(solved, support, "en")
    )
    return document["support"], solved


def kilonewtons(force):
    return [force[0] / 1e3, force[1] / 1e3]


def test_plain_forces_are_those_of_the_pulls_times_the_spacing(section):
    written, _ = write(section)
    points = place_support(LAYOUT, tuple(section.scene.net.head))
    plain = compute_anchor_forces(
        points,
        foot_pull_per_m=(section.foot.x, section.foot.y),
        head_pull_per_m=(section.head.x, section.head.y),
        post_spacing=3.6,
    )
    forces = written["plain"]
    assert forces["foot_anchor_kN"] == pytest.approx(
        forces["foot_kN"]["size"], rel=1e-14
    )
    assert forces["foot_kN"]["size"] == pytest.approx(3.6e-3 * section.foot.size)
    assert forces["head_kN"]["y"] == pytest.approx(3.6e-3 * section.head.y)
    assert forces["post_kN"] == pytest.approx(plain.head.post_compression / 1e3)
    assert forces["error_kN"]["foot_anchor"] >= 3.6e-3 * section.foot.error
    assert written["panel"] is None
    assert written["row_end"] is None
    assert "reason" not in written


@pytest.mark.parametrize("mid", [False, True])
def test_panel_and_row_end_are_those_of_their_functions(section, mid):
    panel = replace(PANEL, has_mid_anchors=mid)
    angle = math.radians(41.0)
    written, _ = write(section, panel=panel, end_guy_angle=angle)
    solved = solve_panel(section, panel)
    points = place_support(LAYOUT, tuple(section.scene.net.head))
    end = compute_end_forces(solved, points, angle)
    forces = written["panel"]
    found = [forces["foot_kN"]["x"], forces["foot_kN"]["y"]]
    np.testing.assert_allclose(found, kilonewtons(solved.foot), rtol=1e-9)
    assert ("mid_foot_kN" in forces) is mid
    ropes = forces["lower_rope"]["H_kN"], forces["upper_rope"]["T_kN"]
    np.testing.assert_allclose(
        ropes, kilonewtons((solved.lower.along, solved.upper.tension)), rtol=1e-9
    )
    assert forces["mid_head_drop_m"] == -solved.upper.mid_displacement[1] > 0.0
    row_end = written["row_end"]
    foot = [row_end["foot_kN"][part] * 1e3 for part in "xyz"]
    np.testing.assert_allclose(foot, end.foot, rtol=1e-9)
    assert row_end["end_guy_kN"] == pytest.approx(end.guy_tension / 1e3)
    assert row_end["post_kN"] == pytest.approx(end.post_compression / 1e3)


def test_a_panel_that_fails_leaves_its_reason(section):
    low = Rope(stiffness=2e7, sag=0.3)
    panel = replace(PANEL, lower=low, upper=low, post_spacing=9.3, cut="fitted")
    written, _ = write(section, panel=panel)
    assert written["plain"]["post_kN"] > 0.0
    assert written["panel"] is None
    assert written["reason"]
