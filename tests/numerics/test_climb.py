"""Largest values over a box: ridges, kinks, flats, several peaks."""

import random

import numpy as np
import pytest

from netdesign.numerics.optimise import find_largest


def grid(*spans, parts=8):
    return [
        np.linspace(low, high, parts + 1) if low < high else np.array([low])
        for low, high in spans
    ]


def test_smooth_peaks_of_several_functions_at_once():
    draw = random.Random(4)
    peaks = np.array([[draw.uniform(-1.3, 2.1) for _ in range(3)] for _ in range(6)])
    sizes = np.array([[draw.uniform(0.3, 9.0)] for _ in range(6)])

    def hills(points):
        away = points[None, :, :] - peaks[:, :, None]
        return 7.0 - sizes * (away**2).sum(axis=1)

    axes = grid((-1.5, 2.2), (-1.4, 2.3), (-1.6, 2.4))
    found, values = find_largest(hills, axes)
    assert found.shape == (3, 6)
    assert np.abs(found.T - peaks).max() < 3e-3
    assert hills(found).diagonal().tolist() == values.tolist()
    assert values == pytest.approx(7.0, rel=1e-6)


@pytest.mark.parametrize("narrow", [3.0, 17.0, 60.0])
def test_ridge_that_rises_slowly_is_followed_to_its_end(narrow):
    """Across two axes, narrower than the grid."""

    def ridge(points):
        x, y = points
        across = y - 0.31 - 0.17 * x
        return (2.0 + 0.005 * x - narrow * across**2)[None]

    found, (value,) = find_largest(ridge, grid((0.0, 1.0), (-0.3, 1.9)))
    assert value == pytest.approx(2.005, rel=1e-5)
    assert found[:, 0] == pytest.approx([1.0, 0.48], abs=5e-3)


def test_higher_of_two_peaks_that_the_grid_takes_for_the_lower():
    """Narrow and high between the points, wide and lower at one of them."""

    def peaks(points):
        (x,) = points
        wide = 1.0 - 2.0 * (x - 0.25) ** 2
        narrow = 1.02 - 0.9 * np.abs(x - 0.81)
        return np.maximum(wide, narrow)[None]

    axes = grid((0.0, 1.0))
    assert peaks(axes)[0].argmax() == 2
    at = find_largest(peaks, axes)[0].item()
    assert at == pytest.approx(0.81, abs=0.005)


def test_kinks_flats_and_ends():
    def shapes(points):
        x, _, z = points
        return np.array(
            [
                -np.abs(x - 0.437) - np.abs(z - 2.91),  # a roof
                np.minimum(x, 0.613),  # flat from there on
                0.0 * x,  # flat
                -np.exp(x) + z,  # at a corner, below zero elsewhere
                -3.0 - x,
            ]
        )

    found, values = find_largest(shapes, grid((0.0, 1.0), (1.7, 1.7), (2.5, 3.3)))
    expected = [0.0, 0.613, 0.0, -1.0 + 3.3, -3.0]
    assert values == pytest.approx(expected, abs=2e-6)
    assert set(found[1]) == {1.7}
    assert found[:, 3] == pytest.approx([0.0, 1.7, 3.3], abs=1e-12)


def test_nothing_on_the_grid_is_larger_and_nothing_lies_outside():
    draw = random.Random(9)
    for _ in range(20):
        waves = [(draw.uniform(0.5, 14.0), draw.uniform(0.0, 6.0)) for _ in range(4)]

        def rough(points, waves=waves):
            x, y = points
            return np.array([np.sin(w * x + p) * np.cos(p * y - w) for w, p in waves])

        axes = grid((-0.7, 0.9), (0.2, 1.1))
        found, values = find_largest(rough, axes)
        highest = rough(np.array([one.ravel() for one in np.meshgrid(*axes)])).max(1)
        assert (values >= highest).all()
        for axis, places in zip(axes, found, strict=True):
            assert axis[0] <= places.min()
            assert places.max() <= axis[-1]
