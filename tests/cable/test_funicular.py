"""The cable solver: statics, lengths, outcomes. Truth: tests/verification."""

import numpy as np
import pytest

from netdesign.cable.funicular import solve_funicular
from netdesign.outcome import Outcome
from tests.each import each

HEAD = np.array([0.6, 0.8])  # chord 1
ACROSS = np.array([0.8, -0.6])
STIFFNESS = 40.0


def uniform_forces(load, lengths):
    """Consistent nodal forces of a load (2,) per unstressed length."""
    shares = np.zeros(2 * lengths.size + 1)
    shares[1::2] = 4.0 / 6.0 * lengths
    shares[:-1:2] += lengths / 6.0
    shares[2::2] += lengths / 6.0
    return np.outer(load, shares)


def random_pressure(seed: int, lengths):
    """Uneven forces that all push outward, and some shear."""
    rng = np.random.default_rng(seed)
    shares = rng.uniform(0.2, 1.0, 2 * lengths.size + 1) / lengths.size
    shear = rng.uniform(-0.2, 0.2, shares.size) / lengths.size
    return np.outer(ACROSS, shares) + np.outer(HEAD, shear)


@each("slack", [0.0, 0.02, 0.3])
@each("seed", [1, 2, 3])
def test_equilibrium_of_the_whole(seed, slack):
    lengths = np.diff(np.linspace(0.0, 1.0, 9) ** 1.5) * (1.0 + slack)
    forces = random_pressure(seed, lengths)
    cable = solve_funicular(forces, lengths, STIFFNESS, HEAD, ACROSS + HEAD)
    assert cable.outcome is Outcome.CONVERGED
    np.testing.assert_allclose(
        cable.foot_pull + cable.head_pull, forces.sum(axis=1), atol=1e-13
    )
    np.testing.assert_array_equal(cable.curve[:, 0], 0.0)
    np.testing.assert_allclose(cable.curve[:, -1], HEAD, atol=1e-11)
    assert cable.tension.min() > 0.0


@pytest.mark.parametrize("n", [1, 2, 7])
def test_moment_of_the_whole_vanishes(n):
    """Exact: rotations are in the space, and T is along dx/dS where it is summed."""
    lengths = np.full(n, 1.1 / n)
    forces = random_pressure(5, lengths)
    cable = solve_funicular(forces, lengths, STIFFNESS, HEAD, ACROSS + HEAD)
    on_cable = forces.copy()
    on_cable[:, -1] -= cable.head_pull
    (x, y), (force_x, force_y) = cable.curve, on_cable
    assert float((x * force_y - y * force_x).sum()) == pytest.approx(0.0, abs=1e-11)


@pytest.mark.parametrize("start", [(1e-6, 0.0), (-5.0, -5.0), (0.0, 300.0)])
def test_result_does_not_depend_on_the_start(start):
    lengths = np.full(6, 1.05 / 6)
    forces = random_pressure(7, lengths)
    from_guess = solve_funicular(forces, lengths, STIFFNESS, HEAD, ACROSS + HEAD)
    other = solve_funicular(forces, lengths, STIFFNESS, HEAD, np.array(start))
    assert other.outcome is Outcome.CONVERGED
    np.testing.assert_allclose(other.curve, from_guess.curve, atol=1e-10)
    np.testing.assert_allclose(other.foot_pull, from_guess.foot_pull, rtol=1e-9)


def test_stretched_without_load_is_straight():
    """T = ES (chord / length - 1) in every element, pulls along the chord."""
    lengths = np.full(5, 0.9 / 5)
    cable = solve_funicular(np.zeros((2, 11)), lengths, STIFFNESS, HEAD, HEAD)
    tension = STIFFNESS * (1.0 / 0.9 - 1.0)
    np.testing.assert_allclose(cable.tension, tension, rtol=1e-10)
    np.testing.assert_allclose(cable.foot_pull, tension * HEAD, rtol=1e-10)
    np.testing.assert_allclose(cable.head_pull, -tension * HEAD, rtol=1e-10)
    np.testing.assert_allclose(
        cable.curve, np.outer(HEAD, np.linspace(0.0, 1.0, 11)), atol=1e-11
    )


def test_forces_at_the_ends_go_into_the_pulls():
    lengths = np.full(4, 1.02 / 4)
    forces = uniform_forces(ACROSS, lengths)
    plain = solve_funicular(forces, lengths, STIFFNESS, HEAD, ACROSS + HEAD)
    foot, head = np.array([0.3, -0.2]), np.array([-0.1, 0.4])
    forces[:, 0] += foot
    forces[:, -1] += head
    loaded = solve_funicular(forces, lengths, STIFFNESS, HEAD, ACROSS + HEAD)
    np.testing.assert_allclose(loaded.foot_pull - plain.foot_pull, foot, atol=1e-12)
    np.testing.assert_allclose(loaded.head_pull - plain.head_pull, head, atol=1e-12)
    np.testing.assert_allclose(loaded.curve, plain.curve, atol=1e-12)
