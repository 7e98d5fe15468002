"""Cables alike: each reaches its end as if it were solved alone."""

import numpy as np
import pytest

from netdesign.cable.funicular import build_alike, reach_ends, solve_funicular
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


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_each_reaches_its_end_as_if_alone(seed):
    forces, shares, lengths, ends = draw_cables(seed)
    cables = build_alike(forces, shares, STIFFNESS)
    alone = [
        solve_funicular(forces, shares * length, STIFFNESS, end, np.array([0.7, 0.6]))
        for length, end in zip(lengths, ends.T, strict=True)
    ]
    assert all(one.outcome is Outcome.CONVERGED for one in alone)
    pulls = np.array([one.pull for one in alone]).T
    reached, _ = reach_ends(cables, pulls)
    np.testing.assert_allclose(reached, ends / lengths, atol=1e-9)
    for one, pull in zip(alone, pulls.T, strict=True):
        foot = pull + cables.to_foot
        np.testing.assert_allclose(foot, one.foot_pull, atol=1e-10)
        np.testing.assert_allclose(cables.load - foot, one.head_pull, atol=1e-10)
