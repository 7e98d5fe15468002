"""Forces by the panel between posts: in one case, over a grid, in a search."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.envelope import run as running
from netdesign.envelope.extremes import describe_gap, find_extremes
from netdesign.envelope.panel_forces import PANEL_QUANTITIES, PanelForces
from netdesign.envelope.ranges import Case
from netdesign.envelope.rows import refine_settings
from netdesign.envelope.run import build_task, run_cases
from netdesign.envelope.search import run_grid, search_rows
from netdesign.outcome import Outcome
from netdesign.panel.solve import FailedPanel
from netdesign.solving.runner import Runner
from netdesign.structure.members import (
    CARRYING_MEMBERS,
    NetPart,
    RopeForce,
    name_in_panel,
)
from netdesign.words.message import say
from tests.envelope.tasks import build_row, draw_case
from tests.solving.small_scene import COARSE, LAYOUT, PANEL, build_scene

TASK = build_row((251.0, 397.0), (16.0, 44.0), panels=(PANEL,))


def solve(case, panel=PANEL, settings=COARSE):
    panels = (panel,) if panel else ()
    (result,) = run_cases([build_task(case, build_scene, (LAYOUT,), settings, panels)])
    return result


@pytest.fixture(scope="module")
def found(runner):
    finer = refine_settings(replace(COARSE, levels=MESH_LEVELS[:4]))
    (one,) = search_rows([replace(TASK, confirmed_by=finer)], runner)
    return one


@pytest.mark.parametrize("mid", [False, True])
def test_a_case_has_both_sets_and_the_panel_carries_the_same_load(mid):
    result = solve(
        draw_case(np.random.default_rng(5)), replace(PANEL, has_mid_anchors=mid)
    )
    forces, panel = result.member_forces, result.panel
    assert isinstance(panel, PanelForces)
    assert set(forces) == {*CARRYING_MEMBERS, NetPart.MESH, *PANEL_QUANTITIES}
    for band in forces.values():
        assert 0.0 <= band.low <= band.value <= band.high
    solution = panel.solution
    load = np.sum([solution.foot, solution.mid_foot, solution.head], axis=0)
    state = result.solution
    pulls = [state.foot.x + state.head.x, state.foot.y + state.head.y]
    np.testing.assert_allclose(load, 3.5 * np.array(pulls), rtol=1e-8)
    assert forces[RopeForce.LOWER_ALONG].value == solution.lower.along
    assert forces[RopeForce.UPPER_TENSION].value == solution.upper.tension
    feet = max(math.hypot(*solution.foot), math.hypot(*solution.mid_foot))
    assert forces["panel_foot_anchor"].value == pytest.approx(feet, rel=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_bands_hold_the_forces_on_finer_meshes(seed):
    """The error of the section's pulls covers that of panel, ropes and mesh."""
    case = draw_case(np.random.default_rng(900 + seed))
    coarse = solve(case)
    fine = solve(case, settings=SolverSettings(accuracy=2e-3))
    for name in (NetPart.MESH, *PANEL_QUANTITIES):
        band, value = coarse.member_forces[name], fine.member_forces[name].value
        assert band.low <= value <= band.high, name


@pytest.fixture
def failing(monkeypatch):
    """No panel in heavy snow."""
    resolve = running.resolve_panels

    def spoil(panels, net, state):
        if state.foot.size > limit:
            return FailedPanel(
                outcome=Outcome.OUT_OF_VALIDITY,
                reason=say("panel.lies_on_ground", depth=state.foot.size / limit),
            )
        return resolve(panels, net, state)

    limit = solve(Case(density=330.0, friction_angle=0.5, inclination=0.5), None)
    limit = limit.solution.foot.size
    monkeypatch.setattr(running, "resolve_panels", spoil)


def test_a_panel_that_fails_leaves_a_gap_and_the_forces_of_the_section(failing, found):
    (one,) = search_rows([TASK], Runner())
    told = str(one.gap)
    assert "have no forces by the panel between posts" in told
    assert told.count("lie on the ground") == 1
    for member in CARRYING_MEMBERS:
        whole = found.extremes[member].force.value
        assert one.extremes[member].force.value == pytest.approx(whole, rel=0.01)
        assert math.isfinite(one.extremes[member].widened.high)
        assert math.isfinite(one.extremes[name_in_panel(member)].widened.high)


def test_a_panel_that_fails_leaves_a_gap_in_a_grid(failing):
    results, _ = run_grid(TASK, {"density": 3, "friction_angle": 3}, Runner())
    assert 0 < sum(isinstance(r.panel, FailedPanel) for r in results) < 9
    assert "by the panel between posts" in str(describe_gap(results))
    assert describe_gap([r for r in results if "panel_post" in r.member_forces]) is None
    heavy = max(results, key=lambda one: one.case.density)
    assert "panel_post" not in heavy.member_forces
    found = find_extremes(results)
    assert found["post"].governing.case.density == 397.0
    assert found["panel_post"].governing.case.density < 397.0
