"""The cable solver: statics, lengths, outcomes. Truth: tests/verification."""

import numpy as np
import pytest

from netdesign.cable.funicular import solve_funicular
from netdesign.outcome import Outcome

HEAD = np.array([0.6, 0.8])  # chord 1
ACROSS = np.array([0.8, -0.6])
STIFFNESS = 40.0


def random_pressure(seed: int, lengths):
    """Uneven forces that all push outward, and some shear."""
    rng = np.random.default_rng(seed)
    shares = rng.uniform(0.2, 1.0, 2 * lengths.size + 1) / lengths.size
    shear = rng.uniform(-0.2, 0.2, shares.size) / lengths.size
    return np.outer(ACROSS, shares) + np.outer(HEAD, shear)


@pytest.mark.parametrize("start", [(1e-6, 0.0), (-5.0, -5.0), (0.0, 300.0)])
def test_result_does_not_depend_on_the_start(start):
    lengths = np.full(6, 1.05 / 6)
    forces = random_pressure(7, lengths)
    from_guess = solve_funicular(forces, lengths, STIFFNESS, HEAD, ACROSS + HEAD)
    other = solve_funicular(forces, lengths, STIFFNESS, HEAD, np.array(start))
    assert other.outcome is Outcome.CONVERGED
    np.testing.assert_allclose(other.curve, from_guess.curve, atol=1e-10)
    np.testing.assert_allclose(other.foot_pull, from_guess.foot_pull, rtol=1e-9)
