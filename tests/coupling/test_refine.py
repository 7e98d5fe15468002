"""Refinement until two levels agree, on sequences whose limit is known."""

import numpy as np
import pytest

from netdesign.coupling.interface import STEADY_ERROR as MODEL
from netdesign.coupling.interface import Looseness, refine
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


def test_error_is_the_last_step_and_a_floor():
    """Nine tenths of the step; less floor on each level from the third."""
    _, estimate, _ = run([1.0, 1.1], accuracy=0.1, levels=MESH_LEVELS[:2])
    assert estimate.error == pytest.approx(0.09 + MODEL.floor * 1.1, rel=1e-12)
    _, estimate, _ = run([1.0, 1.1, 1.18], accuracy=0.07, levels=MESH_LEVELS[:3])
    floor = MODEL.floor_ratio * MODEL.floor
    assert estimate.error == pytest.approx(0.072 + floor * 1.18, rel=1e-12)


@pytest.mark.parametrize("step", [0.0, 0.0137, 0.0449])
def test_meshes_that_agree_by_accident_keep_a_part_of_the_last_difference(step):
    """Even if two meshes in turn give the very same number."""
    found = run([1.0, 1.1, 1.1 + step], accuracy=1e-4, levels=MESH_LEVELS[:3])[1]
    size = 1.1 + step
    assert found.error == pytest.approx(
        0.0405 + MODEL.floor_ratio * MODEL.floor * size, rel=1e-12
    )


def test_snow_that_slips_states_a_third_more():
    """Of the step: the singular flow at the net's ends is sharper there."""
    meshes = [[1.0 * DIRECTION], [1.1 * DIRECTION]]
    (held,), (half,), (loose,) = (
        MODEL.estimate(meshes, Looseness(slip=slip)) for slip in (0.0, 0.5, 1.0)
    )
    assert loose.error - held.error == pytest.approx(0.03, rel=1e-12)
    assert half.error == pytest.approx((held.error + loose.error) / 2.0, rel=1e-12)


def test_snow_that_lifts_off_its_ground_states_more():
    """Half the step and 0.3 % of the pull: the place where it lifts goes with nodes."""
    meshes = [[1.0 * DIRECTION], [1.1 * DIRECTION]]
    (lies,), (lifts,) = (
        MODEL.estimate(meshes, Looseness(lifts=lifts)) for lifts in (False, True)
    )
    assert lifts.error - lies.error == pytest.approx(0.05 + 0.0033, rel=1e-12)


def test_what_no_mesh_sees_falls_slower_where_snow_slips_or_lifts():
    meshes = [[1.1 * DIRECTION]] * 5
    for held, share in (
        (Looseness(), 0.5**3 * 0.0025),
        (Looseness(slip=0.4), 0.62**3 * 0.0025),
        (Looseness(slip=0.4, lifts=True), 0.8**3 * 0.0055),
    ):
        (found,) = MODEL.estimate(meshes, held)
        assert found.error == pytest.approx(share * 1.1, rel=1e-12)


def test_error_is_that_of_the_vector():
    """A force that turns without changing its size has an error too."""
    vectors = iter([np.array([1.0, 0.0]), np.array([0.0, 1.0])])
    _, (estimate,) = refine(
        MESH_LEVELS[:2], lambda *_: next(vectors), lambda v: [v], 0.1, MODEL
    )
    assert estimate.error == pytest.approx(0.9 * np.sqrt(2.0) + MODEL.floor, rel=1e-12)
