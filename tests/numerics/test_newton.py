"""Damped Newton on convex functions whose minimisers are known."""

import numpy as np
import pytest

from netdesign.numerics.optimise import minimise_convex
from netdesign.outcome import Outcome


def quadratic(matrix, minimiser):
    return lambda point: (matrix @ (point - minimiser), matrix)


def hyperbola(point):
    """Gradient and Hessian of sqrt(1 + x^2): full Newton steps go to -x^3."""
    root = np.sqrt(1.0 + point**2)
    return point / root, np.diag(1.0 / root**3)


def test_quadratic_takes_one_step():
    matrix = np.array([[4.0, 1.0], [1.0, 3.0]])
    minimiser = np.array([2.0, -5.0])
    end = minimise_convex(quadratic(matrix, minimiser), np.zeros(2), tolerance=1e-12)
    assert end.outcome is Outcome.CONVERGED
    assert end.iterations == 1
    np.testing.assert_allclose(end.point, minimiser, rtol=1e-14)


@pytest.mark.parametrize("start", [0.5, 1.5, -10.0, 1e3])
def test_damping_where_full_steps_diverge(start):
    end = minimise_convex(hyperbola, np.array([start]), tolerance=1e-12)
    assert end.outcome is Outcome.CONVERGED
    assert abs(end.point[0]) <= 2e-12


def test_nonfinite_gradient_further_on_shortens_the_step():
    """A function defined below 2 only: the full step from 1.9 leaves its domain."""

    def barrier(point):
        if point[0] >= 2.0:
            return np.array([np.nan]), np.eye(1)
        gap = 2.0 - point
        return 1.0 / gap - 4.0, np.diag(1.0 / gap**2)

    end = minimise_convex(barrier, np.array([0.0]), tolerance=1e-12)
    assert end.outcome is Outcome.CONVERGED
    assert end.point[0] == pytest.approx(2.0 - 1.0 / 4.0, rel=1e-12)
