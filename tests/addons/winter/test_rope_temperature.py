"""Ropes that the day's air cools, against histories of the net that they are."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.winter.measured import find_amplitude, find_half_time, find_swing
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.snow.ground import GroundLaw
from tests.addons.winter.histories import follow_lengths
from tests.addons.winter.made_up_row import loaded

DAY = 86400.0
COOLED = 10.0  # [K]
ALPHA = 1.2e-5  # of steel [1/K]
AT_ONCE = 2e7 * ALPHA * COOLED  # [N/m]
NO_SLIP = GroundLaw(kind="no-slip")
SLIDES = GroundLaw(kind="sliding", slip_length=4.7)


@pytest.mark.parametrize(
    ("density", "thickness", "ground"),
    [(300.0, 3.0, NO_SLIP), (310.0, 1.6, NO_SLIP), (330.0, 2.0, SLIDES)],
)
def test_sudden_cold_against_a_history(density, thickness, ground):
    """ES alpha dT at once, half of it at (Y8), and the steady net's own in the end."""
    scene = loaded(density, thickness, ground)
    times = np.concatenate([[1e-6], np.geomspace(1e-4, 0.3, 30)])
    warm = follow_lengths(scene, times, np.ones(times.size))
    cold = follow_lengths(scene, times, np.full(times.size, 1.0 - ALPHA * COOLED))
    more = cold - warm
    assert more[0] == pytest.approx(AT_ONCE, rel=0.05)
    half = find_half_time(scene) / scene.time_scale
    share = np.interp(math.log(half), np.log(times), more[:, 0]) / AT_ONCE
    assert share == pytest.approx(0.5, abs=0.1)
    slack = 1.03 * (1.0 - ALPHA * COOLED) - 1.0
    steady = [
        solve_steady(one, SolverSettings(accuracy=2e-3), on_failure="raise").foot.size
        for one in (scene, replace(scene, net=replace(scene.net, slack=slack)))
    ]
    assert more[-1, 0] == pytest.approx(steady[1] - steady[0], abs=0.02 * AT_ONCE)


@pytest.mark.parametrize(
    ("density", "thickness", "ground"), [(300.0, 3.0, NO_SLIP), (400.0, 3.0, SLIDES)]
)
def test_day_after_day_against_a_history(density, thickness, ground):
    """Three days of a wave of 5 K; the net's pull swings by (Y9) within a quarter."""
    scene = loaded(density, thickness, ground)
    times = np.arange(1, 73) / 24.0
    wave = ALPHA * 5.0 * np.sin(2.0 * np.pi * times)
    moments = times * DAY / scene.time_scale
    swing = follow_lengths(scene, moments, 1.0 + wave)
    swing -= follow_lengths(scene, moments, np.ones(times.size))
    foot = np.ptp(swing[-24:, 0]) / 2.0
    assert find_swing(scene, 5.0) == pytest.approx(foot, rel=0.25)
    # ahead of the cold, as snow that yields is
    assert np.argmax(swing[-24:, 0]) < np.argmin(wave[-24:])


def test_slow_snow_keeps_all_of_it_and_fast_snow_nothing():
    scene = loaded(400.0, 3.0, NO_SLIP)
    stiff, soft = (
        replace(scene, fluidity=factor * scene.creep_fluidity) for factor in (1e-4, 1e4)
    )
    assert find_swing(stiff, 7.0) == pytest.approx(0.7 * AT_ONCE, rel=1e-3)
    assert find_swing(soft, 7.0) < 1e-3 * AT_ONCE


def test_free_ground_lets_the_pull_go_first():
    times = [find_half_time(loaded(300.0, 2.0, g)) for g in (NO_SLIP, SLIDES)]
    free = find_half_time(loaded(300.0, 2.0, GroundLaw()))
    assert times[0] > times[1] > free > 0.0


def test_amplitude_is_half_the_range_from_the_day_before_to_the_day_after():
    read = [(3.5, 260.0), (4.5, 268.0), (5.5, 262.0), (6.5, 285.0)]
    assert find_amplitude(read, 4.5) == 4.0
    assert find_amplitude(read, 5.5) == 11.5
    assert find_amplitude(read, 9.0) is None
    assert find_amplitude(read, 2.6) is None
