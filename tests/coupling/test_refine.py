"""Refinement until two levels agree, on sequences whose limit is known."""

import numpy as np
import pytest

from netdesign.coupling.refine import STEADY_ERROR as MODEL
from netdesign.coupling.refine import refine
from netdesign.coupling.scene import MESH_LEVELS

DIRECTION = np.array([0.6, -0.8])


def run(sizes, accuracy, levels=MESH_LEVELS):
    """Levels that give vectors of these sizes in turn, and the guesses handed on."""
    guesses, values = [], iter(sizes)

    def solve(level, before):
        guesses.append((level, before))
        return next(values)

    states, (estimate,) = refine(
        levels, solve, lambda size: [size * DIRECTION], accuracy, MODEL
    )
    return states, estimate, guesses


def test_stops_where_two_levels_agree():
    states, estimate, _ = run([1.0, 1.1, 1.11, 1.111], accuracy=0.025)
    assert states == [1.0, 1.1, 1.11]
    np.testing.assert_allclose(estimate.vector, 1.11 * DIRECTION, rtol=1e-15)


def test_error_is_the_last_step_and_a_floor():
    """Nine tenths of the step; less floor on each level from the third."""
    _, estimate, _ = run([1.0, 1.1], accuracy=0.1, levels=MESH_LEVELS[:2])
    assert estimate.error == pytest.approx(0.09 + MODEL.floor * 1.1, rel=1e-12)
    _, estimate, _ = run([1.0, 1.1, 1.11], accuracy=0.02)
    floor = 0.8 * MODEL.floor
    assert estimate.error == pytest.approx(0.009 + floor * 1.11, rel=1e-12)
    _, estimate, _ = run([1.0, 1.1, 1.2, 1.21], accuracy=0.02)
    floor = 0.64 * MODEL.floor
    assert estimate.error == pytest.approx(0.009 + floor * 1.21, rel=1e-12)


def test_error_is_that_of_the_vector():
    """A force that turns without changing its size has an error too."""
    vectors = iter([np.array([1.0, 0.0]), np.array([0.0, 1.0])])
    _, (estimate,) = refine(
        MESH_LEVELS[:2], lambda *_: next(vectors), lambda v: [v], 0.1, MODEL
    )
    assert estimate.error == pytest.approx(0.9 * np.sqrt(2.0) + MODEL.floor, rel=1e-12)


def test_finest_level_says_when_it_is_not_enough():
    states, estimate, _ = run([1.0, 2.0, 3.0, 4.0, 5.0], accuracy=0.01)
    assert len(states) == len(MESH_LEVELS)
    assert estimate.error > 0.8


def test_every_vector_has_to_be_accurate():
    """The second still moves when the first has come to rest."""
    pairs = iter([(1.0, 1.0), (1.0, 2.0), (1.0, 2.0), (1.0, 2.0)])
    states, estimates = refine(
        MESH_LEVELS,
        lambda *_: next(pairs),
        lambda pair: [size * DIRECTION for size in pair],
        0.01,
        MODEL,
    )
    assert len(states) == 3
    assert len(estimates) == 2


def test_nan_never_agrees():
    states, _, _ = run([1.0, *(4 * [np.nan])], accuracy=0.1)
    assert len(states) == len(MESH_LEVELS)


def test_each_level_starts_from_the_one_before():
    sizes = [1.0, 2.0, 3.0, 4.0, 5.0]
    _, _, guesses = run(sizes, accuracy=0.01)
    assert guesses == list(zip(MESH_LEVELS, [None, *sizes[:-1]], strict=True))
