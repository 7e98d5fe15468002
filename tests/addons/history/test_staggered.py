"""The paper's exchange: it oscillates, its drag is stated, and what it refuses."""

import math
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from netdesign.addons.history import staggered
from netdesign.addons.history.settings import StaggeredSettings, TransientSettings
from netdesign.addons.history.staggered import (
    add_drag,
    advance_increment,
    measure_drag,
    run_exchange,
    solve_staggered,
)
from netdesign.addons.history.transient import run_history
from netdesign.coupling.interface import Estimate
from netdesign.coupling.solution import FailedSolution
from netdesign.outcome import SolveError
from netdesign.snow.ground import build_ground_from_glide_factor

SETTINGS = StaggeredSettings(base_drag=0.1, horizon=0.02)


def foot(moments):
    return np.array([np.hypot(*moment.foot) for moment in moments])


def test_increments_without_a_solution_fail_with_a_reason(a_scene, monkeypatch):
    without = partial(advance_increment, max_rounds=0)
    monkeypatch.setattr(staggered, "advance_increment", without)
    result = solve_staggered(a_scene(), SETTINGS)
    assert isinstance(result, FailedSolution)
    assert "a shorter step may" in str(result.reason)


# --- fault 8: what the drag holds is in the stated error (K9) ---------------------


def test_the_drag_counts_whole_at_an_end_that_pulls_less_than_the_sum():
    """By hand: D = 2 of a weight 10 leaves 8; ends of 9.6 and 4 get 2.4 and 2."""
    for vector, more in (((0.0, 9.6), 2.4), ((4.0, 0.0), 2.0)):
        pull = add_drag(Estimate(np.array(vector), 0.1), 2.0, 8.0)
        assert pull.error == pytest.approx(0.1 + more)


def test_a_drag_that_holds_the_snow_alone_is_no_result():
    with pytest.raises(SolveError, match="drag"):
        add_drag(Estimate(np.ones(2), 0.0), 2.0, 0.0)


@pytest.mark.parametrize(
    "seed", [0, *(pytest.param(seed, marks=pytest.mark.long) for seed in (1, 2))]
)
def test_the_stated_error_holds_what_the_drag_took_from_the_net(a_scene, seed):
    """Drawn drags, slopes, lengths: the last pulls against a history without drag."""
    rng = np.random.default_rng([61, 8, seed])
    scene = a_scene(
        slope_deg=rng.uniform(32.0, 48.0),
        length_m=rng.uniform(8.0, 16.0),
        slack=rng.uniform(0.02, 0.08),
    )
    drag = float(rng.uniform(0.15, 0.3))
    settings = StaggeredSettings(base_drag=drag, horizon=drag, start="sagged")
    run = run_exchange(scene, settings)
    free = run_history(
        scene, settings.size, TransientSettings(start="sagged"), settings.horizon
    ).moments[-1]
    last = run.moments[-1]
    held, count = replace(run, moments=(last,)), 0
    for pull, bare in ((last.foot, free.foot), (last.head, free.head)):
        error = add_drag(Estimate(pull, 0.0), *measure_drag(held)).error
        off = math.dist(pull, bare)
        count += off > 0.02 * math.hypot(*pull)
        assert off <= error + 0.005 * math.hypot(*pull), (seed, off, error)
    assert count, "a drag that hardly matters shows nothing"


def test_a_ground_with_a_law_of_its_own_takes_no_drag_into_the_error(a_scene):
    scene = replace(a_scene(), ground=build_ground_from_glide_factor(1.2, 1.0))
    settings = replace(SETTINGS, start="steady")
    pull = solve_staggered(scene, settings).foot
    assert pull.error < 0.01 * pull.size
