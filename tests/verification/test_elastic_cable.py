"""Cable solver against the exact elastic cable and a triangle of forces."""

import math

import numpy as np
from scipy.optimize import root

from netdesign.cable.funicular import solve_funicular
from netdesign.outcome import Outcome
from tests.each import each

STIFFNESS = 30.0


def uniform_forces(load, lengths):
    shares = np.zeros(2 * lengths.size + 1)
    shares[1::2] = 4.0 / 6.0 * lengths
    shares[:-1:2] += lengths / 6.0
    shares[2::2] += lengths / 6.0
    return np.outer(load, shares)


def elastic_cable(S, across, along, load, stiffness):
    """(C9) from any point: (x, y) at S, tension (H, V0 + q S), load along -y."""
    end = along + load * S
    x = across * S / stiffness + across / load * (
        np.arcsinh(end / across) - math.asinh(along / across)
    )
    y = (along * S + load * S**2 / 2) / stiffness + (
        np.hypot(across, end) - math.hypot(across, along)
    ) / load
    return np.array([x, y])


def exact_pull(head, length, load, stiffness):
    """Tension vector at the foot (H, V0) that ends the cable at the head; H > 0."""

    def gap(unknowns):
        across = math.exp(unknowns[0])
        return elastic_cable(length, across, unknowns[1], load, stiffness) - head

    solution = root(gap, [math.log(load), load * (head[1] - 0.5)], tol=1e-14)
    assert np.abs(gap(solution.x)).max() < 1e-12
    return np.array([math.exp(solution.x[0]), solution.x[1]])


@each("slack", [0.0, 0.05, 0.4])
@each("head", [(1.0, 0.0), (0.8, 0.6), (0.6, -0.8)])
def test_uniform_load_converges_to_the_exact_cable(head, slack):
    """Tension vectors are exact but for the pull, and that is of fourth order."""
    head, load, length = np.array(head), 5.0, 1.0 + slack
    foot = exact_pull(head, length, load, STIFFNESS)
    end = -(foot + np.array([0.0, load * length]))
    errors = []
    for n in (16, 32, 64):
        lengths = np.full(n, length / n)
        forces = uniform_forces([0.0, -load], lengths)
        cable = solve_funicular(forces, lengths, STIFFNESS, head, np.array([3.0, 0.1]))
        assert cable.outcome is Outcome.CONVERGED
        np.testing.assert_allclose(
            cable.head_pull - end, -(cable.foot_pull - foot), atol=1e-12
        )
        S = np.linspace(0.0, length, 2 * n + 1)
        exact = elastic_cable(S, *foot, load, STIFFNESS)
        errors.append(
            (np.hypot(*(cable.foot_pull - foot)), np.abs(cable.curve - exact).max())
        )
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders[-1, 0] >= 3.9
    assert orders[-1, 1] >= 3.8  # of midpoints as of vertices
    assert errors[-1][0] <= 1e-7 * load


@each("deflection", [0.01, 0.1, 0.5])
@each("place", [0.25, 0.5, 0.7])
def test_point_load_closes_a_triangle(place, deflection):
    """Two straight halves: choose the deflected node, find the load, solve back."""
    node, head = np.array([place, -deflection]), np.array([1.0, 0.0])
    legs = (node, head - node)
    unstressed = np.array([place, 1.0 - place]) * 0.98
    vectors = [
        STIFFNESS * (np.hypot(*leg) / rest - 1.0) * leg / np.hypot(*leg)
        for leg, rest in zip(legs, unstressed, strict=True)
    ]
    load = vectors[0] - vectors[1]
    forces = np.zeros((2, 5))
    forces[:, 2] = load
    cable = solve_funicular(forces, unstressed, STIFFNESS, head, vectors[0] * 1.5)
    assert cable.outcome is Outcome.CONVERGED
    np.testing.assert_allclose(cable.curve[:, 2], node, atol=1e-11)
    np.testing.assert_allclose(cable.foot_pull, vectors[0], atol=1e-9)
    np.testing.assert_allclose(cable.head_pull, -vectors[1], atol=1e-9)
    for k in range(2):
        np.testing.assert_allclose(
            cable.tension[:, k], np.hypot(*vectors[k]), rtol=1e-9
        )
