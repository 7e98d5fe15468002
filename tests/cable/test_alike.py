"""Cables alike: each pulls as if it were solved alone."""

import numpy as np
import pytest

from netdesign.cable.alike import build_alike, find_pulls
from netdesign.cable.funicular import solve_funicular
from netdesign.outcome import Outcome

STIFFNESS = 40.0


def draw_cables(seed):
    """Forces, shares, lengths and ends of nine cables."""
    rng = np.random.default_rng(seed)
    shares = rng.uniform(0.3, 1.0, 11)
    forces = rng.uniform(-0.1, 0.9, (2, 23)) * [[1.0], [-0.2]] / 11
    lengths = rng.uniform(0.7, 1.3, 9)
    ends = np.array([rng.uniform(0.1, 0.6, 9), rng.uniform(0.5, 1.0, 9)])
    return forces, shares / shares.sum(), lengths, ends


@pytest.mark.parametrize(
    "start", [(1e-3, 2e-3), (0.7, 0.6), (-5.0, -5.0), (0.0, 300.0)]
)
@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_each_pulls_as_if_alone(seed, start):
    forces, shares, lengths, ends = draw_cables(seed)
    cables = build_alike(forces, shares, STIFFNESS)
    guess = np.repeat(np.array(start)[:, None], 9, axis=1)
    pulls = find_pulls(cables, ends / lengths, guess)
    assert pulls is not None
    for pull, length, end in zip(pulls.T, lengths, ends.T, strict=True):
        alone = solve_funicular(forces, shares * length, STIFFNESS, end, pull + 0.1)
        assert alone.outcome is Outcome.CONVERGED
        np.testing.assert_allclose(pull, alone.pull, atol=1e-10)
        foot = pull + cables.to_foot
        np.testing.assert_allclose(foot, alone.foot_pull, atol=1e-10)
        head = cables.load - foot
        np.testing.assert_allclose(head, alone.head_pull, atol=1e-10)


def test_cable_without_an_end_finds_no_pull():
    forces, shares, lengths, ends = draw_cables(5)
    ends[0, 4] = np.nan
    guess = np.ones((2, 9))
    assert (
        find_pulls(build_alike(forces, shares, STIFFNESS), ends / lengths, guess)
        is None
    )
