"""The net's own length, recovered from a coupled state."""

import numpy as np
import pytest

from tests.each import each

# Tension is taken constant over an edge of the net, of which it is the mean: second
# order in edges of an eighth of the height, in a stretch of a few per cent.
TOLERANCE = 3e-5


def unstressed_length(solution) -> float:
    """Sum over the net's edges of stretched length over 1 + T / ES."""
    stiffness = solution.scene.net.stiffness_per_m
    curve, forces = solution.net_curve, solution.net_forces
    points, weights = np.polynomial.legendre.leggauss(6)
    slopes = np.array([points - 0.5, -2 * points, points + 0.5])
    vector = np.array([solution.foot.x, solution.foot.y]) - forces[:, 0]
    total = 0.0
    for middle in range(1, curve.shape[1], 2):
        ds = np.hypot(*(curve[:, middle - 1 : middle + 2] @ slopes))
        loaded = middle < forces.shape[1]  # a free end above the snow is not
        half = forces[:, middle] / 2 if loaded else 0.0
        tension = np.hypot(*(vector - half))
        total += float((weights * ds).sum()) / (1.0 + tension / stiffness)
        if middle + 1 < forces.shape[1]:
            vector = vector - 2 * half - forces[:, middle + 1]
    return total


@each("slack", [0.0, 0.02, 0.08])
@each(
    "scene",
    [
        {},
        {"inclination_deg": 30.0, "friction_deg": 5.0},
        {"inclination_deg": 20.0, "height_m": 5.0},
        {"ground": "no-slip", "stiffness_kN_per_m": 4e3},
    ],
)
def test_net_keeps_its_unstressed_length(solved, scene, slack):
    solution = solved(**scene, slack=slack)
    net = solution.scene.net
    np.testing.assert_allclose(solution.net_curve[:, -1], net.head, atol=1e-9)
    chord = float(np.hypot(*net.head))
    expected = (1.0 + slack) * chord
    assert unstressed_length(solution) == pytest.approx(expected, rel=TOLERANCE)
