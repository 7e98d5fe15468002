"""Whole scenes by the compiled core against those in NumPy."""

import math
from contextlib import suppress
from dataclasses import replace

import pytest

from netdesign.addons.evidence.benchmark.scenes import (
    build_tables,
    draw_scene,
    load_scenes,
)
from netdesign.core.library import find_core
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.outcome import ModelError

pytestmark = pytest.mark.skipif(find_core() is None, reason="no compiled core here")

SETTINGS = SolverSettings(accuracy=0.02)


def assert_equal(scene, in_numpy):
    """Same outcome; forces to 1e-8, or a tenth of the error where contacts branch."""
    found = solve_steady(scene, SETTINGS)
    expected = in_numpy(solve_steady, scene, SETTINGS)
    if found.outcome is not expected.outcome:
        assert hangs_on_rounding(scene, in_numpy)
        return
    if not isinstance(expected, Solution):
        return
    for one, other in ((found.foot, expected.foot), (found.head, expected.head)):
        apart = math.hypot(one.x - other.x, one.y - other.y)
        assert apart <= max(1e-8 * other.size, other.error / 10.0)


def hangs_on_rounding(scene, in_numpy):
    """The outcome in NumPy is another for a net stiffer by some 1e-10."""
    outcomes = set()
    for number in range(12):
        stiffness = scene.net.stiffness_per_m * (1.0 + number * 1e-10)
        close = replace(scene, net=replace(scene.net, stiffness_per_m=stiffness))
        outcomes.add(in_numpy(solve_steady, close, SETTINGS).outcome)
    return len(outcomes) > 1


@pytest.mark.parametrize("name", ["slipping-part", "dense-firn", "weak-base"])
def test_named_scenes(name, in_numpy):
    assert_equal(load_scenes((name,))[name], in_numpy)


@pytest.mark.slow
def test_random_scenes(in_numpy):
    """``pytest -m slow tests/core/test_equal_scenes.py``: some 3 minutes."""
    compared = 0
    for number in range(1000):
        with suppress(ModelError):
            scene = build_tables(draw_scene(5, number))
            assert_equal(scene, in_numpy)
            compared += 1
    assert compared > 500
