"""Panels at rest: in balance, what is refused and by which name."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.outcome import Outcome
from netdesign.panel import solve as solving
from netdesign.panel.inputs import Panel, Rope
from netdesign.panel.solve import STATIONS, FailedPanel, PanelSolution, solve_panel

PANEL = Panel(
    post_spacing=3.8,
    lower=Rope(stiffness=21e6, sag=0.037),
    upper=Rope(stiffness=16e6, sag=0.062),
    cut="upper",
)


def assert_fails(failed, outcome, told):
    assert isinstance(failed, FailedPanel)
    assert failed.outcome is outcome
    assert told in str(failed.reason)


@pytest.fixture
def section(solved):
    return solved(inclination_deg=30.0, slack=0.03, ground="no-slip")


@pytest.mark.parametrize("mid", [False, True])
def test_result_is_whole_and_in_balance(section, mid):
    solved = solve_panel(section, replace(PANEL, has_mid_anchors=mid))
    assert isinstance(solved, PanelSolution)
    assert solved.outcome is Outcome.CONVERGED
    assert solved.balance < 1e-8
    both = np.array(solved.foot) + solved.mid_foot + solved.head
    load = np.array([section.foot.x + section.head.x, section.foot.y + section.head.y])
    np.testing.assert_allclose(both, 3.8 * load, rtol=1e-9)
    assert solved.stations.shape == (STATIONS + 1,)
    assert solved.curves.shape == (STATIONS + 1, *section.net_curve.shape)
    assert solved.stations[-1] == 1.9
    assert (solved.mid_foot == (0.0, 0.0)) is not mid


def test_net_on_the_ground_in_mid_panel_is_named(solved):
    """Much slack, an inclined net, and ropes cut to fit: it would hang too low."""
    low = solved(inclination_deg=38.0, slack=0.07, ground="no-slip")
    panel = replace(PANEL, post_spacing=5.9, cut="uniform")
    panel = replace(
        panel,
        lower=replace(panel.lower, sag=0.0),
        upper=replace(panel.upper, sag=0.15),
    )
    failed = solve_panel(low, panel)
    assert_fails(failed, Outcome.OUT_OF_VALIDITY, "the net would lie on the ground")


def test_soft_ropes_that_pass_each_other_on_the_way(solved):
    """A strip then hangs from nothing; shorter steps find the way."""
    low = solved(thickness_m=1.7, inclination_deg=3.0, slack=0.06, slope_deg=47.0)
    panel = Panel(
        post_spacing=5.9,
        lower=Rope(stiffness=1.2e6, sag=0.05),
        upper=Rope(stiffness=2.4e6, sag=0.05),
        cut="fitted",
    )
    soft = solve_panel(low, panel)
    assert isinstance(soft, PanelSolution)
    assert soft.balance < 1e-8


def test_cut_without_net_is_a_result(section):
    slack = Rope(stiffness=2e7, sag=0.3)
    panel = Panel(post_spacing=9.3, lower=slack, upper=slack, cut="fitted")
    assert_fails(solve_panel(section, panel), Outcome.OUT_OF_VALIDITY, "next to no net")


def derive_spoilt(share):
    """Derivatives that tell nothing."""
    derive = solving.derive_missing
    return lambda *given: share * derive(*given)


LOST = (Outcome.NO_EQUILIBRIUM, "are not found")


@pytest.mark.parametrize(
    ("name", "spoilt", "outcome", "told"),
    [
        ("_MOST_STEPS", 2, Outcome.MAX_ITERATIONS, ""),
        ("derive_missing", derive_spoilt(0.0), *LOST),
        ("derive_missing", derive_spoilt(math.nan), *LOST),
        # a loose end of the steps shows in the moments
        ("_STILL", 1e-3, Outcome.BALANCE_VIOLATED, "balance misses"),
    ],
)
def test_what_the_steps_do_not_find_is_a_reason(
    section, monkeypatch, name, spoilt, outcome, told
):
    if callable(spoilt):
        monkeypatch.setenv("NETDESIGN_CORE", "numpy")  # the core has its own
    monkeypatch.setattr(solving, name, spoilt)
    assert_fails(solve_panel(section, PANEL), outcome, told)
