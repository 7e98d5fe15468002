"""Anderson mixing on maps whose fixed points are known."""

import numpy as np
import pytest

from netdesign.coupling.steady.rounds import mix_anderson

SHIFT = np.array([1.0, -2.0, 0.5])


def affine_map(matrix):
    return lambda point: matrix @ point + SHIFT


def iterate(image_of, rounds: int, depth: int = 12, damping: float = 1.0):
    points, images = [], []
    point = np.zeros(3)
    for _ in range(rounds):
        points.append(point)
        images.append(image_of(point))
        point = mix_anderson(points, images, depth=depth, damping=damping)
    return point


@pytest.mark.parametrize("factor", [0.9, 3.0])
@pytest.mark.parametrize("damping", [0.5, 1.0])
def test_affine_map_ends_in_one_round_more_than_unknowns(factor, damping):
    """Equivalent to GMRES: contracting or not, three unknowns need four rounds."""
    rng = np.random.default_rng(4)
    matrix = factor * rng.normal(size=(3, 3))
    fixed_point = np.linalg.solve(np.eye(3) - matrix, SHIFT)
    # differences of iterates are conditioned like the square of the matrix
    np.testing.assert_allclose(
        iterate(affine_map(matrix), 4, damping=damping), fixed_point, rtol=1e-8
    )


def test_secant_of_a_scalar():
    """With two entries: the zero of the line through both residuals."""
    x0, x1, g0, g1 = 1.0, 2.0, 3.0, 2.5
    r0, r1 = g0 - x0, g1 - x1
    expected = g1 - (g1 - g0) * r1 / (r1 - r0)
    mixed = mix_anderson(
        [np.array([x0]), np.array([x1])], [np.array([g0]), np.array([g1])]
    )
    assert mixed[0] == pytest.approx(expected, rel=1e-14)


def test_two_equal_iterates_do_not_break_it():
    """Without a difference to learn from it takes the damped step."""
    points = [np.zeros(3), np.zeros(3)]
    images = [SHIFT, SHIFT]
    for damping in (0.5, 1.0):
        mixed = mix_anderson(points, images, damping=damping)
        np.testing.assert_allclose(mixed, damping * SHIFT)
