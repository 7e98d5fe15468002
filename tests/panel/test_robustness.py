"""Random rows over wide ranges: each is solved, or lies on the ground and says so.

The suite takes a drawn few; ``python -m pytest -m robustness`` takes a thousand.
"""

from collections import Counter

import numpy as np
import pytest

from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import FailedSolution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.outcome import ModelError
from netdesign.panel.inputs import CUTS, Panel, Rope
from netdesign.panel.solve import FailedPanel, solve_panel
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from tests.scenes import build_scene

QUICK = SolverSettings(accuracy=0.1)


def draw_ground(rng, thickness):
    kind = rng.integers(3)
    if kind == 0:
        return build_ground_from_glide_factor(rng.uniform(1.2, 2.4), thickness)
    return GroundLaw(kind="free" if kind == 1 else "no-slip")


def draw_scene(rng):
    thickness = rng.uniform(1.5, 4.5)
    return build_scene(
        thickness_m=thickness,
        slope_deg=rng.uniform(28, 50),
        density_kg_m3=rng.uniform(200, 500),
        ground=draw_ground(rng, thickness),
        inclination_deg=rng.uniform(0, 40),
        stiffness_kN_per_m=10 ** rng.uniform(3.3, 5),
        slack=rng.uniform(0, 0.15),
        friction_deg=rng.uniform(10, 45),
    )


def draw_rope(rng):
    return Rope(stiffness=10 ** rng.uniform(6, 9), sag=rng.uniform(0, 0.15))


def draw_panel(rng):
    return Panel(
        post_spacing=rng.uniform(2, 6),
        lower=draw_rope(rng),
        upper=draw_rope(rng),
        cut=str(rng.choice(CUTS)),
        has_mid_anchors=bool(rng.random() < 0.25),
    )


def end_rows(seed, count):
    """How many rows ended in which way; those without a section are drawn anew."""
    rng, ends = np.random.default_rng(seed), Counter()
    while ends.total() < count:
        try:
            scene = draw_scene(rng)
        except ModelError:
            continue
        panel = draw_panel(rng)
        section = solve_steady(scene, QUICK)
        if isinstance(section, FailedSolution):
            continue
        ends[name_end(solve_panel(section, panel))] += 1
    return ends


def name_end(ended):
    if not isinstance(ended, FailedPanel):
        return "solved" if ended.balance <= 1e-8 else "out of balance"
    return ended.reason.key


@pytest.mark.parametrize("seed", [3, 41])
def test_a_few_rows(seed):
    ends = end_rows(seed, 20)
    assert set(ends) <= {"solved", "panel.lies_on_ground"}, ends
    assert ends["solved"] >= 15


@pytest.mark.robustness
@pytest.mark.parametrize("seed", range(100, 110))
def test_a_thousand_rows(seed):
    ends = end_rows(seed, 100)
    assert set(ends) <= {"solved", "panel.lies_on_ground", "panel.no_net_left"}, ends
    assert ends["solved"] >= 85
