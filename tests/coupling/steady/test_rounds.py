"""Rounds of flow and net: when their derivative is taken out."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.steady import rounds
from netdesign.coupling.steady.rounds import couple
from netdesign.coupling.steady.solve import _build_problem

SETTINGS = SolverSettings(accuracy=0.005)


@pytest.fixture
def smooth(a_scene):
    """A smooth net on the first mesh: all its snow slips."""
    scene = a_scene(friction_deg=0.0, inclination_deg=27.0, slack=0.013)
    return _build_problem(scene, MESH_LEVELS[0])


def test_snow_that_slips_everywhere_needs_no_second_plain_round(smooth, monkeypatch):
    """The same net as after rounds that wait until one has gained little."""
    at_once = couple(smooth, SETTINGS, None, is_first=True)
    monkeypatch.setattr(rounds, "_MOST_SLIPS", 1.0)
    waiting = couple(smooth, SETTINGS, None, is_first=True)
    assert at_once.rounds < waiting.rounds
    assert at_once.tangent is not None
    one, other = (end.last.net.cable.foot_pull for end in (at_once, waiting))
    np.testing.assert_allclose(one, other, atol=2e-3 * np.hypot(*other))


def test_a_net_far_from_rest_takes_plain_rounds_first(smooth, monkeypatch):
    """There the derivative may lead astray."""
    taken = []
    correct = rounds.correct_round

    def record(problem, played, *given):
        taken.append(played.moved)
        return correct(problem, played, *given)

    monkeypatch.setattr(rounds, "correct_round", record)
    couple(smooth, SETTINGS, None, is_first=True)
    first = taken[0]
    taken.clear()
    monkeypatch.setattr(rounds, "_NEAR_REST", 0.9 * first)
    couple(smooth, SETTINGS, None, is_first=True)
    assert not taken or taken[0] < 0.9 * first


def test_finer_meshes_wait_for_a_round_that_gains_little(smooth):
    """A derivative costs most there; the net comes from a coarser mesh."""
    coarse = couple(smooth, SETTINGS, None, is_first=True)
    assert not rounds._is_slow([_a_round(coarse, 3e-3)], coarse)
    assert rounds._is_slow([_a_round(coarse, 3e-3)], None)
    assert rounds._is_slow([_a_round(coarse, 3e-3), _a_round(coarse, 1e-3)], coarse)


def _a_round(end, moved):
    curve = end.last.net.cable.curve
    return replace(end.last, curve=curve, image=curve + moved)
